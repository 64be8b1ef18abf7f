#!/bin/sh
# Measures error against run time again and writes docs/accuracy.md with its figures. Needs a build
# (jobscripts/build.sh) and an hour and a half on one core, and goes on where it was interrupted. With
# --quick: the coarsest levels only, a few minutes, nothing is written.
set -eu
case ${1-} in -h | --help) sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
cd "$(dirname "$0")/.."
. jobscripts/environment.sh
python=$(sed -n 's/^MPM_STUDY_PYTHON:FILEPATH=//p' build/CMakeCache.txt)
export PYTHONDONTWRITEBYTECODE=1
mode=--write
if [ "${1-}" = --quick ]; then mode=--quick; fi
for part in benchmarks honeycomb loblolly; do
  "$python" tests/accuracy/$part.py build/mpm_par "$mode"
done
if [ "$mode" = --quick ]; then exit 0; fi
"$python" tests/accuracy/figures.py
"$python" tests/accuracy/page.py

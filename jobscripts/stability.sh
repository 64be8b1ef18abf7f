#!/bin/sh
# Measures the stability atlas and the critical CFL again and writes docs/stability.md. Needs a build
# (jobscripts/build.sh). With --quick: only what the other tests run, nothing is written.
set -eu
case ${1-} in -h | --help) sed -n '2,3s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
cd "$(dirname "$0")/.."
. jobscripts/environment.sh
python=$(sed -n 's/^MPM_STABILITY_PYTHON:FILEPATH=//p' build/CMakeCache.txt)
export PYTHONDONTWRITEBYTECODE=1
if [ "${1-}" = --quick ]; then exec "$python" tests/stability/atlas.py build/mpm_par --quick; fi
worse=0
"$python" tests/stability/atlas.py build/mpm_par --csv tests/stability/stability.csv || worse=1
"$python" tests/stability/atlas.py build/mpm_par --long --csv tests/stability/stability.csv || worse=1
"$python" tests/stability/critical_cfl.py build/mpm_par --write
"$python" tests/stability/page.py
exit "$worse"

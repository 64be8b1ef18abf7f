#!/bin/sh
# Installs what is missing, builds and runs the tests. Arguments go to ctest:
#
#   sh jobscripts/test.sh                 all tests but those of the last four labels here
#   sh jobscripts/test.sh -L unit         those with the label unit
#   sh jobscripts/test.sh -R snapshot     those whose name contains snapshot
#   sh jobscripts/test.sh -L performance  does everything still measure? docs/building.md, Benchmarks
#   sh jobscripts/test.sh -L convergence  errors against exact solutions on four grids each
#   sh jobscripts/test.sh -L stability    stiff and extreme scenes with every method
#   sh jobscripts/test.sh -L long         the code of docs/contributing.md; many ranks; all wood
#
# The exit status is ctest's: 0 if every test passed. No test at all counts as a failure.
set -eu
case ${1-} in -h | --help) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
cd "$(dirname "$0")/.."

sh jobscripts/build.sh
. jobscripts/environment.sh
cd build
# Measuring wants the machine for itself, ladders and building anew take long: only where asked for by name.
case " $* " in *performance* | *convergence* | *stability* | *long*) ;;
  *) set -- -LE "performance|convergence|stability|long" "$@" ;; esac
exec ctest --output-on-failure --no-tests=error -j"$(nproc)" "$@"

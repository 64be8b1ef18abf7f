#!/bin/sh
# Installs what is missing, configures (Release, with tests) and builds into build/.
#
#   sh jobscripts/build.sh                    everything
#   sh jobscripts/build.sh --target mpm_par   the program alone: arguments go to `cmake --build`
set -eu
case ${1-} in -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
cd "$(dirname "$0")/.."

sh jobscripts/install_packages.sh

# A compiler job on Eigen templates takes up to 2 GiB: no more jobs than memory carries, where the
# limit of a container (cgroup version 2) counts as well as the machine's.
kib=$(awk '/^MemTotal:/ { print $2 }' /proc/meminfo)
limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || echo max)
if [ "$limit" != max ] && [ $((limit / 1024)) -lt "$kib" ]; then kib=$((limit / 1024)); fi
jobs=$((kib / 2097152))
cores=$(nproc)
if [ "$jobs" -gt "$cores" ]; then jobs=$cores; fi
if [ "$jobs" -lt 1 ]; then jobs=1; fi

cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DMPM_BUILD_TESTS=ON
cmake --build build -j"$jobs" "$@"

#!/bin/sh
# From a fresh clone to a crushed piece of pine: installs what is missing, builds, runs the radial
# compression of a loblolly pine micrograph on 2 ranks with the total Lagrangian step, which the scene
# names (some minutes), and leaves a report: stress-strain curve, pictures and film on one page.
#
#   sh jobscripts/quickstart.sh
#
# From any folder, as root or as a user with sudo; a second call only repeats the run.
# Everything it makes is in build/ and results/loblolly_radial/.
set -eu
case ${1-} in
  '') ;;
  -h | --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) echo "quickstart.sh: takes no argument, got '$1'. See --help." >&2; exit 2 ;;
esac
cd "$(dirname "$0")/.."

name=loblolly_radial
results=results/$name
step() { printf '\n== %s\n' "$1"; }

step "Build"
sh jobscripts/build.sh --target mpm_par mpm_curve draw_wood

step "Run inputs/wood/$name.yaml on 2 ranks"
. jobscripts/environment.sh
mpirun -n 2 build/mpm_par --overwrite --report "inputs/wood/$name.yaml"

step "Result, in $PWD"
if [ -f "$results/report.html" ]; then
  printf '  %-24s%s\n' "report, for a browser" "$results/report.html"
fi
printf '  %-24s%s\n' "stress and strain" "$results/history.csv"
printf '  %-24s%s\n' "for ParaView" "$results/$name.xdmf"

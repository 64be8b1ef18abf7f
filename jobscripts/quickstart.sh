#!/bin/sh
# From a fresh clone to a crushed piece of pine: installs what is missing, builds, runs the radial
# compression of a loblolly pine micrograph on 2 ranks with the total Lagrangian step, which the scene
# names (some minutes), draws the stress-strain curve and pictures.
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
draw() {
  xvfb-run -a pvbatch --force-offscreen-rendering jobscripts/paraview_frames.py \
    "$results/$name.xdmf" --strain 5% 17% 29% 46% 60%
}
step() { printf '\n== %s\n' "$1"; }

step "Build"
sh jobscripts/build.sh --target mpm_par

step "Run inputs/wood/$name.yaml on 2 ranks"
. jobscripts/environment.sh
mpirun -n 2 build/mpm_par --overwrite "inputs/wood/$name.yaml"

step "Pictures"
pictures=
if command -v pvbatch >/dev/null && command -v xvfb-run >/dev/null; then
  # xvfb-run sometimes takes a display that is just being closed: a second try then helps.
  if draw || { sleep 2; draw; }; then
    pictures=$(find "$results" -name '*.png' ! -name curve.png | sort)
  else
    echo "quickstart.sh: ParaView could not draw; the run itself is complete." >&2
  fi
else
  echo "pvbatch or xvfb-run is not here: no pictures (packages python3-paraview xvfb xauth)."
fi

step "Result, in $PWD"
# Matplotlib is installed for the system's python3, which need not be the first in PATH.
python=python3
if ! $python -c 'import matplotlib' 2>/dev/null; then python=/usr/bin/python3; fi
$python jobscripts/plot_curve.py "$results/history.csv" ||
  echo "quickstart.sh: no curve drawn; its numbers are in $results/history.csv." >&2
printf '  %-24s%s\n' "stress and strain" "$results/history.csv"
printf '  %-24s%s\n' "for ParaView" "$results/$name.xdmf"
for picture in $pictures; do printf '  %-24s%s\n' picture "$picture"; done

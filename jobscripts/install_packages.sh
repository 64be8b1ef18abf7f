#!/bin/sh
# Installs the packages that mpm_par is built, tested and drawn with, and only those that are missing:
# where nothing is missing it neither needs rights nor touches the network.
#
#   sh jobscripts/install_packages.sh                     everything
#   sh jobscripts/install_packages.sh --without-pictures  no ParaView, no Matplotlib (240 MB less), and
#                                                         nothing that makes and checks the documentation
#   sh jobscripts/install_packages.sh --with-benchmarks   also what -DMPM_BUILD_BENCHMARKS=ON needs
#   sh jobscripts/install_packages.sh --with-slurm        also a Slurm, for the test of the jobscripts
#   sh jobscripts/install_packages.sh --list              print the names and stop
#
# Debian 12 and 13, Ubuntu 24.04. Elsewhere: docs/building.md names the libraries.
set -eu

build_packages="g++ make cmake pkg-config ca-certificates python3 dpkg-dev file
  petsc-dev libhdf5-openmpi-dev libmetis-dev libeigen3-dev libgtest-dev libgmock-dev
  libyaml-cpp-dev libcli11-dev libspdlog-dev libfmt-dev libpugixml-dev nlohmann-json3-dev
  libudunits2-dev libmuparser-dev libstb-dev libtiff-dev zlib1g-dev"
picture_packages="python3-yaml python3-numpy python3-scipy python3-h5py python3-pil python3-matplotlib python3-paraview
  xvfb xauth libgl1-mesa-dri"
documentation_packages="python3-sphinx python3-myst-parser furo python3-jsonschema"
benchmark_packages="libbenchmark-dev valgrind"
slurm_packages="slurm-wlm munge"

pictures=yes
for option in "$@"; do
  case $option in
    --without-pictures) pictures=no ;;
    --with-benchmarks) build_packages="$build_packages $benchmark_packages" ;;
    --with-slurm) build_packages="$build_packages $slurm_packages" ;;
    --list)
      for list in "$build_packages" "$picture_packages" "$documentation_packages" "$benchmark_packages" \
        "$slurm_packages"; do echo $list; done
      exit 0
      ;;
    -h | --help) sed -n '2,12s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "install_packages.sh: unknown option '$option'. See --help." >&2; exit 2 ;;
  esac
done

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "install_packages.sh: no apt-get here, so nothing is installed. Needed by other means" \
    "(cluster modules, spack, dnf): a C++20 compiler, CMake 3.22, pkg-config, MPI, PETSc 3.15," \
    "HDF5 1.10 built with MPI, METIS, Eigen 3.3, yaml-cpp, CLI11, fmt, spdlog, pugixml," \
    "nlohmann-json, udunits2, muParser, libtiff, zlib, stb and GoogleTest. See docs/building.md." >&2
  exit 1
fi

missing_of() {
  for package in "$@"; do
    # A removed package whose settings stay behind is known to dpkg, but not "installed".
    status=$(dpkg-query -W -f '${db:Status-Status} ' "$package" 2>/dev/null) || status=
    case " $status" in *" installed "*) ;; *) printf '%s ' "$package" ;; esac
  done
}

missing_build=$(missing_of $build_packages)
missing_pictures=
if [ $pictures = yes ]; then
  missing_pictures=$(missing_of $picture_packages $documentation_packages)
fi
if [ -z "$missing_build$missing_pictures" ]; then
  echo "All packages are installed."
  exit 0
fi

if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "install_packages.sh: missing $missing_build$missing_pictures" >&2
  echo "install_packages.sh: installing needs root or sudo, and this account has neither." \
    "Ask an administrator for the packages above, or see docs/building.md." >&2
  exit 1
fi

apt() { $as_root env DEBIAN_FRONTEND=noninteractive apt-get "$@"; }

echo "Installing: $missing_build$missing_pictures"
# One list of a foreign source may be out of reach without harm: installing is what has to work.
apt update || echo "install_packages.sh: the package lists are not all up to date; going on." >&2
if [ -n "$missing_build" ]; then apt install -y --no-install-recommends $missing_build; fi
if [ -n "$missing_pictures" ] && ! apt install -y --no-install-recommends $missing_pictures; then
  echo "install_packages.sh: could not install $missing_pictures- the program builds and runs," \
    "but draws no pictures, makes no documentation and skips their tests (--without-pictures does not" \
    "try)." >&2
fi

#!/bin/sh
# Makes the pages of docs/ into HTML, to be read without a network. What is wrong with a page, such as a
# link that leads nowhere, is an error.
#
#   sh jobscripts/docs.sh            into build/docs/html
#   sh jobscripts/docs.sh FOLDER     into FOLDER/html
#
# Exit status: 0; 1 if a page is wrong; 2 if Sphinx, MyST or the theme is missing.
set -eu
case ${1-} in -h | --help) sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
folder=${1-"$(dirname "$0")/../build/docs"}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$(dirname "$0")/.."

# Debian's packages serve the system's python3, which need not be the first in PATH.
for python in python3 /usr/bin/python3 none; do
  if [ $python = none ]; then
    echo "docs.sh: no Python with sphinx, myst_parser and furo." \
      "Run sh jobscripts/install_packages.sh." >&2
    exit 2
  fi
  if $python -c 'import sphinx, myst_parser, furo' 2>/dev/null; then break; fi
done
PYTHONDONTWRITEBYTECODE=1 $python -m sphinx -q -W --keep-going -b html -d "$folder/doctrees" \
  docs "$folder/html" || exit 1
echo "$folder/html/index.html"

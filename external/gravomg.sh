#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Gravo MG into a virtual environment, because no Debian package has it: gravomg.sh FOLDER
#
# It has packages for some Pythons only, and they crash with NumPy 2.
set -euo pipefail

folder=${1:?usage: gravomg.sh FOLDER} release=0.0.4
"$(dirname "$0")/install_debian.sh" gravomg
/usr/bin/python3 -m venv "$folder"
"$folder/bin/python" -m pip install -q --only-binary :all: "gravomg==$release" "numpy<2"

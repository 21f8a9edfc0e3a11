#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the official PyMeshLab into a virtual environment, because no Debian package has it:
# pymeshlab.sh FOLDER
#
# FOLDER/bin/python then also has NumPy and Matplotlib from Debian.
set -euo pipefail

folder=${1:?usage: pymeshlab.sh FOLDER} release=2025.7
"$(dirname "$0")/install_debian.sh" pymeshlab
/usr/bin/python3 -m venv --system-site-packages "$folder"
"$folder/bin/python" -m pip install -q "pymeshlab==$release.*"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Python package tracked_mcf into a virtual environment, which is made if it is missing and then has
# Debian's packages, too: python_package.sh FOLDER [BUILD_DIR]
#
# BUILD_DIR is a build folder of this project, whose core the package then uses. CMake's options stay there.
set -euo pipefail

folder=${1:?usage: python_package.sh FOLDER [BUILD_DIR]} build=${2:+$(realpath "$2")}
here=$(dirname "$0")
"$here/install_debian.sh" python
[ -x "$folder/bin/python" ] || /usr/bin/python3 -m venv --system-site-packages "$folder"
install=("$folder/bin/python" -m pip install -q) package=$here/../filter_tracked_mcf/hosts/python
if [ -z "$build" ]; then
    "${install[@]}" "$package"
    exit
fi
# The environments in which pip builds have new paths each time. scikit-build-core would make everything again.
"${install[@]}" scikit-build-core nanobind
settings=(--config-settings "build-dir=$build"
    --config-settings "build.targets=tracked_mcf_python")
for part in TOOL PLUGIN TESTS; do
    value=$(sed -n "s/^TRACKED_MCF_$part:BOOL=//p" "$build/CMakeCache.txt")
    settings+=(--config-settings "cmake.define.TRACKED_MCF_$part=$value")
done
CMAKE_GENERATOR=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
export CMAKE_GENERATOR
"${install[@]}" --no-build-isolation "${settings[@]}" "$package"

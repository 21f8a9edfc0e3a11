#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Zig, whose Clang compiles for macOS and for older Linux, into a virtual environment, because no Debian
# package has it: zig.sh FOLDER
#
# The compiler is then FOLDER/zig (toolchains/zig.cmake).
set -euo pipefail

folder=${1:?usage: zig.sh FOLDER}
"$(dirname "$0")/install_debian.sh" zig
/usr/bin/python3 -m venv "$folder"
"$folder/bin/python" -m pip install -q 'ziglang==0.17.*'
ln -sf "$("$folder/bin/python" -c 'import os, ziglang; print(os.path.dirname(ziglang.__file__))')/zig" "$folder/zig"

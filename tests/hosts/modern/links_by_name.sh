#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that a plugin lists libmeshlab-common as a needed library: links_by_name.sh PLUGIN
#
# Otherwise PyMeshLab does not find the type information of the plugin's base classes.
set -euo pipefail
readelf -d "$1" | grep 'NEEDED.*\[libmeshlab-common.so\]'

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that a plugin exports only what Qt looks up, so that two builds of it in one MeshLab share
# nothing: exports.sh PLUGIN
set -euo pipefail

exported=$(nm --dynamic --defined-only --format=posix "$1" | cut -d ' ' -f 1)
grep -qx qt_plugin_instance <<< "$exported"
! grep -v '^qt_plugin_' <<< "$exported"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the filter in meshlabserver, with the arguments of apply_filter after PREFIX:
# smooth.sh PREFIX IN OUT [NAME=VALUE]...
#
# Prints the host's log. After a failure, the log has the filter's message.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 in=$2 out=$3
script=$(mktemp --suffix=.mlx)
trap 'rm -f "$script"' EXIT
"$here/flow_script.sh" "${@:4}" > "$script"
"$prefix/bin/meshlabserver" -i "$in" -s "$script" -o "$out" 2>&1

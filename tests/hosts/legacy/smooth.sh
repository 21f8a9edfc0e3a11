#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a filter in meshlabserver, with the arguments of apply_filter after PREFIX:
# smooth.sh PREFIX FILTER IN OUT [NAME=VALUE]...
#
# Prints the host's log. After a failure, the log has the filter's message.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 filter=$2 in=$3 out=$4
script=$(mktemp --suffix=.mlx)
trap 'rm -f "$script"' EXIT
"$here/flow_script.sh" --filter "$filter" "${@:5}" > "$script"
"$prefix/bin/meshlabserver" -i "$in" -s "$script" -o "$out" -m vq 2>&1

#!/usr/bin/env bash
# Runs the filter in stock meshlabserver, as apply_filter does without a display:
# smooth.sh PREFIX IN OUT [NAME=VALUE]...
#
# Prints the host's log; a failure has the filter's message in it.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 in=$2 out=$3
script=$(mktemp --suffix=.mlx)
trap 'rm -f "$script"' EXIT
"$here/flow_script.sh" "${@:4}" > "$script"
"$prefix/bin/meshlabserver" -i "$in" -s "$script" -o "$out" 2>&1

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints a MeshLab script that runs a filter: flow_script.sh [--filter NAME] [--select CONDITION] [NAME=VALUE]...
# It is the script of the plugin's page, with other values. The value of a choice is its index. The filter is Mean
# Curvature Flow by default.
# With --select, MeshLab's "Conditional Face Selection" first selects the faces of a condition such as
# 'fnz > 0'.
set -euo pipefail

page=$(dirname "$(realpath "$0")")/../../../filter_tracked_mcf/hosts/meshlab/README.md
name="Mean Curvature Flow"
[ "${1:-}" != --filter ] || { name=$2 && shift 2; }
filter=$(sed -n "/^ <filter name=\"$name\">\$/,/^ <\/filter>\$/p" "$page")
condition=
set_value() { # NAME VALUE
    grep -q "name=\"$1\"" <<< "$filter" || { echo "flow_script.sh: no parameter $1" >&2 && exit 1; }
    filter=$(sed "s/\(name=\"$1\" value=\)\"[^\"]*\"/\1\"$2\"/" <<< "$filter")
}
if [ "${1:-}" = --select ]; then
    condition=$(sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g' <<< "$2")
    set_value selected true
    shift 2
fi
for setting in "$@"; do
    set_value "${setting%%=*}" "${setting#*=}"
done

cat << XML
<!DOCTYPE FilterScript>
<FilterScript>
XML
[ -z "$condition" ] || cat << XML
 <filter name="Conditional Face Selection">
  <Param type="RichString" name="condSelect" value="$condition"/>
 </filter>
XML
echo "$filter"
echo "</FilterScript>"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints a MeshLab script that runs the filter: flow_script.sh [--select CONDITION] [NAME=VALUE]...
# Other parameters have the filter's defaults. The value of a choice is its index: order=1 is order 2.
# With --select, MeshLab's "Conditional Face Selection" first selects the faces of a condition such as
# 'fnz > 0'.
set -euo pipefail

declare -A is=([detail_size]=0 [local_detail_size]=false [iterations]=3 [order]=0 [preserve]=0
    [boundary]=0 [selected]=false [quality]=0 [step_size]=0 [absolute]=false [depth]=0 [flow]=0 [separate_sheets]=true [solver]=0)
condition=
if [ "${1:-}" = --select ]; then
    condition=$(sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g' <<< "$2")
    is[selected]=true
    shift 2
fi
for setting in "$@"; do
    [ -v "is[${setting%%=*}]" ] || { echo "flow_script.sh: no parameter $setting" >&2 && exit 1; }
    is[${setting%%=*}]=${setting#*=}
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
cat << XML
 <filter name="Mean Curvature Flow">
  <Param type="RichAbsPerc" name="detail_size" value="${is[detail_size]}" min="0" max="1"/>
  <Param type="RichBool" name="local_detail_size" value="${is[local_detail_size]}"/>
  <Param type="RichInt" name="iterations" value="${is[iterations]}"/>
  <Param type="RichEnum" name="order" value="${is[order]}" enum_cardinality="4"
         enum_val0="Flow (order 1)" enum_val1="Kept (order 2)" enum_val2="Kept better (order 3)"
         enum_val3="Kept best (order 4)"/>
  <Param type="RichEnum" name="preserve" value="${is[preserve]}" enum_cardinality="3"
         enum_val0="None" enum_val1="Area" enum_val2="Volume"/>
  <Param type="RichEnum" name="boundary" value="${is[boundary]}" enum_cardinality="3"
         enum_val0="Locked" enum_val1="Locked cells (paper)" enum_val2="Free"/>
  <Param type="RichBool" name="selected" value="${is[selected]}"/>
  <Param type="RichEnum" name="quality" value="${is[quality]}" enum_cardinality="3"
         enum_val0="Kept" enum_val1="Displacement" enum_val2="Mean curvature"/>
  <Param type="RichFloat" name="step_size" value="${is[step_size]}"/>
  <Param type="RichBool" name="absolute" value="${is[absolute]}"/>
  <Param type="RichInt" name="depth" value="${is[depth]}"/>
  <Param type="RichEnum" name="flow" value="${is[flow]}" enum_cardinality="2"
         enum_val0="Mean curvature" enum_val1="Conformalized"/>
  <Param type="RichBool" name="separate_sheets" value="${is[separate_sheets]}"/>
  <Param type="RichEnum" name="solver" value="${is[solver]}" enum_cardinality="2"
         enum_val0="Converged" enum_val1="One W-cycle (paper)"/>
 </filter>
</FilterScript>
XML

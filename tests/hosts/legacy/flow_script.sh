#!/usr/bin/env bash
# Prints a MeshLab script that runs the filter: flow_script.sh [--select CONDITION] [NAME=VALUE]...
# with the filter's defaults for parameters that are not named; a choice's value is its index. With
# --select, MeshLab's "Conditional Face Selection" selects faces before, such as 'fnz > 0'.
set -euo pipefail

declare -A is=([depth]=0 [step_size]=1e-05 [absolute]=false [iterations]=10 [flow]=0 [boundary]=0
    [selected]=false [rescale]=0 [separate_sheets]=true [solver]=0)
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
  <Param type="RichInt" name="depth" value="${is[depth]}"/>
  <Param type="RichFloat" name="step_size" value="${is[step_size]}"/>
  <Param type="RichBool" name="absolute" value="${is[absolute]}"/>
  <Param type="RichInt" name="iterations" value="${is[iterations]}"/>
  <Param type="RichEnum" name="flow" value="${is[flow]}" enum_cardinality="2"
         enum_val0="Mean curvature" enum_val1="Conformalized"/>
  <Param type="RichEnum" name="boundary" value="${is[boundary]}" enum_cardinality="3"
         enum_val0="Locked" enum_val1="Locked cells (paper)" enum_val2="Free"/>
  <Param type="RichBool" name="selected" value="${is[selected]}"/>
  <Param type="RichEnum" name="rescale" value="${is[rescale]}" enum_cardinality="3"
         enum_val0="None" enum_val1="Keep area" enum_val2="Keep volume"/>
  <Param type="RichBool" name="separate_sheets" value="${is[separate_sheets]}"/>
  <Param type="RichEnum" name="solver" value="${is[solver]}" enum_cardinality="2"
         enum_val0="Converged" enum_val1="One W-cycle (paper)"/>
 </filter>
</FilterScript>
XML

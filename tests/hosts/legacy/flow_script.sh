#!/usr/bin/env bash
# Prints a MeshLab script that runs the filter: flow_script.sh DEPTH STEP_SIZE ITERATIONS BOUNDARY
# with BOUNDARY the index of the choice.
set -euo pipefail

cat << XML
<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Mean Curvature Flow">
  <Param type="RichInt" name="depth" value="$1"/>
  <Param type="RichFloat" name="step_size" value="$2"/>
  <Param type="RichInt" name="iterations" value="$3"/>
  <Param type="RichEnum" name="boundary" value="$4" enum_cardinality="2"
         enum_val0="Locked cells" enum_val1="Free"/>
 </filter>
</FilterScript>
XML

#!/usr/bin/env bash
# Prints a MeshLab script that runs the filter:
# flow_script.sh DEPTH STEP_SIZE ITERATIONS BOUNDARY [SEPARATE_SHEETS [SOLVER]]
# with the index of the choice for BOUNDARY and SOLVER, and true (the default) or false for
# SEPARATE_SHEETS.
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
  <Param type="RichBool" name="separate_sheets" value="${5:-true}"/>
  <Param type="RichEnum" name="solver" value="${6:-0}" enum_cardinality="2"
         enum_val0="Converged" enum_val1="One W-cycle (paper)"/>
 </filter>
</FilterScript>
XML

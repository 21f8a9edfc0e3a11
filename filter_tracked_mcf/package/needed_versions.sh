#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the library versions that binaries need: for each set of symbol versions, such as GLIBC,
# GLIBCXX or Qt, the largest version that any of the files needs: needed_versions.sh FILE...
set -euo pipefail

[ $# -gt 0 ] || { sed -n '3,4s/^# \{0,1\}//p' "$0" >&2 && exit 2; }
# The part after the last underscore is the version.
needs=$(LC_ALL=C readelf --version-info --wide "$@" |
    sed -n '/^Version needs section/,/^$/s/.* Name: \([^ ]*\)_\([^ _]*\) .*/\1 \2/p')
[ -n "$needs" ] || { echo "needed_versions.sh: no versions of symbols in $*" >&2 && exit 1; }
LC_ALL=C sort -k1,1 -k2,2V <<< "$needs" |
    awk '{ largest[$1] = $1 "_" $2 } END { for (set in largest) print largest[set] }' |
    LC_ALL=C sort

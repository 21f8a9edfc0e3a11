#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that the kernels' object files share no code: kernel_symbols.sh <nm> <namespace> <object file>...
# If several files define a function, the linker keeps any one of them. If it keeps one for AVX-512,
# other files call it on processors without AVX-512. So no symbol may be weak, and every global symbol
# must be in the namespace.
set -euo pipefail
nm=$1
namespace=$2
shift 2

shared=$("$nm" --defined-only --demangle "$@" |
    awk -v namespace="tracked_mcf::$namespace::" '
        NF < 3 { next }
        { name = $0; sub(/^[^ ]+ [^ ]+ /, "", name) }
        $2 ~ /^[uvVwW]$/ || ($2 ~ /^[A-Z]$/ && index(name, namespace) != 1)')
if [ -n "$shared" ]; then
    printf 'These symbols are not in %s, or are weak:\n%s\n' "$namespace" "$shared"
    exit 1
fi

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that the kernels' object files share no code: kernel_symbols.sh <nm> <object file>...
# If several files define a function, the linker keeps any one of them. If it keeps one for AVX2,
# other files call it on processors without AVX2. So no symbol may be weak, and every global symbol
# must be in the namespace of an instruction set.
set -euo pipefail
nm=$1
shift

shared=$("$nm" --defined-only --demangle "$@" |
    awk '
        NF < 3 { next }
        { name = $0; sub(/^[^ ]+ [^ ]+ /, "", name) }
        $2 ~ /^[uvVwW]$/ || ($2 ~ /^[A-Z]$/ && name !~ /^tracked_mcf::N_[A-Z0-9_]+::/)')
if [ -n "$shared" ]; then
    printf 'These symbols are weak, or in no namespace of an instruction set:\n%s\n' "$shared"
    exit 1
fi

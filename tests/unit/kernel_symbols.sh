#!/usr/bin/env bash
# That the kernels' object files share no code: kernel_symbols.sh <nm> <namespace> <object file>...
# Of a function that several files define, the linker keeps any: were it one for AVX-512, others
# would call it on processors that lack AVX-512. So nothing may be weak, and what other files can see
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
    printf 'These are not for %s alone:\n%s\n' "$namespace" "$shared"
    exit 1
fi

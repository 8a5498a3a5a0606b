#!/usr/bin/env bash
# clang-tidy on every source of native/, after a configured build in BUILD. Ends with 1 if it finds anything.
# The analyzer's checks take five times as long as all others: ANALYZER=1 adds them.
# Usage: scripts/clang_tidy.sh BUILD [FILE ...]
set -euo pipefail
cd "$(dirname "$0")/.."

build=$1
shift
files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(find native -name '*.cpp' | sort)
checks=-clang-analyzer-*
[ -z "${ANALYZER:-}" ] || checks=clang-analyzer-*
# The compile commands are gcc's; clang finds omp.h elsewhere.
printf '%s\0' "${files[@]}" | xargs -0 -n 4 -P "$(nproc)" \
    clang-tidy -p "$build" --quiet --checks="$checks" --warnings-as-errors='*' \
    --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-isystem --extra-arg="$PWD/tests/fuzz/clang" 2> >(grep -vE '^[0-9]+ warnings?( and [0-9]+ errors?)? generated\.$|^Suppressed|^Use -header-filter' >&2)

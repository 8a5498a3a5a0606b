#!/usr/bin/env bash
# Fuzz for so many seconds in all, a quarter of them each target. Ends with 1 if there is a finding.
# Usage: scripts/fuzz.sh BUILD SECONDS [SEED]
# Without a seed, each run has another one and adds to the corpus in BUILD. With one, it starts from the kept inputs alone
# and tries as many as take about so long: the same ones on a slow machine and on a fast one.
set -euo pipefail
cd "$(dirname "$0")/.."

build=$1 total=$2 seed=${3:-0}
targets=(uniformize arrays domains read)
declare -A per_minute=([uniformize]=450 [arrays]=9000 [domains]=150 [read]=75000)  # about, of a minute for all four
each=$(((total + ${#targets[@]} - 1) / ${#targets[@]}))
found=0
fresh=$(mktemp -d)
trap 'rm -rf "$fresh"' EXIT

export ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1
for target in "${targets[@]}"; do
    corpus=$build/corpus/$target findings=$build/findings/$target
    [ "$seed" = 0 ] || corpus=$fresh/$target
    mkdir -p "$corpus" "$findings"
    kept=()
    for folder in tests/fuzz/corpus/$target tests/fuzz/findings/$target; do
        [ ! -d "$folder" ] || kept+=("$folder")
    done
    words=(-max_total_time="$each")
    [ "$seed" = 0 ] || words=(-runs=$((per_minute[$target] * total / 60)))
    [ ! -f "tests/fuzz/$target.dict" ] || words+=(-dict="tests/fuzz/$target.dict")
    log=$build/$target.log
    # An input is too slow from five minutes on: the sanitizers and busy machines take their share.
    if "$build/tests/fuzz/fuzz_$target" -seed="$seed" -timeout=300 -report_slow_units=300 \
        -rss_limit_mb=4096 -max_len="$([ "$target" = read ] && echo 600 || echo 302)" -print_final_stats=1 \
        "${words[@]}" -artifact_prefix="$findings/" "$corpus" "${kept[@]}" >"$log" 2>&1; then
        runs=$(sed -n "s/^stat::number_of_executed_units: *//p" "$log" | tail -n 1)
        echo "fuzz $target: ${runs:-0} inputs, no finding"
    else
        found=1
        echo "fuzz $target: a finding"
        tail -n 60 "$log"
    fi
done
[ $found = 0 ] || echo "Findings are in $build/findings; replay one with $build/tests/fuzz/koebe_fuzz run TARGET FILE" >&2
exit $found

#!/usr/bin/env bash
# clang-tidy on every source of native/ that is built on this system, after a configured build in BUILD. Ends with 1 if it finds anything.
# The analyzer's checks take five times as long as all others: ANALYZER=1 adds them.
# Usage: scripts/clang_tidy.sh BUILD [FILE ...]      SHARE=2/7 takes every seventh file of all, from the third on
set -euo pipefail
cd "$(dirname "$0")/.."

build=$1
shift
files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(python3 - "$build" <<'PYTHON'
import json, os, pathlib, sys
here = pathlib.Path.cwd()
names = {entry["file"] for entry in json.loads(pathlib.Path(sys.argv[1], "compile_commands.json").read_text())}
files = sorted(name for name in names if name.startswith(f"{here}/native/"))
first, step = map(int, (os.environ.get("SHARE") or "0/1").split("/"))
print(*files[first::step], sep="\n")
PYTHON
)
checks="-clang-analyzer-*"
[ -z "${ANALYZER:-}" ] || checks="clang-analyzer-*"
printf '%s\0' "${files[@]}" | xargs -0 -n 4 -P "$(nproc)" \
    clang-tidy -p "$build" --quiet --checks="$checks" --warnings-as-errors='*' \
    --extra-arg=-Wno-ignored-optimization-argument --extra-arg=-Wreserved-identifier \
    --extra-arg=-Wzero-as-null-pointer-constant 2> >(grep -vE '^[0-9]+ warnings?( and [0-9]+ errors?)? generated\.$|^Suppressed|^Use -header-filter' >&2)

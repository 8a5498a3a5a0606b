#!/usr/bin/env bash
# Pack the wheel of the package `koebe` for one Python of this machine.
# Usage: scripts/wheel.sh VENV OUT_FOLDER        VENV: a virtual environment with pybind11, after `make native`
set -euo pipefail
cd "$(dirname "$0")/.."

python=$(realpath --no-symlinks "$1")/bin/python
out=$2
build=build
# Another Python than the build's gets a module of its own on the same library.
if ! grep -q "^Python_EXECUTABLE:.*=$python\$" build/CMakeCache.txt; then
    build=build/wheel-$(basename "$1")
    cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DKOEBE_CORE_LIBRARY="$PWD/build/native/libkoebe.a" \
        -DKOEBE_BUILD_CLI=OFF -DKOEBE_BUILD_TESTS=OFF \
        -DPython_EXECUTABLE="$python" -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)"
    cmake --build "$build" --target _koebe
fi
read -r tag suffix < <("$python" -c 'import sys, sysconfig
tag = "cp{}{}".format(*sys.version_info)
print(f"{tag}-{tag}-{sysconfig.get_platform().translate({45: 95, 46: 95})}", sysconfig.get_config_var("EXT_SUFFIX"))')
rm -f "$out"/koebe-*-"${tag%-*}"-*.whl
python3 scripts/pack_wheel.py local "$build/python/koebe/_koebe$suffix" build/koebe "$tag" "$out"

#!/usr/bin/env bash
# Build the wheels of one or more platforms from pinned sources, cross compiling, each for all Pythons: dist/*.whl
# Usage: PYTHONS="3.10 3.14" scripts/dist.sh VENV PLATFORM...
#        PLATFORM: linux-x64 linux-arm64 windows-x64 macos-arm64 macos-x64
#        VENV: a virtual environment with native/bundle/requirements.txt
set -euo pipefail
cd "$(dirname "$0")/.."

venv=$(realpath "$1")
shift
declare -A targets=(
    [linux-x64]="x86_64-linux-gnu.2.28 manylinux_2_28_x86_64"
    [linux-arm64]="aarch64-linux-gnu.2.28 manylinux_2_28_aarch64"
    [windows-x64]="x86_64-windows-gnu win_amd64"
    [macos-arm64]="aarch64-macos.11.0 macosx_11_0_arm64"
    [macos-x64]="x86_64-macos.11.0 macosx_11_0_x86_64"
)

declare -A systems=([linux]=linux [windows]=windows [macos]=macosx) # in Maven's words
mapfile -t fetched < <(for platform in "$@"; do echo "${systems[${platform%-*}]}"; done | sort -u)
scripts/fetch_sources.sh "${fetched[@]}"
packages=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
export ZIG_GLOBAL_CACHE_DIR="${ZIG_GLOBAL_CACHE_DIR:-$PWD/build/zig-cache}"

# The first link for a target compiles the compiler's own C and C++ libraries, for ten minutes and without a word.
tell_of_libraries() {
    local before now
    before=$(count_of_objects)
    while sleep "${TELL_SECONDS:-15}"; do
        now=$(count_of_objects)
        [ "$now" -eq "$before" ] ||
            echo "make dist: $platform: the compiler's own libraries, once for all builds: $now files after $SECONDS s"
        before=$now
    done
}

# Without the folder, or where a file goes while it is counted, find fails: that must end nothing.
count_of_objects() {
    { find "$ZIG_GLOBAL_CACHE_DIR/o" -name '*.o' 2>/dev/null || true; } | wc -l
}

stop_telling() {
    kill "$teller" 2>/dev/null || true
}

for platform in "$@"; do
    read -r target tag <<<"${targets[$platform]?no such platform}"
    folder=build/dist-$platform
    tell_of_libraries &
    teller=$!
    trap stop_telling EXIT
    cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DKOEBE_BUNDLE=ON -DKOEBE_TARGET="$target" \
        -DCMAKE_TOOLCHAIN_FILE="$PWD/native/bundle/zig.cmake" -DKOEBE_ZIG="$packages/ziglang/zig" \
        -Dpybind11_include="$packages/pybind11/include" \
        -DKOEBE_PYTHONS="${PYTHONS// /;}" -DKOEBE_BUILD_TESTS=OFF -DKOEBE_BUILD_BENCH=OFF
    rm -f "$folder"/koebe/_koebe.* # of Pythons that are not wanted now
    cmake --build "$folder"
    stop_telling
    "$venv/bin/python" scripts/pack_wheel.py bundle "$folder" "py3-none-$tag" dist
done

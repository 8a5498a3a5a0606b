#!/usr/bin/env bash
# Build the page for browsers: the command in WebAssembly and what stands around it, a folder of static files.
# Usage: scripts/web.sh OUT
set -euo pipefail
cd "$(dirname "$0")/.."

out=$1
build=build/web
most_bytes=$((3 << 20)) # of the page, compressed

scripts/fetch_sources.sh
toolchain=$(dirname "$(realpath "$(command -v emcc)")")/cmake/Modules/Platform/Emscripten.cmake
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}" # acorn, by which emscripten shrinks JavaScript
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$toolchain" \
    -DKOEBE_BUNDLE=ON -DKOEBE_BUILD_TESTS=OFF -DKOEBE_BUILD_BENCH=OFF
cmake --build "$build" --target koebe_web

node native/apps/web/page/build.mjs "$build/command" "$build/page" "$out"

bytes=$(for file in "$out"/*; do gzip --best --stdout "$file"; done | wc --bytes)
echo "$out: $bytes bytes compressed"
[ "$bytes" -le "$most_bytes" ] || {
    echo "scripts/web.sh: more than $most_bytes bytes" >&2
    exit 1
}

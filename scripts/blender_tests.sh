#!/usr/bin/env bash
# Install dist/koebe_uv-*.zip into one Blender as a user does, and run tests/blender inside it.
# Usage: scripts/blender_tests.sh blender|PYTHON_WITH_BPY [pytest's options]
set -euo pipefail
cd "$(dirname "$0")/.."

host=$1
shift
unset PYTHONPATH   # only the installed zip may provide the package `koebe`

# A home of its own: nothing of the user's Blender is read or written.
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
export BLENDER_USER_RESOURCES="$home"               # 4.2 and later
export BLENDER_USER_CONFIG="$home/config" BLENDER_USER_SCRIPTS="$home/scripts"
export BLENDER_USER_DATAFILES="$home/datafiles" BLENDER_USER_EXTENSIONS="$home/extensions"
mkdir -p "$home"/{config,scripts/addons,datafiles,extensions}

case $(basename "$host") in
    blender*) run=("$host" --background --factory-startup --python-exit-code 1
                   --python scripts/install_and_test.py --) ;;
    *)        run=("$host" scripts/install_and_test.py) ;;
esac
"${run[@]}" "$PWD"/dist/koebe_uv-*.zip "$@"

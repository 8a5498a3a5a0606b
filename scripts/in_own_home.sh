#!/usr/bin/env bash
# Run a script in one Blender, with a home of its own: nothing of the user's Blender is read or written.
# Usage: scripts/in_own_home.sh blender|PYTHON_WITH_BPY SCRIPT.PY [its arguments]
set -euo pipefail

host=$1
script=$2
shift 2
unset PYTHONPATH   # only the installed zip may provide the package `koebe`

home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
export BLENDER_USER_RESOURCES="$home"               # 4.2 and later
export BLENDER_USER_CONFIG="$home/config" BLENDER_USER_SCRIPTS="$home/scripts"
export BLENDER_USER_DATAFILES="$home/datafiles" BLENDER_USER_EXTENSIONS="$home/extensions"
mkdir -p "$home"/{config,scripts/addons,datafiles,extensions}

case $(basename "$host") in
    blender*) run=("$host" --background --factory-startup --python-exit-code 1 --python "$script" --) ;;
    *)        run=("$host" "$script") ;;
esac
"${run[@]}" "$@"

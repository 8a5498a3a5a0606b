#!/usr/bin/env bash
# Install dist/koebe_uv-VERSION.zip into one Blender as a user does, and run tests/blender inside it.
# Usage: scripts/blender_tests.sh blender|PYTHON_WITH_BPY [pytest's options]     PACKAGE=... names another zip
set -euo pipefail
cd "$(dirname "$0")/.."

host=$1
shift
scripts/in_own_home.sh "$host" scripts/install_and_test.py "$(realpath "${PACKAGE:-dist/koebe_uv-$(scripts/version.sh).zip}")" "$@"

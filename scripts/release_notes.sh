#!/usr/bin/env bash
# Print the summary of the newest version in CHANGELOG.md: the text of its release page.
# Usage: scripts/release_notes.sh ADDRESS     of the files of this version, with a slash at its end: links begin with it
set -euo pipefail
awk '/^##/ { heading += 1; next } heading == 1' "$(dirname "$0")/../CHANGELOG.md" | sed -E "s|\]\(docs/|](${1}docs/|g"

#!/usr/bin/env bash
# The version in CMakeLists.txt.
sed -n 's/^project(koebe VERSION \([0-9.]*\).*/\1/p' "$(dirname "$0")/../CMakeLists.txt"

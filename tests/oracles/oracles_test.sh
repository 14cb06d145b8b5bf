#!/usr/bin/env bash
# Programs of others read what Kerf writes: oracles_test.sh KERF PYTHON SURFACE...
set -euo pipefail

kerf=$1 python=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for surface in "$@"; do
    "$kerf" mesh "$surface" -o "$folder/out" -n 3 --feature-angle 40 -q
    "$python" "$(dirname "$0")/read_vtu.py" "$folder/out"
    rm -r "$folder/out"
done

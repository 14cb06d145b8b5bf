#!/usr/bin/env bash
# VTK and meshio read the parts as Kerf writes them: vtu_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 python=$3 assets=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for surface in "$assets/cube.stl" "$assets/hollow_box.stl"; do
    "$kerf" mesh "$surface" -o "$folder/out" -n 3 --feature-angle 40 -q
    "$python" "$(dirname "$0")/read_vtu.py" "$folder/out"
    rm -r "$folder/out"
done

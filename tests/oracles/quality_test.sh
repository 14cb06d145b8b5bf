#!/usr/bin/env bash
# kerf quality measures what TetGen measures on the same files, and the same in every file that meshio and gmsh write of
# one mesh: quality_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 python=$3 assets=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for surface in cube hollow_box; do
    "$kerf" mesh "$assets/$surface.stl" -o "$folder/out" -n 2 --feature-angle 40 -q
    "$python" "$(dirname "$0")/compare_quality.py" "$kerf" "$folder/out/parts/part_0002.vtu" "$folder"
    rm -r "$folder/out"
done

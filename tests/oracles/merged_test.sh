#!/usr/bin/env bash
# meshio, VTK, Gmsh and the tools of MED and CGNS read what kerf merge writes: merged_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 cases=$2 python=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$cases" "$folder"
for surface in "$folder"/*.stl; do
    name=$(basename "$surface" .stl)
    # shellcheck disable=SC2046  # the words of the file are arguments
    "$kerf" mesh "$surface" -o "$folder/$name" $(cat "$folder/$name.args") -q
    for ending in mesh su2 inp vtu vtk unv med cgns feb vtp; do
        "$kerf" merge "$folder/$name" -o "$folder/$name.merged.$ending"
    done
    "$python" "$(dirname "$0")/read_merged.py" "$folder/$name" "$folder/$name.merged"
done

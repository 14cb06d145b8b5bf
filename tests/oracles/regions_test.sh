#!/usr/bin/env bash
# Programs of others find the regions of a body in every format: regions_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 python=$3
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WM_PROJECT_DIR=/usr/share/openfoam  # where Debian keeps etc/

# logged LOG COMMAND...: the output is seen only if the command fails.
logged() {
    local log=$1
    shift
    timeout 120 "$@" >"$log" 2>&1 || { echo "failed: $*" && tail -40 "$log" && exit 1; }
}

"$python" "$here/read_regions.py" make "$folder/in.msh"
"$kerf" mesh "$folder/in.msh" -o "$folder/run" -n 6 --size 0.25 -q
for ending in vtu msh mesh inp su2 node h5 vtk unv med cgns feb; do
    "$kerf" merge "$folder/run" -o "$folder/whole.$ending"
done
"$kerf" merge "$folder/run" -o "$folder/whole22.msh" --msh-version 2.2
"$kerf" export "$folder/run" --format msh -o "$folder/parts"
"$kerf" export "$folder/run" --format hdf5 -o "$folder/hdf5"
tetgen -r "$folder/whole.node" >"$folder/log" || { cat "$folder/log" && exit 1; }
"$kerf" export "$folder/run" --format openfoam -o "$folder/foam"
"$kerf" export "$folder/run" --format openfoam --into 1 -o "$folder/serial"
logged "$folder/log" reconstructParMesh -constant -case "$folder/foam"
for case in foam serial; do logged "$folder/$case.log" checkMesh -constant -allTopology -case "$folder/$case"; done
"$python" "$here/read_regions.py" judge "$folder"

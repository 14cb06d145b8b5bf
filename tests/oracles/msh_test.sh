#!/usr/bin/env bash
# Gmsh and meshio read MSH files, parts and merged, of all cases: msh_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 export_cases=$2 python=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$export_cases" "$folder"
for surface in "$folder"/*.stl; do
    stem=${surface%.stl}
    # shellcheck disable=SC2046 # the options are words
    "$kerf" mesh "$surface" -o "$stem" $(cat "$stem.args") -q
    "$kerf" export "$stem" --format msh -o "${stem}_parts"
    "$kerf" merge "$stem" -o "$stem.4.1.msh"
    "$kerf" merge "$stem" -o "$stem.2.2.msh" --msh-version 2.2
    "$python" "$(dirname "$0")/read_msh.py" "$surface" "$stem" "${stem}_parts" "$stem.4.1.msh" "$stem.2.2.msh"
done
# The same as text.
stem=$folder/two_solids
"$kerf" export "$stem" --format msh -o "${stem}_text" --msh-ascii
"$kerf" merge "$stem" -o "$stem.4.1.text.msh" --msh-ascii
"$kerf" merge "$stem" -o "$stem.2.2.text.msh" --msh-version 2.2 --msh-ascii
"$python" "$(dirname "$0")/read_msh.py" "$stem.stl" "$stem" "${stem}_text" "$stem.4.1.text.msh" "$stem.2.2.text.msh"

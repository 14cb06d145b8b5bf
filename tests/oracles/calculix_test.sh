#!/usr/bin/env bash
# CalculiX computes with the merged bearing cap: one end fixed, a pressure on the other one; the reactions balance the
# load: calculix_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
kerf=$1 python=$3 assets=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$kerf" mesh "$assets/bearing_cap_14k.stl" -o cap -n 4 --feature-angle 40 -q
"$kerf" merge cap -o cap.inp
"$kerf" merge cap -o cap.mesh
"$python" "$here/compute_with_calculix.py" cap.inp cap.mesh

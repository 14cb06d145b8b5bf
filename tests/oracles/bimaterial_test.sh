#!/usr/bin/env bash
# CalculiX computes a bar of two materials, as Kerf has exported it, with the stresses of kerf solve:
# bimaterial_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
kerf=$1 python=$3
if [ ! -x "$(dirname "$kerf")/kerf-solve" ]; then
    echo "kerf-solve was not built: nothing to compare"
    exit 77  # counted as skipped
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$python" "$here/compare_bimaterial.py" make
"$kerf" mesh rubber.stl steel.stl -o bar -n 4 --size 0.25 -q
"$kerf" solve bar --case case.toml -o stress
"$kerf" merge bar -o bar.inp
"$kerf" merge stress -o stress.vtu
"$python" "$here/compare_bimaterial.py" judge

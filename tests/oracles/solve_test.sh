#!/usr/bin/env bash
# CalculiX computes the same case on the same elements as kerf solve, of order 1 and 2: solve_test.sh KERF EXPORT_CASES
# PYTHON ASSETS
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
kerf=$1 python=$3 assets=$4
if [ ! -x "$(dirname "$kerf")/kerf-solve" ]; then
    echo "kerf-solve was not built: nothing to compare"
    exit 77  # counted as skipped
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$kerf" mesh "$assets/hollow_box.stl" -o body -n 4 --feature-angle 40 -q
"$kerf" solve body --list-patches
for order in 1 2; do
    cat >case.toml <<END
[material.steel]
young = 210000
poisson = 0.3

[[support]]
patch = "face_1"
fixed = true

[[load]]
patch = "face_4"
pressure = 2.5

[[load]]
patch = "face_2"
traction = [1, 2, -3]

[solver]
order = $order
rtol = 1e-11
END
    "$kerf" solve body --case case.toml -o "order$order"
    "$python" "$here/compare_with_calculix.py" "order$order" "$order"
done
"$python" "$here/compare_exports.py" "$kerf" order1

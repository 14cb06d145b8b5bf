#!/usr/bin/env bash
# A browser shows the page of kerf report, without a network: report_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 python=$3 assets=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$kerf" mesh "$assets/bearing_cap_52k.stl" -o "$folder/run" -n 8 -q
"$kerf" report "$folder/run" -o "$folder/report.html" -q
status=0
"$kerf" mesh "$assets/cube.stl" -o "$folder/failed" -n 2 --max-volume 2e-7 --timeout 0.3 --attempts 1 -q 2>/dev/null ||
    status=$?
[ "$status" = 4 ]
"$kerf" report "$folder/failed" -o "$folder/failed.html" -q
# Whoever names a surface in place of a page keeps it.
cp "$assets/cube.stl" "$folder/part.stl"
status=0
"$kerf" report "$folder/run" -o "$folder/part.stl" 2>/dev/null || status=$?
[ "$status" = 2 ]
cmp "$assets/cube.stl" "$folder/part.stl"
"$python" "$(dirname "$0")/open_report.py" "$folder/run" "$folder/report.html" "$folder/failed.html" "$folder"

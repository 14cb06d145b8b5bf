#!/usr/bin/env bash
# TetGen reconstructs the mesh that it reads (-r): tetgen_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 cases=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() { echo "$1" >&2; exit 1; }
# How many items of a file have each last number.
by_mark() {
    grep -v '^#' "$1" | awk 'NR > 1 { ++count[$NF] } END { for (mark in count) print mark, count[mark] }' | sort
}
count() { grep -v '^#' "$1" | awk 'NR == 1 { print $1 }'; }

"$cases" "$folder"
for surface in "$folder"/*.stl; do
    stem=${surface%.stl}
    # shellcheck disable=SC2046  # the words of the file are arguments
    "$kerf" mesh "$surface" -o "$stem" $(cat "$stem.args") -q
    "$kerf" merge "$stem" -o "$stem.node"
    tetgen -r "$stem.node" >"$stem.log" || fail "$(cat "$stem.log")"
    if grep -i -E 'warning|error' "$stem.log"; then fail "TetGen complains"; fi
    for ending in node ele; do
        [ "$(count "$stem.$ending")" = "$(count "$stem.1.$ending")" ] || fail "other counts in $stem.1.$ending"
    done
    diff <(by_mark "$stem.ele") <(by_mark "$stem.1.ele") || fail "other regions in $stem.1.ele"
    # TetGen adds the faces between regions, with marker 0.
    diff <(by_mark "$stem.face") <(by_mark "$stem.1.face" | grep -v '^0 ') || fail "other markers in $stem.1.face"
    echo "$(basename "$stem"): $(count "$stem.1.node") vertices, $(count "$stem.1.ele") tetrahedra"
done

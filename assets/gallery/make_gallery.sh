#!/usr/bin/env bash
# Draws the pictures of the README and of docs/ with the program itself. From the repository's root:
#
#     assets/gallery/make_gallery.sh [FOLDER]
#
# FOLDER holds the CAD files that are drawn before and after remeshing; they are no part of the repository, and without
# it their pictures stay as they are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
kerf=build/kerf
gallery=assets/gallery
work=$(mktemp -d -t kerf_gallery_XXXXXX)
trap 'rm -rf "$work"' EXIT

"$kerf" mesh assets/bearing_cap_14k.stl -o "$work/cap" -n 8 --trace "$work/cap.trace" -q
"$kerf" screenshot "$work/cap" --stage tetrahedra --explode 0.2 --clip y=0.62 --camera assets/cameras/bearing_cap.json \
    --no-legend --antialias 2 --size 1200x420 -o "$gallery/bearing_cap.png"
"$kerf" screenshot assets/pipe_with_holes.stl -n 8 --node 3 --stage contour --state "$gallery/no_times.json" --ui \
    --size 1280x800 -o "$gallery/viewer.png"
"$kerf" screenshot "$work/cap.trace" --stage interface --antialias 2 --size 640x420 -o "$gallery/interface.png"
"$kerf" screenshot assets/sinter_packing.stl -n 8 --stage tetrahedra --clip -y=0.45 --color min-dihedral --antialias 2 \
    --size 640x420 -o "$gallery/quality.png"
"$kerf" mesh assets/bearing_cap_52k.stl -o "$work/lattice" -n 4 --max-volume 0.5 -q
"$kerf" screenshot "$work/lattice" --stage tetrahedra --clip z=0.35 --color origin --antialias 2 --size 900x520 \
    -o "$gallery/lattice.png"
"$kerf" mesh assets/bearing_cap_52k.stl -o "$work/reference" -n 8 --max-volume 0.46 --reference -q
cp "$work/reference/comparison.svg" "$gallery/comparison.svg"
"$kerf" solve assets/bearing_cap_52k.stl --feature-angle 40 --case assets/bearing_cap_case.toml -o "$work/stress" -n 8 -q
"$kerf" screenshot "$work/stress" --color von-mises --range 0 300 --isolines --deform auto --no-edges --antialias 2 \
    --size 1000x560 -o "$gallery/stress.png"
"$kerf" solve assets/l_bracket.stl --case assets/l_bracket_case.toml -o "$work/bracket" -n 4 --adapt 3 -q
for step in 1 2 3 4; do
    "$kerf" screenshot "$work/bracket/step_$step/solution" --color error --range 0 0.15 --no-legend --antialias 2 --size 420x400 \
        -o "$gallery/bracket_$step.png"
done

# Each stage of the first cut.
"$kerf" mesh assets/bearing_cap_14k.stl -o "$work/halves" -n 2 --trace "$work/halves.trace" -q
mkdir -p "$gallery/stages"
for stage in input plane crossed-edges hanging-removed closed-loops paths-removed contour projected triangulation interface \
    split tetrahedra; do
    opened=$work/halves.trace apart=()
    if [[ $stage = tetrahedra ]]; then opened=$work/halves; fi
    if [[ $stage = split || $stage = tetrahedra ]]; then apart=(--explode 0.3); fi
    "$kerf" screenshot "$opened" --stage "$stage" "${apart[@]}" --camera assets/cameras/first_cut.json --no-legend \
        --antialias 2 --size 320x240 -o "$gallery/stages/$stage.png"
done

# The surface of a CAD file as OpenCASCADE triangulates it, and remeshed.
before_and_after() {
    local file=$1 name=$2
    shift 2
    "$kerf" decompose "$file" "$@" --surface split -n 1 --stl -q -o "$work/$name"
    "$kerf" remesh "$file" "$@" -q -o "$work/$name.obj"
    cp "$(find "$work/$name" -name '*.stl')" "$work/$name.stl"
    echo '{"axes": false}' > "$work/no_axes.json"
    for end in stl:before obj:after; do
        "$kerf" screenshot "$work/$name.${end%:*}" --stage input --state "$work/no_axes.json" --no-legend --antialias 2 \
            --size 480x360 -o "$gallery/cad_${name}_${end#*:}.png"
    done
}

if [[ $# -gt 0 ]]; then
    before_and_after "$1/dm1-oc-214.stp" bracket --unite
    before_and_after "$1/model1.igs" casting
    before_and_after "$1/conical.step" ring
fi

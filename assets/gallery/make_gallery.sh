#!/usr/bin/env bash
# Draws the pictures of the README and of docs/ with the program itself. From the repository's root:
#
#     assets/gallery/make_gallery.sh [--kerf PROGRAM] [--into FOLDER] [--cad FOLDER] [GROUP...]
#
# Without a GROUP (a function draw_GROUP below) it draws all; by build/kerf, into this folder. A test (tests/viewer/
# gallery_test.cpp) draws them, too, and fails where a picture here is another one. The CAD files that are drawn before
# and after remeshing are no part of the repository: without their folder their pictures stay as they are, and the test
# leaves them out. So do pictures of solutions where kerf-solve was not built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
kerf=build/kerf into=assets/gallery cad=
groups=(cap pipe stages surfaces packing lattice regions flow reference stress bracket cad)
asked=()
while [[ $# -gt 0 ]]; do
    case $1 in
        --kerf) kerf=$2 && shift 2 ;;
        --into) into=$2 && shift 2 ;;
        --cad) cad=$2 && shift 2 ;;
        *) asked+=("$1") && shift ;;
    esac
done
if [[ ${#asked[@]} -gt 0 ]]; then groups=("${asked[@]}"); fi
work=$(mktemp -d -t kerf_gallery_XXXXXX)
trap 'rm -rf "$work"' EXIT
untimed=assets/gallery/no_times.json

# draw FILE INPUT [OPTION...]
draw() {
    local picture=$1
    shift
    "$kerf" screenshot "$@" -o "$into/$picture"
}

draw_cap() {
    "$kerf" mesh assets/bearing_cap_14k.stl -o "$work/cap" -n 8 --trace "$work/cap.trace" -q
    draw bearing_cap.png "$work/cap" --stage tetrahedra --explode 0.2 --clip y=0.62 \
        --camera assets/cameras/bearing_cap.json --no-legend --antialias 2 --resolution 1200x420
    draw interface.png "$work/cap.trace" --stage interface --antialias 2 --resolution 640x420
}

draw_pipe() {
    draw viewer.png assets/pipe_with_holes.stl -n 8 --node 3 --stage contour --state "$untimed" --ui --resolution 1280x800
}

draw_flow() {
    "$kerf" mesh assets/flow/car.stl -o "$work/tunnel" -n 4 --box 1,1,3 --ground 0 --wake 0.2 -q
    draw tunnel.png "$work/tunnel" --clip=-y=0.5 --view front --no-legend --antialias 2 --resolution 1200x420
}

# Each stage of the first cut.
draw_stages() {
    local stage opened apart
    "$kerf" mesh assets/bearing_cap_14k.stl -o "$work/halves" -n 2 --trace "$work/halves.trace" -q
    mkdir -p "$into/stages"
    for stage in input plane crossed-edges hanging-removed closed-loops paths-removed contour projected triangulation \
        interface split tetrahedra; do
        opened=$work/halves.trace apart=()
        if [[ $stage = tetrahedra ]]; then opened=$work/halves; fi
        if [[ $stage = split || $stage = tetrahedra ]]; then apart=(--explode 0.3); fi
        if [[ $stage = input ]]; then apart=(--axes); fi
        draw "stages/$stage.png" "$opened" --stage "$stage" "${apart[@]}" --camera assets/cameras/first_cut.json \
            --no-legend --antialias 2 --resolution 320x240
    done
}

# Of the viewer's start page, which shows the part of the body: viewer/panels/welcome.cpp.
draw_surfaces() {
    local surface
    echo '{"edges": false, "scale_bar": false}' >"$work/bare.json"
    mkdir -p "$into/surfaces"
    for surface in assets/*.stl; do
        draw "surfaces/$(basename "$surface" .stl).png" "$surface" --stage input --state "$work/bare.json" \
            --antialias 2 --resolution 400x300
    done
}

draw_packing() {
    draw quality.png assets/sinter_packing.stl -n 8 --stage tetrahedra --clip -y=0.45 --color min-dihedral \
        --antialias 2 --resolution 640x420
}

draw_lattice() {
    "$kerf" mesh assets/bearing_cap_52k.stl -o "$work/lattice" -n 4 --max-volume 0.5 -q
    draw lattice.png "$work/lattice" --stage tetrahedra --clip z=0.35 --color origin --antialias 2 --resolution 900x520
}

draw_regions() {
    "$kerf" mesh assets/bone.stl assets/cement.stl -o "$work/implant" -n 8 --size 0.4 -q
    draw regions.png "$work/implant" --stage tetrahedra --color region --clip y=0.5 --antialias 2 --resolution 760x560
}

draw_reference() {
    "$kerf" mesh assets/bearing_cap_52k.stl -o "$work/reference" -n 8 --max-volume 0.46 --reference -q
    cp "$work/reference/comparison.svg" "$into/comparison.svg"
}

# has_solver PICTURE...: says which ones there will not be where it is missing.
has_solver() {
    if [[ -x $(dirname "$kerf")/kerf-solve ]]; then return; fi
    echo "There is no kerf-solve beside $kerf: no $*" >&2
    return 1
}

draw_stress() {
    if ! has_solver stress.png; then return; fi
    "$kerf" solve assets/bearing_cap_52k.stl --feature-angle 40 --case assets/bearing_cap_case.toml -o "$work/stress" \
        -n 8 -q
    draw stress.png "$work/stress" --color von-mises --range 0 300 --isolines --mark-extremes --deform auto --no-edges --antialias 2 \
        --resolution 1000x560
}

draw_bracket() {
    if ! has_solver bracket_1.png to bracket_4.png; then return; fi
    "$kerf" solve assets/l_bracket.stl --case assets/l_bracket_case.toml -o "$work/bracket" -n 4 --adapt 3 -q
    local step
    for step in 1 2 3 4; do
        draw "bracket_$step.png" "$work/bracket/step_$step/solution" --color error --range 0 0.15 --no-legend \
            --antialias 2 --resolution 420x400
    done
}

# draw_cad_surface NAME WHEN ENDING [OPTION...]
draw_cad_surface() {
    local name=$1 when=$2 ending=$3
    shift 3
    draw "cad_${name}_$when.png" "$work/cad_$name.$ending" "$@" --stage input --up z \
        --no-legend --antialias 2 --resolution 480x360
}

# before_and_after FILE NAME [OPTION...]: a CAD file's surface as OpenCASCADE triangulates it, and remeshed.
before_and_after() {
    local file=$1 name=$2
    shift 2
    "$kerf" decompose "$file" "$@" --surface split -n 1 --stl -q -o "$work/cad_$name"
    "$kerf" remesh "$file" "$@" -q -o "$work/cad_$name.obj"
    cp "$(find "$work/cad_$name" -name '*.stl')" "$work/cad_$name.stl"
    draw_cad_surface "$name" before stl --surface split
    draw_cad_surface "$name" after obj
}

draw_cad() {
    if [[ -z $cad ]]; then return; fi
    before_and_after "$cad/dm1-oc-214.stp" bracket --unite
    before_and_after "$cad/model1.igs" casting
    before_and_after "$cad/conical.step" ring
}

for group in "${groups[@]}"; do "draw_$group"; done

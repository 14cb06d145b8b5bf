#!/usr/bin/env bash
# OpenFOAM computes flows on what --box and --cap make: around a car that stands on the ground, around half a body on a
# symmetry plane, through a vessel with three ends. Meshes pass checkMesh, and simpleFoam's equations are solved better
# and better: flow_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 assets=$4
cases=$(dirname "$0")/../../docs/solvers
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WM_PROJECT_DIR=/usr/share/openfoam  # where Debian keeps etc/
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

fail() { echo "flow_test: $*" && exit 1; }

# logged LOG COMMAND...: the output is seen only if the command fails.
logged() {
    local log=$1
    shift
    timeout 200 "$@" >"$log" 2>&1 || { echo "failed: $*" && tail -40 "$log" && exit 1; }
}

# flow NAME CASE ITERATIONS OPTIONS...: a mesh in two parts, its check, and a flow on it. The residual of p falls to a
# third of what it was at the second iteration, and no field grows beyond bounds.
flow() {
    local name=$1 case=$2 iterations=$3 log residuals entry
    shift 3
    logged "$folder/$name.mesh" "$kerf" mesh "$@" -n 2 --format openfoam -o "$folder/$name"
    local run=$folder/$name/export/openfoam
    logged "$folder/$name.check" mpirun --oversubscribe -n 2 checkMesh -parallel -case "$run"
    grep -q '^Mesh OK' "$folder/$name.check" || { cat "$folder/$name.check" && fail "$name: checkMesh"; }
    cp -r "$cases/$case/constant" "$run/"
    for part in "$run"/processor*; do cp -r "$cases/$case/0" "$part/"; done
    for entry in endTime writeInterval; do
        logged "$folder/log" foamDictionary -entry "$entry" -set "$iterations" "$run/system/controlDict"
    done
    log=$folder/$name.flow
    logged "$log" mpirun --oversubscribe -n 2 simpleFoam -parallel -case "$run"
    mapfile -t residuals < <(sed -n 's/.*Solving for p, Initial residual = \([^,]*\),.*/\1/p' "$log")
    awk -v first="${residuals[2]}" -v last="${residuals[-2]}" 'BEGIN { exit !(last < first / 3) }' ||
        { tail -30 "$log" && fail "$name: residuals of p ${residuals[2]} ... ${residuals[-2]}"; }
}

flow car tunnel 40 "$assets/flow/car.stl" --box 1,0.5,2 --ground 0 --box-size 1.2
flow half tunnel 40 "$assets/flow/car.stl" --box=-4,0,-1,10,3,4 --box-size 1.2 --patch-type side_y_min=symmetry
flow vessel artery 30 "$assets/flow/vessel.stl" --cap
grep -q "type  *wall" "$folder"/vessel/export/openfoam/processor0/constant/polyMesh/boundary || fail "the vessel is no wall"

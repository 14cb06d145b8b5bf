#!/usr/bin/env bash
# OpenFOAM's programs and VTK's reader of its cases take what Kerf exports, and a solver runs on it:
# openfoam_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 export_cases=$2 python=$3 assets=$4
judge=$(dirname "$0")/read_openfoam.py
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WM_PROJECT_DIR=/usr/share/openfoam  # where Debian keeps etc/
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# logged LOG COMMAND...: the output is seen only if the command fails.
logged() {
    local log=$1
    shift
    timeout 120 "$@" >"$log" 2>&1 || { echo "failed: $*" && tail -40 "$log" && exit 1; }
}

# processors CASE: how many it has; none if it is serial.
processors() { find "$1" -maxdepth 1 -name 'processor*' | wc -l; }

# on_all CASE PROGRAM OPTIONS...: with as many processes as the case has processors.
on_all() {
    local case=$1 count
    shift
    count=$(processors "$case")
    if ((count == 0)); then
        logged "$folder/log" "$@" -case "$case"
    else
        logged "$folder/log" mpirun --oversubscribe -n "$count" "$@" -parallel -case "$case"
    fi
}

# make NAME SURFACE OPTIONS...: a run and its case.
make() {
    local name=$1
    shift
    "$kerf" mesh "$@" -o "$folder/${name}_run" -q
    "$kerf" export "$folder/${name}_run" --format openfoam -o "$folder/$name"
}

# judge_case NAME: the laws of read_openfoam.py for the case as VTK reads it, as checkMesh finds it, and after joining it.
# Up to six processes are started; more parts than that are joined only.
judge_case() {
    local case=$folder/$1 parts found=()
    parts=$(processors "$case")
    if ((parts <= 6)); then
        on_all "$case" checkMesh -allTopology  # compares the vertices of both sides of processor patches, too
        mv "$folder/log" "$case/log.parts"
        found+=(--check-mesh "$case/log.parts")
    fi
    if ((parts > 0)); then
        logged "$folder/log" reconstructParMesh -constant -case "$case"
        logged "$case/log.joined" checkMesh -constant -allTopology -case "$case"
        found+=(--check-joined "$case/log.joined")
    fi
    "$python" "$judge" "$folder/${1}_run" --case "$case" "${found[@]}" || { echo "in the case $1" && exit 1; }
}

dictionary() {  # OBJECT CLASS: its header; the entries follow on the standard input
    printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$2" "$1"
    cat
}

# Heat flows between two faces of a box: the exact temperature is linear, and a scheme that is exact for linear fields
# finds it if the faces between processors are those of both.
solve() {
    local case=$folder/$1 processor
    for processor in "$case"/processor*; do
        mkdir "$processor/0"
        dictionary T volScalarField >"$processor/0/T" <<'END'
dimensions [0 0 0 1 0 0 0];
internalField uniform 0.5;
boundaryField
{
    ".*" { type zeroGradient; }
    low_x { type fixedValue; value uniform 0; }
    high_x { type fixedValue; value uniform 1; }
    "procBoundary.*" { type processor; value uniform 0.5; }
}
END
    done
    mkdir "$case/constant"
    dictionary transportProperties dictionary >"$case/constant/transportProperties" <<<'DT DT [0 2 -1 0 0 0 0] 1;'
    dictionary fvSchemes dictionary >"$case/system/fvSchemes" <<'END'
ddtSchemes { default steadyState; }
gradSchemes { default leastSquares; }
divSchemes { default none; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
END
    dictionary fvSolution dictionary >"$case/system/fvSolution" <<'END'
solvers { T { solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0; } }
SIMPLE { nNonOrthogonalCorrectors 9; }
END
    dictionary controlDict dictionary >"$case/system/controlDict" <<'END'
startTime 0;
endTime 6;
deltaT 1;
writeInterval 6;
writeFormat binary;
END
    on_all "$case" laplacianFoam
    "$python" "$judge" "$folder/${1}_run" --case "$case" --linear T
    # A finished run of the mesh's own processors is joined like any other.
    logged "$folder/log" reconstructParMesh -constant -case "$case"
    logged "$folder/log" reconstructPar -case "$case"
    rm -r "$case"/processor*
    "$python" "$judge" "$folder/${1}_run" --case "$case" --linear T
}

"$export_cases" "$folder"
for surface in "$folder"/*.stl; do
    name=$(basename "$surface" .stl)
    read -r -a options <"${surface%.stl}.args"
    make "$name" "$surface" "${options[@]}"
    judge_case "$name"
done

make cube "$assets/cube.stl" -n 2 --feature-angle 40
make hollow_box "$assets/hollow_box.stl" -n 3 --feature-angle 40
make bearing_cap "$assets/bearing_cap_14k.stl" -n 4 --feature-angle 40
for name in cube hollow_box bearing_cap; do judge_case "$name"; done

sed 's/low_x/300; {$x} #include/; s/high_x/procBoundary0to1/; s/low_y/"/; s/high_y/a.b/; s/low_z/a b/; s/high_z/a_b/' \
    "$folder/one_part.stl" >"$folder/names.stl"
make names "$folder/names.stl" -n 2
judge_case names

make heat "$folder/one_part.stl" -n 4
solve heat

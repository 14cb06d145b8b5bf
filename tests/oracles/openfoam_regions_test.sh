#!/usr/bin/env bash
# OpenFOAM's programs for several regions take what --split-regions writes, and heat flows from one region into another:
# openfoam_regions_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 assets=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WM_PROJECT_DIR=/usr/share/openfoam  # where Debian keeps etc/
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

fail() {
    echo "broken: $1" && tail -60 "$2"
    exit 1
}

# on_all CASE LOG PROGRAM OPTIONS...: with as many processes as the case has processors.
on_all() {
    local case=$1 log=$2 count
    shift 2
    count=$(find "$case" -maxdepth 1 -name 'processor*' | wc -l)
    if ((count > 0)); then set -- mpirun --oversubscribe -n "$count" "$@" -parallel; fi
    timeout 120 "$@" -case "$case" >"$log" 2>&1 || fail "$*" "$log"
}

dictionary() {  # FILE CLASS: its header; the entries follow on the standard input
    mkdir -p "$(dirname "$1")"
    { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$2" "$(basename "$1")" && cat; } >"$1"
}

# The fields of a region, at a time of the case or of a processor of it.
fields() {  # FOLDER TEMPERATURE
    dictionary "$1/T" volScalarField <<END
dimensions [0 0 0 1 0 0 0];
internalField uniform $2;
boundaryField
{
    ".*" { type zeroGradient; }
    ".*_to_.*"
    {
        type compressible::turbulentTemperatureCoupledBaffleMixed; Tnbr T; kappaMethod solidThermo; value uniform $2;
    }
    "procBoundary.*" { type processor; value uniform $2; }
}
END
    dictionary "$1/p" volScalarField <<'END'
dimensions [1 -1 -2 0 0 0 0];
internalField uniform 1e5;
boundaryField { ".*" { type calculated; value uniform 1e5; } "procBoundary.*" { type processor; value uniform 1e5; } }
END
}

# region CASE NAME TEMPERATURE: a solid that conducts heat.
region() {
    local of
    dictionary "$1/constant/$2/thermophysicalProperties" dictionary <<'END'
thermoType
{
    type heSolidThermo; mixture pureMixture; transport constIso; thermo hConst; equationOfState rhoConst;
    specie specie; energy sensibleEnthalpy;
}
mixture
{
    specie { molWeight 1; } transport { kappa 1; } thermodynamics { Hf 0; Cp 1; } equationOfState { rho 1; }
}
END
    dictionary "$1/constant/$2/radiationProperties" dictionary <<<'radiation off; radiationModel none;'
    dictionary "$1/system/$2/fvSchemes" dictionary <<'END'
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes { default none; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
END
    dictionary "$1/system/$2/fvSolution" dictionary <<'END'
solvers { "h.*" { solver PCG; preconditioner DIC; tolerance 1e-9; relTol 0; } }
PIMPLE { nNonOrthogonalCorrectors 0; }
END
    for of in "$1" "$1"/processor*; do
        if [ -d "$of/constant/$2/polyMesh" ]; then fields "$of/0/$2" "$3"; fi
    done
}

# Hot cement in bone, everything else insulated. What bone gets is what cement loses.
solve() {
    local case=$1
    region "$case" bone 300
    region "$case" cement 400
    dictionary "$case/constant/g" uniformDimensionedVectorField <<<'dimensions [0 1 -2 0 0 0 0]; value (0 0 0);'
    dictionary "$case/system/fvSolution" dictionary <<<'PIMPLE { nOuterCorrectors 8; }'
    dictionary "$case/system/controlDict" dictionary <<'END'
startTime 0;
endTime 0.3;
deltaT 0.1;
writeInterval 3;
functions
{
    heat { type volFieldValue; libs ("libfieldFunctionObjects.so"); regionType all; operation volIntegrate; fields (T);
           writeFields false; region bone; }
    lost { $heat; region cement; }
}
END
    on_all "$case" "$case/log" chtMultiRegionFoam
    [ "$(grep -c '^Time = ' "$case/log")" = 3 ] || fail "three steps" "$case/log"
    awk -v case="$case" '
        /of T = / { sum[++n] = $NF }
        END {
            bone = sum[n - 1] - sum[1]; cement = sum[n] - sum[2]
            printf "%s: bone gets %.4g, cement %.4g\n", case, bone, cement
            exit !(n == 6 && bone > 50 && bone + cement < 0.01 * bone && bone + cement > -0.01 * bone)
        }' "$case/log" || fail "heat flows from cement into bone" "$case/log"
}

"$kerf" mesh "$assets/bone.stl" "$assets/cement.stl" -o "$folder/run" -n 4 --size 1 -q
for pieces in 4 2 1; do
    case=$folder/$pieces
    "$kerf" export "$folder/run" --format openfoam --split-regions --into "$pieces" -o "$case" -q
    if ((pieces == 2)); then continue; fi
    for region in bone cement; do  # OpenFOAM 1912 has no -allRegions yet
        on_all "$case" "$folder/log" checkMesh -constant -region "$region" -allTopology
        grep -q 'Mesh OK' "$folder/log" || fail "checkMesh of $region" "$folder/log"
    done
done
solve "$folder/2"
solve "$folder/1"

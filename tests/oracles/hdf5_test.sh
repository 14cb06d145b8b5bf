#!/usr/bin/env bash
# h5py, VTK and DOLFINx, this one also as two processes, read mesh.h5 and mesh.xdmf of every case:
# hdf5_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

kerf=$1 cases=$2 python=$3
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$cases" "$folder"
names=()
for surface in "$folder"/*.stl; do
    name=${surface%.stl}
    read -ra arguments <"$name.args"
    "$kerf" mesh "$surface" -o "$name" "${arguments[@]}" -q
    "$kerf" export "$name" --format hdf5 -q
    names+=("$name")
done
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
"$python" "$here/read_hdf5.py" "${names[@]}"
"$python" "$here/read_xdmf.py" "${names[@]}"
mpirun --oversubscribe -n 2 "$python" "$here/read_xdmf.py" "${names[@]}"

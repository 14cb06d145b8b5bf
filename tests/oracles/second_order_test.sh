#!/usr/bin/env bash
# Gmsh, meshio, VTK, DOLFINx, PETSc, TetGen and CalculiX read cells of order 2:
# second_order_test.sh KERF EXPORT_CASES PYTHON ASSETS
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
kerf=$1 cases=$2 python=$3 assets=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$cases" .
"$kerf" mesh one_part.stl -o run -n 3 --size 0.4 -q
"$kerf" export run --format msh --order 2 -o parts -q
"$kerf" export run --format hdf5 --order 2 -o hdf5 -q
for ending in msh mesh inp node; do "$kerf" merge run -o "whole.$ending" --order 2 -q; done
"$kerf" merge run -o old.msh --order 2 --msh-version 2.2 -q
"$kerf" merge run -o corners.mesh -q
tetgen -r whole.node >tetgen.log
tets() { awk '!/^#/ { print $1; exit }' "$1"; }
[ "$(tets whole.ele)" = "$(tets whole.1.ele)" ] || { cat tetgen.log && exit 1; }
"$kerf" mesh "$assets/cylinder.stl" -o curved -n 3 --surface remesh --order 2 --format msh -q
for ending in vtk unv med cgns feb; do "$kerf" merge curved -o "curved.$ending" -q; done
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
"$python" "$here/read_second_order.py" run curved
"$python" "$here/compute_with_calculix.py" whole.inp corners.mesh

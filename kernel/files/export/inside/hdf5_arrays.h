// The arrays of the format hdf5: names, types and sizes.
#pragma once

#include <string>
#include <vector>

#include "files/export/inside/hdf5_file.h"
#include "files/export/whole_mesh.h"
#include "files/part/part.h"

namespace kerf {

/// The number of rows in arrays that have some rows for each part, for the parts before one or for all.
struct PieceRows {
    std::int64_t points = 0, cells = 0, corners = 0, offsets = 0;

    /// Adds the rows of a part with cells of this order.
    void add(const PartExtent& part, int order) {
        points += part.vertices + part.edge_nodes;
        cells += part.tets + part.patch_facets;
        corners += nodes_of_tets(order) * part.tets + nodes_of_triangles(order) * part.patch_facets;
        offsets += part.tets + part.patch_facets + 1;
    }
};

PieceRows rows_before(const MeshOutline& outline, PartIndex index);

/// Returns the type of global numbers.
Hdf5Type id_type(const MeshOutline& outline);
/// Returns the name of the array with all nodes of tetrahedra by global numbers. Of order 2 it is beside that of
/// corners, as DMPlex knows no other nodes.
const char* nodes_array(const MeshOutline& outline);

/// Returns the type of the corners and offsets in a piece, which VTK wants to be the same.
Hdf5Type corner_type(const MeshOutline& outline);

/// Returns the name of an array of values: their own name, without slashes, which would make groups.
std::string array_name(const PartValues& values);
/// Return the names of the array of the pieces, and of the one by global numbers.
std::string piece_array_of(const PartValues& values);
std::string whole_array_of(const PartValues& values);

std::vector<Hdf5Array> arrays_of(const MeshOutline& outline);

/// Returns the text of an XDMF file that describes the arrays by global numbers, and lies beside the file `h5` with
/// them.
std::string xdmf_text(const MeshOutline& outline, std::string h5);

}  // namespace kerf

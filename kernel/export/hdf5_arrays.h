// The arrays of the format hdf5: names, types and sizes.
#pragma once

#include <string>
#include <vector>

#include "export/hdf5_file.h"
#include "export/whole_mesh.h"
#include "part/part.h"

namespace kerf {

/// The number of rows in arrays that have some for each part, before the part or over all of them.
struct PieceRows {
    std::int64_t points = 0, cells = 0, corners = 0, offsets = 0;

    /// `order`: of the cells.
    void add(const PartExtent& part, int order) {
        points += part.vertices + part.edge_nodes;
        cells += part.tets + part.patch_facets;
        corners += nodes_of_tets(order) * part.tets + nodes_of_triangles(order) * part.patch_facets;
        offsets += part.tets + part.patch_facets + 1;
    }
};

PieceRows rows_before(const MeshOutline& outline, PartIndex index);

/// The type of global numbers.
Hdf5Type id_type(const MeshOutline& outline);
/// The array by global numbers of all nodes of tetrahedra. Of order 2 it is beside that of corners, as DMPlex knows no
/// other nodes.
const char* nodes_array(const MeshOutline& outline);

/// The type of the corners and offsets in a piece, which VTK wants to be the same.
Hdf5Type corner_type(const MeshOutline& outline);

/// What values are called: by their name, in which a slash would be a group.
std::string array_name(const PartValues& values);
/// The array of the pieces, and the one by global numbers.
std::string piece_array_of(const PartValues& values);
std::string whole_array_of(const PartValues& values);

std::vector<Hdf5Array> arrays_of(const MeshOutline& outline);

/// What the arrays by global numbers mean, for readers of XDMF: a file, beside which they lie in the file `h5`.
std::string xdmf_text(const MeshOutline& outline, std::string h5);

}  // namespace kerf

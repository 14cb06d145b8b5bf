// A polyMesh of OpenFOAM: the files of one part, or of one region of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/export/inside/export_files.h"
#include "files/export/inside/word_names.h"
#include "files/part/part.h"

namespace kerf::openfoam {

using Label = std::int32_t;

/// The place of the files of a mesh.
struct MeshPlace {
    std::int32_t processor;
    std::string location;  ///< location as headers name it
    std::string folder;    ///< folder in the case, with a slash at its end
};

/// Returns the place constant/polyMesh, of a region constant/REGION/polyMesh, in the folder of its processor where
/// there are several.
MeshPlace mesh_place(const MeshOutline& outline, PartIndex index, const std::string& region = "");

/// Returns the header of a file. `note`: a remark on the labels in it; empty: none.
std::string header(std::string_view kind, std::string_view object, std::string_view location, bool is_binary,
                   const std::string& note = "");

/// Returns the rules of OpenFOAM's words for names; `kind`: of which things they are.
WordRules word_rules(const std::string& kind = "patch");
/// Returns a comment on a line of its own with the name, or nothing if the word is the name.
std::string name_comment(const std::string& name, const std::string& word);

/// A patch of a mesh and its range of faces.
struct Patch {
    std::string name, comment;
    std::string type = "processor";
    std::int64_t start = 0, faces = 0;
    std::int32_t other = -1;   ///< processor on the other side, -1 for patches of the surface
    std::string entries = {};  ///< lines of its dictionary behind the usual ones
};

/// Returns the patches of a surface, without faces.
std::vector<Patch> patches_of_surface(const std::vector<std::string>& names, std::span<const PatchType> types);

/// The boundary of a mesh: faces and the cells that own them, patch after patch.
struct Boundary {
    std::vector<Patch> patches;
    std::vector<Triangle> faces;
    std::vector<Label> owner;
};

/// Returns the boundary of a part: triangles on the surface are in `patches`, by their Part::patch, and those on
/// interfaces in patches between processors behind them. O(n log n).
Boundary boundary_of_mesh(const Part& part, const MeshOutline& outline, std::int32_t processor,
                          std::vector<Patch> patches);

/// Returns the face of a cell that lies opposite of one of its corners, its corners as seen from outside.
Triangle face_of_cell(const TetMesh& mesh, CellId t, std::size_t opposite);
/// Returns the number of faces of a mesh of tetrahedra.
std::int64_t face_count(std::int64_t tets, std::int64_t boundary_faces);

/// Writes points, faces, owner, neighbour and boundary. The mesh of the part must have neighbours. Throws Error(io).
void write_mesh(const Part& part, const Boundary& boundary, const MeshPlace& place, ExportFiles& files);

}  // namespace kerf::openfoam

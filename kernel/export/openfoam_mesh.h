// A polyMesh of OpenFOAM: the files of one part, or of one region of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/export_files.h"
#include "export/word_names.h"
#include "part/part.h"

namespace kerf::openfoam {

using Label = std::int32_t;

/// Where the files of a mesh lie.
struct MeshPlace {
    std::int32_t processor;
    std::string location;  ///< as headers name it
    std::string folder;    ///< of the case, with a slash at its end
};

/// constant/polyMesh, of a region constant/REGION/polyMesh, in the folder of its processor where there are several.
MeshPlace mesh_place(const MeshOutline& outline, PartIndex index, const std::string& region = "");

/// What a file begins with. `note`: of the labels in it; empty: none.
std::string header(std::string_view kind, std::string_view object, std::string_view location, bool is_binary,
                   const std::string& note = "");

/// OpenFOAM's words of patches; `kind` of other things.
WordRules word_rules(const std::string& kind = "patch");
/// A comment on a line of its own with the name, if the word is another one.
std::string name_comment(const std::string& name, const std::string& word);

/// Faces of one patch of a mesh.
struct Patch {
    std::string name, comment;
    std::string type = "processor";
    std::int64_t start = 0, faces = 0;
    std::int32_t other = -1;   ///< processor on the other side, -1 for patches of the surface
    std::string entries = {};  ///< lines of its dictionary behind those of all patches
};

/// The patches of a surface, without faces.
std::vector<Patch> patches_of_surface(const std::vector<std::string>& names, std::span<const PatchType> types);

/// What lies on the boundary of a mesh, patch after patch.
struct Boundary {
    std::vector<Patch> patches;
    std::vector<Triangle> faces;
    std::vector<Label> owner;
};

/// The triangles of a part: those of Part::patch in `patches`, which are as many as its names, the others in patches
/// between processors. O(n log n).
Boundary boundary_of_mesh(const Part& part, const MeshOutline& outline, std::int32_t processor,
                          std::vector<Patch> patches);

/// The face of a cell that lies opposite of one of its corners, seen from outside.
Triangle face_of_cell(const TetMesh& mesh, std::size_t t, std::size_t opposite);
/// Faces of a mesh of tetrahedra.
std::int64_t face_count(std::int64_t tets, std::int64_t boundary_faces);

/// Points, faces, owner, neighbour and boundary. The mesh of the part has neighbours. Throws Error(io).
void write_mesh(const Part& part, const Boundary& boundary, const MeshPlace& place, ExportFiles& files);

}  // namespace kerf::openfoam

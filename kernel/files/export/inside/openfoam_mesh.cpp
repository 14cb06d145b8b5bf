// OpenFOAM numbers the faces of a mesh, not its cells: first the faces between two cells, in upper-triangular order (by
// the smaller cell, which is the owner, then by the larger one), then the boundary, patch after patch. The first order
// falls out of the neighbours of cells, four of which are sorted at a time; only the boundary is sorted as a whole.
// Both sides of an interface sort its faces by ascending global vertex numbers and start each face at its smallest
// number, so that the two processors name the same faces in the same order without a message; a face has its corners
// seen from its own side there. Lists are binary and written an entry at a time, behind their length, which is known
// before: of n tetrahedra with b boundary faces there are (4 n + b) / 2 faces.
#include "files/export/inside/openfoam_mesh.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/ids.h"

namespace kerf::openfoam {

MeshPlace mesh_place(const MeshOutline& outline, PartIndex index, const std::string& region) {
    const std::string location = region.empty() ? "constant/polyMesh" : fmt::format("constant/{}/polyMesh", region);
    const std::string processor = outline.parts.size() == 1 ? "" : fmt::format("processor{}/", index.value());
    return {index.value(), location, processor + location + "/"};
}

std::string header(std::string_view kind, std::string_view object, std::string_view location, bool is_binary,
                   const std::string& note) {
    return fmt::format(
        "FoamFile\n{{\n    version     2.0;\n    format      {};\n{}    class       {};\n{}"
        "    location    \"{}\";\n    object      {};\n}}\n\n",
        is_binary ? "binary" : "ascii", is_binary ? "    arch        \"LSB;label=32;scalar=64\";\n" : "", kind,
        note.empty() ? "" : fmt::format("    note        \"{}\";\n", note), location, object);
}

WordRules word_rules(const std::string& kind) {
    return {.most_characters = 200, .taken = {"processor"}, .taken_beginnings = {"procBoundary"}, .kind = kind};
}

std::string name_comment(const std::string& name, const std::string& word) {
    return word == name ? "" : fmt::format("    // {}\n", comment_text(name));
}

std::vector<Patch> patches_of_surface(const std::vector<std::string>& names, std::span<const PatchType> types) {
    const std::vector<std::string> words = word_names(names, word_rules());
    std::vector<Patch> patches(names.size());
    for (std::size_t p = 0; p < names.size(); ++p) {
        patches[p].name = words[p];
        patches[p].type = type_of_patch(types, names[p]);
        patches[p].comment = name_comment(names[p], words[p]);
    }
    return patches;
}

namespace {
namespace mesh_files {

using Labels = std::vector<Label>;

// Returns the patch of each triangle; patches of processors are numbered behind those of the surface.
Labels patches_of_facets(const Part& part, const MeshOutline& outline, Label of_surface) {
    std::vector<NodeId> others = part.neighbour;
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    Labels processors;
    for (const NodeId other : others) processors.push_back(other.is_valid() ? outline.index_of(other).value() : -1);
    Labels patches = part.patch;
    for (std::size_t f = 0; f < patches.size(); ++f) {
        if (!part.is_interface(f)) continue;
        const auto found = std::lower_bound(others.begin(), others.end(), part.neighbour[f]);
        patches[f] = of_surface + processors[found - others.begin()];
    }
    return patches;
}

struct PlacedFacet {
    std::int32_t patch;
    std::array<std::int64_t, 3> ids;  // ascending; zeros on the surface, where the order of facets stays
    std::int32_t facet;
    auto operator<=>(const PlacedFacet&) const = default;
};

// Returns the boundary triangles in the order of their patches.
std::vector<PlacedFacet> place_facets(const Part& part, const MeshOutline& outline, Label of_surface) {
    const Labels patches = patches_of_facets(part, outline, of_surface);
    std::vector<PlacedFacet> placed(part.facets.size());
    for (std::int32_t f = 0; f < count_of(placed); ++f) {
        placed[f] = {patches[f], {}, f};
        if (!part.is_interface(f)) continue;
        for (std::size_t i = 0; i < 3; ++i) placed[f].ids[i] = part.global_id[part.facets[f][i]];
        std::sort(placed[f].ids.begin(), placed[f].ids.end());
    }
    std::sort(placed.begin(), placed.end());
    return placed;
}

Triangle starting_at_smallest_id(Triangle triangle, const Part& part) {
    const auto smallest = std::min_element(triangle.begin(), triangle.end(), [&](std::int32_t a, std::int32_t b) {
        return part.global_id[a] < part.global_id[b];
    });
    std::rotate(triangle.begin(), smallest, triangle.end());
    return triangle;
}

Patch between(std::int32_t processor, std::int32_t other) {
    Patch patch;
    patch.name = fmt::format("procBoundary{}to{}", processor, other);
    patch.other = other;
    patch.entries = fmt::format("        myProcNo        {};\n        neighbProcNo    {};\n", processor, other);
    return patch;
}

// ---- Files

// A list of known length that is written an entry at a time.
class ListFile {
 public:
    ListFile(ExportFile file, std::string_view beginning) : file_(std::move(file)) { file_.write(beginning); }
    void begin(std::int64_t length) {
        file_.number(length);
        file_.write("\n(");
    }
    template <class T>
    void entry(const T& value) {
        file_.value(value);
    }
    template <class T>
    void entries(const std::vector<T>& values) {
        file_.values(std::span(values));
    }
    void end() { file_.write(")\n"); }
    void close() { file_.close(); }

 private:
    ExportFile file_;
};

void write_points(const Part& part, const MeshPlace& place, ExportFiles& files) {
    ListFile points(files.create(place.folder + "points"), header("vectorField", "points", place.location, true));
    points.begin(part.vertex_count());
    points.entries(part.mesh.vertices);
    points.end();
    points.close();
}

void begin_corners(ListFile& faces, std::int64_t count) {
    faces.begin(count + 1);
    for (std::int64_t f = 0; f <= count; ++f) faces.entry<Label>(3 * f);
    faces.end();
    faces.begin(3 * count);
}

// Writes the faces between cells, in upper-triangular order.
void write_inner_faces(const TetMesh& mesh, ListFile& faces, ListFile& owner, ListFile& neighbour) {
    for (const CellId t : mesh.tets.ids()) {
        const std::array<CellId, 4>& across = mesh.neighbours[t];
        std::array<std::size_t, 4> order = {0, 1, 2, 3};
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return across[a] < across[b]; });
        for (const std::size_t i : order) {
            if (across[i] <= t) continue;
            faces.entry(face_of_cell(mesh, t, i));
            owner.entry(t.value());
            neighbour.entry(across[i].value());
        }
    }
}

void write_faces(const Part& part, const Boundary& boundary, const MeshPlace& place, ExportFiles& files) {
    const auto outer = std::ssize(boundary.faces);
    const std::int64_t count = face_count(part.tet_count(), outer), inner = count - outer;
    const std::string note = fmt::format("nPoints:{}  nCells:{}  nFaces:{}  nInternalFaces:{}", part.vertex_count(),
                                         part.tet_count(), count, inner);
    const auto open = [&](const char* object, std::string_view kind, const std::string& of_labels) {
        return ListFile(files.create(place.folder + object), header(kind, object, place.location, true, of_labels));
    };
    ListFile faces = open("faces", "faceCompactList", ""), owner = open("owner", "labelList", note),
             neighbour = open("neighbour", "labelList", note);
    begin_corners(faces, count);
    owner.begin(count);
    neighbour.begin(inner);
    write_inner_faces(part.mesh, faces, owner, neighbour);
    faces.entries(boundary.faces);
    owner.entries(boundary.owner);
    for (ListFile* file : {&faces, &owner, &neighbour}) {
        file->end();
        file->close();
    }
}

void write_boundary(const std::vector<Patch>& patches, const MeshPlace& place, ExportFiles& files) {
    ExportFile file = files.create(place.folder + "boundary");
    file.write(header("polyBoundaryMesh", "boundary", place.location, false));
    file.write(fmt::format("{}\n(\n", patches.size()));
    for (const Patch& patch : patches) {
        file.write(
            fmt::format("{}    {}\n    {{\n        type            {};\n", patch.comment, patch.name, patch.type));
        if (patch.type == "wall" || patch.type == "mappedWall") file.write("        inGroups        1(wall);\n");
        file.write(fmt::format("        nFaces          {};\n        startFace       {};\n", patch.faces, patch.start));
        file.write(patch.entries);
        file.write("    }\n");
    }
    file.write(")\n");
    file.close();
}

}  // namespace mesh_files
}  // namespace

Triangle face_of_cell(const TetMesh& mesh, CellId t, std::size_t opposite) {
    const auto& [a, b, c] = tet_faces[opposite];
    const Tetrahedron& tet = mesh.tets[t];
    return {tet[a], tet[b], tet[c]};
}

std::int64_t face_count(std::int64_t tets, std::int64_t boundary_faces) { return (4 * tets + boundary_faces) / 2; }

Boundary boundary_of_mesh(const Part& part, const MeshOutline& outline, std::int32_t processor,
                          std::vector<Patch> patches) {
    const auto of_surface = count_of(patches);
    Boundary boundary{std::move(patches), {}, {}};
    for (const mesh_files::PlacedFacet& placed : mesh_files::place_facets(part, outline, of_surface)) {
        const std::int32_t f = placed.facet;
        const bool is_of_surface = placed.patch < of_surface;
        const std::int32_t other = placed.patch - of_surface;
        if (!is_of_surface && (boundary.patches.empty() || boundary.patches.back().other != other))
            boundary.patches.push_back(mesh_files::between(processor, other));
        Patch& patch = is_of_surface ? boundary.patches[placed.patch] : boundary.patches.back();
        ++patch.faces;
        boundary.faces.push_back(is_of_surface ? part.facets[f]
                                               : mesh_files::starting_at_smallest_id(part.facets[f], part));
        boundary.owner.push_back(part.tet_at_facet[f]);
    }
    std::int64_t start = (4 * std::ssize(part.mesh.tets) - std::ssize(part.facets)) / 2;
    for (Patch& patch : boundary.patches) {
        patch.start = start;
        start += patch.faces;
    }
    return boundary;
}

void write_mesh(const Part& part, const Boundary& boundary, const MeshPlace& place, ExportFiles& files) {
    mesh_files::write_points(part, place, files);
    mesh_files::write_faces(part, boundary, place, files);
    mesh_files::write_boundary(boundary.patches, place, files);
}

}  // namespace kerf::openfoam

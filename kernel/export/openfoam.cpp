// OpenFOAM: a case with a folder processorN for each part, or a serial case of a single one.
//
// The polyMesh of a part is what "OpenFOAM User Guide: Mesh description" asks for: cells are the tetrahedra in their
// order; faces come in upper-triangular order (those between two cells by owner, the lower cell, then by neighbour),
// then the patches one after the other. Every processor lists all patches of the surface, in the same order. After
// them come its processor patches, ascending by the other processor. Both sides sort the faces between them by their
// global vertex numbers and start each at its smallest one: then OpenFOAM finds vertex i of a face as vertex n - i of
// the same face there. Lists are binary, with labels of 32 bits, as their headers say.
//
// reconstructParMesh -constant joins the processors along their patches and makes the addressing that reconstructPar
// asks for; it needs none, so none is written.
//
// Walls between regions are faces between cells or processors; a patch that has no other triangles is left out. Every
// processor lists the regions as cell zones, in the same order, also those that it has no cell of.
//
// A patch is named by a word (export/word_names.h) that is not one of OpenFOAM's for the patches between processors;
// its own name is in a comment, if it is another one. So are zones.
#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "core/check.h"
#include "core/error.h"
#include "export/format.h"
#include "export/materials.h"
#include "export/text_rows.h"
#include "export/word_names.h"
#include "part/bodies.h"

namespace kerf {

namespace {
namespace openfoam {

using Label = std::int32_t;
using Labels = std::vector<Label>;

// The last entry of the list of offsets into the corners of faces is a label.
constexpr std::int64_t most_faces = std::numeric_limits<Label>::max() / 3;

std::string header(std::string_view kind, std::string_view object, bool is_binary, const std::string& note = "") {
    return fmt::format(
        "FoamFile\n{{\n    version     2.0;\n    format      {};\n{}    class       {};\n{}"
        "    location    \"constant/polyMesh\";\n    object      {};\n}}\n\n",
        is_binary ? "binary" : "ascii", is_binary ? "    arch        \"LSB;label=32;scalar=64\";\n" : "", kind,
        note.empty() ? "" : fmt::format("    note        \"{}\";\n", note), object);
}

WordRules word_rules() {
    return {.most_characters = 200, .taken = {"processor"}, .taken_beginnings = {"procBoundary"}};
}

// ---- Boundary

// Faces of one patch of a processor.
struct Patch {
    std::string name, comment;
    std::string type = "processor";
    std::int64_t start = 0, faces = 0;
    std::int32_t other = -1;  // processor on the other side, -1 for patches of the surface
};

struct Boundary {
    std::vector<Patch> patches;
    std::vector<Triangle> faces;
    Labels owner;
};

// The number of the patch that each triangle belongs to; those of processors are numbered after those of the surface.
Labels patches_of_facets(const Part& part, const MeshOutline& outline) {
    std::vector<NodeId> others = part.neighbour;
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    Labels processors;
    for (const NodeId other : others) processors.push_back(other < 0 ? -1 : outline.index_of(other).value());
    const std::int32_t first = std::ssize(part.patch_names);
    Labels patches = part.patch;
    for (std::size_t f = 0; f < patches.size(); ++f) {
        if (!part.is_interface(f)) continue;
        const auto found = std::lower_bound(others.begin(), others.end(), part.neighbour[f]);
        patches[f] = first + processors[found - others.begin()];
    }
    return patches;
}

struct PlacedFacet {
    std::int32_t patch;
    std::array<std::int64_t, 3> ids;  // ascending; zeros on the surface, whose order stays
    std::int32_t facet;
    auto operator<=>(const PlacedFacet&) const = default;
};

// The boundary triangles in the order of their patches.
std::vector<PlacedFacet> place_facets(const Part& part, const MeshOutline& outline) {
    const Labels patches = patches_of_facets(part, outline);
    std::vector<PlacedFacet> placed(part.facets.size());
    for (std::size_t f = 0; f < placed.size(); ++f) {
        placed[f] = {patches[f], {}, static_cast<std::int32_t>(f)};
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

std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names, word_rules()); }

std::vector<Patch> patches_of_surface(const std::vector<std::string>& names, std::span<const PatchType> types) {
    const std::vector<std::string> words = patch_words(names);
    std::vector<Patch> patches(names.size());
    for (std::size_t p = 0; p < names.size(); ++p) {
        patches[p].name = words[p];
        patches[p].type = type_of_patch(types, names[p]);
        if (words[p] != names[p]) patches[p].comment = fmt::format("    // {}\n", comment_text(names[p]));
    }
    return patches;
}

Patch between(std::int32_t processor, std::int32_t other) {
    Patch patch;
    patch.name = fmt::format("procBoundary{}to{}", processor, other);
    patch.other = other;
    return patch;
}

Boundary boundary_faces_of(const Part& part, const MeshOutline& outline, std::int32_t processor,
                           std::span<const PatchType> types) {
    Boundary boundary;
    boundary.patches = patches_of_surface(part.patch_names, types);
    const std::int32_t of_surface = std::ssize(part.patch_names);
    for (const PlacedFacet& placed : place_facets(part, outline)) {
        const std::int32_t f = placed.facet;
        const bool is_of_surface = placed.patch < of_surface;
        const std::int32_t other = placed.patch - of_surface;
        if (!is_of_surface && boundary.patches.back().other != other)
            boundary.patches.push_back(between(processor, other));
        Patch& patch = is_of_surface ? boundary.patches[placed.patch] : boundary.patches.back();
        ++patch.faces;
        boundary.faces.push_back(is_of_surface ? part.facets[f] : starting_at_smallest_id(part.facets[f], part));
        boundary.owner.push_back(part.tet_at_facet[f]);
    }
    std::int64_t start = (4 * std::ssize(part.mesh.tets) - std::ssize(part.facets)) / 2;
    for (Patch& patch : boundary.patches) {
        patch.start = start;
        start += patch.faces;
    }
    return boundary;
}

// Patches without triangles in any part go, those of processors stay.
void leave_out_walls(const std::vector<std::int64_t>& sizes, std::vector<Patch>& patches) {
    std::size_t number = 0;
    std::erase_if(patches, [&](const Patch&) {
        const std::size_t p = number++;
        return p < sizes.size() && sizes[p] == 0;
    });
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

std::string mesh_folder(std::size_t parts, std::int32_t processor) {
    return (parts == 1 ? "" : fmt::format("processor{}/", processor)) + "constant/polyMesh/";
}

void write_points(const Part& part, ExportFiles& files, const std::string& folder) {
    ListFile points(files.create(folder + "points"), header("vectorField", "points", true));
    points.begin(part.vertex_count());
    points.entries(part.mesh.vertices);
    points.end();
    points.close();
}

std::int64_t face_count(std::int64_t tets, std::int64_t boundary_faces) { return (4 * tets + boundary_faces) / 2; }

void begin_corners(ListFile& faces, std::int64_t count) {
    faces.begin(count + 1);
    for (std::int64_t f = 0; f <= count; ++f) faces.entry(static_cast<Label>(3 * f));
    faces.end();
    faces.begin(3 * count);
}

Triangle face_of(const TetMesh& mesh, std::size_t t, std::size_t opposite) {
    const auto& [a, b, c] = tet_faces[opposite];
    const Tetrahedron& tet = mesh.tets[t];
    return {tet[a], tet[b], tet[c]};
}

// Faces between cells, upper-triangular.
void write_inner_faces(const TetMesh& mesh, ListFile& faces, ListFile& owner, ListFile& neighbour) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const std::array<std::int32_t, 4>& across = mesh.neighbours[t];
        std::array<std::size_t, 4> order = {0, 1, 2, 3};
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return across[a] < across[b]; });
        const auto cell = static_cast<Label>(t);
        for (const std::size_t i : order) {
            if (across[i] <= cell) continue;
            faces.entry(face_of(mesh, t, i));
            owner.entry(cell);
            neighbour.entry(across[i]);
        }
    }
}

void write_faces(const Part& part, const Boundary& boundary, ExportFiles& files, const std::string& folder) {
    const auto outer = std::ssize(boundary.faces);
    const std::int64_t count = face_count(part.tet_count(), outer), inner = count - outer;
    const std::string note = fmt::format("nPoints:{}  nCells:{}  nFaces:{}  nInternalFaces:{}", part.vertex_count(),
                                         part.tet_count(), count, inner);
    ListFile faces(files.create(folder + "faces"), header("faceCompactList", "faces", true));
    ListFile owner(files.create(folder + "owner"), header("labelList", "owner", true, note));
    ListFile neighbour(files.create(folder + "neighbour"), header("labelList", "neighbour", true, note));
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

void write_boundary(const std::vector<Patch>& patches, std::int32_t processor, ExportFiles& files,
                    const std::string& folder) {
    ExportFile file = files.create(folder + "boundary");
    file.write(header("polyBoundaryMesh", "boundary", false));
    file.write(fmt::format("{}\n(\n", patches.size()));
    for (const Patch& patch : patches) {
        const bool is_between = patch.other >= 0;
        file.write(
            fmt::format("{}    {}\n    {{\n        type            {};\n", patch.comment, patch.name, patch.type));
        if (patch.type == "wall") file.write("        inGroups        1(wall);\n");
        file.write(fmt::format("        nFaces          {};\n        startFace       {};\n", patch.faces, patch.start));
        if (is_between)
            file.write(
                fmt::format("        myProcNo        {};\n        neighbProcNo    {};\n", processor, patch.other));
        file.write("    }\n");
    }
    file.write(")\n");
    file.close();
}

// As text, so that labels of any size are read.
void write_zones(const Part& part, const std::vector<std::int32_t>& of_tets, ExportFiles& files,
                 const std::string& folder) {
    WordRules rules = word_rules();
    rules.kind = "region";
    const std::vector<std::string> words = word_names(part.region_names, rules);
    std::vector<Labels> cells(words.size());
    for (std::size_t t = 0; t < of_tets.size(); ++t) cells[of_tets[t]].push_back(static_cast<Label>(t));
    ExportFile file = files.create(folder + "cellZones");
    file.write(header("regIOobject", "cellZones", false));
    file.write(fmt::format("{}\n(\n", words.size()));
    for (std::size_t zone = 0; zone < words.size(); ++zone) {
        const std::string& name = part.region_names[zone];
        if (words[zone] != name) file.write(fmt::format("    // {}\n", comment_text(name)));
        file.write(fmt::format("    {}\n    {{\n        type            cellZone;\n", words[zone]));
        file.write(fmt::format("        cellLabels      List<label>\n{}\n(\n", cells[zone].size()));
        for (const Label cell : cells[zone]) write_row(file, {cell});
        file.write(");\n    }\n");
    }
    file.write(")\n");
    file.close();
}

void write_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    KERF_CHECK(part.mesh.neighbours.size() == part.mesh.tets.size());
    KERF_CHECK(part.tet_at_facet.size() == part.facets.size());
    const MeshOutline& outline = parts.outline();
    const std::string folder = mesh_folder(outline.parts.size(), index.value());
    const Materials materials(parts);
    Boundary boundary = boundary_faces_of(part, outline, index.value(), files.options().patch_types);
    if (materials.are_regions()) {
        leave_out_walls(parts.bodies().boundary_sizes(), boundary.patches);
        write_zones(part, materials.of_tets(index, part), files, folder);
    }
    write_points(part, files, folder);
    write_faces(part, boundary, files, folder);
    write_boundary(boundary.patches, index.value(), files, folder);
}

// ---- The case around the meshes

void require_labels(const MeshOutline& outline) {
    for (const PartExtent& part : outline.parts) {
        const std::int64_t faces = face_count(part.tets, part.patch_facets + part.interface_facets);
        if (faces > most_faces)
            throw Error(ErrorCode::usage,
                        fmt::format("Part {} has {} faces, more than the {} that OpenFOAM's 32-bit labels can number. "
                                    "Make more parts: kerf mesh -n.",
                                    part.id, faces, most_faces));
    }
}

// OpenFOAM takes every folder processorN for a part.
void require_no_more_processors(const MeshOutline& outline, const ExportFiles& files) {
    const std::string next = fmt::format("processor{}", outline.parts.size());
    if (outline.parts.size() > 1 && files.is_of_others(next))
        throw Error(ErrorCode::usage, fmt::format("{} belongs to a case in more parts than these. Remove the folders "
                                                  "processor* there, or choose another folder.",
                                                  files.place() + "/" + next));
}

// A dictionary without which no program of OpenFOAM opens the case. One of the user's stays.
void write_dictionary(ExportFiles& files, const std::string& object, std::string_view entries) {
    const std::string name = "system/" + object;
    if (files.is_of_others(name)) return;
    const std::string text = fmt::format(
        "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       dictionary;\n"
        "    location    \"system\";\n    object      {};\n}}\n\n{}",
        object, entries);
    ExportFile file = files.create(name);
    file.write(text);
    file.close();
}

// Second order, and enough for potentialFoam as it is.
constexpr std::string_view schemes =
    "ddtSchemes\n{\n    default         steadyState;\n}\n"
    "gradSchemes\n{\n    default         Gauss linear;\n}\n"
    "divSchemes\n{\n    default         none;\n    div(phi,U)      bounded Gauss linear;\n"
    "    div(div(phi,U)) Gauss linear;\n}\n"
    "laplacianSchemes\n{\n    default         Gauss linear corrected;\n}\n"
    "interpolationSchemes\n{\n    default         linear;\n}\n"
    "snGradSchemes\n{\n    default         corrected;\n}\n";
constexpr std::string_view solution =
    "solvers\n{\n    \"(Phi|p)\"\n    {\n        solver          PCG;\n        preconditioner  DIC;\n"
    "        tolerance       1e-08;\n        relTol          0.01;\n    }\n}\n"
    "potentialFlow\n{\n    nNonOrthogonalCorrectors 10;\n}\n";

void write_whole(const PartSource& parts, ExportFiles& files) {
    const MeshOutline& outline = parts.outline();
    require_patches(files.options().patch_types, outline.patch_names);
    require_labels(outline);
    require_no_more_processors(outline, files);
    write_dictionary(files, "controlDict",
                     "startTime       0;\nendTime         1;\ndeltaT          1;\nwriteInterval   1;\n"
                     "writeFormat     binary;\n");
    write_dictionary(files, "fvSchemes", schemes);
    write_dictionary(files, "fvSolution", solution);
    if (outline.parts.size() > 1)
        write_dictionary(files, "decomposeParDict",
                         fmt::format("numberOfSubdomains {};\nmethod          scotch;\n", outline.parts.size()));
}

}  // namespace openfoam
}  // namespace

extern const Format openfoam_format = {.name = "openfoam",
                                       .help = "OpenFOAM: a case with a folder processorN for each part",
                                       .ending = nullptr,
                                       .needs_face_neighbours = true,
                                       .patch_words = openfoam::patch_words,
                                       .write_whole = openfoam::write_whole,
                                       .write_part = openfoam::write_part};

}  // namespace kerf

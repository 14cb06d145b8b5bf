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
// With FormatOptions::split_regions each region has a mesh of its own, constant/REGION/polyMesh, of which every
// processor has a piece, maybe an empty one (files/export/inside/openfoam_regions.h).
//
// A patch is named by a word (files/export/inside/word_names.h) that is not one of OpenFOAM's for the patches between
// processors; its own name is in a comment, if it is another one. So are zones. Cells are polyhedra with flat faces:
// there are none of second order.
#include <algorithm>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"
#include "files/export/format.h"
#include "files/export/inside/materials.h"
#include "files/export/inside/openfoam_mesh.h"
#include "files/export/inside/openfoam_regions.h"
#include "files/export/inside/text_rows.h"
#include "files/export/inside/word_names.h"
#include "files/part/bodies.h"

namespace kerf {

namespace openfoam {

namespace {

// The last entry of the list of offsets into the corners of faces is a label.
constexpr std::int64_t most_faces = std::numeric_limits<Label>::max() / 3;

std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names, word_rules()); }

// Patches without triangles in any part go, those of processors stay.
void leave_out_walls(const std::vector<std::int64_t>& sizes, std::vector<Patch>& patches) {
    std::size_t number = 0;
    std::erase_if(patches, [&](const Patch&) {
        const std::size_t p = number++;
        return p < sizes.size() && sizes[p] == 0;
    });
}

// Written as text, so that labels of any size are read.
void write_zones(const std::vector<std::string>& names, const std::vector<std::int32_t>& of_tets,
                 const MeshPlace& place, ExportFiles& files) {
    const std::vector<std::string> words = word_names(names, word_rules("region"));
    std::vector<std::vector<Label>> cells(words.size());
    for (std::size_t t = 0; t < of_tets.size(); ++t) cells[of_tets[t]].push_back(t);
    ExportFile file = files.create(place.folder + "cellZones");
    file.write(header("regIOobject", "cellZones", place.location, false));
    file.write(fmt::format("{}\n(\n", words.size()));
    for (std::size_t zone = 0; zone < words.size(); ++zone) {
        file.write(name_comment(names[zone], words[zone]));
        file.write(fmt::format("    {}\n    {{\n        type            cellZone;\n", words[zone]));
        file.write(fmt::format("        cellLabels      List<label>\n{}\n(\n", cells[zone].size()));
        for (const Label cell : cells[zone]) write_row(file, {cell});
        file.write(");\n    }\n");
    }
    file.write(")\n");
    file.close();
}

void write_regions(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    const MeshOutline& outline = parts.outline();
    const RegionMeshes meshes(parts, files.options().patch_types);
    for (const RegionIndex region : ids<RegionIndex>(meshes.count())) {
        const Part own = meshes.part_of(part, region);
        write_mesh(own, boundary_of_mesh(own, outline, index.value(), meshes.patches(region)),
                   mesh_place(outline, index, meshes.word(region)), files);
    }
}

void write_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    KERF_CHECK(part.mesh.neighbours.size() == part.mesh.tets.size());
    KERF_CHECK(part.tet_at_facet.size() == part.facets.size());
    if (files.options().split_regions) return write_regions(parts, index, part, files);
    const MeshOutline& outline = parts.outline();
    const MeshPlace place = mesh_place(outline, index);
    const Materials materials(parts);
    Boundary boundary = boundary_of_mesh(part, outline, index.value(),
                                         patches_of_surface(outline.patch_names, files.options().patch_types));
    if (materials.are_regions()) {
        leave_out_walls(parts.bodies().boundary_sizes(), boundary.patches);
        write_zones(materials.names(), materials.of_tets(index, part), place, files);
    }
    write_mesh(part, boundary, place, files);
}

// ---- The case around the meshes

void require_labels(const MeshOutline& outline) {
    for (const PartExtent& part : outline.parts) {
        const std::int64_t faces = face_count(part.tets, part.patch_facets + part.interface_facets);
        if (faces > most_faces)
            throw Error(ErrorCode::usage,
                        fmt::format("Part {} has {} faces, more than the {} that OpenFOAM's 32-bit labels can number. "
                                    "Make more parts: kerf mesh -n.",
                                    part.id.value(), faces, most_faces));
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

// Writes a dictionary without which no program of OpenFOAM opens the case. One of the user's stays.
void write_dictionary(ExportFiles& files, const std::string& folder, const std::string& object,
                      std::string_view entries) {
    const std::string name = folder + "/" + object;
    if (files.is_of_others(name)) return;
    ExportFile file = files.create(name);
    file.write(header("dictionary", object, folder, false));
    file.write(entries);
    file.close();
}

// Of second order but for turbulence, and enough as they are for potentialFoam and for simpleFoam, with k and omega or
// epsilon or without turbulence. Corrections for faces that are not orthogonal are limited, as tetrahedra beside sharp
// edges have angles of 80 degrees.
constexpr std::string_view schemes = R"foam(ddtSchemes
{
    default         steadyState;
}
gradSchemes
{
    default         Gauss linear;
    "grad\((U|k|omega|epsilon)\)" cellLimited Gauss linear 1;
}
divSchemes
{
    default         none;
    div(phi,U)      bounded Gauss linearUpwind grad(U);
    "div\(phi,(k|omega|epsilon)\)" bounded Gauss upwind;
    div(div(phi,U)) Gauss linear;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes
{
    default         Gauss linear limited corrected 0.33;
}
interpolationSchemes
{
    default         linear;
}
snGradSchemes
{
    default         limited corrected 0.33;
}
wallDist
{
    method          meshWave;
}
)foam";
constexpr std::string_view solution = R"foam(solvers
{
    Phi
    {
        solver          GAMG;
        smoother        DIC;
        tolerance       1e-08;
        relTol          0;
    }
    p
    {
        solver          GAMG;
        smoother        DIC;
        tolerance       1e-08;
        relTol          0.01;
    }
    "(U|k|omega|epsilon)"
    {
        solver          smoothSolver;
        smoother        symGaussSeidel;
        tolerance       1e-08;
        relTol          0.1;
    }
}
potentialFlow
{
    nNonOrthogonalCorrectors 10;
}
SIMPLE
{
    nNonOrthogonalCorrectors 1;
}
relaxationFactors
{
    fields
    {
        p               0.3;
    }
    equations
    {
        "(U|k|omega|epsilon)" 0.7;
    }
}
)foam";

void write_schemes(ExportFiles& files, const std::string& folder) {
    write_dictionary(files, folder, "fvSchemes", schemes);
    write_dictionary(files, folder, "fvSolution", solution);
}

// All regions are solid until the user says which are not.
void write_region_properties(const RegionMeshes& meshes, ExportFiles& files) {
    std::string text = "regions\n(\n    fluid ()\n    solid\n    (\n";
    for (const RegionIndex region : ids<RegionIndex>(meshes.count()))
        text += name_comment(meshes.name(region), meshes.word(region)) + fmt::format("    {}\n", meshes.word(region));
    write_dictionary(files, "constant", "regionProperties", text + "    )\n);\n");
}

void write_whole(const PartSource& parts, ExportFiles& files) {
    const MeshOutline& outline = parts.outline();
    if (files.options().split_regions) require_regions(outline.region_names.size());
    require_patches(files.options().patch_types, outline.patch_names);
    require_labels(outline);
    require_no_more_processors(outline, files);
    write_dictionary(files, "system", "controlDict",
                     "startTime       0;\nendTime         1;\ndeltaT          1;\nwriteInterval   1;\n"
                     "writeFormat     binary;\n");
    write_schemes(files, "system");
    if (outline.parts.size() > 1)
        write_dictionary(files, "system", "decomposeParDict",
                         fmt::format("numberOfSubdomains {};\nmethod          scotch;\n", outline.parts.size()));
    if (!files.options().split_regions) return;
    const RegionMeshes meshes(parts, files.options().patch_types);
    write_region_properties(meshes, files);
    for (const RegionIndex region : ids<RegionIndex>(meshes.count()))
        write_schemes(files, "system/" + meshes.word(region));
}

}  // namespace

}  // namespace openfoam

extern const Format openfoam_format = {.name = "openfoam",
                                       .help = "OpenFOAM: a case with a folder processorN for each part",
                                       .ending = nullptr,
                                       .needs_face_neighbours = true,
                                       .highest_order = 1,
                                       .patch_words = openfoam::patch_words,
                                       .write_whole = openfoam::write_whole,
                                       .write_part = openfoam::write_part};

}  // namespace kerf

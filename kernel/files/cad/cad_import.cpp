// Bodies come first: the solids of the file, or its loose faces sewn, or all solids united. Bodies that touch are
// mostly found before the work, by coarse facets (contact.h): they become regions that share walls (imprint.h), and all
// bodies are tessellated at once (assembly_mesher.h). Otherwise each body is tessellated by itself (body_mesher.h).
// Vertices that are moved off the faces for the volume may make bodies meet that are only close: so if facets of two
// bodies meet, all are tessellated once more without moved vertices, and only if facets meet then, the bodies touch. At
// last solids that lie inside of others are cut out of them.
#include "files/cad/cad_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "files/cad/inside/assembly_mesher.h"
#include "files/cad/inside/body_mesher.h"
#include "files/cad/inside/contact.h"
#include "files/cad/inside/healing.h"
#include "files/cad/inside/imprint.h"
#include "files/cad/inside/model.h"
#include "files/cad/inside/projection.h"
#include "surface/diagnosis/intersections.h"
#include "surface/regions/region_finder.h"

namespace kerf {

namespace {

using cad::Assembly;
using cad::Body;
using cad::counted;
using cad::MeshedBody;
using cad::Model;
using cad::place_text;
using cad::refuse;
using cad::Tessellation;

[[noreturn]] void refuse_solids(const std::string& path, const std::string& what, const Vec3& where,
                                std::vector<std::string> solids) {
    refuse(path, what, SolidDefect::touching,
           {{ElementKind::solid, {}, {{where.x(), where.y(), where.z()}}, std::move(solids)}});
}

[[noreturn]] void refuse_contact(const std::string& path, const std::string& one, const std::string& other,
                                 const Vec3& where) {
    refuse_solids(path,
                  fmt::format("solids '{}' and '{}' touch or overlap near {}. Join what touches by --unite, or choose "
                              "one by --solid N.",
                              one, other, place_text(where)),
                  where, {one, other});
}

[[noreturn]] void refuse_imprint(const cad::ImprintFailure& failure, const Model& model, const std::string& path) {
    const std::string &one = model.bodies[failure.bodies[0]].name, &other = model.bodies[failure.bodies[1]].name;
    const std::string place = place_text(failure.where);
    using Kind = cad::ImprintFailure::Kind;
    if (failure.kind == Kind::overlap)
        refuse_solids(path,
                      fmt::format("solids '{}' and '{}' overlap near {}. Join them by --unite, or choose one by "
                                  "--solid N.",
                                  one, other, place),
                      failure.where, {one, other});
    if (failure.kind == Kind::apart)
        refuse_solids(path,
                      fmt::format("solids '{}' and '{}' touch or overlap near {}, but OpenCASCADE finds nothing that "
                                  "they have in common. Join what touches by --unite, choose one by --solid N, or move "
                                  "them apart in the CAD program.",
                                  one, other, place),
                      failure.where, {one, other});
    if (one == other)
        refuse_solids(path,
                      fmt::format("solid '{}', near {}, does not stay what it is when solids share what they touch in. "
                                  "Join what touches by --unite, choose one by --solid N, or repair it in the CAD "
                                  "program.",
                                  one, place),
                      failure.where, {one});
    refuse_solids(path,
                  fmt::format("OpenCASCADE cannot make solids share what they touch in, as '{}' and '{}' do near {}. "
                              "Join what touches by --unite, choose one by --solid N, or repair them in the CAD "
                              "program.",
                              one, other, place),
                  failure.where, {one, other});
}

void select_solid(Model& model, std::int32_t number, const std::string& path) {
    const auto count = count_of(model.bodies);
    if (number > std::max(count, 1))
        throw Error(ErrorCode::usage,
                    fmt::format("--solid is {}, but {} has {}.", number, path, counted(count, "solid", "solids")));
    if (count == 0) return;
    Body chosen = std::move(model.bodies[number - 1]);
    model.notes.push_back(fmt::format("Solid {} of {}: {}.", number, count, chosen.name));
    model.bodies.clear();
    model.bodies.push_back(std::move(chosen));
}

// Sews a body that has edges of one face only. A face that is closed in itself, as a sphere is, can be sewn to nothing
// before it is divided.
void close_body(Body& body, Model& model, const std::string& path) {
    cad::FreeEdges free = cad::find_free_edges(body);
    if (free.count == 0) return;
    std::optional<double> share = cad::sew(body, free);
    if (!share && cad::divide_closed_faces(body)) {
        free = cad::find_free_edges(body);
        if (free.count == 0) return;
        share = cad::sew(body, free);
    }
    if (!share)
        refuse(path,
               fmt::format("'{}' is open: {} of one face only, of {}, the first at {}. Close it in the CAD program "
                           "and export a solid.",
                           body.name, counted(free.count, "edge", "edges"), names_of(free.patches, model.patches),
                           place_text(free.where)),
               SolidDefect::open);
    model.notes.push_back(
        fmt::format("The faces of '{}' were sewn within {:.3g} mm.", body.name, *share * cad::diagonal_of(body.shape)));
}

void make_bodies(Model& model, const CadOptions& options, const std::string& path) {
    if (options.solid > 0) select_solid(model, options.solid, path);
    if (model.bodies.empty()) {
        model.bodies.push_back(std::move(model.loose));
    } else if (const int loose = model.loose.patch_of.Extent(); loose > 0 && options.solid == 0) {
        model.notes.push_back(
            fmt::format("{} of no solid {} ignored.", counted(loose, "face", "faces"), loose == 1 ? "was" : "were"));
    }
    for (Body& body : model.bodies) close_body(body, model, path);
    if (!options.unite || model.bodies.size() < 2) return;
    std::optional<Body> united = cad::unite(model.bodies);
    if (!united)
        refuse(path, "OpenCASCADE cannot unite the solids. Unite them in the CAD program, or choose one by --solid N.");
    model.notes.push_back(fmt::format("{} solids were united.", model.bodies.size()));
    model.bodies.clear();
    model.bodies.push_back(*std::move(united));
}

// Takes the bodies as the file has them, loose faces, too.
void take_all(Model& model, const CadOptions& options, const std::string& path) {
    if (options.solid > 0 && !model.bodies.empty())
        select_solid(model, options.solid, path);
    else if (model.loose.patch_of.Extent() > 0)
        model.bodies.push_back(std::move(model.loose));
}

void append(Soup& soup, const Tessellation& mesh) {
    const auto shift = count_of(soup.vertices);
    soup.vertices.insert(soup.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Triangle& t : mesh.facets) soup.facets.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    soup.patch.insert(soup.patch.end(), mesh.patch.begin(), mesh.patch.end());
    for (const ModelEdge& e : mesh.edges)
        soup.model_edges.push_back({{e.vertices[0] + shift, e.vertices[1] + shift}, e.sharp});
}

// The facets of all bodies, in the order of the bodies.
struct Bodies {
    Soup soup;
    std::vector<std::int32_t> first_facet;  // of each
    double volume = 0, exact_volume = 0;
    std::vector<std::array<double, 2>> volumes;  // of each body: of its facets, and exact; empty if they are regions
    std::vector<Body> shapes;                    // the shapes whose faces have these facets
};

Bodies tessellate_bodies(Model& model, const CadOptions& options, const std::string& path, bool may_balance) {
    Bodies all;
    for (Body& body : model.bodies) {
        const MeshedBody meshed = cad::mesh_body(body, model, path, options, may_balance);
        all.first_facet.push_back(count_of(all.soup.facets));
        append(all.soup, meshed.facets);
        all.volume += meshed.facets.volume;
        all.exact_volume += meshed.exact_volume;
        all.volumes.push_back({meshed.facets.volume, meshed.exact_volume});
        all.shapes.push_back(body);
    }
    return all;
}

// Tessellates all faces by chords of a size; what has no triangles is left out, and nothing is checked.
Bodies tessellate_as_it_is(Model& model, const CadOptions& options, const std::string& path) {
    constexpr double deflection = 5e-4, angle = 0.35;  // of the diagonal, and radians
    const double share = options.deflection > 0 ? options.deflection : deflection;
    Bodies all;
    for (Body& body : model.bodies) {
        const double diagonal = cad::diagonal_of(body.shape);
        if (!(diagonal > 0) || !std::isfinite(diagonal)) continue;
        cad::divide_closed_faces(body);
        const Tessellation mesh = cad::tessellate(body, {share * diagonal, angle});
        append(all.soup, mesh);
        all.shapes.push_back(body);
        if (!mesh.failed_faces.empty())
            model.notes.push_back(fmt::format("{} without triangles: {}.",
                                              counted(mesh.failed_faces.size(), "face is", "faces are"),
                                              names_of(mesh.failed_faces, model.patches)));
    }
    if (all.soup.facets.empty()) refuse(path, "no face gets triangles. Export it again.");
    return all;
}

std::vector<double> diagonals_of(const std::vector<Body>& bodies) {
    std::vector<double> diagonals;
    for (const Body& body : bodies) diagonals.push_back(cad::diagonal_of(body.shape));
    return diagonals;
}

void divide_all_closed_faces(Model& model) {
    for (Body& body : model.bodies)
        if (cad::divide_closed_faces(body))
            model.notes.push_back(
                fmt::format("Closed faces of '{}' were divided, since some got no triangles.", body.name));
}

Bodies to_bodies(const Assembly& assembly, cad::MeshedAssembly meshed, Model& model) {
    Bodies all;
    append(all.soup, meshed.facets);
    all.soup.sides = std::move(meshed.facets.sides);
    all.soup.region_names = assembly.region_names;
    for (const RegionIndex r : assembly.volumes.ids()) {
        all.volume += meshed.volumes[r];
        all.exact_volume += assembly.volumes[r];
    }
    model.notes.push_back(fmt::format("Solids touch: they are {} regions that share {}.", assembly.volumes.size(),
                                      counted(assembly.wall_faces, "face", "faces")));
    if (assembly.tolerance > 0)
        model.notes.push_back(fmt::format("Faces within {:.3g} mm were taken as one.", assembly.tolerance));
    model.patches = assembly.patches;
    all.shapes = {assembly.faces};
    return all;
}

// Makes bodies that touch regions that share walls, and tessellates them at once.
Bodies tessellate_touching(Model& model, const cad::Contact& contact, const CadOptions& options,
                           const std::string& path) {
    for (bool is_divided = false;; is_divided = true) {
        const cad::Imprint imprint(model.bodies, model.patches, contact);
        if (!imprint.assembly()) refuse_imprint(imprint.failure(), model, path);
        std::optional<cad::MeshedAssembly> meshed =
            cad::mesh_assembly(*imprint.assembly(), diagonals_of(model.bodies), path, options, !is_divided);
        if (meshed) return to_bodies(*imprint.assembly(), *std::move(meshed), model);
        divide_all_closed_faces(model);
    }
}

// Returns the first two solids whose facets meet; nothing if none do.
std::optional<cad::Contact> contact_of(const Bodies& all) {
    if (all.first_facet.size() < 2) return {};
    const auto pairs = find_self_intersections(all.soup.vertices, all.soup.facets, 1);
    if (pairs.empty()) return {};
    const auto body_of = [&](std::int32_t facet) -> std::size_t {
        const auto next = std::upper_bound(all.first_facet.begin(), all.first_facet.end(), facet);
        return next - all.first_facet.begin() - 1;
    };
    const auto [f, g] = pairs.front();
    return cad::Contact{{body_of(f), body_of(g)}, all.soup.vertices[all.soup.facets[f][0]]};
}

// Cuts a solid that lies inside of another one, which it does not touch, out of it: both are regions.
void take_nested(Bodies& all, Model& model) {
    if (all.volumes.size() < 2) return;
    std::vector<std::int32_t> body_of_facet(all.soup.facets.size());
    for (std::int32_t b = 0; b < count_of(all.first_facet); ++b)
        std::fill(body_of_facet.begin() + all.first_facet[b], body_of_facet.end(), b);
    std::vector<std::string> names;
    for (const Body& body : model.bodies) names.push_back(body.name);
    Soup bodies = all.soup;
    bodies.patch = body_of_facet;
    bodies.patch_names = names;
    if (!find_nested_bodies(bodies, body_of_facet, names)) return;
    all.soup.facets = std::move(bodies.facets);
    all.soup.sides = std::move(bodies.sides);
    all.soup.region_names = std::move(bodies.region_names);
    std::size_t nested = 0;
    for (std::size_t b = 0; b < all.volumes.size(); ++b) {
        if (!all.soup.sides[all.first_facet[b]].is_wall()) continue;
        ++nested;
        all.volume -= all.volumes[b][0];
        all.exact_volume -= all.volumes[b][1];
    }
    model.notes.push_back(
        nested == 1 ? std::string("1 solid lies inside of another one and is cut out of it: they are regions.")
                    : fmt::format("{} solids lie inside of others and are cut out of them: all are regions.", nested));
}

Bodies tessellate_all(Model& model, const CadOptions& options, const std::string& path) {
    const auto touching = [&](const cad::Contact& contact) {
        if (!options.no_imprint) return tessellate_touching(model, contact, options, path);
        refuse_contact(path, model.bodies[contact.bodies[0]].name, model.bodies[contact.bodies[1]].name, contact.where);
    };
    if (const std::optional<cad::Contact> contact = cad::find_contact(model.bodies)) return touching(*contact);
    Bodies all = tessellate_bodies(model, options, path, !options.on_faces);
    std::optional<cad::Contact> contact = contact_of(all);
    if (options.deflection == 0 && !options.on_faces && contact) {
        all = tessellate_bodies(model, options, path, false);
        contact = contact_of(all);
    }
    if (contact) return touching(*contact);
    take_nested(all, model);
    return all;
}

// Gives the soup its patches, and the body their faces. Patches without facets are left out, and those of one name are
// one.
void set_patches(CadBody& body, const std::vector<cad::Patch>& patches) {
    Soup& soup = body.soup;
    std::vector<PatchFace>& faces = body.faces_of_patches;
    std::vector<std::int32_t> number(patches.size(), -1);
    for (const std::int32_t p : soup.patch) number[p] = 0;
    bool any_colour = false;
    std::map<std::string, std::int32_t> number_of_name;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (number[p] < 0) continue;
        const auto next = count_of(soup.patch_names);
        number[p] = number_of_name.try_emplace(patches[p].name, next).first->second;
        if (number[p] != next) continue;
        soup.patch_names.push_back(patches[p].name);
        soup.patch_colours.push_back(patches[p].colour);
        faces.push_back(patches[p].face);
        faces.back().patch = patches[p].name;
        any_colour = any_colour || patches[p].colour[3] != 0;
    }
    if (!any_colour) soup.patch_colours.clear();
    for (std::int32_t& p : soup.patch) p = number[p];
}

void convert(CadBody& body, LengthUnit unit) {
    if (body.file_unit.empty()) return;
    body.unit = length_unit_names()[static_cast<std::size_t>(unit)];
    const double millimetres = millimetres_of(unit);
    if (millimetres == 1) return;
    for (Vec3& p : body.soup.vertices) p /= millimetres;
    for (PatchFace& face : body.faces_of_patches) {
        face.radius /= millimetres;
        face.tube /= millimetres;
    }
    body.volume /= std::pow(millimetres, 3);
    body.exact_volume /= std::pow(millimetres, 3);
}

std::string description(const CadBody& body, bool as_it_is) {
    const std::string unit =
        body.file_unit.empty() ? "no unit" : fmt::format("unit {} -> {}", body.file_unit, body.unit);
    if (as_it_is)
        return fmt::format("{}: {}, {}, {} as they are, with gaps and crossings.", body.format, unit,
                           counted(body.solids, "solid", "solids"), counted(body.faces, "face", "faces"));
    return fmt::format("{}: {}, {}, {}; volume {:.6g}, the facets hold {:+.2g} %.", body.format, unit,
                       counted(body.solids, "solid", "solids"), counted(body.faces, "face", "faces"), body.exact_volume,
                       100 * (body.volume - body.exact_volume) / body.exact_volume);
}

// The result for a file, and the shapes of which it is made.
struct ImportedModel {
    CadBody body;
    std::vector<Body> shapes;
    std::vector<cad::Patch> patches;
};

ImportedModel import_model(Model model, const CadOptions& options, const std::string& path) {
    if (options.as_it_is)
        take_all(model, options, path);
    else
        make_bodies(model, options, path);
    ImportedModel imported;
    CadBody& result = imported.body;
    result.format = name(model.format);
    result.file_unit = model.unit;
    Bodies all = options.as_it_is ? tessellate_as_it_is(model, options, path) : tessellate_all(model, options, path);
    imported.shapes = std::move(all.shapes);
    result.soup = std::move(all.soup);
    result.volume = all.volume;
    result.exact_volume = all.exact_volume;
    set_patches(result, model.patches);
    drop_unused_vertices(result.soup);
    result.soup.vertex_number.clear();  // the file has no vertices of facets
    result.solids = count_of(model.bodies);
    result.faces = count_of(result.soup.patch_names);
    convert(result, options.unit);
    result.soup.is_of_model = true;
    result.soup.notes = {description(result, options.as_it_is)};
    if (result.file_unit.empty() && options.unit != LengthUnit::mm)
        result.soup.notes.emplace_back("The file names no unit: its numbers stay, whatever unit is asked for.");
    result.soup.notes.insert(result.soup.notes.end(), model.notes.begin(), model.notes.end());
    imported.patches = std::move(model.patches);
    return imported;
}

template <class Use>
auto with_imported(std::string_view content, const std::string& path, const CadOptions& options, Use use) {
    silence_occt();
    try {
        return use(import_model(cad::read_model(content, path), options, path));
    } catch (const Standard_Failure& failure) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: OpenCASCADE fails on a shape ({}). Repair it in the CAD program.", path,
                                failure.DynamicType()->Name()));
    }
}

}  // namespace

CadBody import_cad(std::string_view content, const std::string& path, const CadOptions& options) {
    return with_imported(content, path, options, [](ImportedModel imported) { return std::move(imported.body); });
}

ProjectedPoints project_on_cad(std::string_view content, const std::string& path, const CadOptions& options,
                               const CadPoints& points) {
    return with_imported(content, path, options, [&](const ImportedModel& imported) {
        const double millimetres = imported.body.file_unit.empty() ? 1 : millimetres_of(options.unit);
        return cad::project_points(imported.shapes, imported.patches, points, millimetres);
    });
}

void silence_occt() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

}  // namespace kerf

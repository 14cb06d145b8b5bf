// Bodies first: the solids of the file, or its loose faces sewn, or all solids united. Each body is then tessellated
// for itself, down a ladder. Chords that cross, mostly between two close edges, are cured by other chords: a smaller
// deflection, then a smaller angle. A face that is closed in itself may get no triangles; then such faces are divided.
//
// Chords are as fine as the volume between them and the faces asks for, and vertices are moved off the faces until the
// facets hold what the solid holds (volume_balance.h): for the same volume, chords would have to be ten times as fine.
// Where that fails, or bodies meet that way which are apart, the deflection gets smaller by what is missing, since the
// error is proportional to it. Bodies that do touch are mostly found before all of this, by coarse facets.
#include "cad/cad_import.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>

#include "cad/contact.h"
#include "cad/healing.h"
#include "cad/model.h"
#include "cad/tessellation.h"
#include "cad/volume_balance.h"
#include "core/error.h"
#include "geometry/predicates.h"
#include "surface/intersections.h"

namespace kerf {

namespace {

using cad::Body;
using cad::Model;
using cad::Tessellation;
using cad::TessellationSettings;

constexpr double coarsest_deflection = 1e-3;  // of the diagonal
constexpr double finest_deflection = 1e-6;
constexpr double coarsest_angle = 0.35;  // radians between chords: 18 a turn
// Bounds of what is done for the volume. The time that a face takes grows with the square of its facets.
constexpr double most_facets_by_volume = 320000;
constexpr double most_facets_of_face_by_volume = 80000;
constexpr double most_between = 0.01;  // of the volume, between facets and faces: so few chords can be balanced
constexpr double hopeless_volume_error = 0.05;  // beyond that the faces are not those of the solid
constexpr double volume_precision =
    1e-6;  // of the integration, which has a fixed number of points else: 1 % off for a thread
constexpr int most_tries = 12;

std::string counted(std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string place_text(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

[[noreturn]] void refuse(const std::string& path, const std::string& what, const char* kind = SolidDefect::broken) {
    throw SolidDefect(kind, path + ": " + what);
}

[[noreturn]] void refuse_contact(const std::string& path, const std::string& one, const std::string& other,
                                 const Vec3& where) {
    refuse(path,
           fmt::format("solids '{}' and '{}' touch or overlap near {}. Join what touches by --unite, or choose one by "
                       "--solid N.",
                       one, other, place_text(where)),
           SolidDefect::touching);
}

// A body while it is tessellated.
class BodyMesher {
 public:
    BodyMesher(Body& body, Model& model, const std::string& path, double deflection, bool may_balance)
        : body_(body),
          model_(model),
          path_(path),
          by_volume_(deflection == 0),
          may_balance_(may_balance),
          diagonal_(cad::diagonal_of(body.shape)) {
        settings_ = {(by_volume_ ? coarsest_deflection : deflection) * diagonal_, coarsest_angle};
        GProp_GProps properties;
        BRepGProp::VolumeProperties(body.shape, properties, volume_precision);
        exact_volume_ = std::abs(properties.Mass());
    }

    double exact_volume() const { return exact_volume_; }

    Tessellation run() {
        if (!(diagonal_ > 0) || !std::isfinite(diagonal_))
            refuse(path_, fmt::format("solid '{}' has no extent. Export it again.", body_.name));
        cad::find_smooth_edges(body_);
        for (int i = 0; i < most_tries; ++i) {
            Tessellation mesh = cad::tessellate(body_, settings_);
            if (!mesh.failed_faces.empty() && divide()) continue;
            trouble_ = trouble_of(mesh);
            if (trouble_.empty() && !is_right(mesh)) {
                if (balance(mesh)) return checked(std::move(mesh));
                if (tighten(mesh)) continue;
            }
            if (trouble_.empty()) trouble_ = crossing_of(mesh);
            if (trouble_.empty()) return checked(std::move(mesh));
            next_rung();
        }
        refuse(path_, trouble_);
    }

 private:
    bool divide() {
        if (is_divided_) return false;
        is_divided_ = cad::divide_closed_faces(body_);
        if (!is_divided_) return false;
        cad::find_smooth_edges(body_);
        model_.notes.push_back(
            fmt::format("Closed faces of '{}' were divided, since they got no triangles.", body_.name));
        return true;
    }

    std::string trouble_of(const Tessellation& mesh) const {
        if (mesh.facets.empty() && mesh.failed_faces.empty())
            return fmt::format("solid '{}' has no faces. Export it again.", body_.name);
        if (!mesh.failed_faces.empty())
            return fmt::format(
                "OpenCASCADE finds no triangles for {} ({}). Repair them in the CAD program, or export "
                "triangles.",
                counted(mesh.failed_faces.size(), "face", "faces"), names_of(mesh.failed_faces, model_.patches));
        if (!mesh.open_patches.empty())
            return fmt::format(
                "solid '{}' is not closed, or its faces meet each other more than once, at {}. Repair "
                "it in the CAD program.",
                body_.name, names_of(mesh.open_patches, model_.patches));
        return "";
    }

    std::string crossing_of(const Tessellation& mesh) const {
        for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
            const auto& [a, b, c] = mesh.facets[f];
            if (are_collinear(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]))
                return fmt::format(
                    "face {} of solid '{}' has a triangle without area at {}. Repair it in the CAD "
                    "program.",
                    names_of({mesh.patch[f]}, model_.patches), body_.name, place_text(mesh.vertices[a]));
        }
        const auto pairs = find_self_intersections(mesh.vertices, mesh.facets, 1);
        if (pairs.empty()) return "";
        const auto [f, g] = pairs.front();
        return fmt::format("solid '{}' intersects itself near {}, at {}. Repair it in the CAD program.", body_.name,
                           place_text(mesh.vertices[mesh.facets[f][0]]),
                           names_of({mesh.patch[f], mesh.patch[g]}, model_.patches));
    }

    // Signed: positive if the facets hold too much.
    double volume_error(const Tessellation& mesh) const {
        return exact_volume_ > 0 ? (std::abs(mesh.volume) - exact_volume_) / exact_volume_ : 0;
    }

    // How many times rougher the chords are than what can be balanced: volumes that they miss inside and outside may
    // cancel, as in thin tubes.
    double roughness(const Tessellation& mesh) const {
        return exact_volume_ > 0 ? cad::volume_between(mesh) / (most_between * exact_volume_) : 0;
    }

    bool is_right(const Tessellation& mesh) const {
        return !by_volume_ || (std::abs(volume_error(mesh)) <= CadOptions::volume_tolerance && roughness(mesh) <= 1);
    }

    bool balance(Tessellation& mesh) const {
        if (!may_balance_ || roughness(mesh) > 1) return false;
        Tessellation balanced = mesh;
        if (!cad::balance_volume(balanced, std::copysign(exact_volume_, mesh.volume))) return false;
        if (!crossing_of(balanced).empty()) return false;
        mesh = std::move(balanced);
        return true;
    }

    // A smaller deflection for the volume; false if that cannot be bettered.
    bool tighten(const Tessellation& mesh) {
        const double error = volume_error(mesh);
        // As long as the angle decides, facets and error stay what they are.
        const auto facets = static_cast<double>(mesh.facets.size());
        const bool has_effect = facets > 1.3 * std::exchange(last_facets_, facets);
        if (has_effect && is_not_of_chords(error)) return false;
        const double rough = roughness(mesh);
        const double wanted = std::min(rough > 1 ? 0.8 / rough : 0.3, has_effect ? 0.6 : 0.25);
        // Facets grow as 1 / deflection where a face is curved both ways.
        const double factor = std::max({wanted, 0.05, facets / most_facets_by_volume,
                                        facets_of_largest_face(mesh) / most_facets_of_face_by_volume});
        if (factor > 0.9 || settings_.deflection * factor < finest_deflection * diagonal_) return false;
        settings_.deflection *= factor;
        return true;
    }

    static double facets_of_largest_face(const Tessellation& mesh) {
        std::vector<std::int32_t> counts(
            static_cast<std::size_t>(*std::max_element(mesh.patch.begin(), mesh.patch.end())) + 1);
        for (const std::int32_t patch : mesh.patch) ++counts[patch];
        return *std::max_element(counts.begin(), counts.end());
    }

    // The error is proportional to the deflection once the angle counts no more. What would remain without any chords,
    // twice in a row, is due to faces that do not meet exactly.
    bool is_not_of_chords(double error) {
        const double deflection = settings_.deflection;
        if (last_deflection_ > 0) {
            const double slope = (last_error_ - error) / (last_deflection_ - deflection);
            const bool remains = std::abs(error - slope * deflection) > CadOptions::volume_tolerance;
            remaining_ = remains ? remaining_ + 1 : 0;
        }
        last_error_ = error;
        last_deflection_ = deflection;
        return remaining_ >= 2;
    }

    void next_rung() { (rung_++ % 2 == 0 ? settings_.deflection : settings_.angle) *= 0.7; }

    Tessellation checked(Tessellation mesh) const {
        if (std::abs(volume_error(mesh)) > hopeless_volume_error)
            refuse(path_, fmt::format("the facets of solid '{}' hold {:.6g} mm3, but OpenCASCADE gives it {:.6g}: its "
                                      "faces do not bound it. Repair it in the CAD program.",
                                      body_.name, std::abs(mesh.volume), exact_volume_));
        if (mesh.volume < 0) {
            for (Triangle& t : mesh.facets) std::swap(t[1], t[2]);
            mesh.volume = -mesh.volume;
        }
        return mesh;
    }

    Body& body_;
    Model& model_;
    const std::string& path_;
    bool by_volume_;
    bool may_balance_;  // else all vertices stay on the faces
    double diagonal_;
    TessellationSettings settings_ = {};
    double exact_volume_ = 0;
    double last_error_ = 0, last_deflection_ = 0, last_facets_ = 0;
    int remaining_ = 0, rung_ = 0;
    bool is_divided_ = false;
    std::string trouble_;
};

void select_solid(Model& model, std::int32_t number, const std::string& path) {
    const auto count = static_cast<std::int32_t>(model.bodies.size());
    if (number > std::max(count, 1))
        throw Error(ErrorCode::usage, fmt::format("--solid is {}, but {} has {}.", number, path,
                                                  counted(static_cast<std::size_t>(count), "solid", "solids")));
    if (count == 0) return;
    Body chosen = std::move(model.bodies[static_cast<std::size_t>(number) - 1]);
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
                           body.name, counted(static_cast<std::size_t>(free.count), "edge", "edges"),
                           names_of(free.patches, model.patches), place_text(free.where)),
               SolidDefect::open);
    model.notes.push_back(
        fmt::format("The faces of '{}' were sewn within {:.3g} mm.", body.name, *share * cad::diagonal_of(body.shape)));
}

void make_bodies(Model& model, const CadOptions& options, const std::string& path) {
    if (options.solid > 0) select_solid(model, options.solid, path);
    if (model.bodies.empty()) {
        model.bodies.push_back(std::move(model.loose));
    } else if (const int loose = model.loose.patch_of.Extent(); loose > 0 && options.solid == 0) {
        model.notes.push_back(fmt::format("{} of no solid {} ignored.",
                                          counted(static_cast<std::size_t>(loose), "face", "faces"),
                                          loose == 1 ? "was" : "were"));
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

void append(Soup& soup, const Tessellation& mesh) {
    const auto shift = static_cast<std::int32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Triangle& t : mesh.facets) soup.facets.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    soup.patch.insert(soup.patch.end(), mesh.patch.begin(), mesh.patch.end());
    for (const ModelEdge& e : mesh.edges)
        soup.model_edges.push_back({{e.vertices[0] + shift, e.vertices[1] + shift}, e.sharp});
}

// All bodies as facets, in their order.
struct Bodies {
    Soup soup;
    std::vector<std::int32_t> first_facet;  // of each
    double volume = 0, exact_volume = 0;
};

Bodies tessellate_bodies(Model& model, const CadOptions& options, const std::string& path, bool may_balance) {
    Bodies all;
    for (Body& body : model.bodies) {
        BodyMesher mesher(body, model, path, options.deflection, may_balance);
        const Tessellation mesh = mesher.run();
        all.first_facet.push_back(static_cast<std::int32_t>(all.soup.facets.size()));
        append(all.soup, mesh);
        all.volume += mesh.volume;
        all.exact_volume += mesher.exact_volume();
    }
    return all;
}

// Solids whose facets meet, the first of them; nothing if none do.
std::optional<cad::Contact> contact_of(const Bodies& all) {
    if (all.first_facet.size() < 2) return {};
    const auto pairs = find_self_intersections(all.soup.vertices, all.soup.facets, 1);
    if (pairs.empty()) return {};
    const auto body_of = [&](std::int32_t facet) {
        const auto next = std::upper_bound(all.first_facet.begin(), all.first_facet.end(), facet);
        return static_cast<std::size_t>(next - all.first_facet.begin() - 1);
    };
    const auto [f, g] = pairs.front();
    return cad::Contact{{body_of(f), body_of(g)}, all.soup.vertices[all.soup.facets[f][0]]};
}

void refuse_if(const std::optional<cad::Contact>& contact, const Model& model, const std::string& path) {
    if (contact)
        refuse_contact(path, model.bodies[contact->bodies[0]].name, model.bodies[contact->bodies[1]].name,
                       contact->where);
}

// Patches without facets are left out.
void set_patches(Soup& soup, const std::vector<cad::Patch>& patches) {
    std::vector<std::int32_t> number(patches.size(), -1);
    for (const std::int32_t p : soup.patch) number[p] = 0;
    bool any_colour = false;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (number[p] < 0) continue;
        number[p] = static_cast<std::int32_t>(soup.patch_names.size());
        soup.patch_names.push_back(patches[p].name);
        soup.patch_colours.push_back(patches[p].colour);
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
    body.volume /= std::pow(millimetres, 3);
    body.exact_volume /= std::pow(millimetres, 3);
}

std::string description(const CadBody& body) {
    const std::string unit =
        body.file_unit.empty() ? "no unit" : fmt::format("unit {} -> {}", body.file_unit, body.unit);
    return fmt::format("{}: {}, {}, {}; volume {:.6g}, the facets hold {:+.2g} %.", body.format, unit,
                       counted(static_cast<std::size_t>(body.solids), "solid", "solids"),
                       counted(static_cast<std::size_t>(body.faces), "face", "faces"), body.exact_volume,
                       100 * (body.volume - body.exact_volume) / body.exact_volume);
}

CadBody import_model(Model model, const CadOptions& options, const std::string& path) {
    make_bodies(model, options, path);
    CadBody result;
    result.format = name(model.format);
    result.file_unit = model.unit;
    refuse_if(cad::find_contact(model.bodies), model, path);
    Bodies all = tessellate_bodies(model, options, path, true);
    std::optional<cad::Contact> contact = contact_of(all);
    if (options.deflection == 0 && contact) {
        all = tessellate_bodies(model, options, path, false);
        contact = contact_of(all);
    }
    refuse_if(contact, model, path);
    result.soup = std::move(all.soup);
    result.volume = all.volume;
    result.exact_volume = all.exact_volume;
    set_patches(result.soup, model.patches);
    drop_unused_vertices(result.soup);
    result.soup.vertex_number.clear();  // the file has no vertices of facets
    result.solids = static_cast<std::int32_t>(model.bodies.size());
    result.faces = static_cast<std::int32_t>(result.soup.patch_names.size());
    convert(result, options.unit);
    result.soup.is_of_model = true;
    result.soup.notes = {description(result)};
    if (result.file_unit.empty() && options.unit != LengthUnit::mm)
        result.soup.notes.emplace_back("The file names no unit: its numbers stay, whatever unit is asked for.");
    result.soup.notes.insert(result.soup.notes.end(), model.notes.begin(), model.notes.end());
    return result;
}

}  // namespace

CadBody import_cad(std::string_view content, const std::string& path, const CadOptions& options) {
    silence_occt();
    try {
        return import_model(cad::read_model(content, path), options, path);
    } catch (const Standard_Failure& failure) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: OpenCASCADE fails on a shape ({}). Repair it in the CAD program.", path,
                                failure.DynamicType()->Name()));
    }
}

void silence_occt() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

}  // namespace kerf

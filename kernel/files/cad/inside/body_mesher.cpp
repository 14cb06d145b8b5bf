// A body goes down a ladder. Chords that cross, mostly between two close edges, are cured by other chords: a smaller
// deflection, then a smaller angle. A face that is closed in itself may get no triangles; then such faces are divided.
//
// Chords are as fine as the volume between them and the faces asks for, and vertices are moved off the faces until the
// facets hold the volume of the solid (volume_balance.h): for the same volume, chords would have to be ten times as
// fine. Where that fails, the deflection gets smaller by the missing share, since the error is proportional to it.
// "Roughness" is the volume between facets and faces over the most that can be balanced; only above 1 chords must get
// finer for it.
#include "files/cad/inside/body_mesher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>

#include "base/geometry/predicates.h"
#include "files/cad/inside/healing.h"
#include "files/cad/inside/volume_balance.h"
#include "surface/diagnosis/intersections.h"

namespace kerf::cad {

namespace {

constexpr double coarsest_deflection = 1e-3;  // of the diagonal
constexpr double finest_deflection = 1e-6;
constexpr double coarsest_angle = 0.35;  // radians between chords: 18 a turn
// Bounds of the effort for the volume. The time that a face takes grows with the square of its facets.
constexpr double most_facets_by_volume = 320000;
constexpr double most_facets_of_face_by_volume = 80000;
constexpr double most_between = 0.01;  // of the volume, between facets and faces: so few chords can be balanced
constexpr double most_between_on_faces = 0.001;
constexpr double hopeless_volume_error = 0.05;  // beyond that the faces are not those of the solid
constexpr double volume_precision =
    1e-6;  // of the integration, which has a fixed number of points else: 1 % off for a thread
constexpr int most_tries = 12;

class BodyMesher {
 public:
    BodyMesher(Body& body, Model& model, const std::string& path, const CadOptions& options, bool may_balance)
        : body_(body),
          model_(model),
          path_(path),
          by_volume_(options.deflection == 0),
          on_faces_(options.on_faces),
          may_balance_(may_balance),
          diagonal_(diagonal_of(body.shape)) {
        settings_ = {(by_volume_ ? coarsest_deflection : options.deflection) * diagonal_, coarsest_angle};
        GProp_GProps properties;
        BRepGProp::VolumeProperties(body.shape, properties, volume_precision);
        exact_volume_ = std::abs(properties.Mass());
    }

    MeshedBody run() {
        if (!(diagonal_ > 0) || !std::isfinite(diagonal_))
            refuse(path_, fmt::format("solid '{}' has no extent. Export it again.", body_.name));
        find_smooth_edges(body_);
        for (int i = 0; i < most_tries; ++i) {
            Tessellation mesh = tessellate(body_, settings_);
            if (!mesh.failed_faces.empty() && divide()) continue;
            trouble_ = trouble_of(mesh);
            if (trouble_.empty() && !is_right(mesh)) {
                if (balance(mesh)) return {checked(std::move(mesh)), exact_volume_};
                if (tighten(mesh)) continue;
            }
            if (trouble_.empty()) trouble_ = crossing_of(mesh);
            if (trouble_.empty()) return {checked(std::move(mesh)), exact_volume_};
            next_settings();
        }
        refuse(path_, trouble_);
    }

 private:
    bool divide() {
        if (is_divided_) return false;
        is_divided_ = divide_closed_faces(body_);
        if (!is_divided_) return false;
        find_smooth_edges(body_);
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
                           place_text(meeting_place(mesh.vertices, mesh.facets[f], mesh.facets[g])),
                           names_of({mesh.patch[f], mesh.patch[g]}, model_.patches));
    }

    // Returns the signed error of the volume, as a share of it: positive if the facets hold too much.
    double volume_error(const Tessellation& mesh) const {
        return exact_volume_ > 0 ? (std::abs(mesh.volume) - exact_volume_) / exact_volume_ : 0;
    }

    // Returns how many times rougher the chords are than can be balanced: volumes that they miss inside and outside may
    // cancel, as in thin tubes. Bodies whose vertices stay on the faces have fillets that chords must not leave out.
    double roughness(const Tessellation& mesh) const {
        const double most = on_faces_ ? most_between_on_faces : most_between;
        return exact_volume_ > 0 ? volume_between(mesh) / (most * exact_volume_) : 0;
    }

    bool is_right(const Tessellation& mesh) const {
        if (!by_volume_) return true;
        return roughness(mesh) <= 1 && (on_faces_ || std::abs(volume_error(mesh)) <= CadOptions::volume_tolerance);
    }

    bool balance(Tessellation& mesh) const {
        if (!may_balance_ || roughness(mesh) > 1) return false;
        Tessellation balanced = mesh;
        if (!balance_volume(balanced, std::copysign(exact_volume_, mesh.volume))) return false;
        if (!crossing_of(balanced).empty()) return false;
        mesh = std::move(balanced);
        return true;
    }

    // Makes the deflection smaller for the volume; false if that cannot be bettered.
    bool tighten(const Tessellation& mesh) {
        const double error = volume_error(mesh);
        // As long as the angle decides, facets and error stay as they are.
        const double facets = mesh.facets.size();
        const bool has_effect = facets > 1.3 * std::exchange(last_facets_, facets);
        if (has_effect && is_not_of_chords(error)) return false;
        const double rough = roughness(mesh);
        const double wanted = std::min(rough > 1 ? 0.8 / rough : 0.3, has_effect ? 0.6 : 0.25);
        // Facets grow as 1 / deflection where a face is curved both ways.
        const double factor = std::max(
            {wanted, 0.05, facets / most_facets_by_volume, most_facets_of_patch(mesh) / most_facets_of_face_by_volume});
        if (factor > 0.9 || settings_.deflection * factor < finest_deflection * diagonal_) return false;
        settings_.deflection *= factor;
        return true;
    }

    // Tells whether the error is due to faces that do not meet exactly: it is proportional to the deflection once the
    // angle counts no more, so that an error that would remain without any chords, twice in a row, is not of chords.
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

    void next_settings() { (tries_++ % 2 == 0 ? settings_.deflection : settings_.angle) *= 0.7; }

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
    bool by_volume_, on_faces_;
    bool may_balance_;  // else all vertices stay on the faces
    double diagonal_;
    TessellationSettings settings_ = {};
    double exact_volume_ = 0;
    double last_error_ = 0, last_deflection_ = 0, last_facets_ = 0;
    int remaining_ = 0, tries_ = 0;
    bool is_divided_ = false;
    std::string trouble_;
};

}  // namespace

std::string counted(std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string place_text(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

void refuse(const std::string& path, const std::string& what, const char* kind, std::vector<ErrorElements> elements) {
    throw SolidDefect(kind, path + ": " + what, std::move(elements));
}

MeshedBody mesh_body(Body& body, Model& model, const std::string& path, const CadOptions& options, bool may_balance) {
    return BodyMesher(body, model, path, options, may_balance).run();
}

}  // namespace kerf::cad

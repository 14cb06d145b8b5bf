// The ladder of body_mesher.cpp for several regions at once: a face between two of them has the same chords for both,
// and vertices that are moved for the volumes are moved for both. Facets have the regions on their sides, front and
// back; a region is closed if each edge is as often in its facets in one direction as in the other, a facet with the
// region in front counting the other way. Trouble, a text, is a reason to try other chords and the message when tries
// run out. Vertices of facets that cross after balancing are fixed on their faces, and the others balanced again, a few
// times.
#include "files/cad/inside/assembly_mesher.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/geometry/predicates.h"
#include "files/cad/inside/body_mesher.h"
#include "files/cad/inside/volume_balance.h"
#include "surface/diagnosis/intersections.h"
#include "surface/soup/edge_corners.h"

namespace kerf::cad {

namespace {

constexpr double share_of_smallest = 1e-3;  // of its diagonal, for the first chords,
constexpr double share_of_largest = 1e-4;   // unless this is more: a bolt does not make a hall finer
constexpr double finest_share = 1e-6;       // of the smallest diagonal
constexpr double first_angle = 0.35;        // radians between chords
constexpr double most_missed = 0.01;        // of the volume of a region, between facets and faces
constexpr double most_missed_on_faces = 0.001;
constexpr double hopeless_error = 0.05;  // of a volume
constexpr double most_assembly_facets = 320000;
constexpr double most_assembly_facets_of_face = 80000;  // its time grows with the square
constexpr int most_rounds_of_balance = 6;
constexpr int most_attempts = 12;
constexpr const char* way_out =
    "Join the solids by --unite, choose one by --solid N, or repair them in the CAD program.";

class AssemblyMesher {
 public:
    AssemblyMesher(const Assembly& assembly, const std::vector<double>& diagonals, const std::string& path,
                   const CadOptions& options)
        : assembly_(assembly), path_(path), by_volume_(options.deflection == 0), on_faces_(options.on_faces) {
        smallest_ = *std::min_element(diagonals.begin(), diagonals.end());
        const double largest = *std::max_element(diagonals.begin(), diagonals.end());
        settings_ = {by_volume_ ? std::max(share_of_smallest * smallest_, share_of_largest * largest)
                                : options.deflection * smallest_,
                     first_angle};
    }

    std::optional<MeshedAssembly> run(bool may_divide) {
        find_smooth_edges(assembly_.faces);
        int crossings = 0;
        for (int i = 0; i < most_attempts; ++i) {
            Tessellation mesh = tessellate(assembly_.faces, settings_, assembly_.sides);
            if (!mesh.failed_faces.empty() && may_divide) return {};
            trouble_ = trouble_of(mesh);
            if (trouble_.empty() && !is_right(mesh)) {
                if (balance(mesh)) return checked(std::move(mesh));
                trouble_ = crossing_of(mesh);
                if (trouble_.empty() && tighten(mesh)) continue;
            } else if (trouble_.empty()) {
                trouble_ = crossing_of(mesh);
            }
            if (trouble_.empty()) return checked(std::move(mesh));
            (crossings++ % 2 == 0 ? settings_.deflection : settings_.angle) *= 0.7;
        }
        refuse(path_, trouble_);
    }

 private:
    std::string solid_name(RegionIndex region) const { return "'" + assembly_.region_names[region.value()] + "'"; }
    std::string faces_text(const std::vector<std::int32_t>& patches) const {
        return names_of(patches, assembly_.patches);
    }

    // Returns the solids at facets: "'a' and 'b'".
    std::string solids_at(const Tessellation& mesh, std::initializer_list<std::int32_t> facets) const {
        std::set<RegionIndex> regions;
        for (const std::int32_t f : facets) regions.insert({mesh.sides[f].front, mesh.sides[f].back});
        std::string text;
        for (const RegionIndex region : regions)
            if (region.is_valid()) text += (text.empty() ? "" : " and ") + solid_name(region);
        return text;
    }

    std::string trouble_of(const Tessellation& mesh) const {
        if (!mesh.failed_faces.empty())
            return fmt::format("OpenCASCADE finds no triangles for {} ({}). {}",
                               counted(mesh.failed_faces.size(), "face", "faces"), faces_text(mesh.failed_faces),
                               way_out);
        if (!mesh.pierced_patches.empty())
            return fmt::format(
                "a vertex of another solid lies in {}, and OpenCASCADE leaves it out of its triangles. "
                "Let the solids touch in a face, move them apart, join them by --unite, or choose one "
                "by --solid N.",
                faces_text(mesh.pierced_patches));
        Array<RegionIndex, char> has_facets(assembly_.volumes.size());
        for (const auto [front, back] : mesh.sides)
            for (const RegionIndex region : {front, back})
                if (region.is_valid()) has_facets[region] = 1;
        for (const RegionIndex r : has_facets.ids())
            if (!has_facets[r])
                return fmt::format("nothing is left of the solid {} beside those that it touches. {}", solid_name(r),
                                   way_out);
        return opening_of(mesh);
    }

    // Returns the trouble of a region that is open: one that has an edge more often in one direction than in the other.
    std::string opening_of(const Tessellation& mesh) const {
        std::string found;
        EdgeCorners(mesh.facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
            if (!found.empty()) return;
            for (const EdgeCorners::Corner& of_region : corners)
                for (const RegionIndex region :
                     {mesh.sides[of_region.corner / 3].front, mesh.sides[of_region.corner / 3].back}) {
                    if (!region.is_valid() || excess_of(mesh, region, low, corners) == 0) continue;
                    found = fmt::format("the solid {} is open near {} at {}, once solids share what they touch in. {}",
                                        solid_name(region), place_text(mesh.vertices[low]),
                                        faces_text({mesh.patch[of_region.corner / 3]}), way_out);
                    return;
                }
        });
        return found;
    }

    static int excess_of(const Tessellation& mesh, RegionIndex region, std::int32_t low,
                         std::span<const EdgeCorners::Corner> corners) {
        int excess = 0;
        for (const auto& [high, corner] : corners) {
            const int direction = start_vertex(mesh.facets, corner) == low ? 1 : -1;
            const FacetSides sides = mesh.sides[corner / 3];
            excess += direction * ((sides.back == region) - (sides.front == region));
        }
        return excess;
    }

    std::string crossing_of(const Tessellation& mesh) const {
        for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
            const auto& [a, b, c] = mesh.facets[f];
            if (are_collinear(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]))
                return fmt::format("face {} has a triangle without area at {}. {}", faces_text({mesh.patch[f]}),
                                   place_text(mesh.vertices[a]), way_out);
        }
        const auto pairs = find_self_intersections(mesh.vertices, mesh.facets, 1);
        if (pairs.empty()) return "";
        const auto [f, g] = pairs.front();
        return fmt::format("faces of {} cross near {}, at {}. {}", solids_at(mesh, {f, g}),
                           place_text(meeting_place(mesh.vertices, mesh.facets[f], mesh.facets[g])),
                           faces_text({mesh.patch[f], mesh.patch[g]}), way_out);
    }

    // Returns the largest error of the volume of a region, as a share of that.
    double volume_error(const Tessellation& mesh) const {
        const Array<RegionIndex, double> volumes = region_volumes(mesh, assembly_.volumes.size());
        double largest = 0;
        for (const RegionIndex r : volumes.ids())
            largest = std::max(largest, std::abs(volumes[r] / assembly_.volumes[r] - 1));
        return largest;
    }

    // Returns the roughness of body_mesher.cpp, for the worst region.
    double roughness(const Tessellation& mesh) const {
        const Array<RegionIndex, double> between = volumes_between(mesh, assembly_.volumes.size());
        double largest = 0;
        for (const RegionIndex r : between.ids()) largest = std::max(largest, between[r] / assembly_.volumes[r]);
        return largest / (on_faces_ ? most_missed_on_faces : most_missed);
    }

    bool is_right(const Tessellation& mesh) const {
        if (!by_volume_) return true;
        return roughness(mesh) <= 1 && (on_faces_ || volume_error(mesh) <= CadOptions::volume_tolerance);
    }

    // Balances the volumes. Where facets cross then, their vertices go back on the faces and stay there: where a curved
    // face touches another in a line or a point, little is between them.
    bool balance(Tessellation& mesh) const {
        if (on_faces_ || roughness(mesh) > 1) return false;
        std::vector<char> is_fixed(mesh.vertices.size());
        for (int round = 0; round < most_rounds_of_balance; ++round) {
            Tessellation balanced = mesh;
            if (!balance_volumes(balanced, assembly_.volumes, is_fixed)) return false;
            if (crossing_of(balanced).empty()) {
                mesh = std::move(balanced);
                return true;
            }
            for (const auto& [f, g] : find_self_intersections(balanced.vertices, balanced.facets))
                for (const std::int32_t facet : {f, g})
                    for (const std::int32_t v : mesh.facets[facet]) is_fixed[v] = 1;
        }
        return false;
    }

    // Makes the deflection smaller for the volumes; false if they cannot be bettered.
    bool tighten(const Tessellation& mesh) {
        const double rough = roughness(mesh), wanted = rough > 1 ? std::min(0.8 / rough, 0.6) : 0.3;
        const double factor = std::max({wanted, 0.05, static_cast<double>(mesh.facets.size()) / most_assembly_facets,
                                        most_facets_of_patch(mesh) / most_assembly_facets_of_face});
        if (factor > 0.9 || settings_.deflection * factor < finest_share * smallest_) return false;
        settings_.deflection *= factor;
        return true;
    }

    MeshedAssembly checked(Tessellation mesh) const {
        Array<RegionIndex, double> volumes = region_volumes(mesh, assembly_.volumes.size());
        for (const RegionIndex r : volumes.ids())
            if (!(std::abs(volumes[r] / assembly_.volumes[r] - 1) <= hopeless_error))
                refuse(path_,
                       fmt::format("the facets of the solid {} hold {:.6g} mm3, but OpenCASCADE gives it {:.6g}: "
                                   "its faces do not bound it. {}",
                                   solid_name(r), volumes[r], assembly_.volumes[r], way_out));
        return {std::move(mesh), std::move(volumes)};
    }

    const Assembly& assembly_;
    const std::string& path_;
    bool by_volume_, on_faces_;
    double smallest_ = 0;  // smallest diagonal of the solids
    TessellationSettings settings_ = {};
    std::string trouble_;
};

}  // namespace

std::optional<MeshedAssembly> mesh_assembly(const Assembly& assembly, const std::vector<double>& diagonals,
                                            const std::string& path, const CadOptions& options, bool may_divide) {
    return AssemblyMesher(assembly, diagonals, path, options).run(may_divide);
}

}  // namespace kerf::cad

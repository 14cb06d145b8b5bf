// Each volume is turned by itself. Its surfaces are taken from the runs of facets, but for those that it lists twice:
// they have it on both sides. The facets are made consistent over their edges, which divides them into shells. The
// shell with the largest absolute volume is the outer one, with the volume behind its facets; every other shell is
// around a void, with the volume in front. "In front" is the side to which the normal of a facet of the file points,
// "back" the other one. Signs in the lists of the file are not asked, because Gmsh's two geometries disagree about
// them. Where two volumes claim the same side of a facet, the second gets the other side, so that a wall always
// separates the two that list it.
#include "files/io/inside/gmsh_sides.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "files/io/inside/region_facets.h"
#include "surface/diagnosis/orientation.h"

namespace kerf::gmsh {

namespace {

// Facets of the file by their surface.
class FacetsOfSurfaces {
 public:
    FacetsOfSurfaces(const std::vector<SurfaceRun>& runs, std::size_t facet_count) {
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const std::size_t end = r + 1 < runs.size() ? runs[r + 1].first_facet : facet_count;
            ranges_[runs[r].entity].emplace_back(runs[r].first_facet, end);
        }
    }
    bool contain(std::int64_t surface) const { return ranges_.contains(surface); }
    template <class Take>
    void for_each(std::int64_t surface, const Take& take) const {
        for (const auto& [begin, end] : ranges_.at(surface))
            for (std::size_t f = begin; f < end; ++f) take(f);
    }

 private:
    std::map<std::int64_t, std::vector<std::pair<std::size_t, std::size_t>>> ranges_;
};

// The volumes all of whose surfaces are in the file.
struct Volumes {
    std::map<VolumeKey, std::int32_t> numbers;
    std::vector<std::vector<std::int64_t>> surfaces;  // by number; ascending
};

Volumes find_volumes(const Model& model, const FacetsOfSurfaces& of_surfaces) {
    Volumes volumes;
    for (const auto& [entity, boundary] : model.surfaces_of_volume) {
        const bool is_in_file = std::all_of(boundary.begin(), boundary.end(),
                                            [&](std::int64_t surface) { return of_surfaces.contain(surface); });
        if (boundary.empty() || !is_in_file) continue;
        const std::int64_t* group = find(model.volumes.group_of_entity, entity);
        const auto next = count_of(volumes.surfaces);
        if (!volumes.numbers.try_emplace(VolumeKey(group ? *group : 0, entity), next).second) continue;
        volumes.surfaces.push_back(boundary);
        std::sort(volumes.surfaces.back().begin(), volumes.surfaces.back().end());
    }
    return volumes;
}

// Returns six times the signed volume that each shell encloses, by the orientation that its facets agree on.
std::vector<double> six_volumes_of_shells(const ConsistentFacets& consistent, const std::vector<Vec3>& vertices) {
    std::vector<double> six_volumes(consistent.shell_count, 0);
    for (std::size_t f = 0; f < consistent.facets.size(); ++f) {
        const Vec3& origin = vertices[consistent.facets.front()[0]];
        const auto& [a, b, c] = consistent.facets[f];
        const Vec3 p = vertices[a] - origin, q = vertices[b] - origin, r = vertices[c] - origin;
        six_volumes[consistent.shell[f]] += p.cross(q).dot(r);
    }
    return six_volumes;
}

// Tells for each facet whether the volume that all of them bound is in front of it.
std::vector<char> are_inward(const std::vector<Triangle>& facets, const std::vector<Vec3>& vertices) {
    const ConsistentFacets consistent = make_consistent(facets);
    const std::vector<double> six_volumes = six_volumes_of_shells(consistent, vertices);
    const auto outer = std::max_element(six_volumes.begin(), six_volumes.end(),
                                        [](double a, double b) { return std::abs(a) < std::abs(b); });
    std::vector<char> is_inward(facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::int32_t shell = consistent.shell[f];
        const bool is_void = shell != outer - six_volumes.begin();
        is_inward[f] = (six_volumes[shell] < 0) != is_void;
    }
    for (const std::int32_t f : consistent.turned) is_inward[f] ^= 1;
    return is_inward;
}

bool has_three_corners(const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

// Puts the region on this side of a facet, or on the other side if another volume has taken this one already.
void take_side(FacetSides& sides, bool is_in_front, RegionIndex region) {
    const bool is_free = !(is_in_front ? sides.front : sides.back).is_valid();
    (is_in_front == is_free ? sides.front : sides.back) = region;
}

// Puts a region on the sides of the facets of a volume.
void add_sides(const std::vector<std::int64_t>& surfaces, const FacetsOfSurfaces& of_surfaces, const Soup& soup,
               RegionIndex region, std::vector<FacetSides>& sides) {
    std::vector<std::size_t> numbers;
    std::vector<Triangle> facets;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        // A surface that is listed twice has the volume on both sides.
        const bool is_inside =
            (i > 0 && surfaces[i - 1] == surfaces[i]) || (i + 1 < surfaces.size() && surfaces[i + 1] == surfaces[i]);
        of_surfaces.for_each(surfaces[i], [&](std::size_t f) {
            if (is_inside || !has_three_corners(soup.facets[f])) return;
            numbers.push_back(f);
            facets.push_back(soup.facets[f]);
        });
    }
    const std::vector<char> is_inward = are_inward(facets, soup.vertices);
    for (std::size_t i = 0; i < numbers.size(); ++i) take_side(sides[numbers[i]], is_inward[i], region);
}

}  // namespace

SurfaceSides sides_of_surfaces(const Model& model, const std::vector<SurfaceRun>& runs, const Soup& soup) {
    if (model.is_partitioned || runs.empty()) return {};
    const FacetsOfSurfaces of_surfaces(runs, soup.facets.size());
    const Volumes volumes = find_volumes(model, of_surfaces);
    if (volumes.surfaces.size() < 2) return {};
    VolumeRegions regions =
        regions_of(volumes.numbers, [&](const VolumeKey& key) { return model.volumes.name_of(key.first, key.second); });
    constexpr FacetSides no_sides = {RegionIndex::none(), RegionIndex::none()};
    std::vector<FacetSides> sides(soup.facets.size(), no_sides);
    for (std::size_t v = 0; v < volumes.surfaces.size(); ++v)
        add_sides(volumes.surfaces[v], of_surfaces, soup, regions.region_of_volume[v], sides);
    return {std::move(sides), std::move(regions.names)};
}

}  // namespace kerf::gmsh

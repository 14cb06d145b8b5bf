// The facets of the result are compared with the input over them: rays along the normal from four points of a facet
// give its mean height (`rise`), and a facet whose heights all vanish is planar (`plane`). Neighbours of one patch that
// go on smoothly, both planar in one plane or both not, form a face, and balance_volumes()
// (surface/complex/volume_balance.h) moves vertices off these faces. Facets of the input are approximations, too, and
// lie partly above and partly below those of the result, so the factors of the moves may be large and negative
// (`range_of_heights`). If that fails, all vertices rise by the same height, times a factor from -1 to 2, and planar
// faces that end smoothly, as the strips of a cylinder do, count as curved.
#include "surface/remesh/inside/volume_restoration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/core/threads.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/complex/volume_balance.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double smooth_cosine = std::numbers::sqrt3 / 2;  // of the normals of neighbours on one face: 30 degrees
constexpr double coplanar_cosine = 1 - 1e-9;
constexpr double facing_cosine_of_input = 0.3;  // of a facet's normal and that of the input over it
// Factors of the heights of the input. Facets that follow facets are partly above and partly below them: the volume
// missed in all may be far more, or less, than the mean of a few.
constexpr ScaleRange range_of_heights = {-4, 6};
constexpr double flat_share_of_diagonal = 1e-8;

std::vector<FacetSides> sides_of_facets(const SurfaceArrays& surface, const std::vector<FacetSides>& sides) {
    std::vector<FacetSides> of_facets;
    if (sides.empty()) return of_facets;
    for (const std::int32_t patch : surface.patch) of_facets.push_back(sides[patch]);
    return of_facets;
}

Array<RegionIndex, double> volumes_of(const SurfaceArrays& surface, const std::vector<FacetSides>& sides) {
    RegionIndex last;
    for (const FacetSides& s : sides) last = std::max({last, s.front, s.back});
    const std::vector<FacetSides> of_facets = sides_of_facets(surface, sides);
    return region_volumes(surface.vertices, {surface.facets, {}, {}, {}, of_facets}, last.value() + 1);
}

// The facets of a result with their faces, planes and heights as the input over them tells.
class FacesOfInput {
 public:
    FacesOfInput(const InspectedInput& input, double deviation, const ChangedSurface& result)
        : result_(result.surface),
          near_(result.near),
          input_(input),
          deviation_(deviation),
          normal_(result_.facets.size()),
          plane_(result_.facets.size()),
          rise_(result_.facets.size()) {
        constexpr std::size_t grain = 1 << 12;
        for (const Triangle& t : input.surface.facets)
            input_normal_.push_back(area_vector(input.surface.vertices, t).normalized());
        const double flat = flat_share_of_diagonal * box_around(input.surface.vertices).diagonal().norm();
        for_ranges_on_threads(result_.facets.size(), grain, [&](const IndexRange& range) {
            for (std::size_t f = range.first; f < range.last; ++f) {
                normal_[f] = area_vector(result_.vertices, result_.facets[f]).normalized();
                const Heights heights = heights_over(f);
                plane_[f] = heights.largest <= flat ? normal_[f] : Vec3::Zero();
                rise_[f] = heights.mean;
            }
        });
        find_faces();
    }

    FacetsOfFaces facets(const std::vector<FacetSides>& sides) const {
        return {result_.facets, face_, plane_, rise_, sides};
    }

    /// Flat faces that go on smoothly, as the strips of a cylinder do, need not stay flat; all that may move rises by
    /// the same.
    void let_rise_evenly(double height) {
        for (std::size_t f = 0; f < face_.size(); ++f)
            if (goes_on_[face_[f]] != 0) plane_[f].setZero();
        std::fill(rise_.begin(), rise_.end(), height);
    }

 private:
    struct Heights {
        double mean = 0, largest = 0;
    };
    Heights heights_over(std::size_t f) const {
        const Triangle& t = result_.facets[f];
        const Vec3 &a = result_.vertices[t[0]], &b = result_.vertices[t[1]], &c = result_.vertices[t[2]];
        const Vec3 centre = (a + b + c) / 3;
        Heights heights;
        std::int32_t near = near_[f];
        for (const Vec3& p : {centre, Vec3((centre + a) / 2), Vec3((centre + b) / 2), Vec3((centre + c) / 2)}) {
            const double height = height_at(p, normal_[f], near);
            heights.mean += height / 4;
            heights.largest = std::max(heights.largest, std::abs(height));
        }
        return heights;
    }
    // Returns the height of the input over a point; 0 if none of it is near. `near`: where to look first.
    double height_at(const Vec3& p, const Vec3& normal, std::int32_t& near) const {
        const double reach = 2 * deviation_;
        if (const std::int32_t below = input_.nearness.facet_below(p, near); below >= 0) {
            near = below;
            const double cosine = input_normal_[below].dot(normal);
            const double height = input_normal_[below].dot(input_.tree.corners(below)[0] - p) / cosine;
            if (cosine > facing_cosine_of_input && std::abs(height) < reach) return height;
        }
        const auto faces = [&](std::int32_t g) { return input_normal_[g].dot(normal) > facing_cosine_of_input; };
        const double up = input_.tree.first_hit(p, normal, 0, reach, faces);
        const double down = input_.tree.first_hit(p, -normal, 0, std::min(up, reach), faces);
        return down < up ? -down : std::isfinite(up) ? up : 0;
    }
    // Neighbours of one patch that go on smoothly, both flat or both not.
    void find_faces() {
        UnionFind joined(result_.facets.size());
        std::vector<std::int32_t> that_go_on;
        EdgeCorners(result_.facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
            if (corners.size() != 2) return;
            const std::int32_t f = corners[0].corner / 3, g = corners[1].corner / 3;
            const double cosine = normal_[f].dot(normal_[g]);
            if (result_.patch[f] != result_.patch[g] || cosine < smooth_cosine) return;
            const bool is_flat = plane_[f] != Vec3::Zero(), other_is_flat = plane_[g] != Vec3::Zero();
            if (is_flat == other_is_flat && (!is_flat || cosine >= coplanar_cosine))
                joined.join(f, g);
            else
                that_go_on.insert(that_go_on.end(), {f, g});
        });
        for (std::int32_t f = 0; f < std::ssize(result_.facets); ++f) face_.push_back(joined.root(f));
        goes_on_.resize(face_.size(), 0);
        for (const std::int32_t f : that_go_on) goes_on_[face_[f]] = 1;
    }

    const SurfaceArrays& result_;
    const std::vector<std::int32_t>& near_;
    const InspectedInput& input_;
    double deviation_;
    std::vector<Vec3> input_normal_, normal_, plane_;
    std::vector<double> rise_;
    std::vector<std::int32_t> face_;
    std::vector<char> goes_on_;  // of a face: whether it ends smoothly somewhere
};

}  // namespace

double volume_difference(const SurfaceArrays& input, const SurfaceArrays& result, const std::vector<FacetSides>& sides,
                         double reference) {
    const Array<RegionIndex, double> wanted = volumes_of(input, sides), now = volumes_of(result, sides);
    double largest = 0;
    for (const RegionIndex r : wanted.ids())
        largest =
            std::max(largest, std::abs(now[r] - wanted[r]) /
                                  (reference > 0 ? std::min(reference, std::abs(wanted[r])) : std::abs(wanted[r])));
    return largest;
}

bool restore_volumes(const InspectedInput& input, const std::vector<FacetSides>& sides, double deviation,
                     const std::vector<char>& is_fixed, ChangedSurface& result) {
    FacesOfInput faces(input, deviation, result);
    std::vector<Vec3>& vertices = result.surface.vertices;
    const std::vector<FacetSides> of_facets = sides_of_facets(result.surface, sides);
    const Array<RegionIndex, double> volumes = volumes_of(input.surface, sides);
    if (balance_volumes(vertices, faces.facets(of_facets), volumes, is_fixed, range_of_heights)) return true;
    faces.let_rise_evenly(deviation);
    return balance_volumes(vertices, faces.facets(of_facets), volumes, is_fixed, {-1, 2});
}

}  // namespace kerf

// Whether curved solids touch is decided by OpenCASCADE's classifier of points, which is exact but slow; coarse facets
// only say where to ask. All bodies are tessellated with chords of 1e-3 of their diagonals, pairs of facets of
// different bodies that meet are found, and for a few pairs of each two faces some ten points are classified: corners,
// which lie on the true faces of their own body, and points in which edges pass planes or edges of the other facet. A
// point that both bodies hold is a contact. The chords of a convex and a concave face may meet where the faces do not:
// then all points fail and nothing is found, which is right. A contact that is missed here is found by the fine facets
// later.
#include "files/cad/inside/contact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <BRepClass3d_SolidClassifier.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <gp_Pnt.hxx>

#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "files/cad/inside/healing.h"
#include "files/cad/inside/tessellation.h"
#include "surface/diagnosis/intersections.h"

namespace kerf::cad {

namespace {

constexpr double deflection = 1e-3;  // of the diagonal
constexpr double angle = 0.35;
constexpr std::size_t most_pairs = 20000;  // pairs of facets that meet
constexpr int most_pairs_of_faces = 4;     // of facets that are compared for each pair of faces
constexpr int most_comparisons = 400;      // pairs of facets, each some ten points

using Corners = std::array<Vec3, 3>;

// The coarse facets of all bodies.
struct CoarseFacets {
    std::vector<Vec3> vertices;
    std::vector<Triangle> facets;
    std::vector<std::int32_t> patch;
    std::vector<std::size_t> body;

    explicit CoarseFacets(const std::vector<Body>& bodies) {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            const Tessellation mesh = tessellate(bodies[b], {deflection * diagonal_of(bodies[b].shape), angle});
            const auto shift = count_of(vertices);
            vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
            for (const Triangle& t : mesh.facets) facets.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
            patch.insert(patch.end(), mesh.patch.begin(), mesh.patch.end());
            body.resize(facets.size(), b);
        }
    }
    Corners corners(std::int32_t facet) const {
        const auto& [a, b, c] = facets[facet];
        return {vertices[a], vertices[b], vertices[c]};
    }
};

// Tells whether bodies hold points.
class PointsInBodies {
 public:
    explicit PointsInBodies(const std::vector<Body>& bodies) : bodies_(bodies), classifiers_(bodies.size()) {}

    bool holds(std::size_t body, const Vec3& p) {
        std::unique_ptr<BRepClass3d_SolidClassifier>& classifier = classifiers_[body];
        if (!classifier) classifier = std::make_unique<BRepClass3d_SolidClassifier>(bodies_[body].shape);
        classifier->Perform(gp_Pnt(p.x(), p.y(), p.z()), Precision::Confusion());
        return classifier->State() == TopAbs_IN || classifier->State() == TopAbs_ON;
    }

 private:
    const std::vector<Body>& bodies_;
    std::vector<std::unique_ptr<BRepClass3d_SolidClassifier>> classifiers_;
};

// Returns points where two triangles that meet may have something in common: where edges of one go through the plane of
// the other, or pass edges of it. Some of them are in neither.
std::vector<Vec3> meeting_points(const Corners& one, const Corners& other) {
    std::vector<Vec3> points;
    const auto add_edges_through_plane = [&](const Corners& edges, const Corners& plane) {
        const Vec3 normal = doubled_area_vector(plane);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = edges[i], &b = edges[(i + 1) % 3];
            const double above = normal.dot(a - plane[0]), below = normal.dot(b - plane[0]);
            if ((above < 0) != (below < 0)) points.emplace_back(a + above / (above - below) * (b - a));
        }
    };
    add_edges_through_plane(one, other);
    add_edges_through_plane(other, one);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec3 u = one[(i + 1) % 3] - one[i], v = other[(j + 1) % 3] - other[j], across = u.cross(v);
            const double turn = across.squaredNorm();
            if (turn <= 1e-12 * u.squaredNorm() * v.squaredNorm()) continue;  // parallel
            const double t = (other[j] - one[i]).cross(v).dot(across) / turn;
            if (t >= 0 && t <= 1) points.emplace_back(one[i] + t * u);
        }
    return points;
}

std::optional<Vec3> common_point(const CoarseFacets& all, std::int32_t f, std::int32_t g, PointsInBodies& points) {
    const Corners one = all.corners(f), other = all.corners(g);
    const std::size_t a = all.body[f], b = all.body[g];
    for (const Vec3& p : one)  // vertices of facets lie on the faces
        if (points.holds(b, p)) return p;
    for (const Vec3& p : other)
        if (points.holds(a, p)) return p;
    for (const Vec3& p : meeting_points(one, other))
        if (points.holds(a, p) && points.holds(b, p)) return p;
    return {};
}

std::optional<Contact> contact_in(const std::vector<Body>& bodies) {
    const CoarseFacets all(bodies);
    PointsInBodies points(bodies);
    std::map<std::pair<std::int32_t, std::int32_t>, int> comparisons_of_faces;
    int comparisons = 0;
    for (const auto& [f, g] : find_self_intersections(all.vertices, all.facets, most_pairs)) {
        if (all.body[f] == all.body[g] || comparisons == most_comparisons) continue;
        if (++comparisons_of_faces[{all.patch[f], all.patch[g]}] > most_pairs_of_faces) continue;
        ++comparisons;
        if (const std::optional<Vec3> p = common_point(all, f, g, points))
            return Contact{{all.body[f], all.body[g]}, *p};
    }
    return {};
}

}  // namespace

std::optional<Contact> find_contact(const std::vector<Body>& bodies) {
    if (bodies.size() < 2) return {};
    try {
        return contact_in(bodies);
    } catch (const Standard_Failure&) {  // then it is for the fine facets to say
        return {};
    }
}

}  // namespace kerf::cad

#include "cut/decompose/cap_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/geometry/angles.h"

namespace kerf {

namespace {

// A face at an edge, seen from one of its parts.
struct EdgeSide {
    std::int32_t low, high;
    NodeId part;
    std::int32_t apex;
    NodeId cap;
    auto place() const { return std::tie(low, high, part); }
    bool operator<(const EdgeSide& o) const {
        return std::tie(low, high, part, cap, apex) < std::tie(o.low, o.high, o.part, o.cap, o.apex);
    }
};

// Sides of all edges whose ends are vertices of caps.
std::vector<EdgeSide> edge_sides(const FaceComplex& complex) {
    std::vector<char> on_cap(complex.vertex_count(), 0);
    for (const ComplexFace& face : complex.faces())
        for (std::int32_t v : face.corners)
            if (face.cap != no_node) on_cap[v] = 1;
    std::vector<EdgeSide> sides;
    for (const ComplexFace& face : complex.faces())
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(face.corners[i], face.corners[(i + 1) % 3]);
            if (!on_cap[low] || !on_cap[high]) continue;
            for (const NodeId part : face.owner)
                if (part != no_node) sides.push_back({low, high, part, face.corners[(i + 2) % 3], face.cap});
        }
    std::sort(sides.begin(), sides.end());
    return sides;
}

}  // namespace

std::map<NodeId, CapMeasures> measure_caps(const FaceComplex& complex) {
    std::map<NodeId, CapMeasures> caps;
    for (const ComplexFace& face : complex.faces()) {
        if (face.cap == no_node) continue;
        CapMeasures& cap = caps[face.cap];
        ++cap.faces;
        cap.quality.gap_rel = std::numeric_limits<double>::quiet_NaN();
        for (int i = 0; i < 3; ++i)
            cap.quality.angle_deg =
                std::min(cap.quality.angle_deg,
                         angle_degrees(complex.point(face.corners[i]), complex.point(face.corners[(i + 1) % 3]),
                                       complex.point(face.corners[(i + 2) % 3])));
    }
    const std::vector<EdgeSide> sides = edge_sides(complex);
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].place() == sides[i].place()) ++end;
        if (end - i != 2) continue;  // an edge along which a part touches itself
        const EdgeSide &a = sides[i], &b = sides[i + 1];
        if (a.cap == b.cap) continue;
        const double angle =
            dihedral_degrees(complex.point(a.low), complex.point(a.high), complex.point(a.apex), complex.point(b.apex));
        for (const NodeId cap : {a.cap, b.cap})
            if (cap != no_node) caps[cap].quality.dihedral_deg = std::min(caps[cap].quality.dihedral_deg, angle);
    }
    return caps;
}

}  // namespace kerf

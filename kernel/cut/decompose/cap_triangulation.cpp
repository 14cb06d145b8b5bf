// The caps of straight cuts are divided into regions, one for each pair of parts in one plane, and each region is
// triangulated in its plane (cut/cut/planar_triangulation.h). Notation: a border edge is an edge between a region and
// another one, or the surface. It is hard if a face that is no cap holds it, else soft: then it lies exactly on the
// line in which two coordinate planes meet. A vertex on such a line at which nothing else meets is passed over, so that
// a run of soft edges becomes a segment between two kept vertices, which is divided anew; both regions at it use the
// same new vertices.
#include "cut/decompose/cap_triangulation.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/core/check.h"
#include "cut/cut/planar_triangulation.h"

namespace kerf {

namespace {

constexpr double growth = 0.5;      // of the size along a segment, per distance from its ends
constexpr double too_long = 1.4;    // length over size
constexpr double least_edge = 0.3;  // in mean border edges of the region; shorter ones do not set the size

struct Region {
    NodeId cap;
    std::array<NodeId, 2> owner;
    bool operator<(const Region& o) const { return std::tie(cap, owner) < std::tie(o.cap, o.owner); }
    bool operator==(const Region&) const = default;
};

Region region_of(const ComplexFace& face) { return {face.cap, face.owner}; }

// An edge with the region on its left.
struct BorderEdge {
    std::int32_t region, from, to;
    bool operator<(const BorderEdge& o) const { return std::tie(region, from, to) < std::tie(o.region, o.from, o.to); }
};

void sort_unique(std::vector<UndirectedEdge>& edges) {
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

bool contains(const std::vector<UndirectedEdge>& sorted, const UndirectedEdge& edge) {
    return std::binary_search(sorted.begin(), sorted.end(), edge);
}

class CapTriangulator {
 public:
    CapTriangulator(FaceComplex& complex, const CapEdgeLength& longest_edge)
        : complex_(complex), longest_edge_(longest_edge) {}

    void find_borders();
    void measure_sizes();
    void find_passed_vertices();
    void divide_segments();
    // False if a region has no triangulation; the complex then keeps its caps.
    bool triangulate_regions();

 private:
    // A soft run between two kept vertices.
    struct Segment {
        UndirectedEdge ends;
        std::vector<std::int32_t> between;  // from the first end to the second
        bool operator<(const Segment& o) const { return ends < o.ends; }
    };
    double length(const UndirectedEdge& e) const { return (complex_.point(e[0]) - complex_.point(e[1])).norm(); }
    bool is_straight(std::int32_t a, std::int32_t middle, std::int32_t b) const;
    std::int32_t next_kept(const BorderEdge& edge) const;
    void divide(const Segment& segment, double from_first, double first_size, double second_size, std::int32_t a,
                std::int32_t b, NodeId cut, std::vector<std::int32_t>& between);
    std::vector<UndirectedEdge> outline(std::int32_t region) const;
    bool triangulate_region(std::int32_t region);

    FaceComplex& complex_;
    const CapEdgeLength& longest_edge_;
    std::vector<Region> regions_;       // ascending
    std::vector<BorderEdge> borders_;   // ascending
    std::vector<UndirectedEdge> hard_;  // border edges held by a face that is no cap, ascending
    std::vector<char> passed_;          // per vertex
    std::vector<double> size_;          // per vertex: mean length of its hard border edges; 0: none
    std::vector<Segment> segments_;     // ascending
    std::vector<ComplexFace> caps_;
};

void CapTriangulator::find_borders() {
    for (const ComplexFace& face : complex_.faces())
        if (face.cap != no_node) regions_.push_back(region_of(face));
    std::sort(regions_.begin(), regions_.end());
    regions_.erase(std::unique(regions_.begin(), regions_.end()), regions_.end());

    std::vector<BorderEdge> edges;
    for (const ComplexFace& face : complex_.faces()) {
        if (face.cap == no_node) continue;
        const auto region = static_cast<std::int32_t>(
            std::lower_bound(regions_.begin(), regions_.end(), region_of(face)) - regions_.begin());
        for (int i = 0; i < 3; ++i) edges.push_back({region, face.corners[i], face.corners[(i + 1) % 3]});
    }
    std::sort(edges.begin(), edges.end());
    for (const BorderEdge& e : edges)
        if (!std::binary_search(edges.begin(), edges.end(), BorderEdge{e.region, e.to, e.from})) borders_.push_back(e);
}

void CapTriangulator::measure_sizes() {
    std::vector<char> at_border(complex_.vertex_count(), 0);
    std::vector<UndirectedEdge> border_edges;
    for (const BorderEdge& e : borders_) {
        at_border[e.from] = at_border[e.to] = 1;
        border_edges.push_back(undirected(e.from, e.to));
    }
    sort_unique(border_edges);
    for (const ComplexFace& face : complex_.faces())
        for (int i = 0; i < 3 && face.cap == no_node; ++i) {
            const UndirectedEdge e = undirected(face.corners[i], face.corners[(i + 1) % 3]);
            if (at_border[e[0]] && at_border[e[1]] && contains(border_edges, e)) hard_.push_back(e);
        }
    sort_unique(hard_);
    size_.assign(complex_.vertex_count(), 0);
    std::vector<std::int32_t> count(complex_.vertex_count(), 0);
    for (const UndirectedEdge& e : hard_)
        for (std::int32_t v : e) {
            size_[v] += length(e);
            ++count[v];
        }
    for (std::size_t v = 0; v < size_.size(); ++v)
        if (count[v] > 0) size_[v] /= count[v];
}

// Whether the two edges continue each other along a coordinate axis.
bool CapTriangulator::is_straight(std::int32_t a, std::int32_t middle, std::int32_t b) const {
    const Vec3 d = complex_.point(middle) - complex_.point(a), e = complex_.point(b) - complex_.point(middle);
    for (int axis = 0; axis < 3; ++axis)
        if (d[axis] * e[axis] > 0)
            return d[(axis + 1) % 3] == 0 && d[(axis + 2) % 3] == 0 && e[(axis + 1) % 3] == 0 && e[(axis + 2) % 3] == 0;
    return false;
}

void CapTriangulator::find_passed_vertices() {
    std::vector<char> solid(complex_.vertex_count(), 0);
    for (const ComplexFace& face : complex_.faces())
        for (std::int32_t v : face.corners)
            if (face.cap == no_node) solid[v] = 1;
    std::vector<UndirectedEdge> ends;  // vertex and neighbour
    for (const BorderEdge& e : borders_) {
        if (!solid[e.from]) ends.push_back({e.from, e.to});
        if (!solid[e.to]) ends.push_back({e.to, e.from});
    }
    sort_unique(ends);
    passed_.assign(complex_.vertex_count(), 0);
    for (std::size_t i = 0, j = 0; i < ends.size(); i = j) {
        while (j < ends.size() && ends[j][0] == ends[i][0]) ++j;
        if (j - i == 2) passed_[ends[i][0]] = is_straight(ends[i][1], ends[i][0], ends[i + 1][1]);
    }
}

// The kept vertex that the border reaches after the start of the edge.
std::int32_t CapTriangulator::next_kept(const BorderEdge& edge) const {
    std::int32_t v = edge.to;
    while (passed_[v]) v = std::lower_bound(borders_.begin(), borders_.end(), BorderEdge{edge.region, v, 0})->to;
    return v;
}

// Halves the edge a-b of a segment until it suits the size, which grows from both ends of the segment.
void CapTriangulator::divide(const Segment& segment, double from_first, double first_size, double second_size,
                             std::int32_t a, std::int32_t b, NodeId cut, std::vector<std::int32_t>& between) {
    const double ab = length({a, b}), middle = from_first + ab / 2;
    double size = std::min(first_size + growth * middle, second_size + growth * (length(segment.ends) - middle));
    const Vec3 place = (complex_.point(a) + complex_.point(b)) / 2;
    size = std::min(size, longest_edge_(cut, place));
    if (ab <= too_long * size) return;
    const std::int32_t m = complex_.add_point(place, cut);
    divide(segment, from_first, first_size, second_size, a, m, cut, between);
    between.push_back(m);
    divide(segment, middle, first_size, second_size, m, b, cut, between);
}

void CapTriangulator::divide_segments() {
    std::vector<std::pair<UndirectedEdge, NodeId>> soft;
    for (const BorderEdge& e : borders_) {
        if (passed_[e.from] || contains(hard_, undirected(e.from, e.to))) continue;
        soft.push_back({undirected(e.from, next_kept(e)), regions_[e.region].cap});
    }
    std::sort(soft.begin(), soft.end());
    for (std::size_t i = 0; i < soft.size(); ++i) {
        if (i > 0 && soft[i].first == soft[i - 1].first) continue;
        Segment segment{soft[i].first, {}};
        const double whole = length(segment.ends), least = whole / 64;
        const auto size_at = [&](std::int32_t v) { return size_[v] > 0 ? std::max(size_[v], least) : whole; };
        std::vector<std::int32_t> between;
        divide(segment, 0, size_at(segment.ends[0]), size_at(segment.ends[1]), segment.ends[0], segment.ends[1],
               soft[i].second, between);
        segment.between = std::move(between);
        segments_.push_back(std::move(segment));
    }
}

// Directed edges around a region with their new vertices.
std::vector<UndirectedEdge> CapTriangulator::outline(std::int32_t region) const {
    std::vector<UndirectedEdge> edges;
    const auto first = std::lower_bound(borders_.begin(), borders_.end(), BorderEdge{region, 0, 0});
    for (auto it = first; it != borders_.end() && it->region == region; ++it) {
        if (passed_[it->from]) continue;
        const std::int32_t to = next_kept(*it);
        const Segment wanted{undirected(it->from, to), {}};
        const auto segment = std::lower_bound(segments_.begin(), segments_.end(), wanted);
        std::int32_t last = it->from;
        if (segment != segments_.end() && segment->ends == wanted.ends) {
            std::vector<std::int32_t> between = segment->between;
            if (it->from != segment->ends[0]) std::reverse(between.begin(), between.end());
            for (std::int32_t v : between) {
                edges.push_back({last, v});
                last = v;
            }
        }
        edges.push_back({last, to});
    }
    return edges;
}

bool CapTriangulator::triangulate_region(std::int32_t region) {
    const Region& r = regions_[region];
    const Plane plane = complex_.plane(r.cap);
    std::vector<UndirectedEdge> edges = outline(region);
    std::vector<std::int32_t> vertices;
    for (const UndirectedEdge& e : edges) vertices.push_back(e[0]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    PlanarRegion planar;
    for (const std::int32_t v : vertices) planar.contour.push_back(plane.project(complex_.point(v)));
    const auto local = [&](std::int32_t v) {
        return static_cast<std::int32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
    };
    double sum = 0;
    for (const UndirectedEdge& e : edges) {
        planar.edges.push_back({local(e[0]), local(e[1])});
        sum += length(e);
    }
    planar.max_edge = [&](const Vec2& p) { return longest_edge_(r.cap, plane.lift(p, 0)); };
    planar.least_edge = least_edge * sum / static_cast<double>(edges.size());
    const PlanarTriangulation result = triangulate(planar);
    if (result.refusal != Refusal::none) return false;
    for (std::size_t i = vertices.size(); i < result.points.size(); ++i)
        vertices.push_back(complex_.add_point(plane.lift(result.points[i], 0), r.cap));
    for (const Triangle& t : result.triangles)
        caps_.push_back({{vertices[t[0]], vertices[t[1]], vertices[t[2]]}, r.owner, make_key(r.cap, 0), -1, r.cap});
    return true;
}

bool CapTriangulator::triangulate_regions() {
    for (std::int32_t i = 0; i < count_of(regions_); ++i)
        if (!triangulate_region(i)) return false;
    complex_.replace_caps(caps_);
    return true;
}

}  // namespace

void triangulate_caps(FaceComplex& complex, const CapEdgeLength& longest_edge) {
    CapTriangulator triangulator(complex, longest_edge);
    triangulator.find_borders();
    triangulator.measure_sizes();
    triangulator.find_passed_vertices();
    triangulator.divide_segments();
    triangulator.triangulate_regions();
}

}  // namespace kerf

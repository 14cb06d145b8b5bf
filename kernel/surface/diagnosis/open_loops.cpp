// The open edges are sorted by the vertex that they leave; a loop is followed from edge to edge until it meets a vertex
// of its own, so that it is simple.
#include "surface/diagnosis/open_loops.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// An edge against the direction of its facet, which is the direction that a filling facet has it in.
struct OpenEdge {
    std::int32_t from, to, facet;
};

std::vector<OpenEdge> open_edges(const std::vector<Triangle>& facets) {
    std::vector<OpenEdge> open;
    EdgeCorners(facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() != 1) return;
        const std::int32_t corner = corners[0].corner;
        open.push_back({start_vertex(facets, next_corner(corner)), start_vertex(facets, corner), corner / 3});
    });
    std::sort(open.begin(), open.end(), [](const OpenEdge& a, const OpenEdge& b) {
        return std::tie(a.from, a.facet) < std::tie(b.from, b.facet);
    });
    return open;
}

class LoopTracer {
 public:
    LoopTracer(const std::vector<Vec3>& vertices, std::vector<OpenEdge> edges)
        : vertices_(vertices),
          edges_(std::move(edges)),
          used_(edges_.size(), 0),
          cursor_(edges_.size(), 0),
          position_(vertices.size(), -1) {}

    std::vector<OpenLoop> run() {
        // Chains begin where no edge arrives; then there are only loops.
        std::vector<std::int32_t> arrivals;
        for (const OpenEdge& edge : edges_) arrivals.push_back(edge.to);
        std::sort(arrivals.begin(), arrivals.end());
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (!std::binary_search(arrivals.begin(), arrivals.end(), edges_[e].from)) trace(e);
        for (std::size_t e = 0; e < edges_.size(); ++e) trace(e);
        const auto lowest = [](const OpenLoop& loop) {
            return *std::min_element(loop.facets.begin(), loop.facets.end());
        };
        std::sort(loops_.begin(), loops_.end(), [&](const OpenLoop& a, const OpenLoop& b) {
            return std::pair(lowest(a), a.vertices) < std::pair(lowest(b), b.vertices);
        });
        return std::move(loops_);
    }

 private:
    // Where the path comes back to a vertex of its own, the loop is cut off; the rest is a chain when the path ends.
    void trace(std::size_t first) {
        std::vector<std::size_t> path;
        for (std::size_t e = first; e < edges_.size() && !used_[e]; e = next_edge(edges_[e].to)) {
            used_[e] = 1;
            position_[edges_[e].from] = count_of(path);
            path.push_back(e);
            const std::int32_t begin = position_[edges_[e].to];
            if (begin >= 0) cut_off(path, begin, true);
        }
        if (!path.empty()) cut_off(path, 0, false);
    }
    void cut_off(std::vector<std::size_t>& path, std::size_t begin, bool closed) {
        const std::vector<std::size_t> loop(path.begin() + begin, path.end());
        for (const std::size_t e : loop) position_[edges_[e].from] = -1;
        path.resize(begin);
        add_loop(loop, closed);
    }
    // The first unused edge that leaves the vertex, or the number of edges.
    std::size_t next_edge(std::int32_t vertex) {
        const std::size_t first = std::lower_bound(edges_.begin(), edges_.end(), vertex,
                                                   [](const OpenEdge& edge, std::int32_t v) { return edge.from < v; }) -
                                  edges_.begin();
        if (first == edges_.size()) return first;
        std::size_t& e = cursor_[first];
        e = std::max(e, first);
        while (e < edges_.size() && edges_[e].from == vertex && used_[e]) ++e;
        return e < edges_.size() && edges_[e].from == vertex ? e : edges_.size();
    }
    void add_loop(const std::vector<std::size_t>& path, bool closed) {
        OpenLoop& loop = loops_.emplace_back();
        loop.closed = closed;
        for (const std::size_t e : path) {
            loop.vertices.push_back(edges_[e].from);
            loop.facets.push_back(edges_[e].facet);
            loop.length += (vertices_[edges_[e].to] - vertices_[edges_[e].from]).norm();
        }
        if (!closed) loop.vertices.push_back(edges_[path.back()].to);
    }

    const std::vector<Vec3>& vertices_;
    std::vector<OpenEdge> edges_;  // by vertex
    std::vector<char> used_;
    std::vector<std::size_t> cursor_;     // at the first edge of a vertex: its first edge that may be unused
    std::vector<std::int32_t> position_;  // of a vertex on the path, else -1
    std::vector<OpenLoop> loops_;
};

}  // namespace

std::vector<OpenLoop> find_open_loops(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    KERF_CHECK(are_in_range(facets, vertices.size()) && have_distinct_corners(facets));
    return LoopTracer(vertices, open_edges(facets)).run();
}

}  // namespace kerf

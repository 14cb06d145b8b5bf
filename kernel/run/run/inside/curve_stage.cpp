// Each rank puts the nodes of its parts' edges on the surface, and curve_part() straightens edges again where a cell
// would not be valid. An edge of the surface may lie in several parts, which must agree on its node. So the work goes
// in rounds: after each, the edges that any part has straightened are gathered, and the parts that have one of them
// without having straightened it themselves are done again, with that edge straight. The set of straight edges only
// grows, so the rounds end; what a part does depends on its mesh and that set alone, so the result is the same for any
// number of ranks. A part is loaded anew for each round; in between only its curved nodes, its edges on the surface and
// its totals are kept. An edge is "inside" if no boundary triangle of the part and no other part has it: only there
// curve_part() may move nodes to keep cells valid.
#include "run/run/inside/curve_stage.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "base/core/ids.h"
#include "files/part/curved_part.h"
#include "run/run/inside/range_of_rank.h"

namespace kerf {

namespace {

// A node of the whole mesh.
struct NumberedNode {
    std::int64_t id;
    Vec3 point;
    std::int32_t is_inside;

    bool operator<(const NumberedNode& other) const { return id < other.id; }
    template <class Archive>
    void archive(Archive& a) {
        a(id, point, is_inside);
    }
};

struct PartTotals {
    std::int64_t cells = 0;
    double worst_scaled_jacobian = 1, volume_gain = 0;

    template <class Archive>
    void archive(Archive& a) {
        a(cells, worst_scaled_jacobian, volume_gain);
    }
};

// The result of the last round of a part, kept for the next one.
struct PartState {
    std::vector<std::int32_t> on_surface;    // edges of SurfaceNodes that the part has, ascending
    std::vector<std::int32_t> straightened;  // edges that the part itself has straightened, a part of these
    std::vector<NumberedNode> nodes;
    PartTotals totals;
};

std::vector<char> edges_inside(const Part& part, const EdgeTable& edges) {
    std::vector<char> inside(edges.size(), 1);
    for (const Triangle& t : part.facets)
        for (const auto& [i, j] : triangle_edges) inside[edges.find(undirected(t[i], t[j]))] = 0;
    for (const SharedEdgeGroup& group : part.shared_edges)
        for (const UndirectedEdge& e : group.edges) inside[edges.find(undirected(e[0], e[1]))] = 0;
    return inside;
}

class PartsCurver {
 public:
    PartsCurver(const PartSource& parts, const EdgeNumbers& numbers, const SurfaceNodes& surface)
        : parts_(parts), numbers_(numbers), surface_(surface), is_straight_(surface.edges.size()) {}

    PartState curve(PartIndex index) const {
        PartState state;
        const Part part = parts_.load(index);
        const EdgeTable edges(part.mesh.tets, part.mesh.vertices.size());
        std::vector<CurvedEdge> wanted;
        std::vector<std::int32_t> surface_edge;  // numbers of the edges in `wanted`
        edges.for_all([&](std::int64_t e, const UndirectedEdge& ends) {
            if (std::max(ends[0], ends[1]) >= part.mesh.boundary_vertex_count) return;
            const std::int32_t found = surface_edge_of(part.global_id[ends[0]], part.global_id[ends[1]]);
            if (found < 0) return;
            state.on_surface.push_back(found);
            if (is_straight_[found] != 0) return;
            wanted.push_back({static_cast<std::int32_t>(e), surface_.points[found]});
            surface_edge.push_back(found);
        });
        std::sort(state.on_surface.begin(), state.on_surface.end());
        const std::vector<char> inside = edges_inside(part, edges);
        const CurvedPart curved = curve_part(part.mesh, edges, inside, wanted);
        for (const std::int32_t e : curved.straightened) {
            const auto place = std::lower_bound(wanted.begin(), wanted.end(), e,
                                                [](const CurvedEdge& a, std::int32_t b) { return a.edge < b; });
            state.straightened.push_back(surface_edge[place - wanted.begin()]);
        }
        const std::vector<std::int64_t> ids = numbers_.of(part, edges);
        for (const auto& [edge, node] : curved.curved) state.nodes.push_back({ids[edge], node, inside[edge]});
        state.totals = {curved.cells, curved.worst_scaled_jacobian, curved.volume_gain};
        return state;
    }

    /// Whether other parts have straightened an edge of this part since.
    bool must_be_done_again(const PartState& state, const std::vector<std::int32_t>& newly_straight) const {
        return std::any_of(newly_straight.begin(), newly_straight.end(), [&](std::int32_t e) {
            return std::binary_search(state.on_surface.begin(), state.on_surface.end(), e) &&
                   std::find(state.straightened.begin(), state.straightened.end(), e) == state.straightened.end();
        });
    }
    /// Makes edges straight, and returns those that were not so yet.
    std::vector<std::int32_t> straighten(const std::vector<std::int32_t>& edges) {
        std::vector<std::int32_t> newly;
        for (const std::int32_t e : edges)
            if (std::exchange(is_straight_[e], 1) == 0) newly.push_back(e);
        return newly;
    }
    std::int64_t straightened() const { return std::count(is_straight_.begin(), is_straight_.end(), char{1}); }

 private:
    std::int32_t surface_edge_of(std::int64_t a, std::int64_t b) const {
        constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
        if (std::max(a, b) > most) return -1;
        const Vec3* node = surface_.find(undirected(a, b));
        return node ? node - surface_.points.data() : -1;
    }

    const PartSource& parts_;
    const EdgeNumbers& numbers_;
    const SurfaceNodes& surface_;
    std::vector<char> is_straight_;
};

// Returns the nodes of all ranks, each once, and counts them in the report.
CurvedNodes gather_nodes_of(Communicator& ranks, std::span<const PartState> states, CurveReport& report) {
    std::vector<NumberedNode> nodes;
    for (const PartState& state : states) nodes.insert(nodes.end(), state.nodes.begin(), state.nodes.end());
    nodes = gather_items(ranks, nodes);
    std::sort(nodes.begin(), nodes.end());
    CurvedNodes all;
    for (const NumberedNode& node : nodes) {
        if (!all.ids.empty() && all.ids.back() == node.id) continue;
        all.ids.push_back(node.id);
        all.points.push_back(node.point);
        ++(node.is_inside != 0 ? report.moved_nodes : report.curved_edges);
    }
    return all;
}

}  // namespace

CurvedMesh curve_parts(Communicator& ranks, const PartSource& parts, const EdgeNumbers& numbers,
                       const SurfaceNodes& surface, RunListener* listener) {
    CurvedMesh mesh;
    mesh.report.surface_edges = surface.surface_edges;
    if (surface.edges.empty()) return mesh;
    PartsCurver curver(parts, numbers, surface);
    const LeafRange share = range_of_rank(count_of(parts.outline().parts), ranks);
    std::vector<PartState> states(share.last - share.first);
    std::vector<char> is_due(states.size(), 1);
    for (;;) {
        const std::vector<std::int32_t> straightened = in_agreement(ranks, [&] {
            std::vector<std::int32_t> own;
            for (std::size_t i = 0; i < states.size(); ++i) {
                if (is_due[i] == 0) continue;
                tell_progress(listener, "curve", i, states.size());
                states[i] = curver.curve(PartIndex(share.first + i));
                own.insert(own.end(), states[i].straightened.begin(), states[i].straightened.end());
            }
            return own;
        });
        const std::vector<std::int32_t> newly = curver.straighten(gather_items(ranks, straightened));
        if (newly.empty()) break;
        for (std::size_t i = 0; i < states.size(); ++i) is_due[i] = curver.must_be_done_again(states[i], newly);
    }
    mesh.nodes = gather_nodes_of(ranks, states, mesh.report);
    mesh.report.straightened_edges = curver.straightened();
    std::vector<PartTotals> own;
    for (const PartState& state : states) own.push_back(state.totals);
    for (const PartTotals& totals : gather_items(ranks, own)) {  // in the order of the parts
        mesh.report.curved_cells += totals.cells;
        mesh.report.volume_gain += totals.volume_gain;
        mesh.report.worst_scaled_jacobian = std::min(mesh.report.worst_scaled_jacobian, totals.worst_scaled_jacobian);
    }
    return mesh;
}

}  // namespace kerf

// A node of an edge on the boundary is wanted at its place on the surface; a cell with such a node may fold. A cell is
// good if the Bezier coefficients of its Jacobian determinant prove it valid (Johnen, Remacle and Geuzaine 2013,
// johnen2013; fill/mesh/curved_tet.h) and its scaled Jacobian is not below a bound, so that rounding cannot undo the
// proof. Two means follow each other. Nodes of inner edges of bad cells move by pattern search: six steps along the
// axes, halved a few times, kept if the least coefficient over all cells at the edge grows. That affects cells around,
// which are looked at in the next of a few sweeps. For cells that are still bad, one edge after the other is
// straightened, each time the edge whose straightening leaves the largest Jacobian; as straight cells are valid, this
// ends. Edges are visited ascending and only values of the part decide, so that the result is a function of the
// arguments; an edge that one part straightens is told to all by the caller.
#include "files/part/curved_part.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace kerf {

namespace {

constexpr int most_sweeps = 4;           // over the inner edges of cells that are not valid
constexpr int most_shrinks = 6;          // of the steps of a node
constexpr double first_step = 0.5;       // of how far the curved nodes around are from their middles
constexpr double enough_jacobian = 0.1;  // share of the straight one: a node need not be moved for more

class PartCurving {
 public:
    PartCurving(const TetMesh& mesh, const EdgeTable& edges, const std::vector<char>& inside,
                const std::vector<CurvedEdge>& wanted)
        : mesh_(mesh), edges_(edges), inside_(inside), has_curved_(mesh.vertices.size()) {
        for (const auto& [edge, node] : wanted) nodes_.emplace(edge, node);
        edges.for_all([&](std::int32_t e, const UndirectedEdge& ends) {
            if (nodes_.contains(e))
                for (const std::int32_t v : ends) has_curved_[v] = 1;
        });
    }

    CurvedPart run() {
        find_cells();
        std::vector<std::int32_t> invalid = invalid_of(cells_);
        for (int sweep = 0; sweep < most_sweeps && !invalid.empty(); ++sweep) {
            move_inner_nodes(invalid);
            invalid = invalid_of(neighbours_of(invalid));
        }
        while (!invalid.empty()) {
            std::set<std::int32_t> changed;
            for (const std::int32_t t : invalid)
                if (!is_good(t)) changed.insert(straighten_one_of(t));
            invalid = invalid_of(cells_with(changed));
        }
        return result();
    }

 private:
    std::array<std::int32_t, 6> edges_of(std::int32_t t) const {
        std::array<std::int32_t, 6> numbers = {};
        const Tetrahedron& tet = mesh_.tets[t];
        for (std::size_t e = 0; e < 6; ++e)
            numbers[e] = edges_.find(undirected(tet[tet_edges[e][0]], tet[tet_edges[e][1]]));
        return numbers;
    }
    TetNodes nodes_of(std::int32_t t) const {
        const Tetrahedron& tet = mesh_.tets[t];
        TetNodes nodes = straight_nodes(
            {mesh_.vertices[tet[0]], mesh_.vertices[tet[1]], mesh_.vertices[tet[2]], mesh_.vertices[tet[3]]});
        const std::array<std::int32_t, 6> numbers = edges_of(t);
        for (std::size_t e = 0; e < 6; ++e)
            if (const auto found = nodes_.find(numbers[e]); found != nodes_.end()) nodes[4 + e] = found->second;
        return nodes;
    }
    bool is_curved(std::int32_t t) const {
        const Tetrahedron& tet = mesh_.tets[t];
        if (std::count_if(tet.begin(), tet.end(), [&](std::int32_t v) { return has_curved_[v] != 0; }) < 2)
            return false;
        const std::array<std::int32_t, 6> numbers = edges_of(t);
        return std::any_of(numbers.begin(), numbers.end(), [&](std::int32_t e) { return nodes_.contains(e); });
    }
    bool is_good(std::int32_t t) const {
        if (!is_curved(t)) return true;
        const CurvedTetJacobian jacobian(nodes_of(t));
        if (jacobian.coarse_low() >= least_scaled_jacobian * jacobian.straight()) return true;
        return jacobian.validity() == CellValidity::valid && scaled_jacobian(jacobian) >= least_scaled_jacobian;
    }

    void find_cells() {
        for (std::int32_t t = 0; t < std::ssize(mesh_.tets); ++t)
            if (is_curved(t)) cells_.push_back(t);
    }
    std::vector<std::int32_t> invalid_of(const std::vector<std::int32_t>& cells) const {
        std::vector<std::int32_t> invalid;
        for (const std::int32_t t : cells)
            if (!is_good(t)) invalid.push_back(t);
        return invalid;
    }

    // Returns all cells that have one of these edges, ascending.
    std::vector<std::int32_t> cells_with(const std::set<std::int32_t>& edges) const {
        std::vector<std::int32_t> cells;
        if (edges.empty()) return cells;
        for (std::int32_t t = 0; t < std::ssize(mesh_.tets); ++t) {
            const std::array<std::int32_t, 6> numbers = edges_of(t);
            if (std::any_of(numbers.begin(), numbers.end(), [&](std::int32_t e) { return edges.contains(e); }))
                cells.push_back(t);
        }
        return cells;
    }
    std::set<std::int32_t> edges_of(const std::vector<std::int32_t>& cells) const {
        std::set<std::int32_t> edges;
        for (const std::int32_t t : cells)
            for (const std::int32_t e : edges_of(t)) edges.insert(e);
        return edges;
    }
    std::vector<std::int32_t> neighbours_of(const std::vector<std::int32_t>& cells) const {
        return cells_with(edges_of(cells));
    }

    Vec3 middle_of(const UndirectedEdge& ends) const {
        return 0.5 * (mesh_.vertices[ends[0]] + mesh_.vertices[ends[1]]);
    }

    // Returns the least Jacobian of cells, by their coefficients, as a share of that of the straight cell; at most
    // enough_jacobian.
    double least_jacobian(const std::vector<std::int32_t>& cells) const {
        double least = enough_jacobian;
        for (const std::int32_t t : cells) {
            const CurvedTetJacobian jacobian(nodes_of(t));
            least = std::min(least, jacobian.coarse_low() / jacobian.straight());
        }
        return least;
    }

    // Moves the node of every edge inside of these cells once, ascending: by steps along the axes, shorter and shorter.
    void move_inner_nodes(const std::vector<std::int32_t>& invalid) {
        std::map<std::int32_t, std::vector<std::int32_t>> cells_at;
        for (const std::int32_t e : edges_of(invalid))
            if (inside_[e] != 0) cells_at[e];
        for (std::int32_t t = 0; t < std::ssize(mesh_.tets) && !cells_at.empty(); ++t)
            for (const std::int32_t e : edges_of(t))
                if (const auto found = cells_at.find(e); found != cells_at.end()) found->second.push_back(t);
        std::map<std::int32_t, UndirectedEdge> ends;
        edges_.for_all([&](std::int32_t e, const UndirectedEdge& of_edge) {
            if (cells_at.contains(e)) ends[e] = of_edge;
        });
        for (const auto& [edge, cells] : cells_at) move_node(edge, ends.at(edge), cells);
    }
    void move_node(std::int32_t edge, const UndirectedEdge& ends, const std::vector<std::int32_t>& cells) {
        double least = least_jacobian(cells), step = first_step * largest_offset(cells);
        if (least >= enough_jacobian || step == 0) return;
        const Vec3 middle = middle_of(ends);
        const auto moved = nodes_.find(edge);
        Vec3 best = moved == nodes_.end() ? middle : moved->second;
        for (int shrinks = 0; shrinks < most_shrinks; ++shrinks, step /= 2)
            for (int direction = 0; direction < 6; ++direction) {
                const Vec3 tried = best + (direction % 2 == 0 ? step : -step) * Vec3::Unit(direction / 2);
                nodes_.insert_or_assign(edge, tried);
                const double now = least_jacobian(cells);
                if (now <= least) continue;
                least = now;
                best = tried;
            }
        if (best == middle) {
            nodes_.erase(edge);
            return;
        }
        nodes_.insert_or_assign(edge, best);
        for (const std::int32_t v : ends) has_curved_[v] = 1;
    }
    double largest_offset(const std::vector<std::int32_t>& cells) const {
        double largest = 0;
        for (const std::int32_t t : cells) {
            const TetNodes nodes = nodes_of(t);
            for (std::size_t e = 0; e < 6; ++e)
                largest =
                    std::max(largest, (nodes[4 + e] - 0.5 * (nodes[tet_edges[e][0]] + nodes[tet_edges[e][1]])).norm());
        }
        return largest;
    }

    // Straightens the curved edge of a cell whose straightening leaves the largest Jacobian, and returns it.
    std::int32_t straighten_one_of(std::int32_t t) {
        const TetNodes nodes = nodes_of(t);
        const std::array<std::int32_t, 6> numbers = edges_of(t);
        std::int32_t best = -1;
        double most = 0;
        for (std::size_t e = 0; e < 6; ++e) {
            if (!nodes_.contains(numbers[e])) continue;
            TetNodes tried = nodes;
            tried[4 + e] = 0.5 * (nodes[tet_edges[e][0]] + nodes[tet_edges[e][1]]);
            const double left = CurvedTetJacobian(tried).coarse_low();
            if (best >= 0 && left <= most) continue;
            best = numbers[e];
            most = left;
        }
        nodes_.erase(best);
        if (inside_[best] == 0) straightened_.push_back(best);
        return best;
    }

    CurvedPart result() {
        CurvedPart part;
        for (const auto& [edge, node] : nodes_) {
            part.curved.push_back({edge, node});
            part.moved += inside_[edge];
        }
        std::sort(straightened_.begin(), straightened_.end());
        part.straightened = std::move(straightened_);
        for (std::int32_t t = 0; t < std::ssize(mesh_.tets); ++t) {
            if (!is_curved(t)) continue;
            ++part.cells;
            const CurvedTetJacobian jacobian(nodes_of(t));
            part.volume_gain += jacobian.volume() - jacobian.straight() / 6;
            if (jacobian.coarse_low() < part.worst_scaled_jacobian * jacobian.straight())
                part.worst_scaled_jacobian = std::min(part.worst_scaled_jacobian, scaled_jacobian(jacobian));
        }
        return part;
    }

    const TetMesh& mesh_;
    const EdgeTable& edges_;
    const std::vector<char>& inside_;
    std::vector<char> has_curved_;        // of vertices: an end of a curved edge, now or before
    std::map<std::int32_t, Vec3> nodes_;  // of curved edges
    std::vector<std::int32_t> cells_;     // cells with a curved edge at the beginning
    std::vector<std::int32_t> straightened_;
};

}  // namespace

TetNodes places_of_nodes(const Part& part, std::int64_t tet) {
    const std::array<std::int32_t, 10> nodes = part.nodes_of_tet(tet);
    TetNodes places;
    std::transform(nodes.begin(), nodes.end(), places.begin(), [&](std::int32_t n) { return part.node_point(n); });
    return places;
}

CurvedPart curve_part(const TetMesh& mesh, const EdgeTable& edges, const std::vector<char>& inside,
                      const std::vector<CurvedEdge>& wanted) {
    return PartCurving(mesh, edges, inside, wanted).run();
}

}  // namespace kerf

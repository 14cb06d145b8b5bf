// Runs of the cases with cells of order 2, some of whose edges are bent: each node is where no other could be.
#pragma once

#include <array>
#include <map>

#include "export/cases.h"
#include "files/part/run_parts.h"
#include "files/part/second_order_parts.h"

namespace kerf::test {

/// A node on an edge.
struct BentNode {
    std::int64_t id = -1;
    Vec3 point;
};
using BentNodes = std::map<std::array<std::int64_t, 2>, BentNode>;  // by both ends, the smaller one first

/// The node of every edge of the parts.
inline BentNodes nodes_of_edges(const PartSource& parts) {
    BentNodes nodes;
    for (const PartIndex index : parts.outline().parts.ids()) {
        const Part part = parts.load(index);
        part.edge_nodes.edges.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
            std::array ends{part.global_id[edge[0]], part.global_id[edge[1]]};
            std::sort(ends.begin(), ends.end());
            nodes[ends] = {part.edge_nodes.global_id[e], part.edge_nodes.points[e]};
        });
    }
    return nodes;
}

class BentRun {
 public:
    explicit BentRun(const ExportCase& each)
        : run_(run_of(each)), parts_(run_, number_edges(run_), bent(SecondOrderParts(run_, number_edges(run_)))) {}

    const PartSource& parts() const { return parts_; }
    const PartSource& of_order_1() const { return run_; }

 private:
    // Every seventh node, by a hundredth of a typical edge.
    static CurvedNodes bent(const PartSource& straight) {
        CurvedNodes curved;
        std::map<std::int64_t, Vec3> points;
        for (const auto& [ends, node] : nodes_of_edges(straight)) points[node.id] = node.point;
        for (const auto& [id, point] : points) {
            if (id % 7 != 0) continue;
            curved.ids.push_back(id);
            curved.points.push_back(point + Vec3(1e-3, -2e-3, 1.5e-3));
        }
        return curved;
    }

    RunParts run_;
    SecondOrderParts parts_;
};

}  // namespace kerf::test

// Parts with a node on each edge.
#pragma once

#include "files/part/edge_nodes.h"
#include "files/part/edge_numbers.h"
#include "files/part/part.h"

namespace kerf {

/// Adds the nodes on the edges of a part of order 1: their numbers, and points in the middle of straight edges, or as
/// `curved` has them. Values at points are extended to these nodes, as the means of the two ends.
void add_edge_nodes(const EdgeNumbers& numbers, const CurvedNodes& curved, Part& part);

/// The parts of another source, of order 1, as parts of order 2: each edge has a node in its middle or, if it is
/// curved, elsewhere. The nodes are added here and not by meshers, because a part has no say in the nodes that others
/// have: they are numbered when all parts are there. Values at points are extended to these nodes, as the means of the
/// two ends.
class SecondOrderParts : public PartSource {
 public:
    /// Takes the parts, which must outlive this, and the nodes that are not in the middle of their edges, by global
    /// number.
    SecondOrderParts(const PartSource& parts, EdgeNumbers numbers, CurvedNodes curved = {});

    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override;
    const RegionWalls& walls() const override { return parts_.walls(); }
    const CurvedNodes& curved() const { return curved_; }

 private:
    const PartSource& parts_;
    EdgeNumbers numbers_;
    CurvedNodes curved_;
    MeshOutline outline_;
};

}  // namespace kerf

// The layers of a solution: moved vertices and their values, isolines, arrows.
#pragma once

#include "viewer/scene/inside/arrows.h"
#include "viewer/scene/inside/layer_sink.h"

namespace kerf::view {

/// The solution at the nodes of a part, as it is drawn. Places are empty where nothing moves, values where the colour
/// is that of something else.
struct SolvedNodes {
    std::shared_ptr<const PartSolution> found;  ///< null if the view does not need it, or while it is being fetched
    std::vector<Vec3> moved;                    ///< places of vertices
    std::vector<float> at_vertices;             ///< values at vertices
    std::vector<Vec3> moved_edges;              ///< places of nodes on edges
    std::vector<float> at_edges;                ///< values at nodes on edges

    SolvedNodes() = default;
    SolvedNodes(const SceneContext& context, LayerSink& sink, NodeId part, const std::vector<Vec3>& vertices,
                const EdgePoints& edges);
    const std::vector<Vec3>& places(const std::vector<Vec3>& vertices) const {
        return moved.empty() ? vertices : moved;
    }
    DrawnEdges drawn(const EdgePoints& edges) const {
        return {moved_edges.empty() ? edges.places : moved_edges, edges.places, at_edges};
    }

 private:
    void add_edges(const ViewState& state, const EdgePoints& edges);
};

/// Adds isolines and arrows to the layers of parts.
class SolutionLayers {
 public:
    SolutionLayers(const SceneContext& context, LayerSink& sink) : context_(context), sink_(sink) {}

    /// Adds isolines at the inner tenths of the range of colours.
    void add_isolines(const ValueRange& range);
    /// Adds displacements as arrows.
    void add_vectors();

 private:
    std::size_t triangles_seen(const Layer& layer) const;
    void add_arrows(const NodeSurface& surface, const PartSolution& solution, const Vec3& offset,
                    std::vector<Arrow>& arrows) const;

    const SceneContext& context_;
    LayerSink& sink_;
};

}  // namespace kerf::view

// The lengths of edges that the shape of a remeshed surface asks for.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>

#include "base/core/cancellation.h"
#include "surface/remesh/inside/bounded_surface.h"
#include "surface/remesh/thickness.h"

namespace kerf {

struct FoldSizeOptions {
    double longest = 0;                                       ///< upper bound everywhere, > 0
    double shortest = 0;                                      ///< lower bound of the sizes that folds ask for
    double growth = 0.4;                                      ///< increase of the size per distance
    WallEdges walls = {};                                     ///< the edges that walls ask for
    std::function<double(const Vec3&, std::int32_t)> wanted;  ///< size that the user wants at a point of a patch, if
                                                              ///< given
    CancellationCheck check_cancelled = {};                   ///< called while sizes are found
};

/// The sizes that well-shaped triangles need: by the distance to the nearest fold, between folds, and across walls.
/// Reads the surface once, when it is constructed, which should be after all that the bound allows has been left out.
class FoldSizes {
 public:
    /// Numbers the folds (SheetMeshTraits::fold) and sets the size of every vertex. A size is at most that which grows
    /// from its neighbours; at least as long as the edges around, if all facets there are well shaped; and the mean of
    /// the edges beside facets that are kept. Keeps the input by reference. O(#V log #V), on threads, if few folds are
    /// near each other.
    FoldSizes(BoundedSurface& surface, const FoldSizeOptions& options);

    /// Returns the size at a new vertex on an edge of this fold (-1: of none), given the size that has grown to there.
    /// Away from folds the size is the grown one, unless walls or the user ask for less.
    WantedLength of_new(const SheetMesh& mesh, BoundedSurface::Vertex v, std::int32_t fold, WantedLength grown) const;
    /// Returns the size that the user asks for at a vertex, the smallest of the patches around it, at most the longest.
    double asked(const SheetMesh& mesh, BoundedSurface::Vertex v) const;

 private:
    void find_folds(BoundedSurface& surface);
    WantedLength at(const SheetMesh& mesh, BoundedSurface::Vertex v, double own_chord, const WantedLength& grown) const;
    double straight_length(const SheetMesh& mesh, BoundedSurface::Edge e) const;
    double at_wall(const SheetMesh& mesh, BoundedSurface::Vertex v, double limit) const;

    const InputShape& input_;
    FoldSizeOptions options_;
    std::vector<double> chord_;  // of each fold, see chord_over()
    std::vector<Vec3> ends_;     // two for each fold
    std::optional<TriangleTree> folds_;
};

}  // namespace kerf

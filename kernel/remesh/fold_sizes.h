// How long the edges of a remeshed surface are to be, from what the surface looks like.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>

#include "core/cancellation.h"
#include "remesh/edited_surface.h"

namespace kerf {

struct FoldSizeOptions {
    double longest = 0;                                       ///< anywhere, > 0
    double shortest = 0;                                      ///< that folds may ask for
    double thinnest = 0;                                      ///< that walls may ask for
    double growth = 0.4;                                      ///< of the size with distance
    double edges_per_thickness = 0;                           ///< across a wall; 0: walls ask for nothing
    std::function<double(const Vec3&, std::int32_t)> wanted;  ///< by the user at a point of a patch, if given
    CancellationCheck poll = {};                              ///< asked while sizes are found
};

/// The distance to the nearest fold, fold to fold, and across walls: what well-shaped triangles have to be as small as.
/// Reads the surface as it is when this is made, once, after what the bound allows to be left out has gone.
class FoldSizes {
 public:
    /// Numbers the folds (EditTraits::fold) and sets the size of every vertex, which is not more than what grows from
    /// its neighbours; where all facets around it are well shaped, it is not less than their edges; beside facets that
    /// are kept it is the mean of the edges there. Keeps the reference. O(#V log #V) where few folds are near each
    /// other.
    FoldSizes(EditedSurface& surface, const FoldSizeOptions& options);

    /// The size at a vertex that has come onto an edge of that fold (-1: of none), given what has grown to there. Away
    /// from folds nothing is asked but what grows from them.
    WantedLength of_new(EditedSurface::Vertex v, std::int32_t fold, WantedLength grown) const;
    /// The size that the user asks for at a vertex, the smallest of the patches around it, at most the longest.
    double asked(EditedSurface::Vertex v) const;

 private:
    void find_folds(EditedSurface& surface);
    WantedLength at(EditedSurface::Vertex v, double own_chord, const WantedLength& grown) const;
    double straight_length(EditedSurface::Edge e) const;
    double across_wall(EditedSurface::Vertex v, double limit) const;

    const EditedSurface& surface_;
    FoldSizeOptions options_;
    std::vector<double> chord_;  // of the folds, see chord_over()
    std::vector<Vec3> ends_;     // of the folds, in pairs
    std::optional<TriangleTree> folds_;
};

}  // namespace kerf

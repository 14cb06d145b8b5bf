// The place of a vertex that makes the cells around it best.
#pragma once

#include <vector>

#include "fill/improve/inside/improved_mesh.h"

namespace kerf {

/// Looks for a point that sees all of some faces, and makes the worst of the cells between it and them as good as can
/// be: by steps in directions that only look random, which grow where they help and shrink where they do not (Freitag
/// and Ollivier-Gooch 1997, freitag1997, and Klingner and Shewchuk 2007, klingner2007, follow gradients instead).
class BestPlace {
 public:
    struct Face {
        Vec3 a, b, c;  ///< corners that make a positive cell with the point before them
    };

    void clear() { faces_.clear(); }
    void add(const Face& face) { faces_.push_back(face); }
    /// Returns all faces, in an order of its own once it has searched.
    const std::vector<Face>& faces() const { return faces_; }

    struct Place {
        Vec3 at;
        double badness;  ///< badness of the worst cell
    };
    /// Searches from `start` and returns the best place that was found; a place counts if its badness is below
    /// `start.badness`. Cells may exceed their bound of volume by `excess`.
    Place search(const ImprovedMesh& mesh, Place start, double excess, std::int32_t seed);

 private:
    double worst_at(const ImprovedMesh& mesh, const Vec3& p, double limit, double excess);

    std::vector<Face> faces_;
};

}  // namespace kerf

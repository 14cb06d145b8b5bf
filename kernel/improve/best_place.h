// Where a vertex makes the cells around it best.
#pragma once

#include <vector>

#include "improve/edited_mesh.h"

namespace kerf {

/// Looks for a point that sees all of some faces, and makes the worst of the cells between it and them as good as can
/// be: by steps in directions that only look random, which grow where they help and shrink where they do not
/// (freitag1997 and klingner2007 follow gradients instead).
class BestPlace {
 public:
    struct Face {
        Vec3 a, b, c;  ///< with the point before them a positive cell
    };

    void clear() { faces_.clear(); }
    void add(const Face& face) { faces_.push_back(face); }
    /// All faces, in an order of its own once it has searched.
    const std::vector<Face>& faces() const { return faces_; }

    struct Place {
        Vec3 at;
        double badness;  ///< of the worst cell
    };
    /// Moves from there to the best place that was found; badness counts from `start.badness` on. Cells may exceed
    /// their bound of volume by `excess`.
    Place search(const EditedMesh& mesh, Place start, double excess, std::int32_t seed);

 private:
    double worst_at(const EditedMesh& mesh, const Vec3& p, double limit, double excess);

    std::vector<Face> faces_;
};

}  // namespace kerf

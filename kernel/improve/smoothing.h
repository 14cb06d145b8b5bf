// A better place for a vertex.
#pragma once

#include "improve/best_place.h"

namespace kerf {

class Smoothing {
 public:
    /// Moves the vertex to the best place among the cells around it, `star`; false, and nothing has changed, where that
    /// does not make the worst of them better by a share of `least_gain`.
    bool move(EditedMesh& mesh, std::int32_t vertex, std::span<const std::int32_t> star, double least_gain);

 private:
    BestPlace places_;
};

}  // namespace kerf

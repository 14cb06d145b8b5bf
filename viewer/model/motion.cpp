// The motion of the deformation of a solution.
#include <cmath>
#include <numbers>

#include "viewer/model/view_state.h"

namespace kerf::view {

double share_of_motion(Motion motion, double phase) {
    // There and back are the same bit for bit, so that pictures of the way there are known on the way back.
    const double cosine = std::cos(2 * std::numbers::pi * (phase > 0.5 ? 1 - phase : phase));
    switch (motion) {
        case Motion::still:
            return 1;
        case Motion::swing:
            return cosine;
        case Motion::rise:
            return (1 + cosine) / 2;
    }
    return 1;
}

}  // namespace kerf::view

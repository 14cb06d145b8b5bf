#include "solve/case/material.h"

#include <cmath>

namespace kerf {

double von_mises(const SymmetricTensor& stress) {
    SymmetricTensor deviator = stress;
    deviator.head<3>().array() -= stress.head<3>().mean();
    return std::sqrt(1.5 * contracted(deviator, deviator));
}

}  // namespace kerf

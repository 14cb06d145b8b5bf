// kerf.SizeField.
#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "kerf/kerf.h"
#include "python/values.h"

namespace kerf::python {

/// The value of a kerf.SizeField; `sizes` is never null.
struct SizesObject {
    std::shared_ptr<const GivenSizes> sizes;
};

}  // namespace kerf::python

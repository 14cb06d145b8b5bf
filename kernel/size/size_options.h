// What a user says about sizes.
#pragma once

#include "size/size_field.h"

namespace kerf {

/// Lengths are in units of the input; 0 stands for "not given".
struct SizeOptions {
    double size = 0;        ///< wanted edge length everywhere
    double max_volume = 0;  ///< of a tetrahedron everywhere, instead of `size`

    /// Throws Error(usage) naming option, value and range.
    void check() const;
    /// `max_volume`, or what follows from `size`; 0: none.
    double constant_max_volume() const;
};

}  // namespace kerf

// What the arrays by global numbers of the format hdf5 mean, for readers of XDMF.
#pragma once

#include <string>

#include "part/part.h"

namespace kerf {

/// The file, beside which the arrays lie in the file `h5`.
std::string xdmf_text(const MeshOutline& outline, std::string h5);

}  // namespace kerf

#include "size/size_options.h"

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/regular_tet.h"

namespace kerf {

void SizeOptions::check() const {
    // Written so that NaN fails.
    if (!(size >= 0 && std::isfinite(size)))
        throw Error(ErrorCode::usage, fmt::format("--size is {}, but it must be positive.", size));
    if (size > 0 && !std::isnormal(regular_tet_volume(size)))
        throw Error(
            ErrorCode::usage,
            fmt::format("--size is {}, but it must be such that its cube is a number of double precision.", size));
    if (!(max_volume == 0 || (max_volume > 0 && std::isnormal(max_volume))))
        throw Error(ErrorCode::usage,
                    fmt::format("--max-volume is {}, but it must be positive, or 0 for no bound.", max_volume));
}

double SizeOptions::constant_max_volume() const {
    return max_volume == 0 && size > 0 ? regular_tet_volume(size) : max_volume;
}

}  // namespace kerf

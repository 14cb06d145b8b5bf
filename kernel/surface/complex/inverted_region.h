// The error of a region that is inside out.
#pragma once

#include <string>

#include "base/core/error.h"

namespace kerf {

/// Error(input) of a region whose facets all have it on their wrong side, so that its volume is negative.
class InvertedRegion : public Error {
 public:
    static constexpr const char* kind = "inverted region";
    explicit InvertedRegion(const std::string& message) : Error(ErrorCode::input, message) {}
};

}  // namespace kerf

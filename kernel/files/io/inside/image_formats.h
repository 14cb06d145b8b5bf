// Files of images, which are told from others so that they can be refused by name.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// Returns what a file is by its bytes, if it is an image of a known format, as in "an image (NRRD)"; else empty.
std::string_view image_format_of(std::string_view bytes);

/// Returns the sentences that refuse an image and tell the way out. `what` it is: see image_format_of().
std::string image_refusal(std::string_view what);

}  // namespace kerf

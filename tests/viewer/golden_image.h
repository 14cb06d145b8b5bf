// Pictures as they should be.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "viewer/driver.h"
#include "viewer/render/image.h"

namespace kerf::test {

/// How two pictures differ.
struct ImageDifference {
    bool same_size = false;
    double differing = 1;  ///< share of pixels with a channel that is off by more than channel_tolerance
    int largest = 255;     ///< of a channel
};
ImageDifference compare(const view::Image& a, const view::Image& b);

/// The same driver gives the same bytes. Other processors round a little differently: that moves single pixels at
/// borders. What these let pass was measured against pictures that a user would call different
/// (golden_images_test.cpp).
inline constexpr int channel_tolerance = 16;
inline constexpr double most_differing = 5e-4;

/// Whether tests/golden/images/NAME.png is this picture. If not, or if there is none, the candidate is left in
/// golden_candidates below the build folder; ./run goldens replaces the golden ones by all candidates.
///
/// driver.txt beside the golden pictures names the OpenGL driver that drew them. Where another one differs by more than
/// the tolerance, its own pictures lie in a folder named after it, and its candidates go there; a failure says so.
testing::AssertionResult is_golden(const std::string& name, const view::Image& picture, const std::string& drawn_by);
/// The same of the picture as it is after settle().
testing::AssertionResult is_golden(const std::string& name, Driver& driver);

/// The driver of the golden pictures that are for all; `drawn_by` where they do not say.
std::string golden_driver(const std::string& drawn_by);

/// Where the candidate of a picture is left.
std::string candidate_path(const std::string& name, const std::string& drawn_by);

}  // namespace kerf::test

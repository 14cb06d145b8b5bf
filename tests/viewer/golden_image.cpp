#include "viewer/golden_image.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

namespace kerf::test {

namespace {

std::string golden_path(const std::string& name) {
    return fmt::format("{}/tests/golden/images/{}.png", KERF_SOURCE, name);
}

std::string candidate_path(const std::string& name) {
    const std::string folder = KERF_GOLDEN_CANDIDATES;
    std::filesystem::create_directories(folder);
    return fmt::format("{}/{}.png", folder, name);
}

}  // namespace

ImageDifference compare(const view::Image& a, const view::Image& b) {
    ImageDifference difference;
    difference.same_size = a.width == b.width && a.height == b.height;
    if (!difference.same_size) return difference;
    std::size_t differing = 0;
    difference.largest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        int most = 0;
        for (std::size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(int{a.rgb[k]} - int{b.rgb[k]}));
        difference.largest = std::max(difference.largest, most);
        differing += most > channel_tolerance;
    }
    difference.differing =
        static_cast<double>(differing) / static_cast<double>(std::max<std::size_t>(1, a.rgb.size() / 3));
    return difference;
}

testing::AssertionResult is_golden(const std::string& name, const view::Image& picture) {
    const std::string golden = golden_path(name), candidate = candidate_path(name);
    std::filesystem::remove(candidate);
    if (!std::filesystem::exists(golden)) {
        view::write_png(candidate, picture);
        return testing::AssertionFailure() << golden << " is missing; the candidate is " << candidate;
    }
    const ImageDifference difference = compare(view::read_png(golden), picture);
    if (difference.same_size && difference.differing <= most_differing) return testing::AssertionSuccess();
    view::write_png(candidate, picture);
    if (!difference.same_size) return testing::AssertionFailure() << golden << " has another size than " << candidate;
    return testing::AssertionFailure() << fmt::format("{:.3f} % of the pixels of {} are off, by up to {}; see {}",
                                                      100 * difference.differing, golden, difference.largest,
                                                      candidate);
}

}  // namespace kerf::test

#include "viewer/golden_image.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "support/places.h"

namespace kerf::test {

namespace {

namespace fs = std::filesystem;

const fs::path goldens = fs::path(test::source_folder()) / "tests/golden/images";
const fs::path candidates = fs::path(test::candidate_folder()) / "images";

// Of a driver: "llvmpipe (LLVM 15)" gives "llvmpipe-llvm-15".
std::string folder_of(const std::string& drawn_by) {
    std::string folder;
    for (const char c : drawn_by) {
        if (std::isalnum(static_cast<unsigned char>(c)))
            folder += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!folder.empty() && folder.back() != '-')
            folder += '-';
    }
    return folder;
}

// Its own, if there is one.
fs::path golden_path(const std::string& name, const std::string& drawn_by) {
    const fs::path file = fmt::format("{}.png", name), own = goldens / folder_of(drawn_by) / file;
    return fs::exists(own) ? own : goldens / file;
}

// What to know about a picture that is not as it should be.
std::string about_drivers(const std::string& drawn_by) {
    const std::string common = golden_driver(drawn_by);
    if (common == drawn_by) return fmt::format("Both were drawn by {}.", drawn_by);
    return fmt::format("It was drawn by {}, the golden pictures by {}. If it looks right, it goes to {}.", drawn_by,
                       common, (goldens / folder_of(drawn_by)).string());
}

}  // namespace

std::string golden_driver(const std::string& drawn_by) {
    std::ifstream file(goldens / "driver.txt");
    std::string line;
    return std::getline(file, line) ? line : drawn_by;
}

std::string candidate_path(const std::string& name, const std::string& drawn_by) {
    const fs::path folder = golden_driver(drawn_by) == drawn_by ? candidates : candidates / folder_of(drawn_by);
    return (folder / fmt::format("{}.png", name)).string();
}

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

testing::AssertionResult is_golden(const std::string& name, const view::Image& picture, const std::string& drawn_by) {
    const std::string golden = golden_path(name, drawn_by).string(), candidate = candidate_path(name, drawn_by);
    fs::remove(candidate);
    fs::create_directories(fs::path(candidate).parent_path());
    if (!fs::exists(golden)) {
        view::write_png(candidate, picture);
        return testing::AssertionFailure() << golden << " is missing; the candidate is " << candidate;
    }
    const ImageDifference difference = compare(view::read_png(golden), picture);
    if (difference.same_size && difference.differing <= most_differing) return testing::AssertionSuccess();
    view::write_png(candidate, picture);
    const std::string how = difference.same_size ? fmt::format("{:.3f} % of the pixels are off, by up to {}",
                                                               100 * difference.differing, difference.largest)
                                                 : "The size is another";
    return testing::AssertionFailure() << fmt::format("{}: {}, see {}. {}", golden, how, candidate,
                                                      about_drivers(drawn_by));
}

testing::AssertionResult is_golden(const std::string& name, Driver& driver) {
    if (!fs::exists(goldens / "driver.txt")) {
        fs::create_directories(candidates);
        std::ofstream(candidates / "driver.txt") << driver.app().renderer().driver() << '\n';
    }
    return is_golden(name, driver.picture(), driver.app().renderer().driver());
}

}  // namespace kerf::test

// The pictures of the README and of docs/ are those that this program draws.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "fill/volume/child_process.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "viewer/driver.h"
#include "viewer/golden_image.h"

namespace kerf::test {
namespace {

using namespace view;

namespace fs = std::filesystem;

const fs::path gallery = test::asset_folder() + "/gallery";
const std::string new_gallery = test::build_folder() + "/gallery";

std::set<std::string> pictures_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (const fs::path& path = entry.path(); path.extension() == ".png" || path.extension() == ".svg")
            names.insert(path.lexically_relative(folder).string());
    return names;
}

// CAD files are not in the repository, and what reads them need not be there.
const fs::path cad_files = fs::path(test::corpus_folder()) / "cad";
bool has_cad() { return KERF_HAS_CAD && !test::corpus_folder().empty() && fs::is_directory(cad_files); }

// What this build cannot draw, and nothing else.
bool is_left_out(const std::string& name) {
    const bool is_of_solution = name.starts_with("stress") || name.starts_with("bracket");
    return (name.starts_with("cad_") && !has_cad()) || (is_of_solution && !KERF_HAS_SOLVE);
}

std::vector<std::string> arguments() {
    std::vector<std::string> all = {"--kerf", test::kerf_program(), "--into", new_gallery};
    if (has_cad()) all.insert(all.end(), {"--cad", cad_files.string()});
    return all;
}

// The same driver draws the same pixels on the same processor; on another one it rounds single channels to the number
// beside, and another driver moves single pixels.
bool is_same_picture(const std::string& name, const std::string& drawn_by) {
    const std::string ours = (gallery / name).string(), now = (fs::path(new_gallery) / name).string();
    if (name.ends_with(".svg")) return bytes_of_file(ours) == bytes_of_file(now);
    const ImageDifference difference = compare(read_png(ours), read_png(now));
    if (!difference.same_size) return false;
    return golden_driver(drawn_by) == drawn_by ? difference.largest <= 1 : difference.differing <= most_differing;
}

TEST(Gallery, IsDrawnByThisProgram) {
    constexpr double timeout_seconds = 280;
    fs::remove_all(new_gallery);
    fs::create_directories(new_gallery);
    ChildPool pool;
    pool.start(0, (gallery / "make_gallery.sh").string(), arguments(), {}, timeout_seconds);
    const ChildResult drawn = pool.wait_any()->result;
    ASSERT_EQ(drawn.exit_code, 0) << drawn.log;
    const std::set<std::string> kept = pictures_in(gallery), now = pictures_in(new_gallery);
    const std::string driver = Driver().app().renderer().driver();
    constexpr const char* remedy = "To draw it again: assets/gallery/make_gallery.sh";
    for (const std::string& name : kept) EXPECT_NE(now.contains(name), is_left_out(name)) << "assets/gallery/" << name;
    for (const std::string& name : now) {
        ASSERT_TRUE(kept.contains(name)) << "assets/gallery/" << name << " is missing. " << remedy;
        EXPECT_TRUE(is_same_picture(name, driver)) << "assets/gallery/" << name << " is out of date: now it is "
                                                   << new_gallery << "/" << name << ". " << remedy;
    }
}

}  // namespace
}  // namespace kerf::test

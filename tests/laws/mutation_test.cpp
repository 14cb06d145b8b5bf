// Whatever happens to a file, reading and checking it ends with a soup or with an error that blames the file.
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/io/surface_reader.h"
#include "run/prepare/input.h"
#include "support/archives.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/mutation.h"
#include "support/shapes.h"
#include "support/slice.h"
#include "support/surface_files.h"

namespace kerf {
namespace {

using test::SurfaceFile;

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

std::size_t bytes_of(const Soup& soup) {
    return bytes_of(soup.vertices) + bytes_of(soup.facets) + bytes_of(soup.patch) + bytes_of(soup.patch_names) +
           bytes_of(soup.polygon) + bytes_of(soup.holes) + bytes_of(soup.notes);
}

void expect_valid_indices(const Soup& soup) {
    ASSERT_EQ(soup.patch.size(), soup.facets.size());
    ASSERT_TRUE(soup.polygon.empty() || soup.polygon.size() == soup.facets.size());
    for (const Triangle& t : soup.facets)
        for (const std::int32_t v : t) ASSERT_TRUE(v >= 0 && static_cast<std::size_t>(v) < soup.vertices.size());
    for (const std::int32_t p : soup.patch)
        ASSERT_TRUE(p >= 0 && static_cast<std::size_t>(p) < soup.patch_names.size());
}

struct Outcomes {
    unsigned refused = 0, defective = 0, clean = 0;
};

// What every command does with a file before it cuts.
void read_and_check(const SurfaceFile& file, bool is_archive, Outcomes& outcomes) {
    Soup soup = read_surface_bytes(file.bytes, file.name);
    expect_valid_indices(soup);
    const std::size_t growth = is_archive ? 1000 : 1;
    ASSERT_LE(bytes_of(soup), 20 * growth * file.bytes.size() + 10'000);
    CheckedSoup checked = check_soup(std::move(soup));
    EXPECT_FALSE(checked.diagnosis.summary(checked.soup).empty());
    if (!checked.diagnosis.clean()) {
        ++outcomes.defective;
        return;
    }
    apply_repairs(checked);
    ++outcomes.clean;
}

void expect_soup_or_error(const SurfaceFile& file, bool is_archive, Outcomes& outcomes) {
    try {
        read_and_check(file, is_archive, outcomes);
    } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ErrorCode::input || error.code() == ErrorCode::io) << error.what();
        ++outcomes.refused;
    } catch (const std::exception& error) {
        ADD_FAILURE() << "not an error of Kerf: " << error.what();
    }
}

// Each file once for each seed; chunks come from the file behind it. Returns the number of mutations.
unsigned check_mutations(const std::vector<SurfaceFile>& files, unsigned seeds, bool are_archives, Outcomes& outcomes) {
    for (std::size_t i = 0; i < files.size(); ++i)
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            SCOPED_TRACE(files[i].name + ", file " + std::to_string(i) + ", seed " + std::to_string(seed));
            const std::string& donor = files[(i + 1) % files.size()].bytes;
            expect_soup_or_error({files[i].name, test::mutate(files[i].bytes, donor, seed)}, are_archives, outcomes);
            if (testing::Test::HasFailure()) return 0;  // the first says enough
        }
    return static_cast<unsigned>(files.size()) * seeds;
}

std::vector<SurfaceFile> small_files() {
    std::vector<SurfaceFile> files;
    for (const Soup& soup : {test::tetrahedron(), test::box(), test::nested_boxes(2), test::torus(3, 1, 7, 5)})
        for (SurfaceFile& file : test::to_all_formats(soup)) files.push_back(std::move(file));
    return files;
}

TEST(Mutation, MutationsOfFilesOfEveryFormatNeverDoHarm) {
    Outcomes outcomes;
    const std::vector<SurfaceFile> files = small_files();
    EXPECT_GE(check_mutations(files, test::slice(320u), false, outcomes), test::slice(10'000u));
    EXPECT_GT(outcomes.refused, test::slice(1000u));
    EXPECT_GT(outcomes.defective, test::slice(1000u));
    EXPECT_GT(outcomes.clean, test::slice(100u));
}

TEST(Mutation, MutationsOfArchivesNeverDoHarm) {
    Outcomes outcomes;
    std::vector<SurfaceFile> files;
    for (const SurfaceFile& file : test::to_all_formats(test::box())) {
        files.push_back({file.name + ".gz", test::gzip(file.bytes)});
        files.push_back({file.name + ".zst", test::zstd(file.bytes)});
    }
    check_mutations(files, test::slice(30u), true, outcomes);
    EXPECT_GT(outcomes.refused, test::slice(500u));
}

TEST(Mutation, MutationsOfAssetsNeverDoHarm) {
    Outcomes outcomes;
    std::vector<SurfaceFile> files;
    for (const char* name : {"hollow_box", "cube"})
        files.push_back({"asset.stl", test::bytes_of_file(test::asset_path(name))});
    const unsigned seeds = test::in_slices() ? 6 : 24;
    check_mutations(files, seeds, false, outcomes);
    EXPECT_GT(outcomes.refused, seeds / 6);
    EXPECT_GT(outcomes.defective, seeds / 6);
}

}  // namespace
}  // namespace kerf

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/io/file_bytes.h"
#include "files/io/surface_reader.h"
#include "support/archives.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using test::append;

// Facets whose corners are few, so that most are equal to others, or any bits that floats may have.
std::string random_stl(std::mt19937& random, std::uint32_t facets, bool any_bits) {
    constexpr std::uint32_t few[] = {0,          0x80000000, 0x3f800000, 0xbf800000, 1,
                                     0x80000001, 0x007fffff, 0x7f800000, 0xff800000, 0x7fc00000};
    std::string bytes(80, 'x');
    append(bytes, facets);
    for (std::uint32_t f = 0; f < facets; ++f) {
        bytes.append(12, '\x7f');
        for (int i = 0; i < 9; ++i) append(bytes, static_cast<std::uint32_t>(any_bits ? random() : few[random() % 10]));
        bytes.append(2, '\0');
    }
    return bytes;
}

// As the format says it, welded afterwards.
Soup expected_soup(const std::string& bytes) {
    Soup soup;
    for (std::size_t at = 84; at < bytes.size(); at += 50) {
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        soup.facets.push_back({first, first + 1, first + 2});
        for (std::size_t i = 0; i < 3; ++i) {
            float p[3];
            std::memcpy(p, bytes.data() + at + 12 * (i + 1), sizeof p);
            soup.vertices.emplace_back(p[0], p[1], p[2]);
        }
    }
    weld_exactly(soup);
    return soup;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

void expect_same_bits(const Soup& read, const Soup& expected) {
    EXPECT_TRUE(same_bits(read.vertices, expected.vertices));
    EXPECT_EQ(read.facets, expected.facets);
    EXPECT_EQ(read.patch, std::vector<std::int32_t>(expected.facets.size(), 0));
    EXPECT_EQ(read.patch_names, std::vector<std::string>{"surface"});
    EXPECT_TRUE(read.vertex_number.empty());
    EXPECT_TRUE(read.polygon.empty());
}

class BinaryStlFile : public testing::Test {
 protected:
    std::string write(const std::string& bytes) const {
        std::ofstream(path_, std::ios::binary) << bytes;
        return path_;
    }
    std::string message_of(const std::string& bytes) const {
        try {
            read_surface(write(bytes));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    test::TemporaryFolder folder_;
    std::string path_ = folder_.file("part.stl");
};

TEST_F(BinaryStlFile, IsTheSameByBlocksInMemoryAndWeldedAfterwards) {
    std::mt19937 random(5);
    for (const std::uint32_t facets : {1U, 2U, 63U, 64U, 65U, 1000U, 8191U, 8192U, 8193U, 20000U})
        for (const bool any_bits : {false, true}) {
            SCOPED_TRACE(std::to_string(facets) + (any_bits ? " of any bits" : " with few corners"));
            const std::string bytes = random_stl(random, facets, any_bits);
            const Soup expected = expected_soup(bytes);
            const auto read = read_binary_stl_file(write(bytes));
            ASSERT_TRUE(read);
            expect_same_bits(read->soup, expected);
            EXPECT_EQ(read->hash, digest_of(bytes));
            EXPECT_TRUE(read->is_welded);
            Soup again = read->soup;
            EXPECT_EQ(weld_exactly(again), 0);
            expect_same_bits(read_surface(path_), expected);
            expect_same_bits(read_surface_bytes(bytes, path_), expected);
        }
}

TEST_F(BinaryStlFile, IsReadByBlocksOnlyIfItIsNothingElse) {
    const Soup box = test::box();
    const std::string bytes = test::to_binary_stl(box);
    EXPECT_TRUE(read_binary_stl_file(write(test::to_binary_stl(box, "solid facet"))));
    const std::vector<std::string> others = {test::gzip(bytes),
                                             test::zstd(bytes),
                                             test::to_ascii_stl(box),
                                             test::to_obj(box),
                                             bytes + '\0',
                                             bytes.substr(0, bytes.size() - 1),
                                             "\xEF\xBB\xBF" + bytes.substr(3),
                                             "PK\3\4" + bytes.substr(4),
                                             "\x1f\x8b" + bytes.substr(2),
                                             "ISO-10303-21;" + bytes.substr(13),
                                             "solid",
                                             ""};
    for (const std::string& other : others) EXPECT_FALSE(read_binary_stl_file(write(other))) << other.substr(0, 10);
}

// A file that was copied as text has a byte more for each line end, for instance. An even number may leave coordinates
// whole, of other corners.
TEST_F(BinaryStlFile, WithBytesPutInBetweenIsRefusedWithTheirPlace) {
    const std::string bytes = test::to_binary_stl(test::icosphere(3));
    const std::size_t facets = (bytes.size() - 84) / 50;
    const unsigned seed = 3;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    for (int i = 0; i < 50; ++i) {
        const std::size_t facet = random() % (facets - 100), more = 1 + 2 * (random() % 25);
        std::string longer = bytes;
        longer.insert(84 + 50 * facet, more, '\r');
        const std::string message = message_of(longer);
        EXPECT_NE(message.find("damaged: it has " + std::to_string(more) + " byte"), std::string::npos) << message;
        const std::size_t at = message.find("about facet ");
        ASSERT_NE(at, std::string::npos) << message;
        EXPECT_NEAR(std::strtod(message.c_str() + at + 12, nullptr), static_cast<double>(facet), 60);
        EXPECT_EQ(message_of(bytes + std::string(more, '\r')), "") << "padding";
    }
}

TEST_F(BinaryStlFile, CutAnywhereSaysTheSameAsItsBytesInMemory) {
    const std::string bytes = test::to_binary_stl(test::tetrahedron());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const std::string cut = bytes.substr(0, size);
        std::string expected;
        try {
            read_surface_bytes(cut, path_);
        } catch (const Error& error) {
            expected = error.what();
        }
        EXPECT_NE(expected, "") << size;
        EXPECT_EQ(message_of(cut), expected) << size;
    }
    const std::string none = bytes.substr(0, 80) + std::string(4, '\0');
    EXPECT_NE(message_of(none).find("holds no facets"), std::string::npos) << message_of(none);
}

TEST_F(BinaryStlFile, ThatBecomesShorterWhileItIsReadIsRefused) {
    write(std::string(100, 'a'));
    FileReader file(path_);
    std::filesystem::resize_file(path_, 10);
    std::string bytes(file.size(), '\0');
    EXPECT_THROW(file.read(bytes), Error);
}

TEST(AsciiStl, WeldsOverFacetsAndSolidsInTheOrderOfTheCorners) {
    std::mt19937 random(7);
    const char* few[] = {"0", "-0", "1", "-1.5", "4.9e-324", "-4.9e-324", "1e-400", "inf", "nan", "0.1"};
    std::string text;
    Soup expected;
    for (std::int32_t f = 0; f < 600; ++f) {
        if (f % 200 == 0) text += (f ? "endsolid\n" : "") + std::string("solid part") + std::to_string(f / 200) + "\n";
        text += "facet normal 0 0 0\nouter loop\n";
        for (int i = 0; i < 3; ++i) {
            Vec3 p;
            text += "vertex";
            for (double& x : p) {
                const char* word = few[random() % 10];
                x = std::strtod(word, nullptr);
                text += std::string(" ") + word;
            }
            text += "\n";
            expected.vertices.push_back(p);
        }
        text += "endloop\nendfacet\n";
        expected.facets.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    text += "endsolid\n";
    const Soup read = read_surface_bytes(text, "part.stl");
    weld_exactly(expected);
    EXPECT_TRUE(same_bits(read.vertices, expected.vertices));
    EXPECT_EQ(read.facets, expected.facets);
    EXPECT_TRUE(read.vertex_number.empty());
    EXPECT_EQ(read.patch_names, (std::vector<std::string>{"part0", "part1", "part2"}));
    for (std::size_t f = 0; f < read.patch.size(); ++f) ASSERT_EQ(read.patch[f], static_cast<std::int32_t>(f / 200));
}

}  // namespace
}  // namespace kerf

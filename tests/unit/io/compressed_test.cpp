#include "files/io/compressed.h"

#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/archives.h"

namespace kerf {
namespace {

using Compress = std::string (*)(const std::string&);

const std::vector<Compress> compressors = {[](const std::string& bytes) { return test::gzip(bytes); }, test::zstd};

// Half noise, half repetition.
std::string some_bytes(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    std::string bytes(size, 'x');
    for (std::size_t i = 0; i < size / 2; ++i) bytes[i] = static_cast<char>(random());
    return bytes;
}

std::string refusal(const std::string& archive) {
    try {
        decompress(archive, "part.stl.gz");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        EXPECT_EQ(std::string(error.what()).rfind("part.stl.gz: the archive ", 0), 0u) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "accepted";
    return "";
}

TEST(Compressed, GivesBackWhatWasCompressed) {
    for (const Compress compress : compressors)
        for (const std::size_t size : {0u, 1u, 1000u, (1u << 18) - 1, 1u << 18, 3u << 18}) {
            SCOPED_TRACE(size);
            const std::string bytes = some_bytes(size, 1);
            EXPECT_EQ(decompress(compress(bytes), "a"), bytes);
            EXPECT_EQ(decompress(compress("first ") + compress(bytes), "a"), "first " + bytes);
        }
}

TEST(Compressed, LeavesOtherBytesAsTheyAre) {
    for (const std::string bytes : {"", "\x1f", "solid", "\x28\xb5\x2f"}) EXPECT_EQ(decompress(bytes, "a"), bytes);
}

TEST(Compressed, RefusesEveryTruncation) {
    for (const Compress compress : compressors) {
        const std::string archive = compress(some_bytes(300, 2));
        for (std::size_t size = 4; size < archive.size(); ++size) {
            SCOPED_TRACE(size);
            EXPECT_NE(refusal(archive.substr(0, size)).find("is truncated"), std::string::npos);
        }
    }
}

TEST(Compressed, RefusesDamageOrGivesSomethingBack) {
    int refused = 0;
    for (const Compress compress : compressors) {
        const std::string archive = compress(some_bytes(3000, 3));
        for (unsigned seed = 1; seed <= 500; ++seed) {
            SCOPED_TRACE(seed);
            std::mt19937 random(seed);
            std::string damaged = archive;
            damaged[4 + random() % (damaged.size() - 4)] ^= static_cast<char>(1 + random() % 255);
            try {
                decompress(damaged, "a");
            } catch (const Error& error) {
                ASSERT_EQ(error.code(), ErrorCode::input) << error.what();
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 500);  // gzip has a check sum; zstd's is off by default
}

TEST(Compressed, RefusesWhatFollowsAnArchive) {
    for (const Compress compress : compressors) refusal(compress(some_bytes(300, 4)) + "something else");
}

// Many archives one behind the other are one: here of 16 GB, which is refused before there is memory for much of it.
TEST(Compressed, RefusesToGrowWithoutLimit) {
    for (const Compress compress : compressors) {
        const std::string archive = compress(std::string(32'000'000, ' '));
        std::string bomb;
        for (int i = 0; i < 500; ++i) bomb += archive;
        const std::string sentence = refusal(bomb);
        EXPECT_NE(sentence.find("grows to more than 128 times its size"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find("decompress it"), std::string::npos) << sentence;
    }
}

// A hundred megabytes of spaces around a facet, which no surface needs, but may have.
TEST(Compressed, ReadsWhatIsSmallHoweverMuchItGrows) {
    for (const Compress compress : compressors) {
        const std::string archive = compress(std::string(100'000'000, ' '));
        ASSERT_LT(archive.size(), 120'000u);
        EXPECT_EQ(decompress(archive, "a").size(), 100'000'000u);
    }
}

TEST(Compressed, LargerContentsMayGrowAsSurfacesDo) {
    EXPECT_EQ(most_content(0), 250'000'000u);
    EXPECT_EQ(most_content(10'000'000) - most_content(0), 10'000'000 * surface_growth);
}

}  // namespace
}  // namespace kerf

#include "base/core/mixed_bits.h"

#include <bit>

#include <gtest/gtest.h>

namespace kerf {
namespace {

// The published sequence of splitmix64 from the seed 0: files and hashes that were made with it stay readable.
TEST(MixedBits, AreThoseOfSplitmix64) {
    EXPECT_EQ(random_bits(0), 0xe220a8397b1dcdafULL);
    EXPECT_EQ(random_bits(1), 0x6e789e6aa1b965f4ULL);
    EXPECT_EQ(random_bits(2), 0x06c45d188009454fULL);
}

TEST(MixedBits, EveryBitHasASayInTheResult) {
    for (std::uint64_t place = 0; place < 100; ++place)
        for (int bit = 0; bit < 64; ++bit) {
            const std::uint64_t bits = random_bits(place);
            const int turned = std::popcount(mixed_bits(bits) ^ mixed_bits(bits ^ std::uint64_t{1} << bit));
            EXPECT_GT(turned, 8) << place << ' ' << bit;
            EXPECT_LT(turned, 56) << place << ' ' << bit;
        }
}

// The constants are Knuth's: meshes and modes depend on the numbers to the last bit.
TEST(RandomSequence, IsThatOfMmix) {
    RandomSequence random(0);
    EXPECT_EQ(random.next(), 0x14057b7ef767814fULL);
    EXPECT_EQ(random.next(), 0x1a08ee1184ba6d32ULL);
    for (int i = 0; i < 1000; ++i) {
        const double number = random.next_centred();
        EXPECT_GE(number, -0.5);
        EXPECT_LT(number, 0.5);
    }
}

}  // namespace
}  // namespace kerf

#include "base/core/bytes.h"

#include <random>

#include <gtest/gtest.h>

#include "run/work/part_job.h"
#include "support/shapes.h"

namespace kerf {
namespace {

struct Inner {
    std::string name;
    std::vector<Vec3> points;
    template <class Archive>
    void archive(Archive& a) {
        a(name, points);
    }
    bool operator==(const Inner&) const = default;
};

struct Outer {
    std::int32_t number = 0;
    double value = 0;
    Vec3 point = Vec3::Zero();
    std::vector<Inner> inner;
    std::vector<std::vector<std::int32_t>> lists;
    std::vector<std::string> names;
    template <class Archive>
    void archive(Archive& a) {
        a(number, value, point, inner, lists, names);
    }
    bool operator==(const Outer&) const = default;
};

Outer sample() {
    return {-7,
            0.1,
            Vec3(1, -0.0, 1e300),
            {{"a", {Vec3(1, 2, 3), Vec3(4, 5, 6)}}, {"", {}}},
            {{}, {1}, {2, 3, 4}},
            {"with spaces", "", std::string(1000, 'x')}};
}

PartJob job() {
    PartJob job;
    job.surface = test::to_arrays(test::icosphere(1));
    job.part = NodeId(9);
    job.neighbour.assign(job.surface.facets.size(), NodeId::none());
    job.patch_names = {"sphere"};
    job.length_scale = 0.25;
    return job;
}

// Four bytes of it, or of each in an array, would be whatever was in memory.
struct Padded {
    std::int32_t number = 0;
    double value = 0;
    template <class Archive>
    void archive(Archive& a) {
        a(number, value);
    }
    bool operator==(const Padded&) const = default;
};
static_assert(!HasNoPadding<Padded>::value && !HasNoPadding<std::array<Padded, 2>>::value);
static_assert(HasNoPadding<Vec3>::value && HasNoPadding<std::array<Triangle, 2>>::value && HasNoPadding<bool>::value);

TEST(Bytes, HaveNoPadding) {
    const std::vector<Padded> values = {{1, 0.5}, {-2, 1e300}};
    const Bytes bytes = to_bytes(values);
    EXPECT_EQ(bytes.size(), sizeof(std::uint64_t) + 2 * (sizeof(std::int32_t) + sizeof(double)));
    EXPECT_EQ(from_bytes<std::vector<Padded>>(bytes), values);
}

TEST(Bytes, RoundTrip) {
    EXPECT_EQ(from_bytes<Outer>(to_bytes(sample())), sample());
    EXPECT_EQ(from_bytes<Outer>(to_bytes(Outer())), Outer());
    const Bytes bytes = to_bytes(job());
    EXPECT_TRUE(to_bytes(from_bytes<PartJob>(bytes)) == bytes);
    EXPECT_EQ(from_bytes<PartJob>(bytes).patch_names, job().patch_names);
}

TEST(Bytes, EveryShortBufferThrows) {
    const Bytes plain = to_bytes(sample()), large = to_bytes(job());
    for (std::size_t size = 0; size < plain.size(); ++size)
        EXPECT_THROW(from_bytes<Outer>(std::span(plain).first(size)), Error) << size;
    for (std::size_t size = 0; size < large.size(); size += 7)
        EXPECT_THROW(from_bytes<PartJob>(std::span(large).first(size)), Error) << size;
}

TEST(Bytes, DamagedBuffersThrowOrGiveAValue) {
    constexpr unsigned seed = 7;
    std::mt19937 random(seed);
    const Bytes good = to_bytes(sample());
    for (int i = 0; i < 3000; ++i) {
        Bytes bytes = good;
        for (int k = 0; k <= i % 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        try {
            from_bytes<Outer>(bytes);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::internal);
        }
    }
}

TEST(Bytes, HugeCountsThrowBeforeTheyAllocate) {
    for (const std::uint64_t count : {std::uint64_t{9}, ~std::uint64_t{0}, ~std::uint64_t{0} / 8}) {
        EXPECT_THROW(from_bytes<std::vector<double>>(to_bytes(count)), Error);
        EXPECT_THROW(from_bytes<std::string>(to_bytes(count)), Error);
        EXPECT_THROW(from_bytes<std::vector<std::string>>(to_bytes(count)), Error);
    }
}

}  // namespace
}  // namespace kerf

// Needles: facets as long as they like and as thin as doubles allow, divided as straight cuts divide them.
#include "surface/diagnosis/facet_cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <Eigen/Geometry>

namespace kerf {
namespace {

using Corners = std::array<Vec3, 3>;

// A facet of length about 1 at a place about 10 away, and its height over its length.
struct Needle {
    std::mt19937_64 random;
    Corners corners;

    Needle(unsigned seed, double height) : random(seed) {
        std::uniform_real_distribution<double> number(-1, 1);
        const auto direction = [&] { return Vec3(number(random), number(random), number(random)); };
        const Vec3 start = 10 * direction(), along = direction(), across = along.cross(direction()).normalized();
        corners = {start, start + along, start + (0.5 + 0.4 * number(random)) * along + height * across};
    }
};

// Halves the pieces at random points of their longest edges.
std::vector<Corners> divided(const Corners& facet, std::mt19937_64& random) {
    std::uniform_real_distribution<double> part(0.1, 0.9);
    std::vector<Corners> pieces = {facet};
    for (std::size_t i = 0; i < 6; ++i) {
        const Corners t = pieces[i];
        const auto length = [&](int k) { return (t[(k + 1) % 3] - t[k]).norm(); };
        const int k = length(0) > length(1) ? (length(0) > length(2) ? 0 : 2) : (length(1) > length(2) ? 1 : 2);
        const Vec3 a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], middle = a + part(random) * (b - a);
        pieces[i] = {a, middle, c};
        pieces.push_back({middle, b, c});
    }
    return pieces;
}

template <class Body>
void for_needles(Body body) {
    for (const double height : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11})
        for (unsigned seed = 1; seed <= 100; ++seed) {
            SCOPED_TRACE(testing::Message() << "height " << height << ", seed " << seed);
            Needle needle(seed, height);
            body(needle, divided(needle.corners, needle.random), height);
        }
}

TEST(FacetCover, PiecesOfANeedleAreTheNeedle) {
    for_needles([](const Needle& needle, const std::vector<Corners>& pieces, double) {
        EXPECT_TRUE(covers(needle.corners, pieces));
    });
}

TEST(FacetCover, AMissingPieceIsSeen) {
    for_needles([](const Needle& needle, std::vector<Corners> pieces, double height) {
        if (height < 1e-9) return;  // its area is that of its rounding
        const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const Corners& a, const Corners& b) {
            return (a[1] - a[0]).cross(a[2] - a[0]).norm() < (b[1] - b[0]).cross(b[2] - b[0]).norm();
        });
        pieces.erase(largest);
        EXPECT_FALSE(covers(needle.corners, pieces));
    });
}

TEST(FacetCover, ACornerBesideTheFacetIsSeen) {
    for_needles([](const Needle& needle, std::vector<Corners> pieces, double) {
        const Vec3 start = needle.corners[0], along = (needle.corners[1] - start).normalized();
        for (Corners& piece : pieces)
            for (Vec3& p : piece)
                if (p == start) p -= 1e-12 * along;
        EXPECT_FALSE(covers(needle.corners, pieces));
    });
}

}  // namespace
}  // namespace kerf

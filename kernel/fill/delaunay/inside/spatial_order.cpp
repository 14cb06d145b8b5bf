// Hilbert's curve by the recurrence of (Hamilton and Rau-Chaplin 2008, hamilton2008). In each octant the curve enters
// at one corner and leaves at another along an axis; (entry corner, axis) is the state, of which there are 24. The
// octants of a cube are visited in the order of the Gray code, reflected to the entry corner and rotated to the axis.
#include "fill/delaunay/inside/spatial_order.h"

#include <algorithm>
#include <bit>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/box.h"

namespace kerf {

namespace {

constexpr unsigned gray(unsigned i) { return i ^ (i >> 1); }
constexpr unsigned gray_inverse(unsigned g) { return g ^ (g >> 1) ^ (g >> 2); }
constexpr unsigned rotated_left(unsigned bits, unsigned by) { return ((bits << by) | (bits >> (3 - by))) & 7; }

// The corner at which the curve enters the i-th octant of a cube in the standard state, and the axis along which it
// leaves.
constexpr unsigned entry(unsigned i) { return i == 0 ? 0 : gray((i - 1) / 2 * 2); }
constexpr unsigned axis(unsigned i) { return i == 0 ? 0 : std::countr_one(i % 2 == 0 ? i - 1 : i) % 3; }

struct Step {
    std::uint8_t place, next_state;  // place of an octant on the curve, and the state inside of it
};

constexpr Step step_from(unsigned entry_corner, unsigned along, unsigned octant) {
    const unsigned rotation = (along + 1) % 3;
    const unsigned place = gray_inverse(rotated_left(octant ^ entry_corner, (3 - rotation) % 3));
    const unsigned next_entry = entry_corner ^ rotated_left(entry(place), rotation);
    const unsigned next_axis = (along + axis(place) + 1) % 3;
    return {static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(8 * next_axis + next_entry)};
}

constexpr auto steps = [] {
    std::array<std::array<Step, 8>, 24> table{};
    for (unsigned state = 0; state < 24; ++state)
        for (unsigned octant = 0; octant < 8; ++octant) table[state][octant] = step_from(state % 8, state / 8, octant);
    return table;
}();

// The round of a point: 0 for the last and largest one, 1 for the one before, ...
std::uint64_t rounds_to_go(std::uint64_t point) {
    // The finaliser of a 64-bit hash: every bit of the number has a say in the lower bits of the result.
    point = (point + 1) * 0x9e3779b97f4a7c15;
    point = (point ^ (point >> 32)) * 0xd6e8feb86659fd93;
    constexpr std::uint64_t bits_a_round = 3;  // each has 8 times as many points as the one before
    return std::countr_zero((point ^ (point >> 32)) | (1ULL << 45)) / bits_a_round;
}

}  // namespace

std::uint64_t hilbert_code(std::array<std::uint32_t, 3> cell, int bits) {
    std::uint64_t code = 0;
    unsigned state = 0;
    for (int bit = bits - 1; bit >= 0; --bit) {
        const unsigned octant = ((cell[0] >> bit) & 1) | ((cell[1] >> bit) & 1) << 1 | ((cell[2] >> bit) & 1) << 2;
        const Step step = steps[state][octant];
        code = code << 3 | step.place;
        state = step.next_state;
    }
    return code;
}

std::vector<std::int32_t> insertion_order(const std::vector<Vec3>& points) {
    constexpr int bits = 19;
    const Box box = box_around(points);
    const double longest = points.empty() ? 0 : box.sizes().maxCoeff();
    const double scale = longest > 0 ? ((1 << bits) - 1) / longest : 0;
    struct Place {
        std::uint64_t code;
        std::int32_t point;
    };
    std::vector<Place> places;
    places.reserve(points.size());
    for (const Vec3& p : points) {
        const Eigen::Matrix<std::uint32_t, 3, 1> cell = ((p - box.min()) * scale).cast<std::uint32_t>();
        const auto point = count_of(places);
        const std::uint64_t round = 15 - rounds_to_go(places.size());
        places.push_back({round << (3 * bits) | hilbert_code({cell[0], cell[1], cell[2]}, bits), point});
    }
    std::sort(places.begin(), places.end(),
              [](const Place& p, const Place& q) { return p.code != q.code ? p.code < q.code : p.point < q.point; });
    std::vector<std::int32_t> order;
    order.reserve(points.size());
    for (const Place& place : places) order.push_back(place.point);
    return order;
}

}  // namespace kerf

#include "run/run/inside/input_pieces.h"

#include <algorithm>
#include <array>
#include <vector>

#include "surface/diagnosis/facet_cover.h"

namespace kerf {

namespace {

// Whether the pieces are the facet itself, or cover it with new vertices on its edges or inside.
bool are_facet(const Complex& input, const Triangle& t, std::span<const InputPiece> pieces,
               const std::function<Vec3(std::int64_t)>& point_of) {
    if (pieces.size() == 1) return pieces[0].vertices == rotated_to_smallest({t[0], t[1], t[2]});
    std::vector<std::array<Vec3, 3>> corners;
    for (const InputPiece& piece : pieces) {
        const auto& [a, b, c] = piece.vertices;
        corners.push_back({point_of(a), point_of(b), point_of(c)});
    }
    return covers({input.point(t[0]), input.point(t[1]), input.point(t[2])}, corners);
}

}  // namespace

std::int64_t count_missing_sides(const Complex& input, std::int32_t facet, std::span<const InputPiece> pieces,
                                 const std::function<Vec3(std::int64_t)>& point_of) {
    const auto [front, back] = input.sides(facet);
    const Triangle t = input.vertices(facet);
    std::int64_t missing = 0;
    auto foreign = std::ssize(pieces);
    for (const RegionIndex region : {back, front}) {
        if (!region.is_valid()) continue;
        const auto [first, last] =
            std::equal_range(pieces.begin(), pieces.end(), InputPiece{facet, region, 0, {}},
                             [](const InputPiece& a, const InputPiece& b) { return a.region < b.region; });
        foreign -= last - first;
        const Triangle seen = region == back ? t : Triangle{t[0], t[2], t[1]};
        missing += !are_facet(input, seen, {first, last}, point_of);
    }
    return missing + foreign;
}

}  // namespace kerf

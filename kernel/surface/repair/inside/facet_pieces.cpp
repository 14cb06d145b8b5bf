// Side by side: the piece that has a side in full is divided into a fan around its opposite corner.
#include "surface/repair/inside/facet_pieces.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/core/check.h"
#include "base/core/ids.h"

namespace kerf {

namespace {

std::vector<std::int32_t> numbers_of_places(std::size_t count) {
    std::vector<std::int32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

// Puts the fan of the last corner of the piece over its side from the first to the second in place of it.
void divide_piece(std::vector<Triangle>& pieces, std::size_t piece, const std::vector<std::int32_t>& chain) {
    const auto [a, b, apex] = pieces[piece];
    std::vector<Triangle> fan;
    std::int32_t last = a;
    for (const std::int32_t v : chain) {
        fan.push_back({last, v, apex});
        last = v;
    }
    fan.push_back({last, b, apex});
    pieces.erase(pieces.begin() + piece);
    pieces.insert(pieces.begin() + piece, fan.begin(), fan.end());
}

}  // namespace

std::vector<Triangle> pieces_of(const Triangle& facet, const std::array<std::vector<std::int32_t>, 3>& chains) {
    std::vector<Triangle> pieces = {facet};
    for (std::size_t side = 0; side < 3; ++side) {
        const std::vector<std::int32_t>& chain = chains[side];
        if (chain.empty()) continue;
        const std::int32_t a = facet[side], b = facet[(side + 1) % 3];
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            Triangle& t = pieces[p];
            const auto first = std::find(t.begin(), t.end(), a) - t.begin();
            if (first == 3 || t[(first + 1) % 3] != b) continue;
            std::rotate(t.begin(), t.begin() + first, t.end());
            divide_piece(pieces, p, chain);
            break;
        }
    }
    return pieces;
}

void number_vertices(Soup& soup) {
    if (soup.vertex_number.empty()) soup.vertex_number = numbers_of_places(soup.vertices.size());
}

void number_facets(Soup& soup) {
    if (soup.polygon.empty()) soup.polygon = numbers_of_places(soup.facets.size());
}

std::vector<std::int32_t> divide_at(Soup& soup, std::vector<SidePoint> points) {
    KERF_CHECK(soup.sides.empty());
    if (points.empty()) return {};
    std::sort(points.begin(), points.end(), [](const SidePoint& p, const SidePoint& q) {
        return std::tie(p.corner, p.along, p.vertex) < std::tie(q.corner, q.along, q.vertex);
    });
    number_facets(soup);
    std::vector<Triangle> facets;
    std::vector<std::int32_t> patch, polygon, parent;
    facets.reserve(soup.facets.size() + points.size());
    patch.reserve(facets.capacity());
    polygon.reserve(facets.capacity());
    auto point = points.begin();
    for (std::int32_t f = 0; f < count_of(soup.facets); ++f) {
        std::array<std::vector<std::int32_t>, 3> chains;
        const std::int32_t corner = 3 * f;
        for (; point != points.end() && point->corner < corner + 3; ++point)
            chains[point->corner - corner].push_back(point->vertex);
        for (const Triangle& piece : pieces_of(soup.facets[f], chains)) {
            facets.push_back(piece);
            patch.push_back(soup.patch[f]);
            polygon.push_back(soup.polygon[f]);
            parent.push_back(f);
        }
    }
    soup.facets = std::move(facets);
    soup.patch = std::move(patch);
    soup.polygon = std::move(polygon);
    return parent;
}

}  // namespace kerf

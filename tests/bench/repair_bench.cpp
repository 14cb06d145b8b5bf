// What a repair made of a surface, for the benchmark of repairs. tests/bench/repair.py runs it.
//
//     repair_bench INPUT RESULT
//
// Figures are one line of JSON: whether Kerf's check finds nothing wrong with the result, facets, volume and area of
// both (the volume of what is not closed is that which its facets enclose with the middle of their box), the largest
// distances between them at corners, midpoints of edges and centres of facets, those of which a hundredth is larger,
// and how many facets of the input are not in the result with the same corners, in any direction.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/geometry/box.h"
#include "bench/bench.h"
#include "files/io/surface_reader.h"
#include "run/prepare/input.h"
#include "surface/complex/mass_properties.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

using Corners = std::array<std::array<double, 3>, 3>;

Corners corners_of(const Soup& soup, const Triangle& t) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            corners[i][static_cast<std::size_t>(k)] = static_cast<float>(soup.vertices[t[i]][k]);
    std::sort(corners.begin(), corners.end());
    return corners;
}

Soup read(const std::string& path) {
    Soup soup = read_surface(path);
    weld_exactly(soup);
    std::vector<char> drop(soup.facets.size(), 0);
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto& [a, b, c] = soup.facets[f];
        const auto is_finite = [&](std::int32_t v) { return soup.vertices[v].allFinite(); };
        drop[f] = a == b || b == c || c == a || !is_finite(a) || !is_finite(b) || !is_finite(c);
    }
    drop_facets(soup, drop);
    drop_unused_vertices(soup);
    return soup;
}

struct Figures {
    double volume = 0, area = 0, diagonal = 0;
};

Figures figures_of(const Soup& soup) {
    Figures figures;
    const Box box = box_around_finite(soup.vertices);
    figures.diagonal = box.diagonal().norm();
    for (const auto& [a, b, c] : soup.facets) {
        const Vec3 &p = soup.vertices[a], &q = soup.vertices[b], &r = soup.vertices[c];
        figures.area += (q - p).cross(r - p).norm() / 2;
        figures.volume += (p - box.center()).dot((q - box.center()).cross(r - box.center())) / 6;
    }
    return figures;
}

struct Distances {
    double largest = 0, of_hundredth = 0;
};

// From points of the facets of `from` to the other.
Distances distances(const Soup& from, const Soup& to) {
    const TriangleTree tree(to.vertices, to.facets);
    std::vector<double> squared;
    for (const auto& [a, b, c] : from.facets) {
        const Vec3 &p = from.vertices[a], &q = from.vertices[b], &r = from.vertices[c];
        for (const Vec3& x : {Vec3(p), Vec3((p + q) / 2), Vec3((q + r) / 2), Vec3((r + p) / 2), Vec3((p + q + r) / 3)})
            squared.push_back(tree.closest(x).squared_distance);
    }
    if (squared.empty()) return {};
    std::sort(squared.begin(), squared.end());
    return {std::sqrt(squared.back()), std::sqrt(squared[squared.size() - 1 - squared.size() / 100])};
}

std::size_t changed_facets(const Soup& input, const Soup& result) {
    std::vector<Corners> kept;
    for (const Triangle& t : result.facets) kept.push_back(corners_of(result, t));
    std::sort(kept.begin(), kept.end());
    return static_cast<std::size_t>(std::count_if(input.facets.begin(), input.facets.end(), [&](const Triangle& t) {
        return !std::binary_search(kept.begin(), kept.end(), corners_of(input, t));
    }));
}

int run(const std::vector<std::string>& words) {
    if (words.size() != 2) return 2;
    const Soup input = read(words[0]), result = read(words[1]);
    const CheckedSoup checked = check_input(words[1]);
    const Figures before = figures_of(input), after = figures_of(result);
    const Distances there = distances(result, input), back = distances(input, result);
    fmt::print(
        "{{\"passes\": {}, \"facets_before\": {}, \"facets\": {}, \"changed\": {}, \"volume_before\": {}, "
        "\"volume\": {}, \"area_before\": {}, \"area\": {}, \"diagonal\": {}, \"distance\": {}, "
        "\"distance_1\": {}, \"distance_from_input\": {}, \"distance_from_input_1\": {}}}\n",
        checked.diagnosis.clean(), input.facets.size(), result.facets.size(), changed_facets(input, result),
        before.volume, after.volume, before.area, after.area, before.diagonal, there.largest, there.of_hundredth,
        back.largest, back.of_hundredth);
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

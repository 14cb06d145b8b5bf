#include "support/hard_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "support/facet_height.h"
#include "support/faceted_prism.h"
#include "support/hard_bodies.h"
#include "support/shapes.h"
#include "surface/diagnosis/diagnosis.h"

namespace kerf::test {

namespace {

using Polygon = std::vector<Vec2>;

Polygon regular_polygon(int corners, double radius) {
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return polygon;
}

Polygon any_base(SeededNumbers& random) {
    switch (random.integer(0, 3)) {
        case 0:
            return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        case 1:
            return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
        case 2:
            return {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
        default:
            return regular_polygon(random.integer(3, 12), 1);
    }
}

Pattern any_pattern(SeededNumbers& random) { return static_cast<Pattern>(random.integer(0, pattern_count - 1)); }

// Of a prism over a polygon with so many corners that is to have so many facets, half of them in the walls.
PrismStyle any_style(int facets, std::size_t corners, SeededNumbers& random) {
    PrismStyle style;
    const int most_parts = std::max(1, facets / (8 * static_cast<int>(corners)));
    style.edge_parts = random.integer(1, std::min(40, 2 * most_parts));
    style.cap = {.points = facets / 8, .pattern = any_pattern(random), .flips = random.magnitude(0.1, 10)};
    style.cap.least_height = random.magnitude(1e-3, 0.05);
    style.cap.has_star = random.with_chance(0.2);
    style.wall = style.cap;
    style.wall.points = facets / (8 * static_cast<int>(corners));
    style.wall.pattern = any_pattern(random);
    return style;
}

// Two sheets 1e-1 to 1e-6 of an edge apart.
Soup thin(int facets, SeededNumbers& random) {
    const Polygon base = any_base(random);
    PrismStyle style = any_style(facets, base.size(), random);
    style.cap.points = facets / 4;
    style.wall.points = random.integer(0, 1);
    style.height_parts = random.integer(1, 2);
    if (random.with_chance(0.5)) style.roughness = random.between(0, 0.9);
    if (random.with_chance(0.5) && style.cap.pattern == Pattern::near_edges) style.cap.pattern = Pattern::random;
    const double edge = 1 / std::sqrt(1.0 + style.cap.points);
    return faceted_prism(base, edge * random.magnitude(1e-6, 0.1), style, random);
}

// A band of this height along a graph that goes up and down.
Polygon zigzag(int folds, double thickness, SeededNumbers& random) {
    Polygon below, above;
    const double uneven = random.between(0, 0.3);
    for (int k = 0; k <= folds; ++k) {
        const double y = (k % 2) - uneven * random.share();
        below.emplace_back(k / static_cast<double>(folds), y);
        above.emplace_back(k / static_cast<double>(folds), y + thickness);
    }
    below.insert(below.end(), above.rbegin(), above.rend());
    return below;
}

Polygon spiral(int corners, int corners_of_turn, double gap_share) {
    Polygon inner, outer;
    for (int k = 0; k <= corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners_of_turn;
        const double radius = 0.5 + k / static_cast<double>(corners_of_turn);
        const Vec2 direction(std::cos(angle), std::sin(angle));
        inner.emplace_back(radius * direction);
        outer.emplace_back((radius + 1 - gap_share) * direction);
    }
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    return outer;
}

// Layers over each other, joined right and left by turns.
Polygon meander(int layers, double thickness, double gap) {
    Polygon right_hand, left_hand;  // of the way through all layers
    for (int k = 0; k < layers; ++k) {
        const double low = k * (thickness + gap), high = low + thickness;
        const bool is_last = k == layers - 1;
        if (k % 2 == 0) {
            right_hand.insert(right_hand.end(), {{k == 0 ? 0 : thickness, low}, {1, low}});
            left_hand.insert(left_hand.end(), {{0, high}, {is_last ? 1 : 1 - thickness, high}});
        } else {
            right_hand.insert(right_hand.end(), {{1, high}, {is_last ? 0 : thickness, high}});
            left_hand.insert(left_hand.end(), {{1 - thickness, low}, {0, low}});
        }
    }
    right_hand.insert(right_hand.end(), left_hand.rbegin(), left_hand.rend());
    return right_hand;
}

Soup folded(int facets, SeededNumbers& random) {
    const int corners = std::clamp(facets / 12, 4, 60);
    const int corners_of_turn = random.integer(3, 9);
    const double narrow = random.magnitude(1e-6, 0.1);
    Polygon polygon;
    switch (random.integer(0, 2)) {
        case 0:
            polygon = zigzag(corners / 2, narrow, random);
            break;
        case 1:
            polygon = spiral(corners / 2, corners_of_turn, random.with_chance(0.5) ? narrow : 1 - narrow);
            break;
        default:
            polygon = meander(std::max(2, corners / 4), narrow, random.magnitude(1e-6, 0.1));
    }
    PrismStyle style = any_style(facets, polygon.size(), random);
    style.cap.least_height = 1e-9;
    style.cap.points = 0;
    style.edge_parts = random.integer(1, 3);
    style.height_parts = random.integer(1, 3);
    return faceted_prism(polygon, random.magnitude(0.05, 5), style, random);
}

Soup coplanar(int facets, SeededNumbers& random) {
    const Polygon base = any_base(random);
    PrismStyle style = any_style(facets, base.size(), random);
    style.height_parts = style.edge_parts;
    if (random.with_chance(0.5)) style.cap.pattern = style.wall.pattern = Pattern::grid;
    return faceted_prism(base, random.magnitude(0.2, 3), style, random);
}

// Triangles of a height of 1e-2 to 1e-6 of their edges.
Soup needles(int facets, SeededNumbers& random) {
    const double thin = random.magnitude(1e-6, 1e-2);
    switch (random.integer(0, 3)) {
        case 0: {
            const Polygon base = any_base(random);
            PrismStyle style = any_style(facets, base.size(), random);
            style.cap.pattern = style.wall.pattern = Pattern::near_edges;
            style.cap.least_height = style.wall.least_height = thin / 10;
            return faceted_prism(base, random.magnitude(0.2, 3), style, random);
        }
        case 1: {  // a fan from a far point
            const int corners = std::clamp(facets / 3, 3, 300);
            return pyramid(regular_polygon(corners, 1), 1 / thin, random.with_chance(0.5) ? 1 / thin : 0.1, random);
        }
        case 2: {
            const int corners = std::clamp(facets / 6, 3, 100);
            PrismStyle style = any_style(facets, 3, random);
            style.edge_parts = 1;
            style.cap.points = 0;
            style.wall.points = random.integer(0, 2);
            style.cap.least_height = style.wall.least_height = 1e-9;
            return faceted_prism(regular_polygon(corners, 1), 1 / thin, style, random);
        }
        default:
            return squashed(smooth_body(facets, random), thin, random);
    }
}

constexpr std::array<HardFamily, 11> families = {{{"thin", thin},
                                                  {"folded", folded},
                                                  {"nested", nested},
                                                  {"touching", touching},
                                                  {"spikes", spikes},
                                                  {"coplanar", coplanar},
                                                  {"grid", grid},
                                                  {"cospherical", cospherical},
                                                  {"needles", needles},
                                                  {"reflex", reflex},
                                                  {"woven", woven}}};

void move_anywhere(Soup& soup, SeededNumbers& random) {
    const Vec3 axis{random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1)};
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(random.between(0, 3), axis.normalized()));
    const bool is_turned = random.with_chance(0.6);
    const double scale = random.with_chance(0.5) ? 1 : random.magnitude(1e-3, 1e3);
    const Vec3 offset = random.with_chance(0.6) ? Vec3(0, 0, 0) : Vec3(random.magnitude(0.1, 10) * axis);
    for (Vec3& p : soup.vertices) p = scale * ((is_turned ? Vec3(rotation * p) : p) + offset);
}

// Rounding makes needles of corners on one line that are lower by far.
constexpr double least_height = 1e-8;

bool is_valid(const Soup& soup) {
    if (least_relative_height(soup.vertices, soup.facets) < least_height) return false;
    const Diagnosis diagnosis = diagnose(soup);
    const auto is_harmless = [](const Defect& defect) { return defect.severity == Severity::warning; };
    return std::all_of(diagnosis.defects.begin(), diagnosis.defects.end(), is_harmless);
}

}  // namespace

std::span<const HardFamily> hard_families() { return families; }

std::size_t hard_family_number(const std::string& name) {
    std::string names;
    for (std::size_t i = 0; i < families.size(); ++i) {
        if (families[i].name == name) return i;
        names += (i == 0 ? "" : ", ") + std::string(families[i].name);
    }
    throw Error(ErrorCode::usage, fmt::format("There is no family \"{}\" of surfaces, but: {}.", name, names));
}

std::optional<HardSurface> hard_surface(std::uint64_t seed, int most_facets) {
    constexpr int most_tries = 10;
    SeededNumbers random(seed);
    const HardFamily& family = families[seed % families.size()];
    for (int tries = 0; tries < most_tries; ++tries) {
        Soup soup = family.make(static_cast<int>(random.magnitude(20, most_facets)), random);
        move_anywhere(soup, random);
        if (is_valid(soup)) return HardSurface{family.name, to_arrays(soup)};
    }
    return std::nullopt;
}

}  // namespace kerf::test

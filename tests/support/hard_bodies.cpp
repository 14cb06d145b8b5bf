#include "support/hard_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "support/edge_flips.h"
#include "support/faceted_prism.h"
#include "support/notched_box.h"
#include "support/random_cubes.h"
#include "support/shapes.h"

namespace kerf::test {

namespace {

PrismStyle any_box_style(int facets, SeededNumbers& random) {
    PrismStyle style;
    style.cap = {.points = facets / 24,
                 .pattern = static_cast<Pattern>(random.integer(0, pattern_count - 1)),
                 .least_height = 1e-3,
                 .flips = random.magnitude(0.1, 10),
                 .has_star = random.with_chance(0.2)};
    style.wall = style.cap;
    style.edge_parts = style.height_parts = random.integer(1, std::clamp(facets / 20, 1, 12));
    return style;
}

// Voids in a block, with walls of this thickness around them.
Soup cells(int facets, double wall, SeededNumbers& random) {
    const int most = std::max(1, facets / 30);
    std::array<int, 3> n = {};
    n[0] = random.integer(1, std::min(8, most));
    n[1] = random.integer(1, std::max(1, std::min(8, most / n[0])));
    n[2] = random.integer(1, std::max(1, std::min(8, most / (n[0] * n[1]))));
    const int each = facets / (n[0] * n[1] * n[2] + 1);
    Soup soup =
        faceted_box(Vec3::Zero(), Vec3(n[0] + wall, n[1] + wall, n[2] + wall), any_box_style(each, random), random);
    for (int i = 0; i < n[0]; ++i)
        for (int j = 0; j < n[1]; ++j)
            for (int k = 0; k < n[2]; ++k) {
                const Vec3 low(i, j, k);
                soup = join(std::move(soup), inside_out(faceted_box(low + Vec3::Constant(wall), low + Vec3::Ones(),
                                                                    any_box_style(each, random), random)));
            }
    return soup;
}

// Seen from the origin, every facet from inside.
Soup star_body(int facets, double least_radius, SeededNumbers& random) {
    Soup soup = smooth_body(facets, random);
    if (soup.patch_names[0] == "torus") soup = icosphere(facets < 320 ? 1 : 2);
    const bool is_wrinkled = random.with_chance(0.5);
    const double folds = random.integer(2, 12), swirl = random.between(-8, 8);
    for (Vec3& p : soup.vertices) {
        const double wave = 0.5 + 0.5 * std::cos(folds * std::atan2(p[1], p[0]) + swirl * p[2]);
        p *= is_wrinkled ? least_radius + (1 - least_radius) * wave : random.magnitude(least_radius, 1);
    }
    return soup;
}

// Facets upwards at this height.
std::vector<Triangle> facets_at_height(const Soup& soup, double z) {
    std::vector<Triangle> found;
    for (const Triangle& t : soup.facets)
        if (std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return soup.vertices[v][2] == z; }))
            found.push_back(t);
    return found;
}

// A pyramid or wedge below the origin, which its tip or the middle of its edge touches.
Soup tip(double size, SeededNumbers& random) {
    const double height = size * random.between(0.2, 3);
    Soup soup;
    if (random.with_chance(0.5)) {
        std::vector<Vec2> polygon;
        const int corners = random.integer(3, 7);
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.3) / corners;
            polygon.emplace_back(size * std::cos(angle), size * std::sin(angle));
        }
        soup = pyramid(polygon, height, 0, random);
        for (Vec3& p : soup.vertices) p[2] -= height;
    } else {
        PrismStyle style;
        style.cap.points = style.wall.points = random.integer(0, 3);
        style.height_parts = random.integer(1, 3);
        const double half = size * random.between(0.05, 0.7);
        soup = faceted_prism({{0, 0}, {-half, -height}, {half, -height}}, size, style, random);
        const Eigen::AngleAxisd turn(random.between(0, 3), Vec3::UnitZ());
        for (Vec3& p : soup.vertices) p = turn * Vec3(p[0], size / 2 - p[2], p[1]);
    }
    return soup;
}

// The middle of a facet, of an edge, or a corner.
Vec3 place_in(const Soup& soup, const Triangle& t, SeededNumbers& random) {
    const auto p = [&](int i) -> const Vec3& { return soup.vertices[t[i]]; };
    switch (random.integer(0, 2)) {
        case 0:
            return (p(0) + p(1) + p(2)) / 3;
        case 1:
            return (p(0) + p(1)) / 2;
        default:
            return p(2);
    }
}

std::vector<Vec2> star_polygon(int teeth, double inner_radius, bool is_gear) {
    std::vector<Vec2> polygon;
    const int each = is_gear ? 4 : 2;
    for (int i = 0; i < each * teeth; ++i) {
        const double angle = 2 * std::numbers::pi * i / (each * teeth);
        const double radius = i % each < each / 2 ? 1 : inner_radius;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return polygon;
}

// A tube of regular cross sections around points, closed at both ends by fans.
Soup tube(const std::vector<Vec3>& centres, int corners, double radius, double turn) {
    Soup soup;
    const auto count = static_cast<std::int32_t>(centres.size());
    for (std::int32_t k = 0; k < count; ++k) {
        const Vec3 along = (centres[std::min(k + 1, count - 1)] - centres[std::max(k - 1, 0)]).normalized();
        const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
        for (int j = 0; j < corners; ++j) {
            const double angle = turn + 2 * std::numbers::pi * j / corners;
            soup.vertices.emplace_back(centres[k] + radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
    }
    const std::int32_t first = count * corners, last = first + 1;
    soup.vertices.push_back(centres.front());
    soup.vertices.push_back(centres.back());
    for (std::int32_t j = 0; j < corners; ++j) {
        const std::int32_t next = (j + 1) % corners;
        for (std::int32_t k = 0; k + 1 < count; ++k) {
            const std::int32_t a = k * corners + j, b = k * corners + next;
            soup.facets.insert(soup.facets.end(), {{a, b, b + corners}, {a, b + corners, a + corners}});
        }
        soup.facets.push_back({first, next, j});
        soup.facets.push_back({last, (count - 1) * corners + j, (count - 1) * corners + next});
    }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"tube"};
    return soup;
}

// Threads in a plane, over and under each other, this far apart.
Soup weave(int facets, double gap, SeededNumbers& random) {
    const int corners = random.integer(3, 6), steps = random.integer(2, 4);
    const double radius = random.between(0.08, 0.2), amplitude = radius + gap / 2;
    const double of_crossing = 2.0 * 2 * corners * steps;
    const int threads = std::clamp(static_cast<int>(std::sqrt(facets / of_crossing)), 1, 6);
    Soup soup;
    for (int direction = 0; direction < 2; ++direction)
        for (int i = 0; i < threads; ++i) {
            std::vector<Vec3> centres;
            for (int k = -steps / 2; k <= threads * steps - steps / 2; ++k) {
                const double x = k / static_cast<double>(steps);
                const double z = amplitude * std::cos(std::numbers::pi * (x + i + direction));
                centres.push_back(direction == 0 ? Vec3(x, i, z) : Vec3(i, x, z));
            }
            const Soup thread = tube(centres, corners, radius, random.between(0, 1));
            soup = soup.facets.empty() ? thread : join(std::move(soup), thread);
        }
    return soup;
}

}  // namespace

Soup smooth_body(int facets, SeededNumbers& random) {
    const int around = std::clamp(static_cast<int>(std::sqrt(facets / 2.0) * random.between(0.5, 2)), 3, 60);
    const int rings = std::max(3, facets / (2 * around));
    switch (random.integer(0, 2)) {
        case 0: {
            int levels = 0;
            while (20 << 2 * (levels + 1) <= facets) ++levels;
            return icosphere(levels);
        }
        case 1:
            return uv_sphere(rings + 1, around);
        default:
            return torus(1, random.between(0.05, 0.9), std::max(3, rings), around);
    }
}

Soup squashed(Soup soup, double factor, SeededNumbers& random) {
    Vec3 direction{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    if (random.with_chance(0.5)) direction = Vec3::UnitZ();
    direction.normalize();
    for (Vec3& p : soup.vertices) p -= (1 - factor) * p.dot(direction) * direction;
    return soup;
}

Soup pyramid(const std::vector<Vec2>& polygon, double height, double depth, SeededNumbers& random) {
    Soup soup;
    const auto n = static_cast<std::int32_t>(polygon.size());
    for (const Vec2& p : polygon) soup.vertices.emplace_back(p[0], p[1], 0);
    soup.vertices.emplace_back(0, 0, height);
    if (depth != 0) soup.vertices.emplace_back(0, 0, -depth);
    for (std::int32_t i = 0; i < n; ++i) {
        soup.facets.push_back({i, (i + 1) % n, n});
        if (depth != 0) soup.facets.push_back({(i + 1) % n, i, n + 1});
    }
    const auto start = static_cast<std::int32_t>(random.bits() % static_cast<std::uint64_t>(n));
    for (std::int32_t i = 1; depth == 0 && i + 1 < n; ++i)
        soup.facets.push_back({start, (start + i + 1) % n, (start + i) % n});
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"pyramid"};
    return soup;
}

// Voids close to the shell around them, bodies in voids, and walls between voids.
Soup nested(int facets, SeededNumbers& random) {
    const double distance = random.magnitude(1e-6, 0.1);
    const int kind = random.integer(0, 2);
    if (kind == 0) return cells(facets, distance, random);
    const int shells = random.integer(2, std::clamp(facets / 20, 2, 4));
    Soup soup;
    const Soup star = star_body(facets / shells, random.magnitude(0.05, 1), random);
    for (int k = 0; k < shells; ++k) {
        Soup shell = star;
        if (kind == 1) {
            const Vec3 half = Vec3::Constant(1 - 2 * k * distance);
            shell = faceted_box(-half, half, any_box_style(facets / shells, random), random);
        } else {
            for (Vec3& p : shell.vertices) p *= 1 - k * distance;
        }
        if (k % 2 == 1) shell = inside_out(std::move(shell));
        soup = k == 0 ? std::move(shell) : join(std::move(soup), shell);
    }
    return soup;
}

// Tips and edges over or under the facets of a box, outside of it or as voids.
Soup touching(int facets, SeededNumbers& random) {
    Soup soup = faceted_box(Vec3::Zero(), Vec3(1, 1, 0.5), any_box_style(facets, random), random);
    const std::vector<Triangle> above = facets_at_height(soup, 0.5);
    std::vector<Vec3> places;
    for (int tries = 8 * random.integer(1, std::clamp(facets / 40, 1, 6)); tries > 0 && !above.empty(); --tries) {
        const double size = random.magnitude(0.02, 0.15);
        const Vec3 place = place_in(soup, above[random.bits() % above.size()], random);
        const auto is_near = [&](const Vec3& other) { return (other - place).norm() < 0.35; };
        const bool is_void = random.with_chance(0.5);
        const bool is_inside = place[0] > 0.16 && place[0] < 0.84 && place[1] > 0.16 && place[1] < 0.84;
        if ((is_void && !is_inside) || std::any_of(places.begin(), places.end(), is_near)) continue;
        places.push_back(place);
        Soup body = tip(size, random);
        const Vec3 offset(0, 0, random.magnitude(1e-6, 0.1) * size);
        if (is_void) body = inside_out(std::move(body));
        for (Vec3& p : body.vertices)
            p = is_void ? Vec3(place - offset + p) : Vec3(place + offset + Vec3(p[0], -p[1], -p[2]));
        soup = join(std::move(soup), body);
    }
    return soup;
}

// Points far out of their neighbours' plane, up to points of the other side.
Soup spikes(int facets, SeededNumbers& random) {
    if (random.with_chance(0.4)) return star_body(facets, random.magnitude(1e-3, 0.5), random);
    PrismStyle style = any_box_style(facets, random);
    style.cap.points = facets / 5;
    style.wall.points = facets / 50;
    style.roughness = 0.99;
    style.least_gap = random.magnitude(1e-6, 1e-3);
    return faceted_box(Vec3::Zero(), Vec3(1, 1, random.magnitude(0.05, 5)), style, random);
}

Soup reflex(int facets, SeededNumbers& random) {
    PrismStyle style = any_box_style(facets, random);
    style.cap.points = style.wall.points = 0;
    style.edge_parts = style.height_parts = 1;
    const double height = random.magnitude(0.1, 10);
    switch (random.integer(0, 3)) {
        case 0: {
            const int notches = std::clamp(facets / 24, 1, 40);
            const double gap = random.magnitude(1e-6, 1);
            return notched_box(notches, gap, random.magnitude(1e-3, 0.4), random);
        }
        case 1: {
            const int corners = std::clamp(facets / 6, 3, 60);
            const int sides = random.with_chance(0.5) ? 3 : corners;
            style.twist = random.between(-1, 1) * std::numbers::pi / sides;
            return faceted_prism(star_polygon(corners, 1, false), height, style, random);
        }
        default: {
            const bool is_gear = random.with_chance(0.5);
            const int teeth = std::clamp(facets / (is_gear ? 16 : 8), 3, 60);
            style.twist = random.with_chance(0.3) ? 0 : random.between(-1, 1) * std::numbers::pi / (2 * teeth);
            return faceted_prism(star_polygon(teeth, random.between(0.1, 0.9), is_gear), height, style, random);
        }
    }
}

// Unit cubes with random diagonals.
Soup grid(int facets, SeededNumbers& random) {
    const int edge = std::clamp(static_cast<int>(std::sqrt(facets / 12.0)), 1, 9);
    Soup cubes = random_cubes(edge, random.between(0.2, 0.9), random);
    return with_flips(std::move(cubes), random.magnitude(0.1, 10), random);
}

Soup cospherical(int facets, SeededNumbers& random) {
    const int around = std::clamp(static_cast<int>(std::sqrt(facets / 2.0)), 3, 40);
    Soup soup;
    switch (random.integer(0, 6)) {
        case 0:
            soup = box(Vec3::Zero(), Vec3::Ones(), std::max(1, static_cast<int>(std::sqrt(facets / 12.0))));
            break;
        case 1:
            soup = prism(std::clamp(facets / 4, 3, 200), 1, random.magnitude(0.1, 10));
            break;
        case 2:
            soup = twisted_cylinder(around, std::max(1, facets / (2 * around) - 1), 1, 2, random.between(0, 0.5));
            break;
        case 3:
            soup = plate_with_hole(4 * std::clamp(facets / 16, 1, 60));
            break;
        case 4: {
            const int cubes = std::clamp(facets / 160, 1, 4);
            soup = block_with_cavities({cubes, 1, 1});
            break;
        }
        default:
            soup = smooth_body(facets, random);
    }
    return with_flips(std::move(soup), random.magnitude(0.1, 10), random);
}

// Threads and rings that pass each other closely.
Soup woven(int facets, SeededNumbers& random) {
    const double gap = random.magnitude(1e-4, 0.1);
    if (random.with_chance(0.6)) return weave(facets, gap, random);
    if (random.with_chance(0.3)) return porous_frame(facets < 400 ? 1 : 2, 1);
    const int rings = std::clamp(facets / 60, 2, 5), around = random.integer(3, 6);
    return linked_rings(rings, std::clamp(facets / (2 * rings * around), 8, 40), around);
}

}  // namespace kerf::test

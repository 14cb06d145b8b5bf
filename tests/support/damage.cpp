// New vertices are placed within a hundredth of an edge of their place, so that the rest of the surface is out of
// reach.
#include "support/damage.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/geometry/predicates.h"
#include "support/shapes.h"
#include "surface/diagnosis/intersections.h"

namespace kerf::test {

namespace {

constexpr double small = 0.01;  // of an edge

std::int32_t below(std::mt19937& random, std::size_t end) { return static_cast<std::int32_t>(random() % end); }

std::int32_t add_vertex(Soup& soup, const Vec3& p) {
    soup.vertices.push_back(p);
    return static_cast<std::int32_t>(soup.vertices.size()) - 1;
}

void add_facet(Soup& soup, const Triangle& facet) {
    insert_facet(soup, static_cast<std::int32_t>(soup.facets.size()), facet);
}

// A tetrahedron of vertices that are there; normals point out of it.
void add_tetrahedron(Soup& soup, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    const auto& p = soup.vertices;
    if (orientation(p[a], p[b], p[c], p[d]) < 0) std::swap(c, d);
    for (const Triangle& t : {Triangle{a, c, b}, Triangle{a, b, d}, Triangle{a, d, c}, Triangle{b, c, d}})
        add_facet(soup, t);
}

Vec3 unit_normal(const Soup& soup, std::int32_t facet) {
    const auto& [a, b, c] = soup.facets[facet];
    return (soup.vertices[b] - soup.vertices[a]).cross(soup.vertices[c] - soup.vertices[a]).normalized();
}

// The mean normal of facets if it looks away from all of them, else zero.
Vec3 common_normal(const Soup& soup, const std::vector<std::int32_t>& facets) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t f : facets) sum += unit_normal(soup, f);
    sum.normalize();
    const bool away =
        std::all_of(facets.begin(), facets.end(), [&](std::int32_t f) { return sum.dot(unit_normal(soup, f)) > 0.5; });
    return away ? sum : Vec3::Zero();
}

double extent(const Soup& soup) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : soup.vertices) box.extend(p);
    return box.diagonal().norm();
}

Vec3 random_direction(std::mt19937& random) {
    const auto coordinate = [&] { return static_cast<double>(random()) / random.max() - 0.5; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return Vec3(x, y, z).normalized();
}

// A loop as the check lists it: from its lowest vertex, in the direction of the facets that would close it.
ExpectedDefect open_loop(const Soup& soup, std::vector<std::int32_t> rim) {
    std::rotate(rim.begin(), std::min_element(rim.begin(), rim.end()), rim.end());
    ExpectedDefect loop{DefectKind::open_edge, Severity::error, {}, rim};
    for (std::size_t i = 0; i < rim.size(); ++i)
        loop.facets.push_back(facets_with(soup, {rim[i], rim[(i + 1) % rim.size()]}).at(0));
    return loop;
}

Damaged missing_facet(Soup soup, std::mt19937& random) {
    const std::int32_t facet = below(random, soup.facets.size());
    const Triangle t = soup.facets[facet];
    remove_facet(soup, facet);
    return {soup, {open_loop(soup, {t.begin(), t.end()})}};
}

// The rim is the chain of the sides opposite to the vertex.
Damaged missing_fan(Soup soup, std::mt19937& random) {
    const std::int32_t hub = below(random, soup.vertices.size());
    std::vector<std::pair<std::int32_t, std::int32_t>> sides;
    const std::vector<std::int32_t> fan = facets_with(soup, {hub});
    for (auto f = fan.rbegin(); f != fan.rend(); ++f) {
        Triangle t = soup.facets[*f];
        std::rotate(t.begin(), std::find(t.begin(), t.end(), hub), t.end());
        sides.emplace_back(t[1], t[2]);
        remove_facet(soup, *f);
    }
    std::vector<std::int32_t> rim = {sides.front().first};
    while (rim.size() < sides.size())
        rim.push_back(std::find_if(sides.begin(), sides.end(), [&](auto& s) { return s.first == rim.back(); })->second);
    return {soup, {open_loop(soup, rim)}};
}

Damaged at_vertex(Soup soup, std::mt19937& random, double coordinate, DefectKind kind, bool names_facets) {
    const std::int32_t v = below(random, soup.vertices.size());
    soup.vertices[v][below(random, 3)] = coordinate;
    const std::vector<std::int32_t> facets = names_facets ? facets_with(soup, {v}) : std::vector<std::int32_t>();
    return {soup, {{kind, Severity::error, facets, {v}}}};
}

Damaged not_a_number(Soup soup, std::mt19937& random) {
    return at_vertex(std::move(soup), random, std::numeric_limits<double>::quiet_NaN(), DefectKind::non_finite, true);
}

Damaged infinite(Soup soup, std::mt19937& random) {
    return at_vertex(std::move(soup), random, -std::numeric_limits<double>::infinity(), DefectKind::non_finite, true);
}

Damaged absurd(Soup soup, std::mt19937& random) {
    return at_vertex(std::move(soup), random, -1e60, DefectKind::absurd_magnitude, false);
}

Damaged repeated_vertex(Soup soup, std::mt19937& random) {
    const Triangle& t = soup.facets[below(random, soup.facets.size())];
    Triangle flat = {t[0], t[0], random() % 3 ? t[1] : t[0]};
    std::shuffle(flat.begin(), flat.end(), random);
    const std::int32_t place = below(random, soup.facets.size() + 1);
    insert_facet(soup, place, flat);
    return {soup, {{DefectKind::degenerate_facet, Severity::repaired, {place}, {flat.begin(), flat.end()}}}};
}

// A facet is halved at the middle of a side, and a facet without area closes the gap to the neighbour at that side,
// which then lies upon the two new sides.
Damaged collinear_corners(Soup soup, std::mt19937& random) {
    const std::int32_t facet = below(random, soup.facets.size());
    const auto [a, b, c] = soup.facets[facet];
    std::vector<std::int32_t> at_side = facets_with(soup, {a, b});
    at_side.erase(std::find(at_side.begin(), at_side.end(), facet));
    const std::int32_t neighbour = at_side.at(0), middle = add_vertex(soup, (soup.vertices[a] + soup.vertices[b]) / 2);
    const auto half = static_cast<std::int32_t>(soup.facets.size()), flat = half + 1;
    soup.facets[facet] = {a, middle, c};
    add_facet(soup, {middle, b, c});
    add_facet(soup, {a, b, middle});
    std::vector<ExpectedDefect> expected = {{DefectKind::degenerate_facet, Severity::error, {flat}, {a, b, middle}}};
    for (const auto& [f, g] : {std::minmax({facet, neighbour}), std::minmax({half, neighbour})}) {
        const Triangle &s = soup.facets[f], &t = soup.facets[g];
        expected.push_back(
            {DefectKind::self_intersection, Severity::error, {f, g}, {s[0], s[1], s[2], t[0], t[1], t[2]}});
    }
    return {soup, expected};
}

// True if both have the same three vertices in the same direction.
bool same_direction(Triangle s, Triangle t) {
    std::rotate(s.begin(), std::min_element(s.begin(), s.end()), s.end());
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return s == t;
}

// The first of the two stays; if that is a turned copy, it is turned back.
Damaged duplicate(Soup soup, std::mt19937& random) {
    const std::int32_t facet = below(random, soup.facets.size()), place = below(random, soup.facets.size() + 1);
    const Triangle original = soup.facets[facet];
    Triangle copy = original;
    std::shuffle(copy.begin(), copy.end(), random);
    insert_facet(soup, place, copy);
    const auto [first, last] = std::minmax({facet + (place <= facet), place});
    const Triangle& t = soup.facets[first];
    Damaged damaged{soup, {{DefectKind::duplicate_facet, Severity::repaired, {first, last}, {t.begin(), t.end()}}}};
    if (!same_direction(t, original))
        damaged.expected.push_back({DefectKind::inconsistent_orientation, Severity::repaired, {first}, {}});
    return damaged;
}

// A facet and its copy that nothing else hangs on: a body without a volume.
Damaged flat_pocket(Soup soup, std::mt19937& random) {
    const Triangle around = soup.facets[below(random, soup.facets.size())];
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i)
        t[i] = add_vertex(soup, soup.vertices[around[i]] + Vec3::Constant(9 * extent(soup)));
    const auto first = static_cast<std::int32_t>(soup.facets.size());
    add_facet(soup, t);
    add_facet(soup, {t[1], t[0], t[2]});
    return {soup, {{DefectKind::duplicate_facet, Severity::repaired, {first, first + 1}, {t.begin(), t.end()}}}};
}

Damaged coincident_shell(Soup soup, std::mt19937& random) {
    const auto facet = static_cast<std::int32_t>(soup.facets.size());
    soup = join(soup, icosphere(0, 1, Vec3::Constant(10 * extent(soup))));
    std::vector<Triangle> copies(soup.facets.begin() + facet, soup.facets.end());
    for (Triangle& t : copies) std::shuffle(t.begin(), t.end(), random);
    for (const Triangle& t : copies) add_facet(soup, t);
    std::vector<std::int32_t> all(2 * copies.size());
    std::iota(all.begin(), all.end(), facet);
    return {soup, {{DefectKind::coincident_shell, Severity::error, all, {}}}};
}

// A thin tetrahedron stands on an edge.
Damaged tetrahedron_on_edge(Soup soup, std::mt19937& random) {
    while (true) {
        const Triangle& t = soup.facets[below(random, soup.facets.size())];
        const std::int32_t a = std::min(t[0], t[1]), b = std::max(t[0], t[1]);
        const Vec3 up = common_normal(soup, facets_with(soup, {a, b}));
        if (up.isZero()) continue;
        const Vec3 along = soup.vertices[b] - soup.vertices[a], middle = (soup.vertices[a] + soup.vertices[b]) / 2;
        const Vec3 aside = 0.2 * along.normalized().cross(up);
        const std::int32_t c = add_vertex(soup, middle + small * along.norm() * (up + aside));
        const std::int32_t d = add_vertex(soup, middle + small * along.norm() * (up - aside));
        add_tetrahedron(soup, a, b, c, d);
        return {soup, {{DefectKind::non_manifold_edge, Severity::error, facets_with(soup, {a, b}), {a, b}}}};
    }
}

// A small tetrahedron stands on a vertex.
Damaged tetrahedron_on_vertex(Soup soup, std::mt19937& random) {
    while (true) {
        const std::int32_t v = below(random, soup.vertices.size());
        const std::vector<std::int32_t> fan = facets_with(soup, {v});
        const Vec3 up = common_normal(soup, fan), p = soup.vertices[v];
        if (up.isZero()) continue;
        double edge = std::numeric_limits<double>::infinity();
        for (const std::int32_t f : fan)
            for (const std::int32_t u : soup.facets[f])
                if (u != v) edge = std::min(edge, (soup.vertices[u] - p).norm());
        const Vec3 x = up.unitOrthogonal(), y = up.cross(x);
        std::array<std::int32_t, 3> top;
        for (std::size_t i = 0; i < 3; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 3;
            top[i] = add_vertex(soup, p + small * edge * (up + 0.2 * (std::cos(angle) * x + std::sin(angle) * y)));
        }
        add_tetrahedron(soup, v, top[0], top[1], top[2]);
        return {soup, {{DefectKind::non_manifold_vertex, Severity::error, facets_with(soup, {v}), {v}}}};
    }
}

Damaged turned_facets(Soup soup, std::mt19937& random) {
    std::vector<std::int32_t> turned;  // less than half of any shell
    for (std::size_t count = 1 + random() % 5; turned.size() < std::min(count, soup.facets.size() / 20 + 1);) {
        const std::int32_t f = below(random, soup.facets.size());
        if (std::find(turned.begin(), turned.end(), f) == turned.end()) turned.push_back(f);
    }
    std::sort(turned.begin(), turned.end());
    for (const std::int32_t f : turned) std::swap(soup.facets[f][0], soup.facets[f][2]);
    return {soup, {{DefectKind::inconsistent_orientation, Severity::repaired, turned, {}}}};
}

Damaged inverted(Soup soup, std::mt19937&) {
    const auto first = static_cast<std::int32_t>(soup.facets.size());
    soup = join(soup, inside_out(icosphere(1, 1, Vec3::Constant(20 * extent(soup)))));
    const Triangle& t = soup.facets[first];
    return {soup, {{DefectKind::inverted_shell, Severity::repaired, {first}, {t.begin(), t.end()}}}};
}

// Below the middle of a facet.
Damaged second_body_inside(Soup soup, std::mt19937& random) {
    const std::int32_t facet = below(random, soup.facets.size());
    const auto& [a, b, c] = soup.facets[facet];
    const auto& p = soup.vertices;
    const double edge = std::min({(p[a] - p[b]).norm(), (p[b] - p[c]).norm(), (p[c] - p[a]).norm()});
    const Vec3 centre = (p[a] + p[b] + p[c]) / 3 - small * edge * unit_normal(soup, facet);
    const auto first = static_cast<std::int32_t>(soup.facets.size());
    const std::int32_t patch = soup.patch[facet];  // a name of its own would make it a region
    soup = join(std::move(soup), icosphere(0, 0.3 * small * edge, centre));
    std::fill(soup.patch.begin() + first, soup.patch.end(), patch);
    const Triangle& t = soup.facets[first];
    return {soup, {{DefectKind::ambiguous_shell, Severity::error, {first}, {t.begin(), t.end()}}}};
}

Damaged overlapping_bodies(Soup soup, std::mt19937& random) {
    const Vec3 shift = 0.02 * extent(soup) * random_direction(random);
    soup = join(soup, translated(soup, shift));
    return {soup, intersecting_pairs(soup)};
}

Damaged pushed_through_vertex(Soup soup, std::mt19937& random) {
    const double size = extent(soup);
    while (true) {
        Vec3& p = soup.vertices[below(random, soup.vertices.size())];
        const Vec3 place = p;
        p += 0.8 * size * random_direction(random);
        const std::vector<ExpectedDefect> pairs = intersecting_pairs(soup);
        if (!pairs.empty()) return {soup, pairs};
        p = place;
    }
}

// A facet is divided at a point near the middle of a side.
Damaged needle(Soup soup, std::mt19937& random) {
    const std::int32_t facet = below(random, soup.facets.size());
    const auto [a, b, c] = soup.facets[facet];
    const auto& p = soup.vertices;
    const std::int32_t v = add_vertex(soup, (p[a] + p[b]) / 2 * (1 - 1e-4) + p[c] * 1e-4);
    soup.facets[facet] = {a, b, v};
    add_facet(soup, {b, c, v});
    add_facet(soup, {c, a, v});
    return {soup, {{DefectKind::needle, Severity::warning, {facet}, {a, b, v}}}};
}

// Two facets are said to be one face of the file, and not a plane one.
Damaged unfit_polygon(Soup soup, std::mt19937& random) {
    const std::int32_t facet = below(random, soup.facets.size() - 1);
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(soup.facets.size()); ++f)
        soup.polygon.push_back(f - (f > facet));
    soup.unfit_polygons = {facet};
    const Triangle& t = soup.facets[facet];
    return {soup, {{DefectKind::unfit_polygon, Severity::error, {facet}, {t.begin(), t.end()}}}};
}

std::string line(DefectKind kind, Severity severity, const std::vector<std::int32_t>& facets,
                 const std::vector<std::int32_t>& vertices) {
    return fmt::format("{} {}: facets {}; vertices {}", name(severity), name(kind), fmt::join(facets, " "),
                       fmt::join(vertices, " "));
}

}  // namespace

const std::vector<Damage>& mendable_damages() {
    static const std::vector<Damage> damages = {{"repeated vertex", repeated_vertex},
                                                {"duplicate", duplicate},
                                                {"flat pocket", flat_pocket},
                                                {"turned facets", turned_facets}};
    return damages;
}

const std::vector<Damage>& all_damages() {
    static const std::vector<Damage> damages = [] {
        std::vector<Damage> all = mendable_damages();
        const std::vector<Damage> others = {{"missing facet", missing_facet},
                                            {"missing fan", missing_fan},
                                            {"not a number", not_a_number},
                                            {"infinite", infinite},
                                            {"absurd", absurd},
                                            {"collinear corners", collinear_corners},
                                            {"coincident shell", coincident_shell},
                                            {"tetrahedron on an edge", tetrahedron_on_edge},
                                            {"tetrahedron on a vertex", tetrahedron_on_vertex},
                                            {"inverted shell", inverted},
                                            {"second body inside", second_body_inside},
                                            {"overlapping bodies", overlapping_bodies},
                                            {"pushed-through vertex", pushed_through_vertex},
                                            {"needle", needle},
                                            {"unfit polygon", unfit_polygon}};
        all.insert(all.end(), others.begin(), others.end());
        return all;
    }();
    return damages;
}

std::vector<std::string> lines(const std::vector<ExpectedDefect>& expected) {
    std::vector<std::string> all;
    for (const ExpectedDefect& d : expected) all.push_back(line(d.kind, d.severity, d.facets, d.vertices));
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<std::string> lines(const Soup& soup, const Diagnosis& diagnosis) {
    std::vector<std::string> all;
    for (const Defect& d : diagnosis.defects)
        if (d.kind != DefectKind::body_overlap && d.kind != DefectKind::unlike_walls)
            all.push_back(line(d.kind, d.severity, soup.file_facets(d.facets), soup.file_vertices(d.vertices)));
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<ExpectedDefect> intersecting_pairs(const Soup& soup) {
    const auto corners = [&](const Triangle& t) {
        return std::array<Vec3, 3>{soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]};
    };
    std::vector<Eigen::AlignedBox3d> boxes(soup.facets.size());
    for (std::size_t f = 0; f < boxes.size(); ++f)
        for (const std::int32_t v : soup.facets[f]) boxes[f].extend(soup.vertices[v]);
    std::vector<ExpectedDefect> pairs;
    for (std::size_t f = 0; f < boxes.size(); ++f)
        for (std::size_t g = f + 1; g < boxes.size(); ++g) {
            const Triangle &s = soup.facets[f], &t = soup.facets[g];
            if (!boxes[f].intersects(boxes[g]) || !triangles_intersect(corners(s), s, corners(t), t)) continue;
            pairs.push_back({DefectKind::self_intersection,
                             Severity::error,
                             {static_cast<std::int32_t>(f), static_cast<std::int32_t>(g)},
                             {s[0], s[1], s[2], t[0], t[1], t[2]}});
        }
    return pairs;
}

Soup on_a_grid(Soup soup) {
    constexpr double cells = 1 << 20;
    for (Vec3& p : soup.vertices) p = (p * cells).array().round() / cells;
    return soup;
}

Soup cracked(const Soup& whole, double jitter, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offset(-jitter, jitter);
    Soup soup = whole;
    soup.vertices.clear();
    for (Triangle& t : soup.facets)
        for (std::int32_t& v : t) {
            const double x = offset(random), y = offset(random), z = offset(random);
            soup.vertices.push_back(whole.vertices[v] + Vec3(x, y, z));
            v = static_cast<std::int32_t>(soup.vertices.size()) - 1;
        }
    return soup;
}

std::vector<std::int32_t> facets_with(const Soup& soup, const std::vector<std::int32_t>& vertices) {
    std::vector<std::int32_t> facets;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        if (std::all_of(vertices.begin(), vertices.end(),
                        [&](std::int32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); }))
            facets.push_back(static_cast<std::int32_t>(f));
    }
    return facets;
}

void insert_facet(Soup& soup, std::int32_t place, const Triangle& facet) {
    soup.facets.insert(soup.facets.begin() + place, facet);
    soup.patch.insert(soup.patch.begin() + place, 0);
}

void remove_facet(Soup& soup, std::int32_t facet) {
    soup.facets.erase(soup.facets.begin() + facet);
    soup.patch.erase(soup.patch.begin() + facet);
}

}  // namespace kerf::test

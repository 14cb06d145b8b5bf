#include "support/random_damage.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "support/shapes.h"
#include "surface/complex/mass_properties.h"

namespace kerf::test {

namespace {

constexpr double share_of_facets = 0.009, share_of_volume = 4e-4;

double area_of(const Soup& soup, std::int32_t facet) {
    const auto& [a, b, c] = soup.facets[facet];
    return (soup.vertices[b] - soup.vertices[a]).cross(soup.vertices[c] - soup.vertices[a]).norm() / 2;
}

void add_copy(Soup& soup, std::int32_t facet, const Triangle& corners) {
    soup.facets.push_back(corners);
    soup.patch.push_back(soup.patch[facet]);
}

}  // namespace

const char* name(SurfaceDamage damage) {
    static constexpr std::array names = {"deleted", "duplicated", "flipped", "moved", "crossed", "cut", "shifted"};
    return names[static_cast<std::size_t>(damage)];
}

DamagedBody::DamagedBody(Soup whole, std::uint64_t seed) : soup_(std::move(whole)), numbers_(seed) {
    soup_.polygon.clear();
    soup_.vertex_number.clear();
    facets_left_ = static_cast<std::size_t>(share_of_facets * static_cast<double>(soup_.facets.size()));
    volume_left_ = share_of_volume * std::abs(enclosed_volume(soup_.vertices, soup_.facets));
}

void DamagedBody::suffer(SurfaceDamage damage, double gap) {
    switch (damage) {
        case SurfaceDamage::deleted:
            return erase();
        case SurfaceDamage::duplicated:
            return duplicate();
        case SurfaceDamage::flipped:
            return flip();
        case SurfaceDamage::moved:
            return move();
        case SurfaceDamage::crossed:
            return cross();
        case SurfaceDamage::cut:
            return cut(gap);
        case SurfaceDamage::shifted:
            return push_in_a_body();
    }
}

std::vector<std::int32_t> DamagedBody::facets_at(std::int32_t vertex) const {
    std::vector<std::int32_t> facets;
    for (std::size_t f = 0; f < soup_.facets.size(); ++f)
        if (std::find(soup_.facets[f].begin(), soup_.facets[f].end(), vertex) != soup_.facets[f].end())
            facets.push_back(static_cast<std::int32_t>(f));
    return facets;
}

double DamagedBody::edge_at(std::int32_t vertex) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::int32_t f : facets_at(vertex))
        for (const std::int32_t v : soup_.facets[f])
            if (v != vertex) shortest = std::min(shortest, (soup_.vertices[v] - soup_.vertices[vertex]).norm());
    return shortest;
}

Vec3 DamagedBody::direction() {
    while (true) {
        const double x = numbers_.between(-1, 1), y = numbers_.between(-1, 1), z = numbers_.between(-1, 1);
        const Vec3 v(x, y, z);
        if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
}

std::size_t DamagedBody::some_facets(std::size_t most) {
    const std::size_t count = std::min({most, facets_left_, 1 + static_cast<std::size_t>(below(most))});
    facets_left_ -= count;
    return count;
}

std::vector<std::int32_t> DamagedBody::patch(std::size_t count) {
    if (count == 0) return {};
    std::vector<char> is_reached(soup_.vertices.size(), 0);
    std::vector<std::int32_t> facets;
    for (const std::int32_t v : soup_.facets[below(soup_.facets.size())]) is_reached[v] = 1;
    std::vector<char> is_taken(soup_.facets.size(), 0);
    for (bool grows = true; grows && facets.size() < count;) {
        const std::size_t before = facets.size();
        const std::vector<char> reached = is_reached;
        for (std::size_t f = 0; f < soup_.facets.size() && facets.size() < count; ++f) {
            const Triangle& t = soup_.facets[f];
            if (is_taken[f] != 0 || reached[t[0]] + reached[t[1]] + reached[t[2]] < 2) continue;
            is_taken[f] = 1;
            facets.push_back(static_cast<std::int32_t>(f));
            for (const std::int32_t v : t) is_reached[v] = 1;
        }
        grows = facets.size() > before;
    }
    std::sort(facets.begin(), facets.end());
    return facets;
}

double DamagedBody::affordable_move(const std::vector<std::int32_t>& facets, double wish) {
    double area = 0;
    for (const std::int32_t f : facets) area += area_of(soup_, f);
    const double move = std::min(wish, volume_left_ / 4 / area);
    volume_left_ -= move * area;
    return move;
}

void DamagedBody::erase() {
    const std::vector<std::int32_t> facets = patch(some_facets(12));
    std::vector<char> drop(soup_.facets.size(), 0);
    for (const std::int32_t f : facets) drop[f] = 1;
    drop_facets(soup_, drop);
    drop_unused_vertices(soup_);
    soup_.vertex_number.clear();
    soup_.polygon.clear();
}

void DamagedBody::duplicate() {
    for (const std::int32_t f : patch(some_facets(10))) {
        Triangle copy = soup_.facets[f];
        if (numbers_.with_chance(0.5)) std::swap(copy[0], copy[1]);
        if (numbers_.with_chance(0.5))
            for (std::int32_t& v : copy) {
                soup_.vertices.push_back(Vec3(soup_.vertices[v]));
                v = static_cast<std::int32_t>(soup_.vertices.size()) - 1;
            }
        add_copy(soup_, f, copy);
    }
}

void DamagedBody::flip() {
    for (std::size_t count = some_facets(20); count > 0; --count) {
        Triangle& t = soup_.facets[below(soup_.facets.size())];
        std::swap(t[1], t[2]);
    }
}

void DamagedBody::move() {
    for (std::size_t count = (some_facets(30) + 5) / 6; count > 0; --count) {
        const std::int32_t v = below(soup_.vertices.size());
        const double far = affordable_move(facets_at(v), numbers_.between(0.05, 0.9) * edge_at(v));
        soup_.vertices[v] += far * direction();
    }
}

// Beyond a vertex at the other end of the facets at it, so that they turn over, and a little below the surface.
void DamagedBody::cross() {
    for (std::size_t count = (some_facets(24) + 7) / 8; count > 0; --count) {
        const std::int32_t v = below(soup_.vertices.size());
        const std::vector<std::int32_t> facets = facets_at(v);
        if (facets.empty()) continue;
        const Triangle& t = soup_.facets[facets[static_cast<std::size_t>(below(facets.size()))]];
        const Vec3 across =
            (soup_.vertices[t[0]] + soup_.vertices[t[1]] + soup_.vertices[t[2]]) / 3 - soup_.vertices[v];
        const double far = numbers_.between(1.6, 3) * across.norm();
        const double aside = affordable_move(facets, 0.3 * edge_at(v));
        soup_.vertices[v] += far * across.normalized() + aside * direction();
    }
}

void DamagedBody::cut(double gap) {
    const std::vector<std::int32_t> facets = patch(some_facets(30));
    const Vec3 shift = numbers_.between(0, gap) * direction();
    std::vector<std::int32_t> own(soup_.vertices.size(), -1);
    for (const std::int32_t f : facets)
        for (std::int32_t& v : soup_.facets[f]) {
            if (own[v] < 0) {
                own[v] = static_cast<std::int32_t>(soup_.vertices.size());
                soup_.vertices.push_back(soup_.vertices[v] + shift);
            }
            v = own[v];
        }
    drop_unused_vertices(soup_);
    soup_.vertex_number.clear();
}

void DamagedBody::push_in_a_body() {
    if (facets_left_ < 20) return;
    facets_left_ -= 20;
    const double volume_of_unit = 2.54;  // of the icosahedron in the unit sphere
    const double radius = std::cbrt(numbers_.between(0.1, 0.5) * volume_left_ / volume_of_unit);
    volume_left_ -= volume_of_unit * std::pow(radius, 3);
    const Vec3 centre = soup_.vertices[below(soup_.vertices.size())] + numbers_.between(0, 0.5) * radius * direction();
    soup_ = join(std::move(soup_), icosphere(0, radius, centre));
    soup_.vertex_number.clear();
    soup_.polygon.clear();
}

}  // namespace kerf::test

// Closed surfaces by formula: the inputs of the unit tests. Normals point out of the material unless a name says else.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "surface/complex/surface.h"
#include "surface/soup/soup.h"

namespace kerf::test {

/// The corner of the unit cube: 4 facets, volume 1/6.
inline Soup tetrahedron() {
    return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
            {0, 0, 0, 0},
            {"tetrahedron"}};
}

/// Axis-parallel box whose edges are divided into `n` parts per axis: 4 (nx ny + ny nz + nz nx) facets, a patch per
/// side.
inline Soup box(const Vec3& low = Vec3::Zero(), const Vec3& high = Vec3::Ones(), std::array<int, 3> n = {1, 1, 1}) {
    Soup soup;
    const auto add_side = [&](int axis, bool upper) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto corner = [&](int i, int j) {
            Vec3 p;
            p[axis] = upper ? high[axis] : low[axis];
            p[u] = i == n[u] ? high[u] : low[u] + (high[u] - low[u]) * i / n[u];
            p[v] = j == n[v] ? high[v] : low[v] + (high[v] - low[v]) * j / n[v];
            soup.vertices.push_back(p);
        };
        for (int i = 0; i < n[u]; ++i)
            for (int j = 0; j < n[v]; ++j) {
                const auto first = static_cast<std::int32_t>(soup.vertices.size());
                corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1);
                Triangle t{first, first + 1, first + 2}, s{first, first + 2, first + 3};
                if (!upper) std::swap(t[1], t[2]), std::swap(s[1], s[2]);
                soup.facets.insert(soup.facets.end(), {t, s});
            }
        soup.patch.resize(soup.facets.size(), static_cast<std::int32_t>(soup.patch_names.size()));
        soup.patch_names.push_back(std::string(upper ? "high_" : "low_") + "xyz"[axis]);
    };
    for (int axis = 0; axis < 3; ++axis) add_side(axis, false), add_side(axis, true);
    weld_exactly(soup);
    soup.vertex_number.clear();  // there is no file
    return soup;
}

/// Box with the same division along all axes: 12 n^2 facets.
inline Soup box(const Vec3& low, const Vec3& high, int n) { return box(low, high, {n, n, n}); }

/// Icosahedron whose facets are quartered `subdivisions` times, vertices on the sphere: 20 * 4^subdivisions facets.
inline Soup icosphere(int subdivisions, double radius = 1, const Vec3& centre = Vec3::Zero()) {
    const double g = std::numbers::phi;
    Soup soup;
    for (double s : {-1.0, 1.0})
        for (double t : {-g, g})
            soup.vertices.insert(soup.vertices.end(), {Vec3(0, s, t), Vec3(s, t, 0), Vec3(t, 0, s)});
    const auto edge_sq = [&](int a, int b) { return (soup.vertices[a] - soup.vertices[b]).squaredNorm(); };
    for (int a = 0; a < 12; ++a)  // the facets are the vertex triples at mutual distance 2
        for (int b = a + 1; b < 12; ++b)
            for (int c = b + 1; c < 12; ++c) {
                if (std::max({edge_sq(a, b), edge_sq(b, c), edge_sq(c, a)}) > 4.1) continue;
                const bool outward = soup.vertices[a].dot(soup.vertices[b].cross(soup.vertices[c])) > 0;
                soup.facets.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
            }
    for (int level = 0; level < subdivisions; ++level) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
        const auto middle = [&](std::int32_t a, std::int32_t b) {
            const auto size = static_cast<std::int32_t>(soup.vertices.size());
            const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), size);
            if (is_new) soup.vertices.push_back((soup.vertices[a].normalized() + soup.vertices[b].normalized()));
            return it->second;
        };
        std::vector<Triangle> quarters;
        for (const auto& [a, b, c] : soup.facets) {
            const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            quarters.insert(quarters.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        soup.facets = std::move(quarters);
    }
    for (Vec3& p : soup.vertices) p = centre + radius * p.normalized();
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"sphere"};
    return soup;
}

/// Sphere of `rings` bands between the poles (two of them fans) and `segments` meridians: 2 segments (rings - 1)
/// facets.
inline Soup uv_sphere(int rings, int segments, double radius = 1, const Vec3& centre = Vec3::Zero()) {
    Soup soup;
    soup.vertices = {centre - radius * Vec3::UnitZ(), centre + radius * Vec3::UnitZ()};
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < segments; ++j) {
            const double polar = std::numbers::pi * i / rings, angle = 2 * std::numbers::pi * j / segments;
            soup.vertices.push_back(centre + radius * Vec3(std::sin(polar) * std::cos(angle),
                                                           std::sin(polar) * std::sin(angle), -std::cos(polar)));
        }
    const auto at = [&](int i, int j) { return 2 + (i - 1) * segments + j % segments; };
    for (int j = 0; j < segments; ++j) {
        soup.facets.push_back({0, at(1, j + 1), at(1, j)});
        for (int i = 1; i + 1 < rings; ++i)
            soup.facets.insert(soup.facets.end(), {{at(i, j), at(i, j + 1), at(i + 1, j + 1)},
                                                   {at(i, j), at(i + 1, j + 1), at(i + 1, j)}});
        soup.facets.push_back({1, at(rings - 1, j), at(rings - 1, j + 1)});
    }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"sphere"};
    return soup;
}

/// Torus about the z axis: 2 n_major n_minor facets, genus 1.
inline Soup torus(double major_radius, double minor_radius, int n_major, int n_minor) {
    Soup soup;
    for (int i = 0; i < n_major; ++i)
        for (int j = 0; j < n_minor; ++j) {
            const double u = 2 * std::numbers::pi * i / n_major, v = 2 * std::numbers::pi * j / n_minor;
            const double r = major_radius + minor_radius * std::cos(v);
            soup.vertices.emplace_back(r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v));
        }
    const auto at = [&](int i, int j) { return i % n_major * n_minor + j % n_minor; };
    for (int i = 0; i < n_major; ++i)
        for (int j = 0; j < n_minor; ++j)
            soup.facets.insert(soup.facets.end(), {{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                   {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"torus"};
    return soup;
}

/// Ring about the z axis, 1.5 times as long along x and thicker at one end: 640 facets. Where it is cut for two parts
/// and one, the plane touches the inside of the ring, so that a contour of edges meets itself there before it is
/// cleaned.
inline Soup uneven_ring() {
    constexpr int n = 20, m = 16;
    Soup soup;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m,
                         thickness = 1 - 0.3 * std::cos(a);
            const double radius = 1.84 + thickness * std::cos(b);
            soup.vertices.emplace_back(1.5 * radius * std::cos(a), radius * std::sin(a), thickness * std::sin(b));
        }
    const auto number = [](int i, int j) { return i % n * m + j % m; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const int p = number(i, j), q = number(i + 1, j), s = number(i + 1, j + 1), t = number(i, j + 1);
            if ((i + j) % 2 == 1)
                soup.facets.insert(soup.facets.end(), {{p, q, t}, {q, s, t}});
            else
                soup.facets.insert(soup.facets.end(), {{p, q, s}, {p, s, t}});
        }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"ring"};
    return soup;
}

/// Prism with n sides about the z axis: 4 n facets, of which the 2 n of the sides are as long as the part.
inline Soup prism(int n, double radius, double height) {
    Soup soup;
    soup.vertices = {Vec3::Zero(), Vec3(0, 0, height)};
    for (int i = 0; i < n; ++i)
        for (const double z : {0.0, height}) {
            const double angle = 2 * std::numbers::pi * i / n;
            soup.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % n);  // vertices above follow those below
        soup.facets.insert(soup.facets.end(), {{0, b, a}, {a, b, b + 1}, {a, b + 1, a + 1}, {1, a + 1, b + 1}});
        soup.patch.insert(soup.patch.end(), {0, 1, 1, 2});
    }
    soup.patch_names = {"below", "sides", "above"};
    return soup;
}

/// A cylinder along z, from 0 to `height`, whose n vertices of each ring are turned by `twist` of a facet against those
/// of the ring below: contours across it go against the grain of its edges.
inline Soup twisted_cylinder(int n, int rings, double radius, double height, double twist) {
    Soup soup;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < n; ++j) {
            const double angle = 2 * std::numbers::pi * (j + twist * i) / n;
            soup.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * i / rings);
        }
    const std::int32_t bottom = n * (rings + 1), top = bottom + 1;
    soup.vertices.emplace_back(0, 0, 0);
    soup.vertices.emplace_back(0, 0, height);
    for (int j = 0; j < n; ++j) {
        const int next = (j + 1) % n;
        for (int i = 0; i < rings; ++i) {
            const int a = n * i + j, b = n * i + next;
            soup.facets.push_back({a, b, b + n});
            soup.facets.push_back({a, b + n, a + n});
        }
        soup.facets.push_back({next, j, bottom});
        soup.facets.push_back({n * rings + j, n * rings + next, top});
    }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"cylinder"};
    return soup;
}

/// Square plate with a round hole of n vertices, n a multiple of 4: every facet of the upper and lower side runs from
/// the hole to a corner or from an outer edge to the hole. 4 n + 16 facets.
inline Soup plate_with_hole(int n) {
    Soup soup;
    soup.patch_names = {"plate"};
    const auto add_pair = [&](double x, double y) {
        for (const double z : {-0.1, 0.1}) soup.vertices.emplace_back(x, y, z);
    };
    for (int i = 0; i < 4; ++i) add_pair(i == 0 || i == 3 ? 2 : -2, i < 2 ? 2 : -2);
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.3) / n;
        add_pair(std::cos(angle), std::sin(angle));
    }
    const auto add_sides = [&](std::int32_t a, std::int32_t b, std::int32_t c) {  // counter-clockwise from above
        soup.facets.insert(soup.facets.end(), {{a + 1, b + 1, c + 1}, {a, c, b}});
    };
    const auto add_wall = [&](std::int32_t a, std::int32_t b) {  // seen from outside, a on the left
        soup.facets.insert(soup.facets.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
    };
    const auto hole = [&](int i) { return 8 + 2 * (i % n); };
    for (int quarter = 0; quarter < 4; ++quarter) {
        const std::int32_t corner = 2 * quarter, next = 2 * ((quarter + 1) % 4);
        for (int i = quarter * n / 4; i < (quarter + 1) * n / 4; ++i) {
            add_sides(corner, hole(i + 1), hole(i));
            add_wall(hole(i + 1), hole(i));
        }
        add_sides(corner, next, hole((quarter + 1) * n / 4));
        add_wall(corner, next);
    }
    soup.patch.assign(soup.facets.size(), 0);
    return soup;
}

/// The same surface with every facet turned.
inline Soup inside_out(Soup soup) {
    for (Triangle& t : soup.facets) std::swap(t[1], t[2]);
    return soup;
}

inline Soup translated(Soup soup, const Vec3& offset) {
    for (Vec3& p : soup.vertices) p += offset;
    return soup;
}

/// The soups side by side: vertices, facets and patches of `b` behind those of `a`.
inline Soup join(Soup a, const Soup& b) {
    const auto vertex = static_cast<std::int32_t>(a.vertices.size());
    const auto patch = static_cast<std::int32_t>(a.patch_names.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const Triangle& t : b.facets) a.facets.push_back({t[0] + vertex, t[1] + vertex, t[2] + vertex});
    for (std::int32_t p : b.patch) a.patch.push_back(p + patch);
    a.patch_names.insert(a.patch_names.end(), b.patch_names.begin(), b.patch_names.end());
    return a;
}

/// Concentric cubes of edge 1, 3, 5, ... around the origin, smallest first; the largest bounds material, the next a
/// void in it, and so on.
inline Soup nested_boxes(int count, int n = 1) {
    Soup soup;
    for (int i = 0; i < count; ++i) {
        const Vec3 half = Vec3::Constant(0.5 + i);
        const Soup cube = box(-half, half, n);
        soup = join(std::move(soup), (count - 1 - i) % 2 ? inside_out(cube) : cube);
    }
    return soup;
}

/// Rings of major radius 3 and minor radius 0.6 in a row along x, alternately flat and upright, each through its
/// neighbours and touching none: 2 n_major n_minor facets per ring, a shell of genus 1 each.
inline Soup linked_rings(int count, int n_major, int n_minor) {
    Soup soup;
    for (int i = 0; i < count; ++i) {
        Soup ring = torus(3, 0.6, n_major, n_minor);
        for (Vec3& p : ring.vertices) {
            if (i % 2) p = Vec3(p.x(), -p.z(), p.y());
            p.x() += 4.2 * i;
        }
        soup = join(std::move(soup), ring);
    }
    return soup;
}

/// Block of nx x ny x nz unit cubes with a spherical cavity of radius 0.3 in each: 80 facets per cavity, and
/// 16 (nx ny + ny nz + nz nx) outside.
inline Soup block_with_cavities(const std::array<int, 3>& n) {
    Soup soup = box(Vec3::Zero(), Vec3(n[0], n[1], n[2]), {2 * n[0], 2 * n[1], 2 * n[2]});
    for (int i = 0; i < n[0]; ++i)
        for (int j = 0; j < n[1]; ++j)
            for (int k = 0; k < n[2]; ++k)
                soup = join(std::move(soup), inside_out(icosphere(1, 0.3, Vec3(i + 0.5, j + 0.5, k + 0.5))));
    return soup;
}

/// Removes both of two facets with the same corners in opposite order: what solids side by side have in common.
inline void cancel_common_facets(Soup& soup) {
    std::map<Triangle, std::vector<std::size_t>> facets_at;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        Triangle corners = soup.facets[f];
        std::sort(corners.begin(), corners.end());
        facets_at[corners].push_back(f);
    }
    std::vector<char> is_kept(soup.facets.size(), 1);
    for (const auto& [corners, facets] : facets_at)
        if (facets.size() == 2) is_kept[facets[0]] = is_kept[facets[1]] = 0;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (!is_kept[f]) continue;
        soup.patch[kept] = soup.patch[f];
        soup.facets[kept++] = soup.facets[f];
    }
    soup.facets.resize(kept);
    soup.patch.resize(kept);
}

/// Open-cell porous element: a cubic frame of beams with unit square sections around `cells`^3 unit pores, open to all
/// sides; the sides of the unit cubes that make it are divided into n x n squares. One shell of high genus.
inline Soup porous_frame(int cells, int n) {
    Soup soup;
    const int end = 2 * cells + 1;
    for (int i = 0; i < end; ++i)
        for (int j = 0; j < end; ++j)
            for (int k = 0; k < end; ++k)
                if (i % 2 + j % 2 + k % 2 < 2)  // on a beam, or where beams cross
                    soup = join(std::move(soup), box(Vec3(i, j, k), Vec3(i + 1, j + 1, k + 1), n));
    weld_exactly(soup);
    cancel_common_facets(soup);
    drop_unused_vertices(soup);
    soup.vertex_number.clear();
    return soup;
}

/// The soup as arrays of an input surface: keys of node 0.
inline SurfaceArrays to_arrays(const Soup& soup) {
    SurfaceArrays arrays{soup.vertices, soup.facets, {}, {}, soup.patch};
    for (std::size_t v = 0; v < soup.vertices.size(); ++v)
        arrays.vertex_key.push_back(make_key(input_node, static_cast<std::int32_t>(v)));
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        arrays.facet_key.push_back(make_key(input_node, static_cast<std::int32_t>(f)));
    return arrays;
}

/// The soup, which is closed, as a surface.
inline Surface to_surface(const Soup& soup) { return Surface(to_arrays(soup)); }

}  // namespace kerf::test

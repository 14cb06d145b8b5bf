// Rounds around the remeshing proper (triangle_shaping.h), until the whole passes inspect(). A round whose result is
// refused at some facets is followed by one with a quarter of their tolerances; after `most_rounds` of these the
// refused facets, with all around them, are kept as they are; when that does not help either, the surface is refused.
// Operations get only `used_share` of the deviation, as the rest is for points between those that are compared. After a
// round that passes, volumes are restored (volume_restoration.h): vertices at which the moved surface is refused are
// fixed, and the restoration is tried again. If a volume is still wrong, rounds with smaller tolerances everywhere
// follow, in which chords leave out less.
#include "surface/remesh/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/core/cancellation.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "surface/complex/touching.h"
#include "surface/diagnosis/intersections.h"
#include "surface/diagnosis/nearness.h"
#include "surface/remesh/inside/bounded_surface.h"
#include "surface/remesh/inside/fold_sizes.h"
#include "surface/remesh/inside/triangle_shaping.h"
#include "surface/remesh/inside/volume_restoration.h"
#include "surface/remesh/thickness.h"

namespace kerf {

namespace {

constexpr double as_asked = 0.95;  // a size over that which is asked for, which counts as that
// Points between those that operations compare with the input may be further off.
constexpr double used_share = 0.8;
constexpr int most_rounds = 5, most_rounds_that_keep = 3;
constexpr double smaller_tolerance = 0.25;  // of the tolerance, where the result of a round is refused
constexpr double same_volume = 5e-5;        // of a region, before and after: nothing is to be restored
constexpr int most_restorations = 6;
constexpr double needle_sine = 0.3, needle_share = 0.7;  // of a facet after a move; over the sine before
constexpr int most_rounds_for_volume = 2;                // with smaller tolerances, because volumes were not restored
constexpr double smaller_for_volume = 0.5;

constexpr double most_facets_on_walls = 1.5e6;

constexpr double first_bound = 0.2, step_of_bound = 1.25;  // of the deviation; of the one before
// The divisions allowed for one facet in the proof: it may be near all of the other surface, along whose facets it is
// divided.
constexpr int least_divisions = 100'000, divisions_per_facet = 16;

std::vector<InputPlace> places_on(const TriangleTree& input, const std::vector<Vec3>& vertices) {
    std::vector<InputPlace> places;
    places.reserve(vertices.size());
    for (const Vec3& p : vertices) {
        const TriangleTree::Closest closest = input.closest(p);
        places.push_back({closest.facet, closest.point});
    }
    return places;
}

// Returns the shares of the area in which some corner has a smaller size than the user asks for there; the corner with
// the smallest ratio gives the reason.
FinerShares finer_shares(const SheetMesh& mesh) {
    std::array<double, 4> finer{};
    double all = 0;
    for (const auto f : mesh.faces()) {
        const double area = area_normal(mesh.corners(f)).norm();
        all += area;
        double least = as_asked;
        LengthRule rule = LengthRule::asked;
        for (const auto v : mesh.fv_range(f))
            if (const double share = mesh.size(v) / mesh.data(v).asked; share < least) {
                least = share;
                rule = mesh.data(v).wanted.rule;
            }
        if (least < as_asked) finer[static_cast<std::size_t>(rule)] += area;
    }
    if (!(all > 0)) return {};
    const auto share = [&](LengthRule rule) { return finer[static_cast<std::size_t>(rule)] / all; };
    return {share(LengthRule::bound), share(LengthRule::features), share(LengthRule::walls)};
}

// Joins the copies at seams, and makes the numbers of vertices their keys.
SurfaceArrays with_seams_joined(SurfaceArrays sheets) {
    SurfaceArrays joined = joined_by_key(std::move(sheets));
    for (std::int32_t v = 0; v < count_of(joined.vertices); ++v) joined.vertex_key[v] = make_key(input_node, v);
    return joined;
}

Remeshed remesh_once(const Sheets& sheets, const TriangleTree& tree, const Tolerances& tolerances,
                     const RemeshOptions& options) {
    const InputShape input(sheets, tree, tolerances, options.feature_angle_deg, options.creases, options.walls);
    BoundedSurface shaped(input, options.kept);
    shape_triangles(shaped, options);
    const SheetMesh& mesh = shaped.mesh();
    const RemeshReport report = {.feature_edges = mesh.feature_edges(), .finer = finer_shares(mesh)};
    return {with_seams_joined(shaped.arrays()), {}, report};
}

// Calls visit(point) for the points of a lattice in the facet that divides each of its edges in six.
template <class Visit>
void for_each_sample(const std::vector<Vec3>& vertices, const Triangle& t, Visit visit) {
    constexpr int samples_per_edge = 6;
    for (int i = 0; i <= samples_per_edge; ++i)
        for (int j = 0; i + j <= samples_per_edge; ++j)
            visit(Vec3((i * vertices[t[0]] + j * vertices[t[1]] + (samples_per_edge - i - j) * vertices[t[2]]) /
                       samples_per_edge));
}

int divisions_for(std::size_t facets) {
    return std::min<std::size_t>(least_divisions + divisions_per_facet * facets, 1 << 30);
}

// One of the surfaces, with the bounds within which the facets of the other are known to be near.
struct Side {
    Nearness nearness;
    int most_divisions;
    double bound;            // that does for all so far
    std::int32_t last = -1;  // facet of this side that the last one is near

    Side(const TriangleTree& tree, const std::vector<Triangle>& facets, double deviation)
        : nearness(tree, facets), most_divisions(divisions_for(facets.size())), bound(first_bound * deviation) {}
};

bool is_near(const std::vector<Vec3>& vertices, const Triangle& t, const RemeshOptions& options, Side& side) {
    const auto holds = [&] {
        return side.nearness.holds(
            {vertices[t[0]], vertices[t[1]], vertices[t[2]]}, side.bound, [&](std::int32_t) { return side.bound; },
            side.most_divisions, side.last);
    };
    for (; !holds(); side.bound = std::min(options.deviation, step_of_bound * side.bound))
        if (side.bound == options.deviation) return false;
    return true;
}

// Compares a result with the input: finds facets that meet, and points too far from the other surface. Returns for
// each facet of the input whether the result is refused there, and puts the distances into the report. `input_tree` is
// of the facets of `input`. O(#F log #F).
std::vector<char> inspect(const SurfaceArrays& input, const TriangleTree& input_tree, const RemeshOptions& options,
                          const SurfaceArrays& result, RemeshReport& report) {
    std::vector<char> refused(input.facets.size(), 0);
    const auto refuse_around = [&](const Vec3& p) {
        input_tree.any_within(p, options.deviation, [&](std::int32_t near, double) {
            refused[near] = 1;
            return false;
        });
    };
    for (const auto& [f, g] : find_self_intersections(result.vertices, result.facets))
        for (const std::int32_t facet : {f, g}) for_each_sample(result.vertices, result.facets[facet], refuse_around);
    const CancellationCheck check_cancelled(options.check_cancelled);
    Side to_input(input_tree, input.facets, options.deviation);
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        check_cancelled.at(f);
        const Triangle& t = result.facets[f];
        if (!is_near(result.vertices, t, options, to_input))
            for_each_sample(result.vertices, t, [&](const Vec3& p) { refused[input_tree.closest(p).facet] = 1; });
    }
    const TriangleTree tree(result.vertices, result.facets);
    Side from_input(tree, result.facets, options.deviation);
    for (std::size_t f = 0; f < input.facets.size(); ++f) {
        check_cancelled.at(f);
        if (!is_near(input.vertices, input.facets[f], options, from_input)) refused[f] = 1;
    }
    report.distance_to_input = to_input.nearness.directed_distance();
    report.distance_from_input = from_input.nearness.directed_distance();
    return refused;
}

void afford_walls(const SurfaceArrays& surface, const TriangleTree& tree, RemeshOptions& options) {
    const WallEdges wanted = {options.edges_per_thickness, shortest_on_walls(options), options.longest};
    const WallEdges edges =
        affordable_edges(surface, Thickness(surface, tree, options.walls), wanted, most_facets_on_walls);
    options.edges_per_thickness = edges.per_thickness;
    options.shortest_on_walls = edges.shortest;
}

void check_remesh_options(const RemeshOptions& options, std::size_t facets) {
    KERF_CHECK(options.kept.empty() || options.kept.size() == facets);
    KERF_CHECK(options.walls.empty() || options.walls.size() == facets);
    KERF_CHECK(options.deviation > 0 && options.longest > 0 && options.growth > 0 && options.feature_angle_deg > 0);
}

// Adds facets to those that stay as they are, with all that share a vertex with them. Returns whether others are left.
bool leave(const SurfaceArrays& surface, const std::vector<char>& refused, std::vector<char>& kept) {
    std::vector<char> is_near(surface.vertices.size(), 0);
    for (std::size_t f = 0; f < refused.size(); ++f)
        if (refused[f] != 0)
            for (const std::int32_t v : surface.facets[f]) is_near[v] = 1;
    kept.resize(surface.facets.size(), 0);
    for (std::size_t f = 0; f < kept.size(); ++f) {
        const Triangle& t = surface.facets[f];
        if (is_near[t[0]] != 0 || is_near[t[1]] != 0 || is_near[t[2]] != 0) kept[f] = 1;
    }
    return std::find(kept.begin(), kept.end(), char{0}) != kept.end();
}

// The vertices of the result that are corners of facets which are kept.
std::vector<char> corners_of_kept(const SurfaceArrays& surface, const std::vector<char>& kept,
                                  const SurfaceArrays& result) {
    std::vector<std::array<double, 3>> corners;
    const auto coordinates = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
    for (std::size_t f = 0; f < kept.size(); ++f)
        if (kept[f] != 0)
            for (const std::int32_t v : surface.facets[f]) corners.push_back(coordinates(surface.vertices[v]));
    std::sort(corners.begin(), corners.end());
    std::vector<char> is_corner;
    for (const Vec3& p : result.vertices)
        is_corner.push_back(std::binary_search(corners.begin(), corners.end(), coordinates(p)));
    return is_corner;
}

// Fixes the corners of facets that a move has made needles. Returns whether some of them had moved.
bool fix_needles(const SurfaceArrays& before, const SurfaceArrays& moved, std::vector<char>& is_fixed) {
    bool any = false;
    for (const Triangle& t : moved.facets) {
        const auto sine = [&t](const std::vector<Vec3>& p) { return smallest_sine(p[t[0]], p[t[1]], p[t[2]]); };
        if (sine(moved.vertices) >= std::min(needle_sine, needle_share * sine(before.vertices))) continue;
        for (const std::int32_t v : t) {
            any = any || moved.vertices[v] != before.vertices[v];
            is_fixed[v] = 1;
        }
    }
    return any;
}

// Vertices stay where a move would leave the bound, make an intersection or a needle.
void restore_volumes_within_bound(const SurfaceArrays& surface, const TriangleTree& tree, const RemeshOptions& options,
                                  const std::vector<char>& kept, Remeshed& result) {
    result.report.volume_difference = volume_difference(surface, result.surface, options.sides);
    if (result.report.volume_difference <= same_volume) return;
    std::vector<char> is_fixed = corners_of_kept(surface, kept, result.surface);
    for (int round = 0; round < most_restorations; ++round) {
        SurfaceArrays moved = result.surface;
        if (!restore_volumes(surface, tree, options.sides, options.deviation, is_fixed, moved)) return;
        if (fix_needles(result.surface, moved, is_fixed) && round + 1 < most_restorations) continue;
        RemeshReport report = result.report;
        const std::vector<char> refused = inspect(surface, tree, options, moved, report);
        if (std::find(refused.begin(), refused.end(), char{1}) == refused.end()) {
            result.surface = std::move(moved);
            result.places = places_on(tree, result.surface.vertices);
            result.report = report;
            result.report.volume_difference = volume_difference(surface, result.surface, options.sides);
            return;
        }
        for (std::size_t v = 0; v < is_fixed.size(); ++v)
            if (refused[result.places[v].facet] != 0) is_fixed[v] = 1;
    }
}

[[noreturn]] void refuse(const SurfaceArrays& surface, const std::vector<char>& refused, double deviation) {
    const auto first = std::find(refused.begin(), refused.end(), char{1}) - refused.begin();
    const Vec3& place = surface.vertices[surface.facets[first][0]];
    throw Error(
        ErrorCode::input,
        fmt::format("The surface cannot be remeshed within {:g} at {} facets, the first near ({:g}, "
                    "{:g}, {:g}). Try another --deviation, or keep the surface as it is.",
                    deviation, std::count(refused.begin(), refused.end(), char{1}), place[0], place[1], place[2]));
}

}  // namespace

double shortest_on_walls(const RemeshOptions& options) {
    return options.shortest_on_walls > 0 ? options.shortest_on_walls : 0.75 * options.deviation;
}

double forecast_facets(const SurfaceArrays& surface, const RemeshOptions& options) {
    check_remesh_options(options, surface.facets.size());
    double facets = 0;
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        if (!options.kept.empty() && options.kept[f] != 0) {
            ++facets;
            continue;
        }
        const Triangle& t = surface.facets[f];
        const std::vector<Vec3>& p = surface.vertices;
        double density = 0;  // sum over the samples
        int samples = 0;
        for_each_sample(p, t, [&](const Vec3& point) {
            const double edge =
                options.wanted ? std::min(options.wanted(point, surface.patch[f]), options.longest) : options.longest;
            density += 1 / (edge * edge);
            ++samples;
        });
        const double area = triangle_area(p, t);
        facets += area / facet_area_per_squared_length * density / samples;
    }
    return facets;
}

Remeshed remesh(const SurfaceArrays& surface, const RemeshOptions& options) {
    check_remesh_options(options, surface.facets.size());
    const TriangleTree tree(surface.vertices, surface.facets);
    const Sheets sheets = take_apart(surface);
    Tolerances tolerances =
        find_tolerances(surface, tree, {used_share * options.deviation, used_share * options.share_of_thickness},
                        options.walls, CancellationCheck(options.check_cancelled));
    RemeshOptions own = options;
    afford_walls(surface, tree, own);
    int rounds_for_volume = 0;
    for (int round = 1;; ++round) {
        Remeshed result = remesh_once(sheets, tree, tolerances, own);
        result.report.rounds = round;
        const std::vector<char> refused = inspect(surface, tree, options, result.surface, result.report);
        if (std::find(refused.begin(), refused.end(), char{1}) == refused.end()) {
            result.places = places_on(tree, result.surface.vertices);
            restore_volumes_within_bound(surface, tree, options, own.kept, result);
            result.report.facets_left = std::count(own.kept.begin(), own.kept.end(), char{1}) -
                                        std::count(options.kept.begin(), options.kept.end(), char{1});
            if (result.report.volume_difference <= options.volume_tolerance ||
                rounds_for_volume == most_rounds_for_volume)
                return result;
            ++rounds_for_volume;
            tolerances.multiply(smaller_for_volume);
        } else if (round >= most_rounds + rounds_for_volume) {
            if (round >= most_rounds + most_rounds_that_keep + rounds_for_volume || !leave(surface, refused, own.kept))
                refuse(surface, refused, options.deviation);
        } else {
            for (std::size_t f = 0; f < refused.size(); ++f)
                if (refused[f] != 0) tolerances.of_facet[f] *= smaller_tolerance;
        }
    }
}

}  // namespace kerf

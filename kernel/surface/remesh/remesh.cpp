// Rounds around the remeshing proper (triangle_shaping.h), until the whole passes inspect(). Where facets meet once the
// surface is simplified, tolerances become smaller at once, if that helps. A round whose result is refused at some
// facets is followed by one with a quarter of their tolerances; after `most_rounds` of these the refused facets, with
// all around them, are kept as they are; when that does not help either, the surface is refused. Operations get only
// `used_share` of the deviation, as the rest is for points between those that are compared. Volumes are restored
// (volume_restoration.h) before the inspection, and again with the vertices fixed at which the moved surface is
// refused. If a volume is still wrong, rounds with smaller tolerances everywhere follow, in which chords leave out
// less.
#include "surface/remesh/remesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/cancellation.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/triangle.h"
#include "surface/diagnosis/nearness.h"
#include "surface/remesh/inside/inspection.h"
#include "surface/remesh/inside/shared_work.h"
#include "surface/remesh/inside/sheet_mesh.h"
#include "surface/remesh/inside/triangle_shaping.h"
#include "surface/remesh/inside/volume_restoration.h"
#include "surface/remesh/thickness.h"

namespace kerf {

namespace {

constexpr double as_asked = 0.95;  // a size over that which is asked for, which counts as that
// Points between those that operations compare with the input may be further off.
constexpr double used_share = 0.8;
constexpr int most_tightenings = 4;  // because facets of a simple surface meet
constexpr int most_rounds = 5, most_rounds_that_keep = 3;
constexpr double smaller_tolerance = 0.25;  // of the tolerance, where the result of a round is refused
constexpr double same_volume = 5e-5;        // of a region, before and after: nothing is to be restored
constexpr int most_restorations = 6;
constexpr double needle_sine = 0.3, needle_share = 0.7;  // of a facet after a move; over the sine before
constexpr int most_rounds_for_volume = 2;                // with smaller tolerances, because volumes were not restored
constexpr double smaller_for_volume = 0.5;

constexpr double most_facets_on_walls = 1.5e6;

// A facet known to be near bounds each search.
std::vector<InputPlace> places_on(const TriangleTree& input, const ChangedSurface& result) {
    constexpr std::size_t grain = 1 << 12;
    constexpr double a_little_more = 1 + 1e-6;  // of the squared distance, which must be below the limit
    const std::vector<Vec3>& vertices = result.surface.vertices;
    std::vector<std::int32_t> near(vertices.size(), -1);
    for (std::size_t f = 0; f < result.near.size(); ++f)
        for (const std::int32_t v : result.surface.facets[f]) near[v] = result.near[f];
    std::vector<InputPlace> places(vertices.size());
    for_ranges_on_threads(vertices.size(), grain, [&](const IndexRange& range) {
        for (std::size_t v = range.first; v < range.last; ++v) {
            const double squared = input.squared_distance_to(vertices[v], near[v]);
            const TriangleTree::Closest closest = input.closest(vertices[v], a_little_more * squared);
            places[v] = closest.facet < 0 ? InputPlace{near[v], vertices[v]} : InputPlace{closest.facet, closest.point};
        }
    });
    return places;
}

// Tells the reasons for the sizes at the corners of facets that are not kept: by the area in which some corner has a
// smaller size than the user asks for there, and by facets. The corner with the smallest ratio gives the reason.
void tell_reasons(const SheetArrays& sheets, RemeshReport& report) {
    std::array<double, 4> finer{};
    std::array<std::int64_t, 4> facets{};
    double all = 0;
    for (std::size_t f = 0; f < sheets.corners.size(); ++f) {
        const double area = area_normal(sheets.triangle(f)).norm();
        all += area;
        if (sheets.facets[f].is_kept) continue;
        double least = as_asked;
        LengthRule rule = LengthRule::asked;
        for (const std::int32_t v : sheets.corners[f]) {
            const SheetVertex& vertex = sheets.vertices[v];
            if (const double share = vertex.wanted.length / vertex.asked; share < least) {
                least = share;
                rule = vertex.wanted.rule;
            }
        }
        if (least < as_asked) finer[static_cast<std::size_t>(rule)] += area;
        ++facets[static_cast<std::size_t>(rule)];
    }
    const auto of = [](const auto& sums, LengthRule rule) { return sums[static_cast<std::size_t>(rule)]; };
    if (all > 0)
        report.finer = {of(finer, LengthRule::bound) / all, of(finer, LengthRule::features) / all,
                        of(finer, LengthRule::walls) / all};
    report.facets_by = {of(facets, LengthRule::asked), of(facets, LengthRule::bound), of(facets, LengthRule::features),
                        of(facets, LengthRule::walls)};
}

ChangedSurface changed_surface(const SheetArrays& sheets) {
    ChangedSurface result = {joined_surface(sheets), {}, {}};
    for (const SheetFacet& facet : sheets.facets) {
        result.near.push_back(facet.near);
        result.is_kept.push_back(facet.is_kept ? 1 : 0);
    }
    return result;
}

void tighten(const std::vector<char>& refused, Tolerances& tolerances) {
    for (std::size_t f = 0; f < refused.size(); ++f)
        if (refused[f] != 0) tolerances.of_facet[f] *= smaller_tolerance;
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

// Gives a result the volumes of the input. Vertices stay where a move would leave the bound, make an intersection or a
// needle. Returns what the inspection of the result says.
Inspection restore_volumes_within_bound(const InspectedInput& input, const RemeshOptions& options,
                                        const std::vector<char>& kept, ChangedSurface& result) {
    const CancellationCheck check_cancelled(options.check_cancelled);
    std::optional<Inspection> as_it_is;
    const auto inspect_as_it_is = [&]() -> const Inspection& {
        if (!as_it_is) as_it_is = inspect(input, kept, options.deviation, result, check_cancelled);
        return *as_it_is;
    };
    if (volume_difference(input.surface, result.surface, options.sides, options.reference_volume) <= same_volume)
        return inspect_as_it_is();
    std::vector<char> is_fixed = corners_of_kept(input.surface, kept, result.surface);
    ChangedSurface moved = result;
    for (int round = 0; round < most_restorations; ++round) {
        check_cancelled();
        moved.surface.vertices = result.surface.vertices;
        if (!restore_volumes(input, options.sides, options.deviation, is_fixed, moved)) break;
        if (fix_needles(result.surface, moved.surface, is_fixed) && round + 1 < most_restorations) continue;
        Inspection inspection = inspect(input, kept, options.deviation, moved, check_cancelled);
        if (inspection.has_passed()) {
            result = std::move(moved);
            return inspection;
        }
        if (!inspect_as_it_is().has_passed()) break;
        for (std::size_t f = 0; f < result.near.size(); ++f)
            if (inspection.refused[result.near[f]] != 0)
                for (const std::int32_t v : result.surface.facets[f]) is_fixed[v] = 1;
    }
    return inspect_as_it_is();
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

namespace {

// Shares of the work that are done, as they are of most surfaces, after each of its stages.
constexpr double tolerances_end = 0.1, simplified_end = 0.3, shaped_end = 0.85;

// A function that adds shares of a stage.
std::function<void(double)> in_share_of(SharedWork& work, double of_stage) {
    return [&work, of_stage](double share) { work.add(of_stage * share); };
}

// The input without what the bound does not need, and where facets of it meet.
struct Simplified {
    std::unique_ptr<const InputShape> input;
    SheetState state;
    std::vector<char> meeting;  // #F of the input
    std::ptrdiff_t meeting_count = 0;
};

// Simplifies with smaller tolerances where facets of the simple surface meet, as long as that makes fewer of them meet;
// `tolerances` are those of the result.
template <class Simplify>
Simplified simplify_apart(const Simplify& simplify_within, Tolerances& tolerances) {
    Simplified best = simplify_within(tolerances);
    for (int step = 0; step < most_tightenings && best.meeting_count > 0; ++step) {
        Tolerances smaller = tolerances;
        tighten(best.meeting, smaller);
        Simplified next = simplify_within(smaller);
        if (next.meeting_count >= best.meeting_count) break;
        best = std::move(next);
        tolerances = std::move(smaller);
    }
    return best;
}

}  // namespace

Remeshed remesh(const SurfaceArrays& surface, const RemeshOptions& asked) {
    check_remesh_options(asked, surface.facets.size());
    SharedWork work(asked.check_cancelled, asked.tell_share);
    RemeshOptions options = asked;
    options.check_cancelled = [&work] { work.check(); };
    const TriangleTree tree(surface.vertices, surface.facets);
    const Nearness nearness(tree, surface.facets);
    const InspectedInput inspected = {surface, tree, nearness};
    const Sheets sheets = take_apart(surface);
    Tolerances tolerances =
        find_tolerances(surface, tree, {used_share * options.deviation, used_share * options.share_of_thickness},
                        options.walls, CancellationCheck(options.check_cancelled));
    afford_walls(surface, tree, options);
    std::vector<char> kept = options.kept;
    const auto simplify_within = [&](const Tolerances& some) {
        work.reach(tolerances_end);
        auto input = std::make_unique<const InputShape>(sheets, tree, nearness, some, options.feature_angle_deg,
                                                        options.creases, options.walls);
        SheetState state = simplify(*input, kept, options, in_share_of(work, simplified_end - tolerances_end));
        std::vector<char> meeting = find_meeting(inspected, options.deviation, joined_surface(state.arrays));
        const auto count = std::count(meeting.begin(), meeting.end(), char{1});
        return Simplified{std::move(input), std::move(state), std::move(meeting), count};
    };
    std::vector<char> last_refused;
    int rounds_for_volume = 0, rounds_that_keep = 0;
    for (int round = 1;; ++round) {
        ChangedSurface result;
        RemeshReport report;
        {  // what is shaped takes memory that proofs need
            Simplified simplified = simplify_apart(simplify_within, tolerances);
            SheetState& shaped = simplified.state;
            work.reach(simplified_end);
            shape_triangles(*simplified.input, options, in_share_of(work, shaped_end - simplified_end), shaped);
            work.reach(shaped_end);
            result = changed_surface(shaped.arrays);
            report.rounds = round;
            report.feature_edges = count_features(shaped.arrays);
            tell_reasons(shaped.arrays, report);
        }
        const Inspection inspection = restore_volumes_within_bound(inspected, options, kept, result);
        const std::vector<char>& refused = inspection.refused;
        if (inspection.has_passed()) {
            report.distance_to_input = inspection.distance_to_input;
            report.distance_from_input = inspection.distance_from_input;
            report.volume_difference =
                volume_difference(surface, result.surface, options.sides, options.reference_volume);
            report.facets_left = std::count(kept.begin(), kept.end(), char{1}) -
                                 std::count(options.kept.begin(), options.kept.end(), char{1});
            if (report.volume_difference <= options.volume_tolerance || rounds_for_volume == most_rounds_for_volume) {
                std::vector<InputPlace> places = places_on(tree, result);
                return {std::move(result.surface), std::move(places), report};
            }
            ++rounds_for_volume;
            tolerances.multiply(smaller_for_volume);
        } else if (round >= most_rounds + rounds_for_volume || refused == last_refused) {
            if (++rounds_that_keep > most_rounds_that_keep || !leave(surface, refused, kept))
                refuse(surface, refused, options.deviation);
        } else {
            tighten(refused, tolerances);
        }
        last_refused = inspection.refused;
    }
}

}  // namespace kerf

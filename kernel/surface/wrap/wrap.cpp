// A wrap is an alpha wrap with an offset (Portaneri et al. 2022, portaneri2022; surface/wrap/inside/alpha_wrap.h),
// whose vertices are drawn back to the surface (surface/wrap/inside/wrap_pullback.h). Facets without area are left out
// first. Then the distance from wrap to surface and back is proven, not sampled
// (surface/wrap/inside/proven_distance.h); the way back counts only facets that are seen, from which a ray across them
// leaves freely on one side, because facets inside are lost on purpose. The gap is the diameter of the balls that
// carve; its limits, as shares of the diagonal, and an estimate of the number of facets, area over squared gap, keep
// the cost in bounds.
#include "surface/wrap/wrap.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/core/cancellation.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "surface/soup/edge_corners.h"
#include "surface/wrap/inside/alpha_wrap.h"
#include "surface/wrap/inside/proven_distance.h"
#include "surface/wrap/inside/wrap_pullback.h"

namespace kerf {

namespace {

constexpr double no_length_of_wrap = 1e-9;  // of the diagonal

// Marks facets without area or finite coordinates.
std::vector<char> facets_without_area(const Soup& soup) {
    std::vector<char> is_none(soup.facets.size(), 0);
    for (std::size_t f = 0; f < is_none.size(); ++f) {
        const double area = triangle_area(soup.vertices, soup.facets[f]);
        is_none[f] = !(area > 0) || !std::isfinite(area);
    }
    return is_none;
}

double area_to_wrap(const Soup& soup) {
    double sum = 0;
    for (const Triangle& t : soup.facets)
        if (const double area = triangle_area(soup.vertices, t); std::isfinite(area)) sum += area;
    return sum;
}

// Facets from which a ray across them, on one of the sides, meets nothing.
std::vector<char> facets_seen(const TriangleSet& surface, const TriangleTree& tree, double diagonal,
                              const CancellationCheck& check_cancelled) {
    std::vector<char> is_seen(surface.facets.size(), 0);
    for (std::int32_t f = 0; f < count_of(is_seen); ++f) {
        check_cancelled.at(f);
        const auto& [a, b, c] = surface.facets[f];
        const Vec3 from = (surface.vertices[a] + surface.vertices[b] + surface.vertices[c]) / 3;
        const Vec3 across = doubled_area_vector(surface.vertices, surface.facets[f]).normalized();
        const auto is_other = [&](std::int32_t hit) { return hit != f; };
        const auto is_free = [&](const Vec3& way) {
            return std::isinf(tree.first_hit(from, way, no_length_of_wrap * diagonal, 2 * diagonal, is_other));
        };
        is_seen[f] = is_free(across) || is_free(-across);
    }
    return is_seen;
}

// Each facet has the patch of the nearest of the surface; single ones among others take that of their neighbours.
std::vector<std::int32_t> patches_of_wrap(const TriangleSet& wrap, const TriangleTree& tree,
                                          const std::vector<std::int32_t>& patch_before) {
    constexpr int sweeps = 4;
    std::vector<std::int32_t> patch(wrap.facets.size());
    for (std::size_t f = 0; f < patch.size(); ++f) {
        const auto& [a, b, c] = wrap.facets[f];
        const Vec3 centre = (wrap.vertices[a] + wrap.vertices[b] + wrap.vertices[c]) / 3;
        patch[f] = patch_before[tree.closest(centre).facet];
    }
    const std::vector<std::int32_t> partner = edge_partners(wrap.facets);
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::size_t f = 0; f < patch.size(); ++f) {
            const std::int32_t beside[] = {patch[partner[3 * f] / 3], patch[partner[3 * f + 1] / 3],
                                           patch[partner[3 * f + 2] / 3]};
            if (std::count(std::begin(beside), std::end(beside), patch[f]) > 1) continue;
            if (beside[0] == beside[1] || beside[0] == beside[2]) patch[f] = beside[0];
            if (beside[1] == beside[2]) patch[f] = beside[1];
        }
    return patch;
}

// Returns the volume between the facets and the middle of their box, which openings change little.
double bounded_volume(const TriangleSet& surface) {
    const Vec3 middle = box_around(surface.vertices).center();
    double six_volumes = 0;
    for (const auto& [a, b, c] : surface.facets) {
        const std::vector<Vec3>& p = surface.vertices;
        six_volumes += (p[a] - middle).cross(p[b] - middle).dot(p[c] - middle);
    }
    return std::abs(six_volumes) / 6;
}

// Tells a volume that is not what one may have taken the facets for.
std::string volume_text(const WrapReport& report) {
    constexpr double alike = 0.05;
    std::string text = fmt::format("; volume {:.6g}", report.volume);
    const double ratio = report.volume / report.volume_of_input;
    if (!(report.volume_of_input > 0) || std::abs(ratio - 1) < alike) return text;
    text += fmt::format(", where the facets bound about {:.6g}", report.volume_of_input);
    return text + (ratio < 1 ? ": bodies that overlap count once, and where an opening is wider than the gap, only "
                               "the wall around it is filled (a larger --gap, --fill-holes or --cap closes it)"
                             : ": hollows that nothing leads into may be filled, and thin walls be thicker");
}

// Puts the wrap into the soup, in the place of its surface.
void put_wrap_into(Soup& soup, TriangleSet wrap, std::vector<std::int32_t> patch) {
    Soup wrapped{std::move(wrap.vertices), std::move(wrap.facets), std::move(patch), std::move(soup.patch_names)};
    wrapped.notes = std::move(soup.notes);
    wrapped.patch_colours = std::move(soup.patch_colours);
    if (!soup.sides.empty()) wrapped.notes.emplace_back("Regions are one body in a wrap.");
    soup = std::move(wrapped);
}

}  // namespace

WrapReport wrap_lengths(const Soup& soup, const WrapOptions& options) {
    constexpr double least_gap = 5e-4, most_gap = 0.5, least_offset = 1e-3, most_offset = 0.5;  // of diagonal, of gap
    constexpr double facets_per_gap = 5;  // for an area of a squared gap
    constexpr double usual_facets = 1e5, too_many_facets = 5e6;
    const double diagonal = box_around_finite(soup.vertices).diagonal().norm(), area = area_to_wrap(soup);
    const auto gap_for = [&](double facets) { return std::sqrt(facets_per_gap * area / facets); };
    WrapReport report;
    report.gap = options.gap.number() > 0
                     ? options.gap.of(diagonal)
                     : std::clamp(gap_for(usual_facets), WrapOptions::usual_gap_share * diagonal, most_gap * diagonal);
    report.offset =
        options.offset.number() > 0 ? options.offset.of(diagonal) : WrapOptions::usual_offset_share * report.gap;
    if (!(report.gap >= least_gap * diagonal && report.gap <= most_gap * diagonal))
        throw Error(ErrorCode::usage,
                    fmt::format("--gap is {}, but it must be a length or, with %, a share of the diagonal ({:g}), from "
                                "{:g} % to {:g} %.",
                                options.gap.text(), diagonal, 100 * least_gap, 100 * most_gap));
    if (report.gap < gap_for(too_many_facets))
        throw Error(ErrorCode::usage, fmt::format("With --gap {} the wrap would have millions of facets. Use {:.2g} or "
                                                  "more.",
                                                  options.gap.text(), 1.05 * gap_for(too_many_facets)));
    if (!(report.offset >= least_offset * report.gap && report.offset <= most_offset * report.gap))
        throw Error(ErrorCode::usage,
                    fmt::format("--offset is {:.4g}, but it must be from a thousandth to half of the gap, which is "
                                "{:.4g}.",
                                report.offset, report.gap));
    return report;
}

double estimated_wrap_distance(const Soup& soup, const WrapOptions& options) {
    const WrapReport lengths = wrap_lengths(soup, options);
    return lengths.gap / 2 + lengths.offset;
}

WrapReport wrap(Soup& soup, const WrapOptions& options, const std::function<void()>& check_cancelled) {
    const std::vector<char> is_none = facets_without_area(soup);
    const auto facets_before = std::ssize(soup.facets);
    drop_facets(soup, is_none);
    drop_unused_vertices(soup);
    if (soup.facets.empty())
        throw Error(ErrorCode::input, "There is nothing to wrap: no facet has an area and finite coordinates.");
    const double diagonal = box_around_finite(soup.vertices).diagonal().norm();
    WrapReport report = wrap_lengths(soup, options);
    report.facets_before = facets_before;
    report.left_out = facets_before - std::ssize(soup.facets);

    const TriangleSet before = {std::move(soup.vertices), std::move(soup.facets)};
    const TriangleTree tree(before.vertices, before.facets);
    TriangleSet wrapped = pulled_back(alpha_wrap(before, report.gap / 2, report.offset, check_cancelled), tree,
                                      report.offset, check_cancelled);
    report.facets = std::ssize(wrapped.facets);
    report.volume = bounded_volume(wrapped);
    report.volume_of_input = bounded_volume(before);

    report.distance_to_input = proven_distance(wrapped.vertices, wrapped.facets, {}, tree, before.facets,
                                               no_length_of_wrap * diagonal, check_cancelled);
    const std::vector<char> seen = facets_seen(before, tree, diagonal, CancellationCheck(check_cancelled));
    report.seen = std::count(seen.begin(), seen.end(), char{1});
    report.distance_from_input =
        proven_distance(before.vertices, before.facets, seen, TriangleTree(wrapped.vertices, wrapped.facets),
                        wrapped.facets, no_length_of_wrap * diagonal, check_cancelled);
    std::vector<std::int32_t> patch = patches_of_wrap(wrapped, tree, soup.patch);
    put_wrap_into(soup, std::move(wrapped), std::move(patch));
    return report;
}

std::string to_text(const WrapReport& report) {
    const std::string left_out =
        report.left_out > 0 ? fmt::format(" ({} without area or finite coordinates left out)", grouped(report.left_out))
                            : "";
    return fmt::format(
        "{} facets around {}{}, gap {:.3g}, offset {:.3g}; at most {:.2g} from the input, whose {} "
        "visible facets are at most {:.2g} from it{}",
        grouped(report.facets), grouped(report.facets_before), left_out, report.gap, report.offset,
        report.distance_to_input, grouped(report.seen), report.distance_from_input, volume_text(report));
}

}  // namespace kerf

// Forecasts fall while the size grows, nearly as a power of it: so the size is found by the secant of logarithms (the
// Illinois variant of regula falsi), between one that gives too many tetrahedra and the diagonal. A remeshed surface
// depends on the size in ways that no forecast knows: then a few sizes are tried in full, each from the slope of the
// last two, and the closest is kept.
#include "run/prepare/cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "fill/volume/tet_forecast.h"
#include "run/prepare/remeshing.h"
#include "run/prepare/size_reader.h"
#include "surface/size/mean_edge.h"
#include "surface/size/volume_samples.h"

namespace kerf {

namespace {

constexpr int most_remeshings = 4, most_tries = 40;
constexpr double least_share = 1e-9;                                                 // of the diagonal, for sizes
constexpr double good_forecast = 0.005, good_remeshing = 0.05, noted_excess = 0.14;  // of the number of tetrahedra
constexpr double usual_slope = -2.3, flattest_slope = -0.8, steepest_slope = -3.2, largest_step = 4;
constexpr double usual_edge = 0.89, usual_longest = 1;  // of facets of a remeshed surface, over the wanted length

RunRequest with_edge(const RunRequest& request, double size) {
    RunRequest sized = request;
    sized.sizes = request.sizes.with_edge(size);
    return sized;
}

// Forecasts of the number of tetrahedra that a surface will be filled with for this request, by size. 0: no size.
class TetForecast {
 public:
    TetForecast(const Input& input, const RunRequest& request)
        : input_(input), surface_(input.complex.arrays()), request_(request) {
        places_ = read_size_field(request.sizes, surface_, input.patch_names);
    }
    double tets(double size, CoarseFacets coarse = CoarseFacets::kept) const {
        const MesherOptions mesher = mesher_for(size);
        return tets_at_facets(surface_, half_thickness(), mesher, coarse) +
               tets_inside(sized_volume_of(mesher.size), mesher);
    }
    // Forecast for a surface that this change will be made to first.
    double tets_after(SurfaceChange change, double size) const {
        if (change == SurfaceChange::remeshing) return tets_if_remeshed(size);
        return tets(size, change == SurfaceChange::division ? CoarseFacets::divided : CoarseFacets::kept);
    }

 private:
    double tets_if_remeshed(double size) const {
        const MesherOptions mesher = mesher_for(size);
        const FacetShape usual{usual_edge * size, usual_longest * size};
        const double of_facet = tets_at_facet(usual, size, half_thickness(), mesher);
        return of_facet * forecast_changed_facets(input_, with_edge(request_, size)) +
               tets_inside(sized_volume_of(mesher.size), mesher);
    }

    MesherOptions mesher_for(double size) const {
        return MesherOptions(request_.mesher, places_.with_constant(
                                                  size > 0 ? request_.sizes.with_edge(size).constant_max_volume() : 0));
    }
    double half_thickness() const { return input_.volume / input_.area; }
    double sized_volume_of(const SizeField& size) const {
        return sized_volume(size, surface_.vertices, surface_.facets, input_.volume);
    }

    const Input& input_;
    SurfaceArrays surface_;
    const RunRequest& request_;
    SizeField places_;  // the other sizes that are asked for
};

// Written as it is used.
double with_four_digits(double size) { return std::stod(fmt::format("{:.4g}", size)); }

// 0 if even the largest size gives more. `excess`: logarithm of the tetrahedra over those that are wanted, falling.
template <class Excess>
double find_root(double small, double large, const Excess& excess) {
    double at_large = excess(large);
    if (at_large > 0) return 0;
    double at_small = excess(small);
    for (int step = 0; at_small <= 0 && step < most_tries; ++step) at_small = excess(small /= 2);
    double low = std::log(small), high = std::log(large), middle = low;
    int side = 0;  // of the last try: where it is the same twice, the other end is pulled in (Illinois)
    for (int step = 0; step < most_tries; ++step) {
        middle = (low * at_large - high * at_small) / (at_large - at_small);
        const double value = excess(std::exp(middle));
        if (std::abs(value) < good_forecast) break;
        if (value > 0) {
            low = middle;
            at_small = value;
            if (std::exchange(side, 1) == 1) at_large /= 2;
        } else {
            high = middle;
            at_large = value;
            if (std::exchange(side, -1) == -1) at_small /= 2;
        }
    }
    return with_four_digits(std::exp(middle));
}

double forecast_size(const Input& input, const RunRequest& request, SurfaceChange change) {
    const TetForecast forecast(input, request);
    const double cells = request.sizes.cells;
    const double small = std::max(mean_edge_below(input.volume / cells), least_share * input.diagonal);
    return find_root(small, std::max(input.diagonal, 2 * small),
                     [&](double size) { return std::log(forecast.tets_after(change, size) / cells); });
}

// Returns the next size to be tried, by the slope of the forecasts for the last ones.
double next_size(const std::vector<FoundSize>& tried) {
    const FoundSize& last = tried.back();
    double slope = usual_slope;
    if (tried.size() > 1) {
        const FoundSize& before = tried[tried.size() - 2];
        slope = std::log(last.tets / before.tets) / std::log(last.size / before.size);
        slope = std::isfinite(slope) ? std::clamp(slope, steepest_slope, flattest_slope) : usual_slope;
    }
    const double factor = std::pow(last.tets / last.cells, -1 / slope);
    return with_four_digits(last.size * std::clamp(factor, 1 / largest_step, largest_step));
}

double excess_of(const FoundSize& found) { return std::log(found.tets / found.cells); }

SizedInput size_to_cells(Input input, const RunRequest& request, StageListener* listener) {
    const double size = forecast_size(input, request, SurfaceChange::none);
    const FoundSize found{request.sizes.cells, size, TetForecast(input, request).tets(size)};
    const RunRequest sized = with_edge(request, size);
    input = remesh_where_asked(std::move(input), sized, listener);
    return {std::move(input), sized.sizes, found};
}

SizedInput change_to_cells(const Input& input, const RunRequest& request, SurfaceChange change,
                           StageListener* listener) {
    SizedInput best;
    std::vector<FoundSize> tried;
    double size = forecast_size(input, request, change);
    if (size == 0 && change == SurfaceChange::division) return size_to_cells(input, request, listener);
    if (size == 0) size = with_four_digits(input.diagonal);
    while (true) {
        const RunRequest sized = with_edge(request, size);
        Input changed = remesh_where_asked(input, sized, listener);
        tried.push_back({request.sizes.cells, size, TetForecast(changed, request).tets(size)});
        const double excess = excess_of(tried.back());
        if (!best.found || std::abs(excess) < std::abs(excess_of(*best.found)))
            best = {std::move(changed), sized.sizes, tried.back()};
        if (std::abs(excess) < good_remeshing || tried.size() == most_remeshings) break;
        size = std::min(next_size(tried), with_four_digits(input.diagonal));
        if (size == tried.back().size) break;
    }
    best.found->remeshings = change == SurfaceChange::remeshing ? count_of(tried) : 0;
    return best;
}

// Rounded up to two digits, as an option takes it.
std::string enough(double tets) {
    const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(tets)) - 1));
    return fmt::format("{:.0f}", std::ceil(tets / unit) * unit);
}

// Empty if there will be as many as were asked for.
std::string note_of(const FoundSize& found, bool is_remeshed, const SizeOptions& sizes) {
    if (excess_of(found) < noted_excess) return "";
    return fmt::format(
        "--cells asks for {} tetrahedra, but {}{} need about {} at least: there are as few as they allow. "
        "{}sk for --cells {} or more.",
        short_number(found.cells), is_remeshed ? "the shape of the surface" : "the facets",
        sizes.depends_on_place() ? " and the sizes at places" : "", short_number(found.tets),
        is_remeshed ? "A" : "Use --surface remesh for larger facets, or a", enough(found.tets));
}

}  // namespace

SizeOptions forecast_sizes(const Input& input, const RunRequest& request) {
    if (request.sizes.cells == 0) return request.sizes;
    return request.sizes.with_edge(forecast_size(input, request, surface_change(input, request)));
}

SizedInput remesh_and_size(Input input, const RunRequest& request, StageListener* listener) {
    if (request.sizes.cells == 0)
        return {remesh_where_asked(std::move(input), request, listener), request.sizes, std::nullopt};
    const SurfaceChange change = surface_change(input, request);
    SizedInput sized = change == SurfaceChange::none ? size_to_cells(std::move(input), request, listener)
                                                     : change_to_cells(input, request, change, listener);
    const std::string note = note_of(*sized.found, change == SurfaceChange::remeshing, request.sizes);
    if (!note.empty()) sized.input.notes.push_back(note);
    return sized;
}

std::string found_size_text(const FoundSize& found) {
    const std::string size = found.size > 0 ? fmt::format("size {:.4g}", found.size) : "no size";
    return fmt::format("{} asked for: {}, about {} forecast{}", grouped(found.cells), size, short_number(found.tets),
                       found.remeshings > 1 ? fmt::format(", remeshed {} times", found.remeshings) : "");
}

}  // namespace kerf

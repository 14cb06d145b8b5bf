// Three questions are answered here: whether a surface is remeshed, divided or kept (change_of()), with which lengths
// and which deviation (remesh_task() and, where the body is slender, narrow_on_slender_bodies()), and what becomes of a
// refusal. A surface is remeshed where that is asked for, where it comes of a CAD file, or where slivers or facets
// beside thin layers would spoil cells; it is divided where facets are coarser than sizes; both can be turned off.
// Forecasts use the same functions as the change itself, so that a run and its forecast never disagree about what is
// done.
//
// A deviation that nobody gave is a twentieth of the wanted length, less where the body is thin, and volumes must then
// stay. Where nobody has asked for remeshing, or the surface is a wrap, a bound or volume that cannot be kept does not
// end the run: the facets stay and are divided instead. Lengths of regions are told to the remesher by labels
// (run/prepare/inside/labelled_facets.h), of a wall the smaller.
#include "run/prepare/remeshing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/parallel/process_memory.h"
#include "run/prepare/inside/facet_division.h"
#include "run/prepare/inside/labelled_facets.h"
#include "run/prepare/inside/periodicity.h"
#include "run/prepare/inside/thin_layers.h"
#include "run/prepare/size_reader.h"
#include "run/prepare/slivers.h"
#include "surface/complex/mass_properties.h"
#include "surface/remesh/remesh.h"
#include "surface/remesh/thickness.h"
#include "surface/size/mean_edge.h"
#include "surface/size/region_sizes.h"

namespace kerf {

namespace {

constexpr double largest_share = 0.05;   // of the diagonal, for the deviation
constexpr double smallest_share = 1e-9;  // coordinates have few more digits
// Longest edges where nothing else is wanted, as shares of the diagonal: coarse, medium and fine.
constexpr double longest_shares[] = {0.05, 0.03, 0.015};
// Deviations where none is given, as shares of the wanted length, or, if none is wanted, of the diagonal.
constexpr double share_of_length = 0.05, shares_of_diagonal[] = {2e-3, 5e-4, 1.5e-4};
// Bounds of the deviation where none is given, as shares of the median thickness of the body, and of that at each
// place.
constexpr double share_of_median_thickness = 0.05, share_of_thickness = 0.1;
constexpr double volume_tolerance = 1e-4;  // of the volume of a region, where no deviation is given
constexpr double bytes_per_facet = 280;    // bytes of the process for each facet while it remeshes
constexpr double deg_per_rad = 180 / std::numbers::pi;

std::vector<double> smallest_sines(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    std::vector<double> sines;
    sines.reserve(facets.size());
    for (const Triangle& t : facets) sines.push_back(smallest_sine(vertices[t[0]], vertices[t[1]], vertices[t[2]]));
    return sines;
}

double in_degrees(double sine) { return std::asin(std::min(1.0, sine)) * deg_per_rad; }

FacetAngles facet_angles(const SurfaceArrays& surface) {
    std::vector<double> sines = smallest_sines(surface.vertices, surface.facets);
    const auto first_percent = sines.begin() + std::ssize(sines) / 100;
    std::nth_element(sines.begin(), first_percent, sines.end());
    return {in_degrees(*std::min_element(sines.begin(), first_percent + 1)), in_degrees(*first_percent)};
}

// Lengths in space that the options ask for; the growth from the surface's own edges, which are to change, is not.
SizeField wanted_lengths(const RunRequest& options, const Input& input) {
    SizeOptions sizes = options.sizes;
    sizes.growth = 0;
    return read_size_field(sizes, input);
}

// The same on facets, of which those of a region may have a size of its own; of a wall the smaller one counts.
FacetSizes wanted_on_facets(const RunRequest& options, const Input& input) {
    const SizeField all = wanted_lengths(options, input);
    const Array<RegionIndex, double> volumes = max_volumes_of_regions(options.sizes, input);
    if (volumes.empty()) return all;
    const RegionSizes sizes(volumes);
    std::vector<RegionIndex> order;  // the finest first
    for (const RegionIndex region : volumes.ids()) order.push_back(region);
    const auto volume_of = [&](RegionIndex region) { return sizes.of(region, all).constant_volume(); };
    std::stable_sort(order.begin(), order.end(),
                     [&](RegionIndex a, RegionIndex b) { return volume_of(a) < volume_of(b); });
    Array<RegionIndex, std::int32_t> place(volumes.size());
    std::vector<SizeField> fields;
    for (const RegionIndex region : order) {
        place[region] = count_of(fields);
        fields.push_back(sizes.of(region, all));
    }
    const std::int32_t coarsest = count_of(fields) - 1;
    std::vector<std::int32_t> field;
    for (const FacetSides& sides : input.complex.all_sides()) {
        const auto place_of = [&](RegionIndex region) { return region.is_valid() ? place[region] : coarsest; };
        field.push_back(std::min(place_of(sides.back), place_of(sides.front)));
    }
    return {std::move(fields), std::move(field)};
}

// Edge where nothing else is wanted.
double longest_edge(const RunRequest& options, double diagonal) {
    const double max_volume = options.sizes.constant_max_volume();
    return max_volume > 0 ? std::min(mean_edge_below(max_volume), diagonal)
                          : longest_shares[static_cast<int>(options.sizes.fineness)] * diagonal;
}

double smallest_length(const SizeField& wanted, const SurfaceArrays& surface) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : surface.vertices) smallest = std::min(smallest, wanted.at(p));
    return smallest;
}

// Facets that spoil cells.
struct BadFacets {
    Slivers slivers;
    std::int64_t on_thin_layers = 0;

    bool are_too_wide() const { return kerf::spoil_cells(on_thin_layers, slivers.facets); }
    bool spoil_cells() const { return slivers.spoil_cells() || are_too_wide(); }
};

BadFacets find_bad_facets(const Input& input) {
    const Slivers slivers = find_slivers(input.complex);
    if (input.complex.region_count() == 1) return {slivers};
    const std::vector<char> is_thin = facets_on_thin_layers(label_facets(input.complex));
    return {slivers, std::count(is_thin.begin(), is_thin.end(), char{1})};
}

// The task of the remesher.
struct RemeshTask {
    LabelledFacets facets;
    RemeshOptions options;
    std::optional<Periodicity> periodicity = {};  // of the file's own facets
};

// Sets the length that is wanted at a point of a label, and the longest one, by the sizes of regions. `all`: the sizes
// of the other regions.
void want_lengths_of_regions(const RunRequest& options, const SizeField& all, const Input& input, RemeshTask& task) {
    const Array<RegionIndex, double> volumes = max_volumes_of_regions(options.sizes, input);
    if (std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume == 0; })) return;
    const RegionSizes sizes(volumes);
    double longest = 0;
    Array<RegionIndex, SizeField> fields;
    for (const RegionIndex r : volumes.ids()) {
        longest = std::max(longest, volumes[r] > 0 ? mean_edge_below(volumes[r]) : task.options.longest);
        fields.push_back(sizes.of(r, all));
    }
    task.options.wanted = [fields = std::move(fields), labels = task.facets.labels, usual = task.options.longest](
                              const Vec3& p, std::int32_t label) {
        double least = std::numeric_limits<double>::infinity();
        const auto& [front, back] = labels[label].sides;
        for (const RegionIndex region : {front, back}) {
            if (!region.is_valid()) continue;
            const SizeField& field = fields[region];
            least = std::min(least, field.is_empty() ? usual : field.at(p));
        }
        return least;
    };
    task.options.longest = longest;
}

// Whether more than one in fifty of the chosen facets is a sliver: they are not worth to be kept then.
bool has_many_slivers(const SurfaceArrays& surface, const std::vector<char>& is_chosen) {
    constexpr std::int64_t least = 50;
    std::vector<Triangle> chosen;
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
        if (is_chosen[f]) chosen.push_back(surface.facets[f]);
    return least * find_slivers(surface.vertices, chosen).count > std::ssize(chosen);
}

// Beside bodies edges are as they would be without the box of air around them, and on its faces as they are; bodies are
// on the other side of their facets.
void want_lengths_of_air(const Input& input, RemeshTask& task) {
    if (!input.enclosure) return;
    std::vector<char> is_face;  // by label
    for (const LabelledFacets::Label& label : task.facets.labels)
        is_face.push_back(input.enclosure->has_face(input.patch_names[label.patch]));
    RemeshOptions& options = task.options;
    const double beside_bodies = options.longest, on_faces = input.enclosure->edge;
    options.wanted = [is_face, beside_bodies, on_faces, wanted = options.wanted](const Vec3& p, std::int32_t label) {
        const double usual = is_face[label] != 0 ? on_faces : beside_bodies;
        return wanted ? std::min(usual, wanted(p, label)) : usual;
    };
    options.longest = std::max(beside_bodies, on_faces);
    options.walls.resize(task.facets.surface.facets.size(), 0);
    for (std::size_t f = 0; f < options.walls.size(); ++f)
        if (is_face[task.facets.surface.patch[f]] == 0) options.walls[f] = 1;
    options.reference_volume = input.reference_volume(input.volume);
}

// A deviation that is asked for says how much the shape may change; a wrap is another shape than the file's. Where
// curved cells follow, vertices are put on the faces of the model again, and the edges between them bulge.
bool may_change_volume(const Input& input, const RunRequest& options) {
    return options.deviation.number() > 0 || input.wrapped || (input.is_cad && options.has_curved_edges());
}

// Of air around bodies not more than the bodies would have without it: sizes may be wanted far from them.
double usual_deviation_of(const Input& input, const SizeField& wanted, const SurfaceArrays& surface,
                          Fineness fineness) {
    const double usual = usual_deviation(wanted, surface, input.body_diagonal(), fineness);
    return input.enclosure ? std::min(usual, usual_deviation({}, surface, input.body_diagonal(), fineness)) : usual;
}

// A deviation that nobody has asked for is that of a body which is not slender, see narrow_on_slender_bodies().
RemeshTask remesh_task(const Input& input, const SurfaceArrays& surface, const BadFacets& bad,
                       const RunRequest& options) {
    constexpr double share_of_gap = 0.1;  // a wrap is rough where it bridges
    const SizeField wanted = wanted_lengths(options, input);
    RemeshTask task = {label_facets(input.complex),
                       {.longest = longest_edge(options, input.body_diagonal()), .creases = input.creases}};
    RemeshOptions& result = task.options;
    result.walls = task.facets.walls;
    for (const LabelledFacets::Label& label : task.facets.labels) result.sides.push_back(label.sides);
    if (!wanted.is_empty()) result.wanted = [wanted](const Vec3& p, std::int32_t) { return wanted.at(p); };
    want_lengths_of_regions(options, wanted, input, task);
    if (options.deviation.number() > 0) {
        result.deviation = deviation_for(options.deviation, input.body_diagonal());
    } else {
        result.deviation = usual_deviation_of(input, wanted, surface, options.sizes.fineness);
        if (input.wrapped)
            result.deviation = std::max(result.deviation, share_of_gap * input.wrapped->gap);
        else
            result.share_of_thickness = share_of_thickness;
    }
    if (!may_change_volume(input, options)) result.volume_tolerance = volume_tolerance;
    if (const double growth = options.sizes.growth_beside_kept_facets(); growth > 0) result.growth = growth;
    const bool may_keep = options.remeshing == Remeshing::where_needed && !input.is_cad && !result.wanted;
    if (may_keep && !bad.are_too_wide()) result.kept = facets_away_from_slivers(task.facets.surface);
    if (!input.is_cad && !input.wrapped)
        task.periodicity = find_periodicity(task.facets.surface.vertices, task.facets.surface.facets);
    if (may_keep && task.periodicity && !has_many_slivers(task.facets.surface, task.periodicity->is_paired)) {
        result.kept.resize(task.facets.surface.facets.size(), 0);
        std::transform(result.kept.begin(), result.kept.end(), task.periodicity->is_paired.begin(), result.kept.begin(),
                       std::bit_or<char>());
        task.periodicity->is_kept = true;
    }
    want_lengths_of_air(input, task);
    return task;
}

SurfaceArrays marked_facets(const SurfaceArrays& surface, const std::vector<char>& marks) {
    SurfaceArrays marked;
    marked.vertices = surface.vertices;
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
        if (marks[f] != 0) marked.facets.push_back(surface.facets[f]);
    return marked;
}

// Makes a deviation that nobody has asked for smaller where most of the body is thin. Of the air around bodies,
// that of the bodies counts.
void narrow_on_slender_bodies(const Input& input, RemeshTask& task) {
    if (task.options.share_of_thickness == 0) return;
    double& deviation = task.options.deviation;
    const std::optional<SurfaceArrays> bodies =
        input.enclosure ? std::optional(marked_facets(task.facets.surface, task.options.walls)) : std::nullopt;
    const SurfaceArrays& surface = bodies ? *bodies : task.facets.surface;
    const std::vector<char> walls = bodies ? std::vector<char>(surface.facets.size(), 1) : task.facets.walls;
    const TriangleTree tree(surface.vertices, surface.facets);
    const double thickness = median_thickness(surface, tree, walls, deviation / share_of_median_thickness);
    deviation =
        std::max(smallest_share * input.body_diagonal(), std::min(deviation, share_of_median_thickness * thickness));
}

// Returns a note for users whose solvers join opposite sides, and who want to know whether they still match.
std::string note_of_periodicity(const Periodicity& periodicity) {
    const Vec3& period = periodicity.period;
    return fmt::format("Opposite sides match, {:.6g}, {:.6g} and {:.6g} apart along x, y and z: {}", period.x(),
                       period.y(), period.z(),
                       periodicity.is_kept ? fmt::format("their {} facets are kept, so that they still do.",
                                                         grouped(periodicity.paired_facets()))
                                           : "remeshed, they do not. --surface split keeps the facets.");
}

void check_memory(double facets, const RunRequest& options, double edge) {
    const double most = most_memory_bytes() / bytes_per_facet;
    if (facets <= most) return;
    // A twentieth more than the memory allows, so that it stays enough when it is rounded.
    const std::string way_out = options.sizes.depends_on_place() ? "Use larger sizes"
                                                                 : fmt::format("Use --size {:.2g} or larger",
                                                                               1.05 * edge * std::sqrt(facets / most));
    throw Error(ErrorCode::memory,
                fmt::format("The surface of these sizes would have about {} facets, but there is memory for {}. {}.",
                            short_number(facets), short_number(most), way_out));
}

// Tells of the share that is done, in hundredths, again and again.
void tell_of_remeshing(StageListener* listener, RemeshOptions& options) {
    if (!listener) return;
    const auto hundredths = std::make_shared<std::size_t>(0);
    options.check_cancelled = [listener, hundredths] { tell_progress(listener, "remesh", *hundredths, 100); };
    options.tell_share = [hundredths](double share) { *hundredths = static_cast<std::size_t>(100 * share); };
}

// Tells of steps, of nobody knows how many. Copies count together.
std::function<void()> step_counter(StageListener* listener) {
    if (!listener) return {};
    return [listener, steps = std::make_shared<std::size_t>(0)] { tell_progress(listener, "remesh", (*steps)++, 0); };
}

// Returns a note on remeshing that nobody has asked for.
std::string note_of_remeshing(const Input& input, const BadFacets& bad, const RemeshOptions& options) {
    if (input.is_cad)
        return "A CAD file has no triangles of its own: they are remeshed. --surface split keeps those of OpenCASCADE.";
    const std::string reason =
        !bad.are_too_wide()
            ? fmt::format("{} of {} facets have angles below 10 degrees, which would spoil the cells",
                          grouped(bad.slivers.count), grouped(bad.slivers.facets))
            : fmt::format(
                  "{} of {} facets are so wide beside a thin region that its cells would have angles below 10 "
                  "degrees",
                  grouped(bad.on_thin_layers), grouped(bad.slivers.facets));
    return fmt::format("{}: {} remeshed within {:.2g} (--deviation). --surface split keeps the facets.", reason,
                       options.kept.empty() ? "the surface is" : "these places are", options.deviation);
}

std::vector<std::string> region_names(const Complex& complex) {
    return {complex.region_names().begin(), complex.region_names().end()};
}

void refuse_changed_volumes(const Input& input) {
    if (count_changed_volumes(input) == 0) return;
    const Array<RegionIndex, double> now = region_volumes(input);
    const Array<RegionIndex, double>& before = input.remeshed->volumes_before;
    const auto change = [&](RegionIndex r) { return std::abs(now[r] - before[r]) / input.reference_volume(before[r]); };
    RegionIndex worst;
    for (const RegionIndex r : now.ids())
        if (!(change(r) <= change(worst))) worst = r;
    const std::string where = now.size() == 1 ? "" : fmt::format(" of {}", input.complex.region_names()[worst.value()]);
    throw Error(ErrorCode::verification,
                fmt::format("The remeshed surface holds another volume{} than the file: {:.6g} for {:.6g}, {:+.2f} %. "
                            "Keep the surface as it is by --surface split, or bound its changes by a --deviation of "
                            "yours, whose volume is not compared.",
                            where, now[worst], before[worst], 100 * (now[worst] - before[worst]) / before[worst]));
}

Input remeshed(Input input, const SurfaceArrays& before, const BadFacets& bad, const RunRequest& options,
               StageListener* listener) {
    RemeshTask task = remesh_task(input, before, bad, options);
    narrow_on_slender_bodies(input, task);
    RemeshOptions& wanted = task.options;
    if (options.remeshing == Remeshing::where_needed) input.notes.push_back(note_of_remeshing(input, bad, wanted));
    if (task.periodicity) input.notes.push_back(note_of_periodicity(*task.periodicity));
    check_memory(forecast_facets(task.facets.surface, wanted), options, wanted.longest);
    tell_of_remeshing(listener, wanted);
    if (wanted.check_cancelled) wanted.check_cancelled();
    Remeshed result = remesh(task.facets.surface, wanted);

    input.remeshed = {.facets_before = input.facets,
                      .facets_kept = std::count(wanted.kept.begin(), wanted.kept.end(), char{1}),
                      .angles_before = facet_angles(before),
                      .angles = facet_angles(result.surface),
                      .deviation = wanted.deviation,
                      .distance_to_input = result.report.distance_to_input,
                      .distance_from_input = result.report.distance_from_input,
                      .feature_edges = result.report.feature_edges,
                      .finer = wanted.wanted ? result.report.finer : FinerShares(),
                      .facets_by = result.report.facets_by,
                      .volumes_before = region_volumes(input),
                      .may_change_volume = may_change_volume(input, options)};
    if (result.report.facets_left > 0)
        input.notes.push_back(
            fmt::format("{} facets stay as they are, because no change of them stays within {:.2g}: "
                        "cells may be bad there.",
                        grouped(result.report.facets_left), wanted.deviation));
    input.complex = task.facets.to_complex(std::move(result.surface), region_names(input.complex));
    measure_input(input);
    refuse_changed_volumes(input);
    return input;
}

// A piece has the sides of its facet.
Complex with_pieces(const Complex& before, DividedSurface divided) {
    if (before.region_count() == 1) return Complex(Surface(std::move(divided.surface)));
    std::vector<FacetSides> sides;
    sides.reserve(divided.facet_before.size());
    for (const std::int32_t f : divided.facet_before) sides.push_back(before.sides(f));
    return {std::move(divided.surface), std::move(sides), region_names(before)};
}

Input divided(Input input, const SurfaceArrays& before, const RunRequest& options, StageListener* listener) {
    const FacetSizes wanted = wanted_on_facets(options, input);
    check_memory(forecast_divided_facets(before, wanted), options, longest_edge(options, input.body_diagonal()));
    DividedSurface result = divide_facets(before, wanted, CancellationCheck(step_counter(listener)));

    input.remeshed = {.facets_before = input.facets,
                      .facets_kept = result.kept,
                      .only_divided = true,
                      .angles_before = facet_angles(before),
                      .angles = facet_angles(result.surface),
                      .volumes_before = region_volumes(input)};
    input.complex = with_pieces(input.complex, std::move(result));
    measure_input(input);
    return input;
}

// A surface may be so rough, or so thin, that no bound can be kept. Its facets do.
Input remeshed_if_possible(Input input, const SurfaceArrays& before, const BadFacets& bad, const RunRequest& options,
                           StageListener* listener) {
    try {
        return remeshed(input, before, bad, options, listener);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::input && error.code() != ErrorCode::verification) throw;
        input.notes.push_back(fmt::format("The facets of the surface are kept. {}", error.what()));
        return divided(std::move(input), before, options, listener);
    }
}

SurfaceChange change_of(const Input& input, const BadFacets& bad, const RunRequest& options) {
    if (options.remeshing == Remeshing::never) return SurfaceChange::none;
    if (options.remeshing == Remeshing::always || input.is_cad || bad.spoil_cells()) return SurfaceChange::remeshing;
    if (options.sizes.cells > 0 || has_facets_to_divide(input.complex, wanted_on_facets(options, input)))
        return SurfaceChange::division;
    return SurfaceChange::none;
}

}  // namespace

SurfaceChange surface_change(const Input& input, const RunRequest& options) {
    return change_of(input, find_bad_facets(input), options);
}

// Whoever wants a size gets it: a bound that is much smaller would ask for finer facets wherever the surface is curved.
double usual_deviation(const SizeField& wanted, const SurfaceArrays& surface, double diagonal, Fineness fineness) {
    if (wanted.is_empty()) return shares_of_diagonal[static_cast<int>(fineness)] * diagonal;
    return std::clamp(share_of_length * smallest_length(wanted, surface), smallest_share * diagonal,
                      largest_share * diagonal);
}

double deviation_for(const Length& wanted, double diagonal) {
    const double deviation = wanted.of(diagonal);
    if (!(deviation >= smallest_share * diagonal && deviation <= largest_share * diagonal))
        throw Error(
            ErrorCode::usage,
            fmt::format("--deviation is {}, but it must be a length or, with %, a share of the diagonal ({:g}), "
                        "from 1e-7 % to 5 %.",
                        wanted.text(), diagonal));
    return deviation;
}

double forecast_changed_facets(const Input& input, const RunRequest& options) {
    const BadFacets bad = find_bad_facets(input);
    switch (change_of(input, bad, options)) {
        case SurfaceChange::none:
            break;
        case SurfaceChange::division:
            return forecast_divided_facets(input.complex.arrays(), wanted_on_facets(options, input));
        case SurfaceChange::remeshing: {
            const RemeshTask task = remesh_task(input, input.complex.arrays(), bad, options);
            return forecast_facets(task.facets.surface, task.options);
        }
    }
    return input.facets;
}

Input remesh_where_asked(Input input, const RunRequest& options, StageListener* listener) {
    const BadFacets bad = find_bad_facets(input);
    const SurfaceChange change = change_of(input, bad, options);
    if (change != SurfaceChange::remeshing)
        if (const std::string note = sliver_note(bad.slivers, input.path.empty() ? "" : "--surface remesh");
            !note.empty())
            input.notes.push_back(note);
    if (change == SurfaceChange::none) return input;
    const SurfaceArrays before = input.complex.arrays();
    if (change == SurfaceChange::division) return divided(std::move(input), before, options, listener);
    return input.wrapped || options.remeshing == Remeshing::where_needed
               ? remeshed_if_possible(std::move(input), before, bad, options, listener)
               : remeshed(std::move(input), before, bad, options, listener);
}

}  // namespace kerf

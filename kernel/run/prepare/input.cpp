// All ways to a surface go through check_files() and to_input(). check_files() does, in this order: exact welding, the
// ladder of repairs (surface/repair/repair.h), the wrap, points of regions, the diagnosis with its search for regions,
// regions that are left empty, and the box of air. The order is part of what users see: each step counts on the ones
// before. to_input() refuses a surface with errors, drops superfluous facets and orients the rest, and makes the
// complex; vertices and facets get keys of node 0, which are their numbers.
//
// Arrays of other programs are checked row by row first, in every build, because nothing behind that checks numbers
// again. Regions exclude the optimisation of the surface and patches by angles.
#include "run/prepare/input.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/hash.h"
#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "files/io/run_manifest.h"
#include "run/prepare/region_diagnosis.h"
#include "run/prepare/stage_listener.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/intersections.h"
#include "surface/diagnosis/optimisation.h"
#include "surface/enclosure/enclosure.h"
#include "surface/regions/region_finder.h"
#include "surface/regions/regions.h"
#include "surface/repair/repair.h"
#include "surface/wrap/wrap.h"

namespace kerf {

namespace {

SurfaceArrays with_input_keys(Soup soup) {
    SurfaceArrays arrays;
    arrays.vertex_key.resize(soup.vertices.size());
    arrays.facet_key.resize(soup.facets.size());
    std::iota(arrays.vertex_key.begin(), arrays.vertex_key.end(), make_key(input_node, 0));
    std::iota(arrays.facet_key.begin(), arrays.facet_key.end(), make_key(input_node, 0));
    arrays.vertices = std::move(soup.vertices);
    arrays.facets = std::move(soup.facets);
    arrays.patch = std::move(soup.patch);
    return arrays;
}

double diagonal_of(const Soup& soup) {
    const Box box = box_around_finite(soup.vertices);
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

// Points that the user gives are in place of those of the file.
void take_points(Soup& soup, const std::vector<RegionSeed>& seeds) {
    if (seeds.empty()) return;
    if (!soup.sides.empty())
        throw Error(ErrorCode::usage,
                    "--region is for facets that do not say what they bound, but this file has "
                    "regions. Leave it out.");
    soup.seeds = seeds;
}

// Moves vertices of a surface that is known to be clean.
void optimise(Soup& soup, std::int32_t sweeps, Input& input) {
    OptimisationOptions options;
    options.sweeps = sweeps;
    std::vector<Vec3> moved = optimise_nodes(soup.vertices, soup.facets, soup.patch, {}, options);
    if (const auto pairs = find_self_intersections(moved, soup.facets, 1); !pairs.empty())
        throw Error(
            ErrorCode::usage,
            fmt::format("{}: with --optimise-surface {} the facets {} and {} would intersect. Use fewer sweeps or "
                        "leave the option out.",
                        input.path, sweeps, pairs[0].first, pairs[0].second));
    for (std::size_t v = 0; v < moved.size(); ++v) {
        input.moved_vertices += moved[v] != soup.vertices[v];
        input.largest_move = std::max(input.largest_move, (moved[v] - soup.vertices[v]).norm());
    }
    soup.vertices = std::move(moved);
}

// Returns the bounds of cells by region. Among points with one name the smallest bound counts, for a body without
// regions that of all points.
Array<RegionIndex, double> largest_cells_of(const Soup& soup) {
    const bool is_single = soup.region_names.empty();
    Array<RegionIndex, double> largest(is_single ? 1 : soup.region_names.size(), 0);
    bool is_any = false;
    for (const RegionSeed& seed : soup.seeds) {
        const auto found = std::find(soup.region_names.begin(), soup.region_names.end(), seed.name);
        if ((!is_single && found == soup.region_names.end()) || !(seed.largest_cell > 0)) continue;
        double& own = largest[found - soup.region_names.begin()];
        own = own > 0 ? std::min(own, seed.largest_cell) : seed.largest_cell;
        is_any = true;
    }
    return is_any ? largest : Array<RegionIndex, double>();
}

// Puts the air in the place of the bodies.
void enclose_bodies(CheckedSoup& checked, const InputOptions& options, const std::function<void()>& check_cancelled) {
    Soup& soup = checked.soup;
    checked.orientation = apply_repairs(checked);
    if (options.feature_angle_deg > 0 && soup.patch_names.size() == 1 && soup.sides.empty())
        make_feature_patches(soup, options.feature_angle_deg);
    checked.enclosure = enclosure_around(box_around(soup.vertices), options.air);
    enclose(soup, *checked.enclosure, options.fill_voids, check_cancelled);
}

// Makes the input of a surface that was read or given. `advice`: a sentence for one that cannot be meshed.
Input to_input(CheckedSoup checked, const std::string& path, const InputOptions& options, const char* advice) {
    Input input;
    input.path = path;
    Soup& soup = checked.soup;
    if (!checked.diagnosis.clean()) {
        const bool is_open = checked.diagnosis.count(DefectKind::open_edge) > 0 && !options.repairs.cap;
        const std::string message =
            fmt::format("{}: {}{}{}", path, checked.diagnosis.summary(soup),
                        is_open ? " Ends of a vessel get patches of their own by --cap." : "", advice);
        throw UnfitSurface(message, std::move(checked));
    }
    const std::vector<std::string> gap_notes = notes_on_gaps(checked);
    const OrientationReport turned = apply_repairs(checked);
    input.orientation = checked.enclosure ? checked.orientation : turned;
    input.enclosure = checked.enclosure;
    input.tidied = checked.tidied;
    input.ladder = std::move(checked.ladder);
    input.wrapped = checked.wrapped;
    input.notes = soup.notes;
    for (const std::string& note : gap_notes) input.notes.push_back(note);
    if (!soup.sides.empty() && (options.feature_angle_deg > 0 || options.optimisation_sweeps > 0))
        throw Error(ErrorCode::usage,
                    fmt::format("{} has several regions, whose surfaces are neither optimised nor "
                                "divided into patches by angles. Leave --{} out.",
                                path, options.optimisation_sweeps > 0 ? "optimise-surface" : "feature-angle"));
    if (options.feature_angle_deg > 0 && soup.patch_names.size() == 1)
        make_feature_patches(soup, options.feature_angle_deg);
    if (options.optimisation_sweeps > 0) optimise(soup, options.optimisation_sweeps, input);
    input.patch_names = soup.patch_names;
    input.is_cad = soup.is_of_model;
    for (const ModelEdge& edge : soup.model_edges)
        if (edge.sharp != 0) input.creases.push_back(edge.vertices);
    if (soup.patch_colours.size() == soup.patch_names.size()) input.patch_colours = soup.patch_colours;
    input.diagonal = diagonal_of(soup);
    input.largest_cells = largest_cells_of(soup);
    if (!input.largest_cells.empty())
        input.notes.emplace_back(
            "The file bounds the volumes of cells in its regions: beside --size these hold, too. --size-region takes "
            "their place.");
    input.complex = make_complex(std::move(soup));
    measure_input(input);
    return input;
}

double area_of(const Complex& complex) {
    double area = 0;
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const auto [a, b, c] = complex.vertices(f);
        area += triangle_area(complex.point(a), complex.point(b), complex.point(c));
    }
    return area;
}

// Rows of an array that are refused, all in the elements, the first in words.
class RefusedRows {
 public:
    RefusedRows(const char* array, ElementKind kind) : array_(array), elements_{kind, {}, {}, {}} {}

    void add(std::int64_t row) { elements_.ids.push_back(row); }
    /// `describe`: returns the content of the row with this number, and the reason why it is wrong.
    template <class Describe>
    void throw_if_any(Describe describe) const {
        if (elements_.ids.empty()) return;
        const std::int64_t first = elements_.ids.front();
        const std::size_t more = elements_.ids.size() - 1;
        throw WrongRow(fmt::format("{}[{}] {}.{}", array_, first, describe(first),
                                   more > 0 ? fmt::format(" {} more rows are wrong alike.", more) : ""),
                       elements_);
    }

 private:
    const char* array_;
    ErrorElements elements_;
};

void check_sizes(const Soup& soup) {
    constexpr std::size_t most_vertices = std::numeric_limits<std::int32_t>::max();
    if (soup.vertices.size() > most_vertices || std::ssize(soup.facets) > most_facets)
        throw Error(ErrorCode::usage,
                    fmt::format("A surface has at most {} vertices and {} facets, but these are {} and "
                                "{}. Split it.",
                                most_vertices, most_facets, soup.vertices.size(), soup.facets.size()));
    if (soup.patch.size() != soup.facets.size())
        throw Error(ErrorCode::usage,
                    fmt::format("There are {} facets, but patch has {} rows. Give one for each facet, "
                                "or none.",
                                soup.facets.size(), soup.patch.size()));
    if (soup.region_names.empty() ? !soup.sides.empty() : soup.sides.size() != soup.facets.size())
        throw Error(ErrorCode::usage,
                    fmt::format("There are {} facets and {} names of regions, but sides has {} rows. Give one for each "
                                "facet, and a name for each region.",
                                soup.facets.size(), soup.region_names.size(), soup.sides.size()));
}

void check_rows(const Soup& soup) {
    const auto vertex_count = count_of(soup.vertices);
    const auto patch_count = count_of(soup.patch_names);
    RefusedRows infinite("vertices", ElementKind::vertex), beyond("facets", ElementKind::facet),
        repeated("facets", ElementKind::facet), unnamed("patch", ElementKind::facet),
        nowhere("sides", ElementKind::facet);
    for (std::size_t v = 0; v < soup.vertices.size(); ++v)
        if (!soup.vertices[v].allFinite()) infinite.add(v);
    std::int32_t smallest = vertex_count, largest = -1;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto& [a, b, c] = soup.facets[f];
        smallest = std::min({smallest, a, b, c});
        largest = std::max({largest, a, b, c});
        if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= vertex_count) beyond.add(f);
        if (a == b || b == c || c == a) repeated.add(f);
        if (soup.patch[f] < 0 || soup.patch[f] >= patch_count) unnamed.add(f);
    }
    const auto region_count = count_of(soup.region_names);
    for (std::size_t f = 0; f < soup.sides.size(); ++f)
        if (const auto [front, back] = soup.sides[f];
            std::min(front, back) < RegionIndex::none() || std::max(front, back) >= RegionIndex(region_count))
            nowhere.add(f);
    nowhere.throw_if_any([&](std::size_t f) {
        return fmt::format("is ({}, {}), but the {} regions are numbered from 0, and -1 is outside",
                           soup.sides[f].front.value(), soup.sides[f].back.value(), region_count);
    });
    infinite.throw_if_any(
        [&](std::size_t v) { return fmt::format("is ({}), which is not finite", fmt::join(soup.vertices[v], ", ")); });
    const bool is_from_1 = smallest == 1 && largest == vertex_count;
    beyond.throw_if_any([&](std::size_t f) {
        return fmt::format("is ({}), but the {} vertices are numbered from 0{}", fmt::join(soup.facets[f], ", "),
                           vertex_count, is_from_1 ? ", not from 1: take 1 from all corners" : "");
    });
    repeated.throw_if_any([&](std::size_t f) {
        return fmt::format("is ({}), but the corners of a facet differ", fmt::join(soup.facets[f], ", "));
    });
    unnamed.throw_if_any([&](std::size_t f) {
        return fmt::format("is {}, but the {} patches are numbered from 0", soup.patch[f], patch_count);
    });
}

std::string hash_of(const Soup& soup) {
    Hasher hasher;
    hasher.add(std::span<const Vec3>(soup.vertices));
    hasher.add(std::span<const Triangle>(soup.facets));
    hasher.add(std::span<const std::int32_t>(soup.patch));
    for (const std::string& name : soup.patch_names) hasher.add(std::span<const char>(name));
    for (const FacetSides& sides : soup.sides)
        hasher.add(std::span<const RegionIndex>(std::array{sides.front, sides.back}));
    for (const std::string& name : soup.region_names) hasher.add(std::span<const char>(name));
    return hash_text(hasher.digest());
}

// Gives defaults to arrays that were not given, and checks all.
void check_given(Soup& soup) {
    if (soup.patch.empty()) soup.patch.assign(soup.facets.size(), 0);
    check_sizes(soup);
    if (soup.patch_names.empty()) {
        const auto largest = std::max_element(soup.patch.begin(), soup.patch.end());
        const std::int32_t last = largest == soup.patch.end() ? 0 : std::max(0, *largest);
        for (std::int32_t p = 0; p <= last && p < count_of(soup.facets); ++p)
            soup.patch_names.push_back(fmt::format("patch_{}", p));
    }
    check_rows(soup);
}

Input input_of_arrays(Soup soup, const InputChoices& choices, const std::function<void()>& check_cancelled) {
    check_given(soup);
    const std::string hash = hash_of(soup);
    scale(soup, choices.options.scale);
    Input input =
        to_input(check_soup(std::move(soup), choices, 1, check_cancelled), name_of_arrays, choices.options, "");
    input.file_hash = hash;
    return input;
}

// Bodies that lie inside of others and fit are regions as they are: steps that make one body of all would leave the
// inner ones out. Nothing: there are no such bodies, or more is asked for than to mend what is wrong.
std::optional<CheckedSoup> bodies_that_fit(const InputFiles& files, const InputChoices& choices,
                                           double needle_angle_deg, const std::function<void()>& check_cancelled) {
    const RepairPlan& plan = choices.repairs;
    const bool are_bodies = files.soup.patch_names.size() > 1 && files.soup.sides.empty() && files.walls.empty() &&
                            choices.options.holes.empty();
    const bool may_lose_some =
        plan.find(RepairKind::intersections) != nullptr && plan.bodies == BodyRepair::as_found && choices.seeds.empty();
    if (!are_bodies || !may_lose_some || choices.options.wraps() || is_preparation(plan.steps.front().kind)) return {};
    for (const RepairKind kind : {RepairKind::caps, RepairKind::thicken, RepairKind::snap})
        if (plan.find(kind) != nullptr) return {};
    InputChoices as_read = choices;
    as_read.repairs = {};
    CheckedSoup checked = check_files(files, as_read, needle_angle_deg, check_cancelled);
    if (!checked.diagnosis.clean() || checked.soup.sides.empty()) return {};
    return checked;
}

}  // namespace

CheckedSoup check_files(InputFiles files, const InputChoices& choices, double needle_angle_deg,
                        const std::function<void()>& check_cancelled) {
    const InputOptions& options = choices.options;
    if (std::optional<CheckedSoup> as_read = bodies_that_fit(files, choices, needle_angle_deg, check_cancelled))
        return *std::move(as_read);
    CheckedSoup checked{std::move(files.soup), {}};
    checked.faces_of_patches = std::move(files.faces_of_patches);
    Soup& soup = checked.soup;
    TidyCounts& tidied = checked.tidied;
    if (!files.is_welded) tidied.welded_vertices = weld_exactly(soup);
    RepairPlan plan = choices.repairs;
    plan.are_walls |= !files.walls.empty() || !soup.seeds.empty();
    checked.ladder = repair(soup, plan, check_cancelled);
    tidied.unused_vertices = drop_unused_vertices(soup);
    if (options.wraps()) {
        checked.wrapped = wrap(soup, options.wrapping, check_cancelled);
        files = {{}, files.hash, {}, {}};  // a wrap is one body, whichever bodies were in it
    }
    take_points(soup, choices.seeds);
    const DiagnosisOptions diagnosis = {options.voids, needle_angle_deg};
    diagnose_regions(checked, files, diagnosis, options.fill_voids && !options.air.encloses());
    const std::vector<char>& dropped = checked.diagnosis.dropped;
    tidied.dropped_facets = std::count(dropped.begin(), dropped.end(), char{1});
    if (!options.holes.empty() && checked.diagnosis.clean()) {
        leave_regions_empty(soup, options.holes);
        checked.diagnosis = diagnose(soup, diagnosis);
    }
    if (options.air.encloses() && checked.diagnosis.clean()) {
        enclose_bodies(checked, options, check_cancelled);
        checked.diagnosis = diagnose(soup, diagnosis);
    }
    return checked;
}

CheckedSoup check_input(const std::string& path, const InputChoices& choices, double needle_angle_deg,
                        const std::function<void()>& check_cancelled) {
    return check_files(read_input_files(path, choices.options), choices, needle_angle_deg, check_cancelled);
}

CheckedSoup check_soup(Soup read, const InputChoices& choices, double needle_angle_deg,
                       const std::function<void()>& check_cancelled) {
    return check_files({std::move(read), {}, {}, {}}, choices, needle_angle_deg, check_cancelled);
}

CheckedSoup check_arrays(Soup soup, const InputChoices& choices, double needle_angle_deg,
                         const std::function<void()>& check_cancelled) {
    check_given(soup);
    scale(soup, choices.options.scale);
    return check_soup(std::move(soup), choices, needle_angle_deg, check_cancelled);
}

Complex make_complex(Soup soup) {
    if (soup.sides.empty()) return Complex(Surface(with_input_keys(std::move(soup))));
    std::vector<FacetSides> sides = std::move(soup.sides);
    std::vector<std::string> names = std::move(soup.region_names);
    return {with_input_keys(std::move(soup)), std::move(sides), std::move(names)};
}

OrientationReport apply_repairs(CheckedSoup& checked) {
    const Diagnosis diagnosis = std::exchange(checked.diagnosis, {});  // its numbers lose their meaning
    const std::vector<char>& dropped = diagnosis.dropped;
    if (std::find(dropped.begin(), dropped.end(), char{1}) != dropped.end()) {
        drop_facets(checked.soup, dropped);
        checked.tidied.unused_vertices += drop_unused_vertices(checked.soup);
    }
    if (!checked.soup.sides.empty()) return {};
    if (!diagnosis.orientation) return orient(checked.soup);
    turn_facets(checked.soup.facets, diagnosis.orientation->turned);
    return diagnosis.orientation->report;
}

Array<RegionIndex, double> max_volumes_of_regions(const SizeOptions& sizes, const Input& input) {
    Array<RegionIndex, double> volumes = sizes.max_volumes_of_regions(input.complex.region_names());
    if (input.largest_cells.empty()) return volumes;
    volumes.resize(input.largest_cells.size(), 0);
    for (const RegionIndex r : volumes.ids())
        if (volumes[r] == 0) volumes[r] = input.largest_cells[r];
    return volumes;
}

Input read_input(const std::string& path, const InputChoices& choices, StageListener* listener) {
    InputFiles files = read_input_files(path, choices.options);
    const std::string hash = files.hash;
    const std::size_t more = choices.options.more_files.size();
    const std::string all = more == 0 ? path : fmt::format("{} and {} more file{}", path, more, more == 1 ? "" : "s");
    if (!choices.repairs.only_prepares()) tell_progress(listener, "repair", 0, 0);
    Input input = to_input(check_files(std::move(files), choices, 1, cancellation_check(listener)), all,
                           choices.options, " Run kerf check on it for all defects.");
    input.path = path;
    input.file_hash = hash;
    return input;
}

Input make_input(std::vector<Vec3> vertices, std::vector<Triangle> facets, std::vector<std::int32_t> patch,
                 std::vector<std::string> patch_names, const InputChoices& choices,
                 const std::function<void()>& check_cancelled) {
    return input_of_arrays({std::move(vertices), std::move(facets), std::move(patch), std::move(patch_names)}, choices,
                           check_cancelled);
}

Input make_input(std::vector<Vec3> vertices, std::vector<Triangle> facets, std::vector<FacetSides> sides,
                 std::vector<std::string> region_names, std::vector<std::int32_t> patch,
                 std::vector<std::string> patch_names, const InputChoices& choices,
                 const std::function<void()>& check_cancelled) {
    Soup soup{std::move(vertices), std::move(facets), std::move(patch), std::move(patch_names)};
    soup.sides = std::move(sides);
    soup.region_names = std::move(region_names);
    return input_of_arrays(std::move(soup), choices, check_cancelled);
}

Array<RegionIndex, double> region_volumes(const Input& input) {
    Array<RegionIndex, double> volumes;
    for (const InputRegion& region : input.regions) volumes.push_back(region.volume);
    if (volumes.empty()) volumes.push_back(input.volume);
    return volumes;
}

std::int64_t facets_of_file(const Input& input) {
    if (input.wrapped) return input.wrapped->facets_before;
    return input.remeshed ? input.remeshed->facets_before : input.facets;
}

double volume_before_remeshing(const Input& input) {
    if (!input.remeshed) return input.volume;
    const std::vector<double>& volumes = input.remeshed->volumes_before;
    return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

std::int64_t count_changed_volumes(const Input& input) {
    if (!input.remeshed || input.remeshed->may_change_volume) return 0;
    const Array<RegionIndex, double> now = region_volumes(input);
    const Array<RegionIndex, double>& before = input.remeshed->volumes_before;
    std::int64_t changed = 0;
    for (const RegionIndex r : now.ids())
        changed += !(std::abs(now[r] - before[r]) <= largest_volume_change * input.reference_volume(before[r]));
    return changed;
}

void measure_input(Input& input) {
    const Complex& complex = input.complex;
    input.largest_coordinate = 0;
    for (std::int32_t v = 0; v < complex.vertex_count(); ++v)
        input.largest_coordinate = std::max(input.largest_coordinate, complex.point(v).cwiseAbs().maxCoeff());
    input.vertices = complex.vertex_count();
    input.facets = complex.facet_count();
    input.volume = input.volume_error = input.area = 0;
    input.components = input.genus = 0;
    input.regions.clear();
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
        const Surface surface = complex.surface_of(region);
        const MassProperties mass = mass_properties(surface);
        const std::int64_t shells = find_shells(surface).count;
        input.volume += mass.volume;
        input.volume_error += mass.volume_error;
        input.area += mass.area;
        input.components += shells;
        // V - E + F = 2 (c - g), E = 3 F / 2
        input.genus += shells - (surface.vertex_count() - surface.facet_count() / 2) / 2;
        if (complex.region_count() > 1)
            input.regions.push_back({surface.facet_count(), shells, mass.volume, mass.volume_error, mass.area});
    }
    if (complex.region_count() > 1) input.area = area_of(complex);
}

}  // namespace kerf

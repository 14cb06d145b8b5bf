// From the texts of options to sources of sizes. Each kind of text has one parser, which check() calls for its errors
// alone and make_size_field() for its values, so that both accept the same texts; `form_...` are the forms that
// messages show. Lengths may be percentages until resolve_lengths() has rewritten the texts, and are used as numbers
// only after that. An unknown patch is found out in make_size_field(), because only the surface knows its patches.
#include "surface/size/size_options.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/name_pattern.h"
#include "base/geometry/box.h"
#include "surface/size/inside/surface_sizes.h"
#include "surface/size/mean_edge.h"

namespace kerf {

namespace {

constexpr double least_told_rel = 1e-4;  // of the diagonal: sizes that follow from curvature and thickness
constexpr const char* form_of_solids =
    "box:x0,y0,z0,x1,y1,z1=H, sphere:x,y,z,r=H or cylinder:x0,y0,z0,x1,y1,z1,r=H, such as sphere:0,0,0,2.5=0.1";
constexpr const char* form_on_patch = "NAME=H, such as inlet=0.1";
constexpr const char* form_in_region = "NAME=H, such as bone=0.1";
constexpr const char* form_near_patch = "NAME=H:D, such as inlet=0.1:2";

[[noreturn]] void refuse_text(const char* option, const std::string& text, const char* form) {
    throw Error(ErrorCode::usage, fmt::format("'{}' is no value of --{}. It has the form {}; lengths are positive, in "
                                              "units of the input, or with % of its diagonal.",
                                              text, option, form));
}

bool has_normal_volume(double edge) { return std::isnormal(largest_volume_for(edge)); }

// A wanted edge length: positive, with a volume that a double can hold. 0 if the text is none.
Length size_in(std::string_view text) {
    const std::optional<Length> length = length_in(text);
    return length && length->number() > 0 && has_normal_volume(length->number()) ? *length : Length();
}

// The parts of a text before and behind the last `mark`.
struct Halves {
    std::string before, behind;
    Halves(const std::string& text, char mark) {
        const std::size_t place = text.rfind(mark);
        before = text.substr(0, place);
        if (place != text.npos) behind = text.substr(place + 1);
    }
};

Vec3 point_of(std::span<const double> numbers) { return {numbers[0], numbers[1], numbers[2]}; }

// False if the text has not the form of a solid.
bool add_solid(const std::string& text, SizeSources& sources) {
    const Halves halves(text, '=');
    const Length wanted = size_in(halves.behind);
    const std::size_t colon = halves.before.find(':');
    if (wanted.number() == 0 || colon == std::string::npos) return false;
    const double size = wanted.number();
    const std::string kind = halves.before.substr(0, colon);
    const std::vector<double> n = numbers_in(std::string_view(halves.before).substr(colon + 1));
    const bool has_radius = !n.empty() && n.back() > 0;
    if (kind == "box" && n.size() == 6) {
        const Vec3 a = point_of(n), b = point_of(std::span(n).subspan(3));
        sources.boxes.push_back({a.cwiseMin(b), a.cwiseMax(b), size});
    } else if (kind == "sphere" && n.size() == 4 && has_radius) {
        sources.spheres.push_back({point_of(n), n[3], size});
    } else if (kind == "cylinder" && n.size() == 7 && has_radius) {
        const Vec3 from = point_of(n), to = point_of(std::span(n).subspan(3));
        if (from == to) return false;
        sources.cylinders.push_back({from, to, n[6], size});
    } else {
        return false;
    }
    return true;
}

struct PatchSize {
    std::string name;  // '*' stands for any characters
    Length size, reach;
};

PatchSize parse_named_size(const char* option, const std::string& text, const char* form) {
    const Halves halves(text, '=');
    const PatchSize wanted{halves.before, size_in(halves.behind), 0};
    if (wanted.name.empty() || wanted.size.number() == 0) refuse_text(option, text, form);
    return wanted;
}
PatchSize parse_on(const std::string& text) { return parse_named_size("size-on", text, form_on_patch); }
PatchSize parse_in_region(const std::string& text) { return parse_named_size("size-region", text, form_in_region); }

PatchSize parse_near(const std::string& text) {
    const Halves halves(text, '='), numbers(halves.behind, ':');
    const PatchSize wanted{halves.before, size_in(numbers.before), length_in(numbers.behind).value_or(-1)};
    if (wanted.name.empty() || wanted.size.number() == 0 || !(wanted.reach.number() >= 0))
        refuse_text("size-near", text, form_near_patch);
    return wanted;
}

void append(std::vector<SizedTriangle>& all, const std::vector<SizedTriangle>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

// Noise of coordinates has any curvature, and walls may touch: sizes that follow from these have a lower limit.
std::vector<SizedTriangle> no_smaller_than(double least, std::vector<SizedTriangle> sized) {
    for (SizedTriangle& t : sized)
        for (double& size : t.size) size = std::max(size, least);
    return sized;
}

std::vector<SizedTriangle> sizes_of_surface(const SizeOptions& options, const SurfaceArrays& surface,
                                            const std::vector<std::string>& patch_names) {
    const double least = least_told_rel * box_around(surface.vertices).diagonal().norm();
    std::vector<SizedTriangle> all;
    const auto add_patch = [&](const char* option, const PatchSize& wanted) {
        for (const std::int32_t patch : matching_names(option, "patch", wanted.name, patch_names))
            append(all, sizes_on_patch(surface, patch, wanted.size, wanted.reach));
    };
    for (const std::string& text : options.on) add_patch("--size-on", parse_on(text));
    for (const std::string& text : options.near) add_patch("--size-near", parse_near(text));
    if (options.growth > 0) append(all, sizes_of_edges(surface));
    if (options.chord_error > 0 || options.segments_per_turn > 0)
        append(all,
               no_smaller_than(least, sizes_of_curvature(surface, {options.chord_error, options.segments_per_turn})));
    if (options.cells_across > 0)
        append(all, no_smaller_than(least, sizes_of_thickness(surface, options.cells_across)));
    return all;
}

}  // namespace

void SizeOptions::check() const {
    require_in(size_range::length, "size", size.number());
    if (size.number() != 0 && !has_normal_volume(size.number()))
        refuse_number("size", size.text(), "such that its cube is a number of double precision");
    require_in(size_range::max_volume, "max-volume", max_volume);
    if (max_volume != 0 && !std::isnormal(max_volume))
        refuse_number("max-volume", fmt::format("{}", max_volume), "a number that double precision does not round off");
    require_in(size_range::cells, "cells", cells);
    const auto refuse_beside_cells = [&](const char* option, const std::string& text) {
        throw Error(ErrorCode::usage,
                    fmt::format("--cells is {} and --{} is {}, but each follows from the other. Leave "
                                "one of them out.",
                                cells, option, text));
    };
    if (cells > 0 && size.number() != 0) refuse_beside_cells("size", size.text());
    if (cells > 0 && max_volume != 0) refuse_beside_cells("max-volume", fmt::format("{}", max_volume));
    if (background && !field_file.empty())
        throw Error(ErrorCode::usage,
                    fmt::format("--size-field is {}, but sizes are given in memory, too. Leave one of "
                                "them out.",
                                field_file));
    require_in(size_range::growth, "growth", growth);
    require_in(size_range::length, "chord-error", chord_error.number());
    require_in(size_range::segments_per_turn, "segments-per-turn", segments_per_turn);
    require_in(size_range::cells_across, "cells-across", cells_across);
    SizeSources ignored;
    for (const std::string& text : inside)
        if (!add_solid(text, ignored)) refuse_text("size-in", text, form_of_solids);
    for (const std::string& text : on) parse_on(text);
    for (const std::string& text : in_region) parse_in_region(text);
    for (const std::string& text : near) parse_near(text);
}

void SizeOptions::resolve_lengths(double diagonal) {
    size = size.of(diagonal);
    if (chord_error.of(diagonal) > diagonal)  // and sizes that follow from it might be no numbers
        throw Error(ErrorCode::usage,
                    fmt::format("--chord-error is {}, but the whole surface is only {:.6g} from corner "
                                "to corner of its bounding box. Give less.",
                                chord_error.text(), diagonal));
    chord_error = chord_error.of(diagonal);
    // Only texts with a percentage are written anew.
    const auto resolved = [&](const std::string& text) {
        const std::optional<Length> length = length_in(text);
        return length && length->is_percent() ? fmt::format("{}", length->of(diagonal)) : text;
    };
    for (std::vector<std::string>* texts : {&inside, &on, &in_region})
        for (std::string& text : *texts)
            if (const Halves halves(text, '='); !halves.behind.empty())
                text = halves.before + "=" + resolved(halves.behind);
    for (std::string& text : near) {
        const Halves halves(text, '='), numbers(halves.behind, ':');
        if (numbers.behind.empty()) continue;
        text = halves.before + "=" + resolved(numbers.before) + ":" + resolved(numbers.behind);
    }
    check();
    max_volume = constant_max_volume();
}

SizeOptions SizeOptions::with_edge(double edge) const {
    SizeOptions options = *this;
    options.cells = 0;
    options.fineness = Fineness::medium;
    options.size = edge;
    options.max_volume = options.constant_max_volume();
    return options;
}

double SizeOptions::growth_beside_kept_facets() const {
    return follow_fineness() && fineness == Fineness::fine && growth == 0 ? usual_growth : growth;
}

double SizeOptions::constant_max_volume() const {
    return max_volume == 0 && size > 0 ? largest_volume_for(mean_over_size() * size) : max_volume;
}

Array<RegionIndex, double> SizeOptions::max_volumes_of_regions(std::span<const std::string> regions) const {
    Array<RegionIndex, double> volumes(in_region.empty() ? 0 : regions.size(), 0);
    std::set<std::string> names;
    for (const std::string& text : in_region) {
        const auto [name, wanted, reach] = parse_in_region(text);
        if (regions.empty())
            throw Error(ErrorCode::usage, fmt::format("--size-region names the region '{}', but the input is one body "
                                                      "without regions: --size is its size.",
                                                      name));
        if (!names.insert(name).second)
            throw Error(ErrorCode::usage, fmt::format("--size-region names the region '{}' twice.", name));
        const double largest = largest_volume_for(mean_over_size() * wanted.number());
        for (const std::int32_t region : matching_names("--size-region", "region", name, regions)) {
            double& volume = volumes[region];
            volume = volume > 0 ? std::min(volume, largest) : largest;
        }
    }
    return volumes;
}

SizeField make_size_field(const SizeOptions& options, const SurfaceArrays& surface,
                          const std::vector<std::string>& patch_names, std::optional<SizedMesh> background) {
    SizeSources sources;
    sources.growth = options.growth_or_usual();
    for (const std::string& text : options.inside) add_solid(text, sources);
    sources.triangles = SizedTriangles(sizes_of_surface(options, surface, patch_names));
    if (background) sources.backgrounds.emplace_back(*std::move(background), sources.growth);
    return {options.constant_max_volume(), std::move(sources), options.mean_over_size()};
}

}  // namespace kerf

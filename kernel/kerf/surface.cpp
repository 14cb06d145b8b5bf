// Surfaces of arrays and files, with errors that name all defects. Arrays become a Soup and go the way of a file
// (make_input(), run/prepare/input.h). Where that throws UnfitSurface, its defects are those of the diagnosis that it
// carries; where it throws another Error(input), the input is diagnosed once more as `kerf check` does, and if that
// finds nothing, the message itself is the defect. So a SurfaceError always has a defect at least.
#include <algorithm>

#include <fmt/format.h>

#include "files/io/output_file.h"
#include "kerf/inside/array_points.h"
#include "kerf/kerf.h"
#include "kerf/progress_listener.h"
#include "run/prepare/surface_file.h"
#include "run/report/file_diagnosis.h"
#include "run/request/run_request.h"

namespace kerf {

namespace {

// Returns whether the option is --surface wrap, the only choice of --surface that makes another surface; the others are
// for its mesh.
bool asks_for_wrap(const std::pair<std::string, std::string>& option) {
    return option.first == "surface" && option.second == "wrap";
}

InputOptions input_options(const NamedOptions& options) {
    InputOptions result;
    const std::vector<OptionField> fields = input_option_fields(result);
    for (const auto& option : options) {
        if (asks_for_wrap(option)) {
            result.wrap = true;
            continue;
        }
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == option.first; });
        if (field == fields.end())
            throw Error(ErrorCode::usage, fmt::format("--{} is no option of a surface.", option.first));
        field->set_text(option.second);
        if (option.first == "unit") result.cad.unit_is_asked = true;
    }
    result.check();
    return result;
}

SurfaceDefect surface_defect(const Defect& defect, const Soup& soup) {
    SurfaceDefect result{.kind = name(defect.kind),
                         .severity = name(defect.severity),
                         .facets = {},
                         .vertices = {},
                         .points = {},
                         .measure = defect.measure,
                         .regions = defect.bodies,
                         .advice = advice(defect),
                         .text = defect_text(defect, soup)};
    for (const std::int32_t f : soup.file_facets(defect.facets)) result.facets.push_back(f);
    for (const std::int32_t v : soup.file_vertices(defect.vertices)) result.vertices.push_back(v);
    for (const std::int32_t v : defect.vertices) {
        const Vec3& p = soup.vertices[v];
        result.points.push_back({p.x(), p.y(), p.z()});
    }
    if (result.points.empty()) result.points = {{defect.where.x(), defect.where.y(), defect.where.z()}};
    return result;
}

std::vector<SurfaceDefect> defects_of(const CheckedSoup& checked) {
    std::vector<SurfaceDefect> defects;
    for (const Defect& defect : checked.diagnosis.defects) defects.push_back(surface_defect(defect, checked.soup));
    return defects;
}

// Returns the reason why there is no surface that could have defects, as a defect.
SurfaceDefect refusal(const std::string& kind, const Error& error) {
    SurfaceDefect result{.kind = kind,
                         .severity = name(Severity::error),
                         .facets = {},
                         .vertices = {},
                         .points = {},
                         .measure = 0,
                         .regions = {},
                         .advice = {},
                         .text = error.what()};
    for (const ErrorElements& elements : error.elements()) {
        if (elements.kind == ElementKind::facet)
            result.facets.insert(result.facets.end(), elements.ids.begin(), elements.ids.end());
        else if (elements.kind != ElementKind::solid)
            result.vertices.insert(result.vertices.end(), elements.ids.begin(), elements.ids.end());
        result.points.insert(result.points.end(), elements.points.begin(), elements.points.end());
    }
    return result;
}

SurfaceCheck surface_check(const FileDiagnosis& found) {
    return {found.can_be_meshed(), to_text(found), to_json(found),
            found.refused ? std::vector<SurfaceDefect>{refusal(found.refused->kind, found.refused->error)}
                          : defects_of(found.checked)};
}

// Returns the surface of make(). Calls diagnose() for the defects where make() throws an Error(input) without them.
template <class Make, class Diagnose>
ClosedSurface surface_of(const Make& make, const Diagnose& diagnose) {
    try {
        return ClosedSurface(std::make_shared<const Input>(make()));
    } catch (const UnfitSurface& error) {
        throw SurfaceError(error, defects_of(error.checked()));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::input) throw;
        const std::vector<SurfaceDefect> defects = surface_check(diagnose()).defects;
        throw SurfaceError(error, !defects.empty() ? defects : std::vector{refusal("refused surface", error)});
    }
}

const Progress untold;  // making and checking a surface tell of no progress

Soup to_soup(std::span<const std::array<double, 3>> vertices, std::span<const std::array<std::int32_t, 3>> facets,
             std::span<const std::array<std::int32_t, 2>> sides, std::vector<std::string> region_names,
             std::span<const std::int32_t> patches, std::vector<std::string> patch_names) {
    Soup soup{
        to_points(vertices), {facets.begin(), facets.end()}, {patches.begin(), patches.end()}, std::move(patch_names)};
    soup.sides.reserve(sides.size());
    for (const auto& [behind, in_front] : sides) soup.sides.push_back({RegionIndex(in_front), RegionIndex(behind)});
    soup.region_names = std::move(region_names);
    return soup;
}

}  // namespace

ClosedSurface surface_from_arrays(std::span<const std::array<double, 3>> vertices,
                                  std::span<const std::array<std::int32_t, 3>> facets,
                                  std::span<const std::int32_t> patches, std::vector<std::string> patch_names,
                                  const NamedOptions& options, const IsCancelled& is_cancelled) {
    return surface_of_regions(vertices, facets, {}, {}, patches, std::move(patch_names), options, is_cancelled);
}

ClosedSurface surface_of_regions(std::span<const std::array<double, 3>> vertices,
                                 std::span<const std::array<std::int32_t, 3>> facets,
                                 std::span<const std::array<std::int32_t, 2>> sides,
                                 std::vector<std::string> region_names, std::span<const std::int32_t> patches,
                                 std::vector<std::string> patch_names, const NamedOptions& options,
                                 const IsCancelled& is_cancelled) {
    const InputOptions wanted = input_options(options);
    ProgressListener listener(untold, is_cancelled);
    const std::function<void()> check_cancelled = cancellation_check(&listener);
    const auto soup_of_all = [&] { return to_soup(vertices, facets, sides, region_names, patches, patch_names); };
    return surface_of(
        [&] {
            Soup soup = soup_of_all();
            return make_input(std::move(soup.vertices), std::move(soup.facets), std::move(soup.sides),
                              std::move(soup.region_names), std::move(soup.patch), std::move(soup.patch_names), wanted,
                              check_cancelled);
        },
        [&] { return diagnose_arrays(soup_of_all(), wanted, 1, check_cancelled); });
}

ClosedSurface surface_from_file(const std::string& path, const NamedOptions& options, const IsCancelled& is_cancelled) {
    const InputOptions wanted = input_options(options);
    ProgressListener listener(untold, is_cancelled);
    return surface_of([&] { return read_input(path, wanted, &listener); },
                      [&] { return diagnose_file(path, wanted, 1, cancellation_check(&listener)); });
}

void surface_to_file(const ClosedSurface& surface, const std::string& path) {
    const Complex& complex = surface.input().complex;
    require_surface_file("path", path, complex.region_count());
    require_writable("path", path, output_kind::surface);
    write_surface(path, complex, surface.patch_names());
}

SurfaceCheck check_file(const std::string& path, const NamedOptions& options, double needle_angle,
                        const IsCancelled& is_cancelled) {
    ProgressListener listener(untold, is_cancelled);
    return surface_check(diagnose_file(path, input_options(options), needle_angle, cancellation_check(&listener)));
}

SurfaceCheck check_arrays(std::span<const std::array<double, 3>> vertices,
                          std::span<const std::array<std::int32_t, 3>> facets,
                          std::span<const std::array<std::int32_t, 2>> sides, std::vector<std::string> region_names,
                          std::span<const std::int32_t> patches, std::vector<std::string> patch_names,
                          const NamedOptions& options, double needle_angle, const IsCancelled& is_cancelled) {
    ProgressListener listener(untold, is_cancelled);
    return surface_check(
        diagnose_arrays(to_soup(vertices, facets, sides, std::move(region_names), patches, std::move(patch_names)),
                        input_options(options), needle_angle, cancellation_check(&listener)));
}

}  // namespace kerf

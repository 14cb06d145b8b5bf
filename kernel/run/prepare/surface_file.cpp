#include "run/prepare/surface_file.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/obj_writer.h"
#include "files/io/stl_writer.h"
#include "files/io/surface_writers.h"

namespace kerf {

namespace {

std::string ending_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

// A closed group of facets for each region, so that a wall is there twice: read as bodies that touch.
void write_regions(const std::string& path, const Complex& complex) {
    const SurfaceArrays all = complex.arrays();
    std::vector<Triangle> facets;
    std::vector<std::int32_t> region_of_facet;
    for (const RegionIndex r : ids<RegionIndex>(complex.region_count()))
        for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
            const auto [front, back] = complex.sides(f);
            const auto& [a, b, c] = all.facets[f];
            if (front != r && back != r) continue;
            facets.push_back(back == r ? Triangle{a, b, c} : Triangle{a, c, b});
            region_of_facet.push_back(r.value());
        }
    write_obj(path, all.vertices, facets, region_of_facet,
              {complex.region_names().begin(), complex.region_names().end()});
}

void write_as_obj(const std::string& path, const Soup& soup) {
    write_obj(path, soup.vertices, soup.facets, soup.patch, soup.patch_names);
}
void write_as_stl(const std::string& path, const Soup& soup) { write_stl(path, soup.vertices, soup.facets); }

// How a format tells several regions apart.
enum class Regions { none, as_groups, as_sides };

struct SurfaceFormat {
    const char* ending;
    Regions regions;
    void (*write)(const std::string& path, const Soup& soup);
};

constexpr std::array surface_formats = {
    SurfaceFormat{".obj", Regions::as_groups, write_as_obj}, SurfaceFormat{".stl", Regions::none, write_as_stl},
    SurfaceFormat{".ply", Regions::none, write_ply},         SurfaceFormat{".off", Regions::none, write_off},
    SurfaceFormat{".vtp", Regions::as_sides, write_vtp},     SurfaceFormat{".vtk", Regions::as_sides, write_vtk}};

const SurfaceFormat& format_of(const std::string& what, const std::string& path) {
    const std::string ending = ending_of(path);
    for (const SurfaceFormat& format : surface_formats)
        if (format.ending == ending) return format;
    throw Error(ErrorCode::usage,
                fmt::format("{} is {}, but surfaces are written as .obj, .stl, .ply, .off, .vtp or .vtk.", what, path));
}

Soup soup_of(const Complex& complex, const std::vector<std::string>& patch_names) {
    SurfaceArrays surface = complex.arrays();
    Soup soup{std::move(surface.vertices), std::move(surface.facets), std::move(surface.patch), patch_names};
    if (complex.region_count() == 1) return soup;
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) soup.sides.push_back(complex.sides(f));
    soup.region_names.assign(complex.region_names().begin(), complex.region_names().end());
    return soup;
}

}  // namespace

void require_surface_file(const std::string& what, const std::string& path, std::int32_t region_count) {
    const SurfaceFormat& format = format_of(what, path);
    if (region_count == 1 || format.regions != Regions::none) return;
    const char* const article = format.ending == std::string_view(".ply") ? "a" : "an";
    throw Error(ErrorCode::usage,
                fmt::format("{} is {}, but the surface has {} regions, which {} {} cannot tell apart. "
                            "Write an .obj or a .vtp.",
                            what, path, region_count, article, format.ending));
}

void write_surface(const std::string& path, const Complex& complex, const std::vector<std::string>& patch_names) {
    const SurfaceFormat& format = format_of("path", path);
    if (complex.region_count() > 1 && format.regions == Regions::as_groups) return write_regions(path, complex);
    format.write(path, soup_of(complex, patch_names));
}

void write_surface(const std::string& path, const Soup& soup) {
    Soup facets = soup;
    facets.sides.clear();
    format_of("path", path).write(path, facets);
}

}  // namespace kerf

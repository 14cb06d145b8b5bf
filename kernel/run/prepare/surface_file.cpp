#include "run/prepare/surface_file.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/obj_writer.h"
#include "files/io/stl_writer.h"

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

void write(const std::string& path, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
           const std::vector<std::int32_t>& patch, const std::vector<std::string>& patch_names) {
    if (ending_of(path) == ".obj")
        write_obj(path, vertices, facets, patch, patch_names);
    else
        write_stl(path, vertices, facets);
}

}  // namespace

void require_surface_file(const std::string& what, const std::string& path, std::int32_t region_count) {
    const std::string ending = ending_of(path);
    if (ending != ".obj" && ending != ".stl")
        throw Error(ErrorCode::usage, fmt::format("{} is {}, but surfaces are written as .obj or .stl.", what, path));
    if (region_count > 1 && ending == ".stl")
        throw Error(ErrorCode::usage, fmt::format("{} is {}, but the surface has {} regions, which an .stl cannot tell "
                                                  "apart. Write an .obj.",
                                                  what, path, region_count));
}

void write_surface(const std::string& path, const Complex& complex, const std::vector<std::string>& patch_names) {
    if (complex.region_count() > 1) return write_regions(path, complex);
    const SurfaceArrays surface = complex.arrays();
    write(path, surface.vertices, surface.facets, surface.patch, patch_names);
}

void write_surface(const std::string& path, const Soup& soup) {
    write(path, soup.vertices, soup.facets, soup.patch, soup.patch_names);
}

}  // namespace kerf

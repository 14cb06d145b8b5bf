#include "run/input.h"

#include <numeric>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/error.h"
#include "io/surface_reader.h"
#include "surface/diagnosis.h"
#include "surface/mass_properties.h"

namespace kerf {

namespace {

SurfaceArrays with_input_keys(Soup soup) {
    SurfaceArrays arrays;
    arrays.vertex_key.resize(soup.vertices.size());
    arrays.facet_key.resize(soup.facets.size());
    std::iota(arrays.vertex_key.begin(), arrays.vertex_key.end(), make_key(0, 0));
    std::iota(arrays.facet_key.begin(), arrays.facet_key.end(), make_key(0, 0));
    arrays.vertices = std::move(soup.vertices);
    arrays.facets = std::move(soup.facets);
    arrays.patch = std::move(soup.patch);
    return arrays;
}

}  // namespace

Input read_input(const std::string& path) {
    Input input;
    input.path = path;
    Soup soup = read_surface(path);
    input.welded_vertices = weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    if (!diagnosis.clean()) throw Error(ErrorCode::input, fmt::format("{}: {}", path, diagnosis.summary()));
    input.unused_vertices = drop_unused_vertices(soup);
    input.orientation = orient(soup);
    input.patch_names = soup.patch_names;
    Eigen::AlignedBox3d box;
    for (const Vec3& p : soup.vertices) box.extend(p);
    input.diagonal = box.diagonal().norm();
    input.surface = Surface(with_input_keys(std::move(soup)));

    const MassProperties mass = mass_properties(input.surface);
    input.volume = mass.volume;
    input.area = mass.area;
    input.vertices = input.surface.vertex_count();
    input.facets = input.surface.facet_count();
    input.components = input.orientation.shells;
    input.genus = input.components - (input.vertices - input.facets / 2) / 2;  // V - E + F = 2 (c - g), E = 3 F / 2
    return input;
}

}  // namespace kerf

#include "run/input.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/error.h"
#include "io/surface_reader.h"
#include "surface/diagnosis.h"
#include "surface/intersections.h"
#include "surface/mass_properties.h"
#include "surface/optimisation.h"

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

}  // namespace

Input read_input(const std::string& path, std::int32_t optimisation_sweeps) {
    Input input;
    input.path = path;
    Soup soup = read_surface(path);
    input.welded_vertices = weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    if (!diagnosis.clean()) throw Error(ErrorCode::input, fmt::format("{}: {}", path, diagnosis.summary()));
    input.unused_vertices = drop_unused_vertices(soup);
    input.orientation = orient(soup);
    if (optimisation_sweeps > 0) optimise(soup, optimisation_sweeps, input);
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

#include "run/prepare/size_reader.h"

#include <cmath>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/tet_mesh_reader.h"

namespace kerf {

namespace {

// The only scalar, or the one that is called "size".
std::vector<double> sizes_at_nodes(const TetFile& file, const std::string& path) {
    const NodeScalar* found = nullptr;
    std::string names;
    for (const NodeScalar& scalar : file.node_scalars) {
        if (scalar.name == "size" || file.node_scalars.size() == 1) found = &scalar;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", scalar.name);
    }
    if (!found)
        throw Error(
            ErrorCode::input,
            names.empty()
                ? path + ": it has no scalar at its nodes. Save the wanted edge lengths as one."
                : fmt::format("{}: its nodes have the scalars {}. Call that of the edge lengths size.", path, names));
    for (std::size_t v = 0; v < found->values.size(); ++v)
        if (!(found->values[v] > 0 && std::isfinite(found->values[v])))
            throw Error(
                ErrorCode::input,
                fmt::format("{}: its scalar {} is {} at node {} (counted from 0), but edge lengths are positive.", path,
                            found->name, found->values[v], v));
    return found->values;
}

SizedMesh read_sized_mesh(const std::string& path) {
    TetFile file = read_tets_with_scalars(path);
    std::vector<double> size = sizes_at_nodes(file, path);
    return {std::move(file.mesh.vertices), std::move(file.mesh.tets), std::move(size)};
}

}  // namespace

SizeField read_size_field(const SizeOptions& options, const SurfaceArrays& surface,
                          const std::vector<std::string>& patch_names) {
    if (!options.depends_on_place()) return SizeField(options.constant_max_volume());
    std::optional<SizedMesh> background;
    if (!options.field_file.empty()) background = read_sized_mesh(options.field_file);
    if (options.background) background = *options.background;
    return make_size_field(options, surface, patch_names, std::move(background));
}

SizeField read_size_field(const SizeOptions& given, const Input& input) {
    SizeOptions options = given;
    if (input.enclosure && input.enclosure->wake) {
        const Box& wake = *input.enclosure->wake;
        options.inside.push_back(fmt::format("box:{},{}={}", fmt::join(wake.min(), ","), fmt::join(wake.max(), ","),
                                             input.enclosure->wake_edge));
    }
    return read_size_field(options, options.depends_on_place() ? input.complex.arrays() : SurfaceArrays(),
                           input.patch_names);
}

SizeOptions sizes_of_cells(const SizeOptions& options, const Input& input) {
    if (!input.enclosure) return options;
    SizeOptions sizes = options.constant_max_volume() > 0 ? options : options.with_edge(input.enclosure->edge);
    if (sizes.growth == 0) sizes.growth = SizeOptions::usual_growth;
    return sizes;
}

}  // namespace kerf

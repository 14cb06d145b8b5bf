// Checks the options and hands the surface to the mesher that they name.
#include "volume/mesher.h"

#include <fmt/format.h>

#include "core/error.h"
#include "volume/tetgen_adapter.h"

namespace kerf {

namespace {

void check(const MesherOptions& options) {
    // Written so that NaN fails.
    if (!(options.max_volume >= 0))
        throw Error(ErrorCode::usage,
                    fmt::format("The largest volume of a tetrahedron is {}. Give a positive number, or 0 for no bound.",
                                options.max_volume));
    if (!(options.radius_edge == 0 || options.radius_edge > 1))
        throw Error(
            ErrorCode::usage,
            fmt::format("The radius-edge ratio is {}. Give a number above 1, or 0 for no bound.", options.radius_edge));
}

}  // namespace

TetMesh mesh_volume(const SurfaceArrays& surface, const MesherOptions& options, std::uint32_t vertex_order_seed) {
    check(options);
    switch (options.kind) {
        case MesherKind::tetgen:
            return mesh_with_tetgen(surface, hole_points(surface), options, vertex_order_seed);
    }
    throw Error(ErrorCode::internal, "The mesher that the options name does not exist.");
}

}  // namespace kerf

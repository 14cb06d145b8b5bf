#include <fmt/format.h>

#include "base/core/error.h"
#include "fill/volume/meshers.h"

namespace kerf {

namespace {

std::vector<Vec3> hole_points_if_any(const SurfaceArrays& surface) {
    try {
        return hole_points(surface);
    } catch (const Error&) {
        return {};
    }
}

std::string smesh_text(const SurfaceArrays& surface) {
    std::string text = fmt::format("{} 3 0 0\n", surface.vertices.size());
    const auto add_point = [&](std::size_t i, const Vec3& p) {
        text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", i, p.x(), p.y(), p.z());
    };
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) add_point(v, surface.vertices[v]);
    text += fmt::format("{} 0\n", surface.facets.size());
    for (const Triangle& t : surface.facets) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    const std::vector<Vec3> holes = hole_points_if_any(surface);
    text += fmt::format("{}\n", holes.size());
    for (std::size_t i = 0; i < holes.size(); ++i) add_point(i + 1, holes[i]);
    return text;
}

}  // namespace

Reproducer smesh_reproducer(const SurfaceArrays& surface, const MesherOptions& options, std::string command) {
    Reproducer reproducer{.ending = ".smesh", .bytes = smesh_text(surface), .command = std::move(command), .note = ""};
    if (!options.size.is_constant() && options.tetgen.switches.empty())
        reproducer.note =
            "The wanted sizes differ from place to place: the command leaves them out, and may succeed where the run "
            "did not.\n";
    return reproducer;
}

}  // namespace kerf

#include "run/failed_part.h"

#include <filesystem>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/error.h"
#include "io/text_file.h"

namespace kerf {

namespace {

std::vector<Vec3> hole_points_if_any(const SurfaceArrays& surface) {
    try {
        return hole_points(surface);
    } catch (const Error&) {
        return {};  // a void without a hole point may be the very reason of the failure
    }
}

std::string smesh_text(const SurfaceArrays& surface, const std::vector<Vec3>& holes) {
    std::string text = fmt::format("{} 3 0 0\n", surface.vertices.size());
    const auto add_point = [&](std::size_t i, const Vec3& p) {
        text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", i, p.x(), p.y(), p.z());
    };
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) add_point(v, surface.vertices[v]);
    text += fmt::format("{} 0\n", surface.facets.size());
    for (const Triangle& t : surface.facets) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    text += fmt::format("{}\n", holes.size());
    for (std::size_t i = 0; i < holes.size(); ++i) add_point(i + 1, holes[i]);
    return text;
}

std::string tetgen_switches(const MesherOptions& mesher) {
    if (!mesher.tetgen_switches.empty()) return "pY" + mesher.tetgen_switches;
    std::string switches = "pY";
    if (mesher.radius_edge > 0) switches += fmt::format("q{:g}", mesher.radius_edge);
    if (mesher.tolerance > 0) switches += fmt::format("T{:g}", mesher.tolerance);
    if (!mesher.size.is_empty() && mesher.size.is_constant())
        switches += fmt::format("a{:g}", mesher.size.reference_volume());
    return switches;
}

// What the command of tetgen cannot say.
std::string note_on_sizes(const MesherOptions& mesher) {
    if (mesher.size.is_constant() || !mesher.tetgen_switches.empty()) return "";
    return "The wanted sizes differ from place to place: the command leaves them out, and may succeed where the run "
           "did not.\n";
}

// The bounding box.
std::string place_of(const SurfaceArrays& surface) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.vertices) box.extend(p);
    return fmt::format("between ({:.6g}, {:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g})", box.min().x(), box.min().y(),
                       box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

}  // namespace

void write_failed_part(const std::string& folder, int leaf, const SurfaceArrays& surface, const MesherOptions& mesher,
                       const std::string& reason) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error(ErrorCode::io, fmt::format("Cannot create {}: {}.", folder, error.message()));
    const std::string name = fmt::format("part_{:04}", leaf);
    write_text_file(folder + "/" + name + ".smesh", smesh_text(surface, hole_points_if_any(surface)));
    write_text_file(folder + "/" + name + ".txt",
                    fmt::format("{}\nIt lies {}.\nTo repeat: tetgen -{} {}.smesh\n{}To look at it: "
                                "paraview ../parts/{}.surface.vtu\n",
                                reason, place_of(surface), tetgen_switches(mesher), name, note_on_sizes(mesher), name));
}

}  // namespace kerf

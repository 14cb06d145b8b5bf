#include "run/work/failed_part.h"

#include <filesystem>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/geometry/box.h"
#include "files/io/run_folder.h"
#include "files/io/text_file.h"
#include "fill/volume/meshers.h"

namespace kerf {

namespace {

// Returns the bounding box as text.
std::string place_of(const SurfaceArrays& surface) {
    const Box box = box_around(surface.vertices);
    return fmt::format("between ({:.6g}, {:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g})", box.min().x(), box.min().y(),
                       box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

}  // namespace

void write_failed_part(const std::string& folder, NodeId leaf, const SurfaceArrays& surface,
                       const MesherOptions& mesher, const std::string& reason) {
    namespace fs = std::filesystem;
    const fs::path text = fs::path(folder) / failed_part_file_name(leaf), place = text.parent_path();
    std::error_code error;
    fs::create_directories(place, error);
    if (error) throw Error(ErrorCode::io, fmt::format("Cannot create {}: {}.", place.string(), error.message()));
    const std::string name = text.stem().string();
    const fs::path surface_file = fs::path(folder).parent_path() / "parts" / part_surface_file_name(leaf);
    const Reproducer reproducer = find_mesher(mesher.name).reproducer(surface, mesher, name);
    write_text_file((place / (name + reproducer.ending)).string(), reproducer.bytes);
    write_text_file(text.string(), fmt::format("{}\nIt lies {}.\nTo repeat: {}\n{}To look at it: paraview {}\n", reason,
                                               place_of(surface), reproducer.command, reproducer.note,
                                               surface_file.lexically_relative(place).string()));
}

}  // namespace kerf

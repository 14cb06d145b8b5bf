#include "work/failed_part.h"

#include <filesystem>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/error.h"
#include "geometry/box.h"
#include "io/text_file.h"
#include "volume/meshers.h"

namespace kerf {

namespace {

// The bounding box.
std::string place_of(const SurfaceArrays& surface) {
    const Box box = box_around(surface.vertices);
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
    const Reproducer reproducer = find_mesher(mesher.name).reproducer(surface, mesher, name);
    write_text_file(folder + "/" + name + reproducer.ending, reproducer.bytes);
    write_text_file(folder + "/" + name + ".txt",
                    fmt::format("{}\nIt lies {}.\nTo repeat: {}\n{}To look at it: paraview ../parts/{}.surface.vtu\n",
                                reason, place_of(surface), reproducer.command, reproducer.note, name));
}

}  // namespace kerf

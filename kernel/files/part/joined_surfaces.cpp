// Files of surfaces have the same arrays one after the other, so each array of the whole is a copy of theirs, file by
// file, in blocks of 256 KB; a file is opened once for each array, and memory does not depend on the surfaces. Only the
// numbers of vertices change: they go on from file to file, and the offsets and types of cells are computed. Names of
// patches and regions are those of the whole, since a part may have only the names that it uses.
#include "files/part/joined_surfaces.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/checked_file.h"
#include "files/io/vtk_cell_types.h"
#include "files/part/appended_vtu.h"
#include "files/part/inside/vtu_header.h"

namespace kerf {

namespace {

using Grid = VtuGrid<CheckedFile>;
using GridArray = VtuArray<CheckedFile>;

constexpr std::int64_t bytes_at_once = std::int64_t{1} << 18;  // bytes; whole values of every type

struct Piece {
    std::string path;
    VtuHeader header;
};

Piece open_piece(const std::string& path) {
    CheckedFile file(path, "rb");
    return {path, parse_vtu_header(file.read(vtu_header_limit), path)};
}

// Calls take(bytes) with the values of an array of the file, some at a time.
template <class Take>
void read_array(const Piece& piece, const std::string& name, std::int64_t item_bytes, Take take) {
    const VtuHeader::Array* array = piece.header.find(name);
    if (!array) fail_damaged_vtu(piece.path, fmt::format("it has no array {}", name));
    CheckedFile file(piece.path, "rb");
    file.seek(array->position + sizeof(std::uint64_t));
    for (std::int64_t left = array->components * array->tuples * item_bytes; left > 0;) {
        const std::string bytes = file.read(std::min(left, bytes_at_once));
        if (std::ssize(bytes) != std::min(left, bytes_at_once)) fail_damaged_vtu(piece.path, "it ends too early");
        take(bytes);
        left -= std::ssize(bytes);
    }
}

class JoinedSurfaces {
 public:
    explicit JoinedSurfaces(const std::vector<std::string>& paths) {
        for (const std::string& path : paths) {
            pieces_.push_back(open_piece(path));
            points_ += pieces_.back().header.point_count;
            cells_ += pieces_.back().header.cell_count;
        }
    }

    /// Returns the grid; each array has those of the files one behind the other.
    Grid grid(std::span<const std::string> patch_names, std::span<const std::string> region_names) const {
        Grid grid{points_, cells_, number_field(vtk_type<std::int64_t>, "BoundaryVertexCount", points_)};
        grid.arrays = {names_array<CheckedFile>("PatchNames", patch_names),
                       copied<std::int64_t>("PointData", "GlobalVertexId", 1, points_),
                       copied<std::int32_t>("CellData", "Part", 1, cells_),
                       copied<std::int32_t>("CellData", "Patch", 1, cells_),
                       copied<std::int32_t>("CellData", "Facet", 1, cells_),
                       copied<std::int32_t>("CellData", "Neighbour", 1, cells_),
                       copied<double>("Points", "Points", 3, points_),
                       GridArray::of<std::int64_t>("Cells", "connectivity", 1, 3 * cells_,
                                                   [this](CheckedFile& file) { write_connectivity(file); }),
                       computed<std::int64_t>("offsets", [](std::int64_t cell) { return 3 * (cell + 1); }),
                       computed<std::uint8_t>("types", [](std::int64_t) { return vtk_triangle; })};
        if (!region_names.empty()) {
            grid.add(names_array<CheckedFile>("RegionNames", region_names));
            grid.add(copied<std::int32_t>("CellData", "Region", 1, cells_));
        }
        return grid;
    }

 private:
    template <class T>
    GridArray copied(const char* section, const char* name, std::int64_t components, std::int64_t tuples) const {
        return GridArray::of<T>(section, name, components, tuples, [this, name](CheckedFile& file) {
            for (const Piece& piece : pieces_)
                read_array(piece, name, sizeof(T), [&](const std::string& bytes) { file.write(bytes); });
        });
    }

    template <class T, class Value>
    GridArray computed(const char* name, Value value) const {
        return GridArray::of<T>("Cells", name, 1, cells_,
                                [this, value](CheckedFile& file) { write_computed<T>(file, cells_, value); });
    }

    void write_connectivity(CheckedFile& file) const {
        std::int64_t before = 0;  // vertices of the pieces before
        std::vector<std::int64_t> numbers;
        for (const Piece& piece : pieces_) {
            read_array(piece, "connectivity", sizeof(std::int32_t), [&](const std::string& bytes) {
                numbers.clear();
                for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::int32_t)) {
                    std::int32_t vertex = 0;
                    bytes.copy(reinterpret_cast<char*>(&vertex), sizeof vertex, at);
                    numbers.push_back(before + vertex);
                }
                file.write(numbers.data(), numbers.size() * sizeof(std::int64_t));
            });
            before += piece.header.point_count;
        }
    }

    std::vector<Piece> pieces_;
    std::int64_t points_ = 0, cells_ = 0;
};

}  // namespace

std::string surfaces_pvtu_text(const std::vector<std::string>& pieces, std::span<const std::string> region_names) {
    return pvtu_text(JoinedSurfaces({}).grid({}, region_names).heads(), pieces);
}

void write_joined_surfaces(const std::string& path, const std::vector<std::string>& pieces,
                           std::span<const std::string> patch_names, std::span<const std::string> region_names) {
    CheckedFile file(path, "wb");
    JoinedSurfaces(pieces).grid(patch_names, region_names).write(file);
    file.close();
}

}  // namespace kerf

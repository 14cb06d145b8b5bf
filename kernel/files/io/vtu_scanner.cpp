// VTK's XML files are XML around arrays: FieldData and Piece > Points, Cells (of a surface: Verts, Lines, Polys,
// Strips), CellData > DataArray. First the structure of the whole file is read, with the place of each array in its
// bytes (files/io/inside/vtu_structure.h), then the values of the arrays that are needed, piece by piece
// (files/io/inside/vtu_arrays.h). Arrays of cells that are not read are passed over without decoding. Arrays with the
// regions on the sides of triangles count only if all pieces have both.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/inside/mesh_scanners.h"
#include "files/io/inside/vtk_cells.h"
#include "files/io/inside/vtu_arrays.h"
#include "files/io/inside/vtu_structure.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace vtu {

namespace {

// The cells of a surface: those of its lists, one behind the other.
void read_lists(const Decoder& decoder, const Piece& piece, Cells& cells) {
    for (const CellList& list : piece.lists) {
        if (list.cells == 0) continue;
        const auto ends = decoder.values<std::int64_t>(piece, list.element + "/offsets", list.cells);
        const auto corners = decoder.values<std::int64_t>(piece, list.element + "/connectivity", ends.back());
        const std::int64_t before = std::ssize(cells.corners);
        for (const std::int64_t end : ends)
            cells.ends.push_back(before + std::clamp<std::int64_t>(end, 0, std::ssize(corners)));
        cells.corners.insert(cells.corners.end(), corners.begin(), corners.end());
        cells.types.insert(cells.types.end(), list.cells, list.type);
    }
}

Cells read_cells(const Decoder& decoder, const Piece& piece, const std::string& region_array) {
    Cells cells;
    if (piece.lists.empty()) {
        cells.types = decoder.values<std::int64_t>(piece, "types", piece.cells);
        cells.ends = decoder.values<std::int64_t>(piece, "offsets", piece.cells);
        cells.corners = decoder.values<std::int64_t>(piece, "connectivity", piece.cells ? cells.ends.back() : 0);
    } else {
        read_lists(decoder, piece, cells);
    }
    const auto of_cells = [&](const char* name) {
        return piece.arrays.contains(name) ? decoder.values<std::int64_t>(piece, name, piece.cells)
                                           : std::vector<std::int64_t>();
    };
    cells.neighbours = of_cells(neighbour_array);
    cells.patches = of_cells(patch_array);
    if (!region_array.empty() && piece.cells > 0) cells.regions = of_cells(region_array.c_str());
    if (piece.cells > 0 && piece.arrays.contains(front_array) && piece.arrays.contains(back_array)) {
        cells.front = of_cells(front_array);
        cells.back = of_cells(back_array);
    }
    return cells;
}

// The array of cells that tells their regions; empty if there is none.
std::string region_array_of(const File& file) {
    for (const char* name : region_arrays) {
        const auto has_it = [&](const Piece& piece) { return piece.cells == 0 || piece.arrays.contains(name); };
        if (std::all_of(file.pieces.begin(), file.pieces.end(), has_it)) return name;
    }
    return {};
}

// Tells whether all pieces have the arrays of sides.
bool has_sides(const File& file) {
    return std::all_of(file.pieces.begin(), file.pieces.end(), [](const Piece& piece) {
        return piece.cells == 0 || (piece.arrays.contains(front_array) && piece.arrays.contains(back_array));
    });
}

// Returns the names in an array of field data, by the numbers that another one has for them.
Names names_in(const File& file, const Decoder& decoder, const char* names, const char* numbers) {
    const auto values = [&](const char* name) {
        const auto found = file.fields.find(name);
        return found == file.fields.end() ? std::vector<std::int64_t>()
                                          : decoder.values_of<std::int64_t>(found->second);
    };
    return names_of(values(names), values(numbers));
}

// Takes the scalars at the points of the last piece.
void take_scalars(const Decoder& decoder, const Piece& piece, const std::string& path, SoupBuilder& builder) {
    for (const auto& [name, array] : piece.scalars) {
        const std::vector<double> values = decoder.values_of<double>(array);
        if (std::ssize(values) != piece.points)
            fail(path, "its array " + name + " has not one value for each point. Save or copy it again.");
        std::copy(values.begin(), values.end(), builder.tets().scalar(name).end() - piece.points);
    }
}

}  // namespace

}  // namespace vtu

void scan_vtu(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    const vtu::File file = vtu::read_structure(bytes, path);
    const vtu::Decoder decoder(file, path);
    const std::string region_array = builder.wants_scalars() ? std::string() : vtu::region_array_of(file);
    vtu::CellTaker taker(path, vtu::names_in(file, decoder, "PatchNames", "PatchNumbers"), builder);
    for (const vtu::Piece& piece : file.pieces) {
        const std::vector<double> coordinates = decoder.values<double>(piece, "Points", 3 * piece.points);
        taker.add(coordinates, vtu::read_cells(decoder, piece, region_array));
        if (builder.wants_scalars()) vtu::take_scalars(decoder, piece, path, builder);
    }
    if (builder.wants_scalars()) return;
    taker.finish(vtu::names_in(file, decoder, "RegionNames", "RegionNumbers"), !region_array.empty(),
                 vtu::has_sides(file));
}

Soup read_vtu(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    scan_vtu(bytes, path, builder);
    return builder.finish();
}

}  // namespace kerf

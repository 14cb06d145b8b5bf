#include "files/export/inside/hdf5_arrays.h"

#include <algorithm>
#include <limits>

namespace kerf {

PieceRows rows_before(const MeshOutline& outline, PartIndex index) {
    PieceRows rows;
    for (const PartIndex i : IdRange(PartIndex(), index)) rows.add(outline.parts[i], outline.order);
    return rows;
}

namespace {

Hdf5Type type_for(std::int64_t largest) {
    return largest > std::numeric_limits<std::int32_t>::max() ? Hdf5Type::int64 : Hdf5Type::int32;
}

}  // namespace

Hdf5Type id_type(const MeshOutline& outline) { return type_for(outline.nodes()); }

const char* nodes_array(const MeshOutline& outline) {
    return outline.order == 1 ? "viz/topology/cells" : "viz/topology/cells10";
}

Hdf5Type corner_type(const MeshOutline& outline) {
    std::int64_t most = 0;
    for (const PartExtent& part : outline.parts) {
        PieceRows size;
        size.add(part, outline.order);
        most = std::max(most, size.corners);
    }
    return type_for(most);
}

std::string array_name(const PartValues& values) {
    std::string name = values.name;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

std::string piece_array_of(const PartValues& values) {
    const bool of_points = values.of == PartValues::Of::points;
    return (of_points ? "VTKHDF/PointData/" : "VTKHDF/CellData/") + array_name(values);
}

std::string whole_array_of(const PartValues& values) {
    const bool of_points = values.of == PartValues::Of::points;
    return (of_points ? "fields/vertices/" : "fields/cells/") + array_name(values);
}

std::vector<Hdf5Array> arrays_of(const MeshOutline& outline) {
    const std::int64_t parts = std::ssize(outline.parts);
    const PieceRows all = rows_before(outline, PartIndex(outline.parts.size()));
    const std::int64_t tets = outline.tets(), facets = outline.patch_facets();
    std::vector<Hdf5Array> arrays = {
        {"VTKHDF/NumberOfPoints", Hdf5Type::int64, parts},
        {"VTKHDF/NumberOfCells", Hdf5Type::int64, parts},
        {"VTKHDF/NumberOfConnectivityIds", Hdf5Type::int64, parts},
        {"VTKHDF/Points", Hdf5Type::real, all.points, 3},
        {"VTKHDF/PointData/GlobalVertexId", Hdf5Type::int64, all.points},
        {"VTKHDF/Connectivity", corner_type(outline), all.corners},
        {"VTKHDF/Offsets", corner_type(outline), all.offsets},
        {"VTKHDF/Types", Hdf5Type::byte, all.cells},
        {"VTKHDF/CellData/Part", Hdf5Type::int32, all.cells},
        {"VTKHDF/CellData/Patch", Hdf5Type::int32, all.cells},
        {"geometry/vertices", Hdf5Type::real, outline.nodes(), 3},
        {"viz/topology/cells", id_type(outline), tets, 4},
        {"viz/topology/facets", id_type(outline), facets, nodes_of_triangles(outline.order)},
        {"viz/body", Hdf5Type::int32, tets},
        {"viz/part", Hdf5Type::int32, tets},
        {"viz/patch", Hdf5Type::int32, facets},
    };
    if (outline.order == 2) arrays.push_back({nodes_array(outline), id_type(outline), tets, nodes_of_tets(2)});
    if (!outline.region_names.empty()) {
        arrays.push_back({"VTKHDF/CellData/Region", Hdf5Type::int32, all.cells});
        arrays.push_back({"viz/region", Hdf5Type::int32, tets});
    }
    for (const PartValues& values : outline.values) {
        const bool of_points = values.of == PartValues::Of::points;
        const std::int64_t columns = values.components == 1 ? 0 : values.components;
        arrays.push_back({piece_array_of(values), Hdf5Type::real, of_points ? all.points : all.cells, columns});
        arrays.push_back({whole_array_of(values), Hdf5Type::real, of_points ? outline.nodes() : tets, columns});
    }
    return arrays;
}

}  // namespace kerf

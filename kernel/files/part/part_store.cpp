// A file has a fixed head with the sizes, the boundary as one block of bytes (facets, patches, neighbours, global
// numbers of boundary vertices, names, regions, shared vertices and edges), then the points, then the tetrahedra, each
// as they lie in memory. So the surface is read from the front of a file, cells by one jump, and a part can be handed
// out in pieces. Interior vertices have no numbers in it: they follow each other, and the first one is known when all
// parts are counted. A worker can write its part without knowing the others. The sizes in the head are compared with
// that of the file before memory is taken; every vertex number is in range when a part is handed out, and StoredParts
// compares the hash of whole parts with that of the bytes that were written, too.
#include "files/part/part_store.h"

#include <array>
#include <filesystem>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/core/bytes.h"
#include "base/core/elements.h"
#include "base/core/error.h"
#include "files/io/checked_file.h"

namespace kerf {

namespace {

constexpr std::array<char, 8> magic = {'K', 'E', 'R', 'F', 'P', 'A', 'R', '3'};
constexpr std::uint64_t most_elements = std::uint64_t{1} << 31;

struct Head {
    std::array<char, 8> kind = magic;
    std::uint64_t boundary_bytes = 0, vertices = 0, tets = 0;
};

// The content of a part that grows with its boundary.
struct Boundary {
    Part& part;
    std::vector<std::int64_t> ids;

    template <class Archive>
    void archive(Archive& a) {
        a(part.id, part.mesh.boundary_vertex_count, part.facets, part.patch, part.facet, part.neighbour,
          part.tet_at_facet, ids, part.patch_names, part.region_names, part.regions, part.contact_vertices,
          part.contact_edges, part.shared, part.shared_edges);
    }
};

[[noreturn]] void fail_damaged(const std::string& path) {
    throw Error(ErrorCode::io, fmt::format("{} is damaged: the disk or the memory has changed it. Its part is meshed "
                                           "again when the run is continued.",
                                           path));
}

// Tells whether sizes and numbers fit together, but for the corners of tetrahedra.
bool is_consistent(const Part& part, std::size_t ids, std::uint64_t vertices, std::uint64_t tets) {
    const std::size_t facets = part.facets.size();
    const std::size_t boundary = part.mesh.boundary_vertex_count;
    const auto is_tet = [&](std::int32_t t) { return t >= -1 && std::cmp_less(t, tets); };
    bool holds = part.patch_names.is_consistent() && part.region_names.is_consistent() &&
                 part.mesh.boundary_vertex_count >= 0 && boundary <= vertices && ids == boundary &&
                 part.patch.size() == facets && part.facet.size() == facets && part.neighbour.size() == facets &&
                 part.tet_at_facet.size() == facets && are_in_range(part.facets, boundary) &&
                 std::all_of(part.tet_at_facet.begin(), part.tet_at_facet.end(), is_tet);
    for (const SharedGroup& group : part.shared)
        for (const std::int32_t v : group.vertices)
            holds = holds && v >= 0 && v < part.mesh.boundary_vertex_count && group.parts.size() > 1;
    for (const SharedEdgeGroup& group : part.shared_edges)
        holds = holds && are_in_range(group.edges, boundary) && group.parts.size() > 1;
    return holds;
}

// A damaged head must not ask for more memory than the file has bytes.
bool has_size_of(const Head& head, std::uint64_t bytes) {
    return std::max({head.boundary_bytes, head.vertices, head.tets}) <= most_elements &&
           bytes == sizeof head + head.boundary_bytes + head.vertices * sizeof(Vec3) + head.tets * sizeof(Tetrahedron);
}

template <class T>
void read_all(CheckedFile& file, const std::string& path, std::vector<T>& values, std::uint64_t count) {
    values.resize(count);
    if (file.read_into(static_cast<void*>(values.data()), count * sizeof(T)) != count * sizeof(T)) fail_damaged(path);
}

// Reads the head and the boundary, all that comes before the points.
Head read_beginning(CheckedFile& file, const std::string& path, Boundary& boundary) {
    Head head;
    if (file.read_into(&head, sizeof head) != sizeof head || head.kind != magic) fail_damaged(path);
    if (!has_size_of(head, file.size())) fail_damaged(path);
    Bytes bytes;
    read_all(file, path, bytes, head.boundary_bytes);
    try {
        ByteReader{bytes}(boundary);
    } catch (const Error&) {
        fail_damaged(path);
    }
    return head;
}

// Calls take(first, piece) with all values that follow, in pieces.
template <class T, class Take>
void read_pieces(CheckedFile& file, const std::string& path, std::uint64_t count, const Take& take) {
    constexpr std::uint64_t at_once = (std::uint64_t{2} << 20) / sizeof(T);
    std::vector<T> piece;
    for (std::uint64_t first = 0; first < count; first += piece.size()) {
        read_all(file, path, piece, std::min(at_once, count - first));
        take(first, piece);
    }
}

void number_vertices(Part& part, std::vector<std::int64_t> boundary_ids, std::uint64_t vertices,
                     std::int64_t first_interior_id) {
    const auto boundary = std::ssize(boundary_ids);
    part.global_id = std::move(boundary_ids);
    part.global_id.resize(vertices);
    std::iota(part.global_id.begin() + boundary, part.global_id.end(), first_interior_id);
}

}  // namespace

FileHash write_stored_part(const std::string& path, const Part& part, bool durable) {
    const std::ptrdiff_t boundary_count = part.mesh.boundary_vertex_count;
    const Bytes boundary =
        to_bytes(Boundary{const_cast<Part&>(part), {part.global_id.begin(), part.global_id.begin() + boundary_count}});
    const Head head{magic, boundary.size(), part.mesh.vertices.size(), part.mesh.tets.size()};
    Hasher hasher;
    CheckedFile file(path, "wb");
    file.hash_into(hasher);
    file.write(&head, sizeof head);
    file.write(boundary.data(), boundary.size());
    file.write(part.mesh.vertices.data(), part.mesh.vertices.size() * sizeof(Vec3));
    file.write(part.mesh.tets.data(), part.mesh.tets.size() * sizeof(Tetrahedron));
    if (durable) file.sync();
    file.close();
    return hasher.digest();
}

Part read_stored_part(const std::string& path, std::int64_t first_interior_id, PartContent content, FileHash* hash) {
    Hasher hasher;
    CheckedFile file(path, "rb");
    file.hash_into(hasher);
    Part part;
    Boundary boundary{part, {}};
    const Head head = read_beginning(file, path, boundary);
    const std::uint64_t vertices = content == PartContent::surface ? boundary.ids.size() : head.vertices;
    if (vertices > head.vertices) fail_damaged(path);
    if (content != PartContent::cells) read_all(file, path, part.mesh.vertices, vertices);
    if (content == PartContent::cells) file.seek(sizeof head + head.boundary_bytes + head.vertices * sizeof(Vec3));
    if (content == PartContent::all || content == PartContent::cells) read_all(file, path, part.mesh.tets, head.tets);
    if (!is_consistent(part, boundary.ids.size(), vertices, head.tets) || !are_in_range(part.mesh.tets, vertices))
        fail_damaged(path);
    if (hash) *hash = hasher.digest();
    number_vertices(part, std::move(boundary.ids), vertices, first_interior_id);
    return part;
}

Part StoredParts::load(PartIndex index) const {
    const Place& place = places_[index];
    FileHash hash;
    Part part = read_stored_part(place.path, place.first_interior_id, PartContent::all, &hash);
    if (hash != place.hash) fail_damaged(place.path);
    return part;
}

void StoredParts::load_in_pieces(PartIndex index, const PartPieces& take) const {
    const Place& place = places_[index];
    Hasher hasher;
    CheckedFile file(place.path, "rb");
    file.hash_into(hasher);
    Part part;
    Boundary boundary{part, {}};
    const Head head = read_beginning(file, place.path, boundary);
    if (!is_consistent(part, boundary.ids.size(), head.vertices, head.tets)) fail_damaged(place.path);
    number_vertices(part, std::move(boundary.ids), head.vertices, place.first_interior_id);
    take.boundary(part);
    read_pieces<Vec3>(file, place.path, head.vertices,
                      [&](std::size_t first, const std::vector<Vec3>& points) { take.points(part, first, points); });
    read_pieces<Tetrahedron>(file, place.path, head.tets, [&](std::size_t first, const std::vector<Tetrahedron>& tets) {
        if (!are_in_range(tets, head.vertices)) fail_damaged(place.path);
        take.cells(part, first, tets);
    });
    if (hasher.digest() != place.hash) fail_damaged(place.path);
}

void StoredParts::remove(PartIndex index) const {
    const std::string& path = places_[index].path;
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) throw Error(ErrorCode::io, fmt::format("Cannot remove {}: {}.", path, error.message()));
}

Part StoredParts::load_only(PartIndex index, PartContent content) const {
    const Place& place = places_[index];
    return content == PartContent::all ? load(index) : read_stored_part(place.path, place.first_interior_id, content);
}

}  // namespace kerf

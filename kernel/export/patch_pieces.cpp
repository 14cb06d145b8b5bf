#include "export/patch_pieces.h"

#include <algorithm>

namespace kerf {

namespace {

// `is_wanted`: of each vertex.
PatchPieces pieces_with(const Part& part, const std::vector<bool>& is_wanted) {
    std::vector<PatchPiece> all(part.patch_names.size());
    std::vector<std::vector<std::int32_t>> on_patch(all.size());  // triangles, also those that others list
    std::int32_t place = 0;
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        if (part.patch[f] < 0) continue;
        on_patch[part.patch[f]].push_back(f);
        if (!part.is_listed(f)) continue;
        all[part.patch[f]].facets.push_back(f);
        all[part.patch[f]].places.push_back(place++);
    }
    PatchPieces pieces;
    std::vector<bool> is_left = is_wanted;
    for (std::size_t patch = 0; patch < all.size(); ++patch) {
        if (on_patch[patch].empty()) continue;
        PatchPiece& piece = pieces.on_patches.emplace_back(std::move(all[patch]));
        piece.patch = static_cast<std::int32_t>(patch);
        for (const std::int32_t f : on_patch[patch])
            for (const std::int32_t v : part.facets[f]) {
                piece.box.extend(part.mesh.vertices[v]);
                if (is_left[v]) piece.vertices.push_back(v);
                is_left[v] = false;
            }
    }
    for (std::size_t v = 0; v < is_left.size(); ++v) {
        pieces.box.extend(part.mesh.vertices[v]);
        if (is_left[v]) pieces.inside.push_back(v);
    }
    return pieces;
}

}  // namespace

std::int64_t pieces_without_facets(const PatchPieces& pieces) {
    return std::count_if(pieces.on_patches.begin(), pieces.on_patches.end(),
                         [](const PatchPiece& piece) { return piece.facets.empty(); });
}

PatchPieces patch_pieces(const Part& part) {
    return pieces_with(part, std::vector<bool>(part.mesh.vertices.size(), true));
}

PatchPieces owned_patch_pieces(const Part& part) {
    const std::vector<NodeId> owner = owners_of_vertices(part);
    std::vector<bool> is_owned(owner.size());
    for (std::size_t v = 0; v < owner.size(); ++v) is_owned[v] = owner[v] == part.id;
    return pieces_with(part, is_owned);
}

}  // namespace kerf

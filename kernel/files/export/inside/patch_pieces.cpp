#include "files/export/inside/patch_pieces.h"

#include <algorithm>

#include "files/export/whole_mesh.h"

namespace kerf {

namespace {

// `is_wanted`: of each node.
PatchPieces pieces_with(const Part& part, const std::vector<bool>& is_wanted) {
    std::vector<PatchPiece> all(part.patch_names.end());
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
        piece.patch = patch;
        const auto add_nodes = [&](const auto& nodes) {
            for (const std::int32_t n : nodes) {
                piece.box.extend(part.node_point(n));
                if (is_left[n]) piece.nodes.push_back(n);
                is_left[n] = false;
            }
        };
        for (const std::int32_t f : on_patch[patch])
            part.order() == 1 ? add_nodes(part.facets[f]) : add_nodes(part.nodes_of_facet(f));
    }
    for (std::size_t n = 0; n < is_left.size(); ++n) {
        pieces.box.extend(part.node_point(n));
        if (is_left[n]) pieces.inside.push_back(n);
    }
    return pieces;
}

}  // namespace

std::int64_t pieces_without_facets(const PatchPieces& pieces) {
    return std::count_if(pieces.on_patches.begin(), pieces.on_patches.end(),
                         [](const PatchPiece& piece) { return piece.facets.empty(); });
}

PatchPieces patch_pieces(const Part& part) { return pieces_with(part, std::vector<bool>(part.node_count(), true)); }

PatchPieces owned_patch_pieces(const Part& part) { return pieces_with(part, own_nodes(part)); }

}  // namespace kerf

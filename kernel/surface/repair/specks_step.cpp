// Pieces that hang together over vertices are measured by their boxes, closed ones by their volume for their area, too.
#include <algorithm>

#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

constexpr double least_thickness = 1e-9;  // of a closed piece, of the diagonal of all

struct SpeckPiece {
    Box box;
    Vec3 origin = Vec3::Zero();
    double area = 0, volume = 0;
    bool is_closed = true;
    std::int32_t first = -1;

    double diagonal() const { return box.isEmpty() ? 0 : box.diagonal().norm(); }
    bool is_speck(double size, double diagonal_of_all) const {
        return diagonal() < size || (is_closed && std::abs(volume) < least_thickness * diagonal_of_all * area);
    }
};

Components hang_together(const Soup& soup) {
    UnionFind vertices(soup.vertices.size());
    for (const auto& [a, b, c] : soup.facets) {
        vertices.join(a, b);
        vertices.join(b, c);
    }
    return vertices.take();
}

std::vector<SpeckPiece> measure_pieces(const Soup& soup, const Components& of_vertices) {
    const Rims rims = find_rims(soup.facets);
    std::vector<SpeckPiece> pieces(of_vertices.count);
    for (std::int32_t f = 0; f < count_of(soup.facets); ++f) {
        const Triangle& t = soup.facets[f];
        SpeckPiece& piece = pieces[of_vertices.of[t[0]]];
        if (piece.first < 0) {
            piece.first = f;
            piece.origin = soup.vertices[t[0]];
        }
        const Vec3 area = area_vector(soup.vertices, t);
        piece.box.extend(box_around(soup.vertices, t));
        piece.area += area.norm();
        piece.volume += area.dot(soup.vertices[t[0]] - piece.origin) / 3;
        for (std::size_t side = 0; side < 3; ++side) piece.is_closed &= !rims.is_open[3 * f + side];
    }
    return pieces;
}

}  // namespace

void specks_step(Soup& soup, const StepRequest& request, StepReport& report) {
    if (soup.facets.empty()) return;
    const Components of_vertices = hang_together(soup);
    const std::vector<SpeckPiece> pieces = measure_pieces(soup, of_vertices);
    const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const SpeckPiece& a, const SpeckPiece& b) {
        return a.area != b.area ? a.area < b.area : a.diagonal() < b.diagonal();
    });
    RepairAction removed{"speck removed", "specks removed", "across"};
    removed.is_loss = true;
    std::vector<char> is_speck(pieces.size(), 0);
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
        if (piece->first < 0 || piece == largest || !piece->is_speck(request.amount, request.diagonal)) continue;
        is_speck[piece - pieces.begin()] = 1;
        removed.add({piece->box.center(), soup.file_facets({piece->first}), piece->diagonal()});
    }
    const bool is_any = removed.count > 0;
    report.actions.push_back(std::move(removed));
    if (!is_any) return;
    std::vector<char> drop;
    for (const Triangle& t : soup.facets) drop.push_back(is_speck[of_vertices.of[t[0]]]);
    drop_facets(soup, drop);
    drop_unused_vertices(soup);
}

}  // namespace kerf

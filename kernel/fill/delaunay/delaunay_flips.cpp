// A stack holds cells whose faces may have to be flipped (Lawson 1977, lawson1977; Joe 1991, joe1991). A face with the
// vertex e behind it, inside of the sphere of its cell with the vertex d, is flipped in one of two ways: two cells
// become three around the edge d e, where that edge passes through the inside of the face; or, where it passes beyond
// one edge p q of the face and just three cells lie around that, these become two. Other faces stay. Seen on the
// paraboloid, each flip replaces upper faces by lower ones, so that no cell comes back and the flips end; in_sphere()
// has no ties. A cell on the stack may have been replaced, or its number given to another one; its vertices as they
// were tell.
#include "fill/delaunay/delaunay_flips.h"

#include <array>
#include <numeric>
#include <vector>

#include "base/geometry/predicates.h"

namespace kerf {

namespace {

class DelaunayFlips {
 public:
    DelaunayFlips(EditableTets& tets, const std::function<void(CellId)>& on_made) : t_(tets), on_made_(on_made) {}

    void push(CellId cell) { cells_.push_back({cell, t_.vertices(cell)}); }

    std::int64_t run() {
        std::int64_t flips = 0;
        while (!cells_.empty()) {
            const Entry at = cells_.back();
            cells_.pop_back();
            if (at.cell.value() >= t_.cell_count() || t_.vertices(at.cell) != at.vertices) continue;
            for (int i = 0; i < 4; ++i)
                if (flip(cell_face(at.cell, i))) {
                    ++flips;
                    break;
                }
        }
        return flips;
    }

 private:
    struct Entry {
        CellId cell;
        Tetrahedron vertices;  // vertices of the cell when it was pushed
    };

    const Vec3& point(std::int32_t v) const { return t_.points()[v]; }
    int orientation_of(const Tetrahedron& v) const {
        return orientation(point(v[0]), point(v[1]), point(v[2]), point(v[3]));
    }

    bool flip(CellFace face) {
        if (t_.is_constrained(face)) return false;
        const CellFace behind = t_.mirror(face);
        const std::int32_t d = t_.opposite_vertex(face), e = t_.opposite_vertex(behind);
        const Tetrahedron& v = t_.vertices(cell_of(face));
        if (!in_sphere(point(v[0]), point(v[1]), point(v[2]), point(v[3]), point(e))) return false;
        const Triangle corners = t_.face_vertices(face);
        std::array<Tetrahedron, 3> three;
        int flat = 0, turned = -1;
        for (int i = 0; i < 3; ++i) {
            three[i] = {d, corners[i], corners[(i + 1) % 3], e};
            const int side = orientation_of(three[i]);
            if (side > 0) continue;
            ++flat;
            turned = i;
        }
        if (flat == 0) return replace(std::array{cell_of(face), cell_of(behind)}, three);
        return flat == 1 && remove_edge(face, corners[turned], corners[(turned + 1) % 3]);
    }

    // Replaces three cells around the edge between p and q by two. Returns false where that is not possible.
    bool remove_edge(CellFace face, std::int32_t p, std::int32_t q) {
        const Tetrahedron& vertices = t_.vertices(cell_of(face));
        EdgeRing ring;
        if (!find_ring(t_, cell_of(face), index_of(vertices, p), index_of(vertices, q), ring, 3) || ring.size() != 3)
            return false;
        for (std::size_t k = 0; k < 3; ++k)
            if (is_spoke_constrained(t_, ring, k)) return false;
        const std::array<Tetrahedron, 2> two = {Tetrahedron{ring.a, ring.ring[0], ring.ring[1], ring.ring[2]},
                                                Tetrahedron{ring.ring[0], ring.ring[1], ring.ring[2], ring.b}};
        if (orientation_of(two[0]) <= 0 || orientation_of(two[1]) <= 0) return false;
        return replace(std::array{ring.cells[0], ring.cells[1], ring.cells[2]}, two);
    }

    bool replace(std::span<const CellId> cells, std::span<const Tetrahedron> by) {
        for (const CellId made : t_.replace(cells, by)) {
            push(made);
            on_made_(made);
        }
        return true;
    }

    EditableTets& t_;
    const std::function<void(CellId)>& on_made_;
    std::vector<Entry> cells_;
};

}  // namespace

std::int64_t flip_to_delaunay(EditableTets& tets) {
    std::vector<CellId> all(tets.cell_count());
    std::iota(all.rbegin(), all.rend(), CellId(0));
    return flip_to_delaunay(tets, all, [](CellId) {});
}

std::int64_t flip_to_delaunay(EditableTets& tets, std::span<const CellId> cells,
                              const std::function<void(CellId cell)>& on_made) {
    DelaunayFlips flips(tets, on_made);
    for (const CellId cell : cells) flips.push(cell);
    return flips.run();
}

}  // namespace kerf

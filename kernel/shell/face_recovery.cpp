// An edge that is missing is crossed by faces, and a triangle whose edges are there by edges. What is in the way is
// removed by flips, nearest to the start first.
#include "shell/face_recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>

#include <Eigen/Geometry>

#include "delaunay/faces.h"
#include "geometry/predicates.h"
#include "shell/ring_flips.h"

namespace kerf {

namespace {

constexpr int most_flips_of_an_edge = 40;
// In each round, how deep: to remove an edge, others around it are removed first, and others around these.
constexpr std::array depth_of_round = {0, 0, 1, 2, 2, 2, 2, 2};
// From this one on vertices are added where nothing else helps.
constexpr std::size_t first_round_with_vertices = 3;
// With more of all triangles still lost there, those that are thin and close together, it would take long, and fail.
constexpr double most_lost_share = 0.1;
constexpr int most_vertices_of_a_triangle = 3;  // a round
constexpr int most_places_of_a_vertex = 4;
constexpr double farthest_behind = 0.4;  // of a triangle's longest edge
constexpr int most_rings_of_an_edge = 400;

// Where the line from a to b leaves the cells around a.
struct Crossing {
    std::int32_t cell = Triangulation::none;  // that has b, or through whose face the line leaves
    CellFace face = Triangulation::none;      // opposite to a
    std::array<std::int32_t, 2> edge = {Triangulation::none, Triangulation::none};  // if it leaves through an edge
    bool has_end = false;                                                           // the cell has b
};

class FaceRecovery {
 public:
    FaceRecovery(Triangulation& triangulation, const std::vector<Triangle>& triangles)
        : t_(triangulation), triangles_(triangles) {}

    RecoveredFaces run() {
        RecoveredFaces result{find_faces(t_, triangles_), 0, 0};
        for (const CellFace face : result.faces)
            if (face != Triangulation::none) t_.constrain(face);
        result.missing = result.lost = count_missing(result.faces);
        for (std::size_t round = 0; round < depth_of_round.size() && result.lost > 0; ++round) {
            if (round == first_round_with_vertices &&
                static_cast<double>(result.lost) > most_lost_share * static_cast<double>(triangles_.size()))
                break;
            depth_ = depth_of_round[round];
            new_vertices_ = round < first_round_with_vertices ? NewVertices::none : NewVertices::allowed;
            for (std::size_t k = 0; k < triangles_.size(); ++k)
                if (result.faces[k] == Triangulation::none) recover(triangles_[k]);
            find_again(result.faces);
            result.lost = count_missing(result.faces);
        }
        return result;
    }

 private:
    // Flips have given cells other numbers, and have removed no constrained face.
    void find_again(std::vector<CellFace>& faces) {
        for (std::size_t k = 0; k < triangles_.size(); ++k) {
            if (faces[k] != Triangulation::none && is_face(faces[k], triangles_[k])) continue;
            faces[k] = face_of(triangles_[k]);
            if (faces[k] != Triangulation::none) t_.constrain(faces[k]);
        }
    }
    bool is_face(CellFace face, const Triangle& triangle) const {
        if (cell_of(face) >= t_.cell_count() || t_.opposite_vertex(face) == triangle[0]) return false;
        Triangle there = t_.face_vertices(face);
        std::rotate(there.begin(), std::find(there.begin(), there.end(), triangle[0]), there.end());
        return there == triangle;
    }
    CellFace face_of(const Triangle& triangle) {
        for (const std::int32_t cell : t_.cells_around_vertex(triangle[0]))
            for (int i = 0; i < 4; ++i)
                if (is_face(cell_face(cell, i), triangle)) return cell_face(cell, i);
        return Triangulation::none;
    }
    static std::int64_t count_missing(const std::vector<CellFace>& faces) {
        return std::count(faces.begin(), faces.end(), Triangulation::none);
    }

    int orient(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
        const auto& p = t_.points();
        return orientation(p[a], p[b], p[c], p[d]);
    }

    void recover(const Triangle& triangle) {
        vertices_left_ = most_vertices_of_a_triangle;
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            if (!recover_edge(a, b) && !(insert_behind(triangle, (point(a) + point(b)) / 2) && recover_edge(a, b)))
                return;
        }
        recover_face(triangle);
        if (const CellFace face = face_of(triangle); face != Triangulation::none) t_.constrain(face);  // from now on
    }

    // A new vertex behind a point of the triangle takes away long cells that are in the way. Behind, because in front
    // of it may be nothing.
    bool insert_behind(const Triangle& triangle, const Vec3& p) {
        if (new_vertices_ == NewVertices::none || --vertices_left_ < 0) return false;
        const Vec3 u = point(triangle[1]) - point(triangle[0]), v = point(triangle[2]) - point(triangle[0]);
        const Vec3 inwards = v.cross(u).normalized();
        const double length = std::max({u.norm(), v.norm(), (v - u).norm()});
        const auto before = static_cast<std::int32_t>(t_.points().size());
        for (int tries = 0; tries < most_places_of_a_vertex; ++tries) {
            const double share = farthest_behind * (0.1 + some_share()) / (1 << tries), x = some_share() / 2,
                         y = some_share() / 2;
            const Vec3 behind =
                p + share * (length * inwards + x * (point(triangle[1]) - p) + y * (point(triangle[2]) - p));
            if (behind.allFinite() && t_.insert(behind, t_.cell_at(triangle[0])) >= before) return true;
        }
        return false;
    }
    // From 0 to 1, different each time, the same in every run.
    double some_share() { return static_cast<double>(random_()) / std::minstd_rand::max(); }
    const Vec3& point(std::int32_t vertex) const { return t_.points()[vertex]; }

    // --- edges ---

    Crossing crossing_of(std::int32_t a, std::int32_t b) {
        Crossing crossing;
        for (const std::int32_t cell : t_.cells_around_vertex(a)) {
            if (index_of(t_.vertices(cell), b) < 4) {
                crossing.cell = cell;
                crossing.has_end = true;
                return crossing;
            }
            if (crossing.cell == Triangulation::none && !t_.is_ghost(cell)) look_at(cell, a, b, crossing);
        }
        return crossing;
    }

    void look_at(std::int32_t cell, std::int32_t a, std::int32_t b, Crossing& crossing) const {
        const CellFace face = cell_face(cell, index_of(t_.vertices(cell), a));
        const Triangle corners = t_.face_vertices(face);
        int zeros = 0, on_edge = 0;
        for (int i = 0; i < 3; ++i) {
            const int side = orient(corners[i], corners[(i + 1) % 3], a, b);
            if (side < 0) return;
            if (side == 0) ++zeros, on_edge = i;
        }
        if (zeros > 1) return;
        crossing.cell = cell;
        crossing.face = face;
        if (zeros == 1) crossing.edge = {corners[on_edge], corners[(on_edge + 1) % 3]};
    }

    bool recover_edge(std::int32_t a, std::int32_t b) {
        rings_left_ = most_rings_of_an_edge;
        for (int flip = 0; flip < most_flips_of_an_edge; ++flip) {
            const Crossing crossing = crossing_of(a, b);
            if (crossing.has_end) return true;
            if (clear(crossing, a, b)) continue;
            const Crossing from_end = crossing_of(b, a);
            if (!clear(from_end, b, a) && !loosen(crossing) && !loosen(from_end)) return false;
        }
        return false;
    }

    // Takes away what the line from a to b crosses first.
    bool clear(const Crossing& crossing, std::int32_t a, std::int32_t b) {
        if (crossing.cell == Triangulation::none) return false;
        if (crossing.edge[0] != Triangulation::none)
            return clear_edge(crossing.cell, crossing.edge[0], crossing.edge[1], a, b);
        if (t_.opposite_vertex(t_.mirror(crossing.face)) != b) {
            const Triangle corners = t_.face_vertices(crossing.face);
            for (int i = 0; i < 3; ++i)
                if (is_shared_by_crossed_faces(crossing.face, corners[i], corners[(i + 1) % 3], a, b) &&
                    clear_edge(crossing.cell, corners[i], corners[(i + 1) % 3], a, b))
                    return true;
        }
        return replace_face_by_edge(t_, crossing.face);
    }

    // Takes away any edge of the face that is crossed: other flips are possible then.
    bool loosen(const Crossing& crossing) {
        if (crossing.cell == Triangulation::none) return false;
        const Triangle corners = t_.face_vertices(crossing.face);
        for (int i = 0; i < 3; ++i)
            if (remove_ring_edge(t_, ring_around(t_, crossing.cell, corners[i], corners[(i + 1) % 3]), {})) return true;
        return false;
    }

    // Whether the line, which crosses the face, leaves the next cell through a face with this edge, too.
    bool is_shared_by_crossed_faces(CellFace face, std::int32_t p, std::int32_t q, std::int32_t a,
                                    std::int32_t b) const {
        const std::int32_t o = t_.opposite_vertex(t_.mirror(face));
        return o >= 0 && orient(q, o, a, b) >= 0 && orient(o, p, a, b) >= 0;
    }

    bool clear_edge(std::int32_t cell, std::int32_t c, std::int32_t d, std::int32_t a, std::int32_t b) {
        const EdgeRing ring = ring_around(t_, cell, c, d);
        if (ring.place_of(b) < ring.size())
            if (span_ring(t_, ring, a, b, new_vertices_) || remove_ring_edge(t_, ring, std::array{a, b}, new_vertices_))
                return true;
        return remove_edge(ring, std::array{a, b}, depth_);
    }

    // --- edges in the way of others ---

    // Removes the edge, or at least some of those that lead from its ends to its ring, but to the `kept` vertices:
    // then the ring has others.
    bool remove_edge(const EdgeRing& ring, std::span<const std::int32_t> kept, int depth) {
        if (remove_ring_edge(t_, ring, {})) return true;
        if (depth == 0) return false;
        for (const std::int32_t v : ring.ring)
            for (const std::int32_t end : {ring.a, ring.b}) {
                if (v < 0 || std::find(kept.begin(), kept.end(), v) != kept.end()) continue;
                if (--rings_left_ < 0) return false;
                const std::int32_t cell = cell_with_edge(end, v);
                if (remove_edge(ring_around(t_, cell, end, v), kept, depth - 1)) return true;
            }
        return false;
    }

    std::int32_t cell_with_edge(std::int32_t c, std::int32_t d) {
        for (const std::int32_t cell : t_.cells_around_vertex(c))
            if (index_of(t_.vertices(cell), d) < 4) return cell;
        return Triangulation::none;
    }

    // --- triangles whose edges are there ---

    void recover_face(const Triangle& triangle) {
        rings_left_ = most_rings_of_an_edge;
        for (int flip = 0; flip < most_flips_of_an_edge; ++flip)
            if (!clear_face(triangle)) return;
    }

    // Takes away an edge that goes through the triangle. False if there is none.
    bool clear_face(const Triangle& triangle) {
        bool is_pierced = false;
        for (const std::int32_t first : t_.cells_around_vertex(triangle[0])) {
            if (t_.is_ghost(first)) continue;
            const int i = index_of(t_.vertices(first), triangle[0]);
            const Triangle far = t_.face_vertices(cell_face(first, i));
            for (int k = 0; k < 3; ++k) {
                const std::int32_t p = far[k], q = far[(k + 1) % 3];
                if (!pierces(p, q, triangle)) continue;
                const EdgeRing ring = ring_around(t_, first, p, q);
                if (remove_ring_edge(t_, ring, triangle, new_vertices_) || remove_edge(ring, triangle, depth_))
                    return true;
                is_pierced = true;
            }
        }
        return is_pierced &&
               insert_behind(triangle, (point(triangle[0]) + point(triangle[1]) + point(triangle[2])) / 3);
    }

    // Whether the edge between p and q goes through the inner of the triangle.
    bool pierces(std::int32_t p, std::int32_t q, const Triangle& triangle) const {
        const auto& [a, b, c] = triangle;
        if (std::find(triangle.begin(), triangle.end(), p) != triangle.end() ||
            std::find(triangle.begin(), triangle.end(), q) != triangle.end())
            return false;
        if (orient(a, b, c, p) * orient(a, b, c, q) >= 0) return false;
        const int side = orient(p, q, a, b);
        return side != 0 && orient(p, q, b, c) == side && orient(p, q, c, a) == side;
    }

    Triangulation& t_;
    const std::vector<Triangle>& triangles_;
    std::minstd_rand random_;
    NewVertices new_vertices_ = NewVertices::none;
    int depth_ = 0, rings_left_ = 0, vertices_left_ = 0;
};

}  // namespace

RecoveredFaces recover_faces(Triangulation& triangulation, const std::vector<Triangle>& triangles) {
    return FaceRecovery(triangulation, triangles).run();
}

}  // namespace kerf

// Each facet of a sheet has two sides, front and back, and six corners, 6 f + i. Around an edge a side goes on with the
// one that it faces across the space between two neighbours (surface/soup/radial_order.h); at a rim it ends. Corners of
// sides that hang together in this way at a vertex, sets of a union-find, are one vertex of the wall. It moves to where
// the planes of its facets meet once each is moved by half of the thickness: the least squares of their distances,
// weighted by angles, without directions in which they hardly differ. Front sides take the places of the facets, back
// sides follow, in patches named "NAME_back", and two triangles along each edge of a rim close the wall, in the patch
// "rim".
//
// Sheets are the facets that hang together over edges and have an open edge; they may be one-sided, and their facets
// turned against each other. No vertex moves by more than four times half of the thickness. Where several sheets meet
// in an edge, the space between each two neighbours gets a side of its own. The volume of a wall is its area times the
// thickness, to first order; a fin that ends within a sheet tapers there. Where the sheet is bent more sharply than by
// a radius of half the thickness, sides cross and are left so, which is reported. O(#F log #F), deterministic.
#include <algorithm>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/angles.h"
#include "base/geometry/symmetric_axes.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/openings/opening_filler.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/radial_order.h"

namespace kerf {

namespace {

// Corner i of the front of facet f is 6 f + i, of its back 6 f + 3 + i.
std::int32_t side_corner(std::int32_t corner, bool is_back) { return corner / 3 * 6 + (is_back ? 3 : 0) + corner % 3; }

// A vertex of the sheet, and the two vertices of the wall between which the closing triangles at a rim end, in the
// direction of the facets that go on there.
using RimEnd = std::array<std::int32_t, 3>;

// The planes around a vertex of the wall, each moved by the same height.
struct MovedPlanes {
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Vec3 sum = Vec3::Zero();

    void add(const Vec3& normal, double weight) {
        products += weight * normal * normal.transpose();
        sum += weight * normal;
    }
    // Returns the point where they meet, in the sense of least squares; it does not move along directions in which they
    // hardly differ.
    Vec3 meeting_point() const {
        constexpr double hardly = 0.05, farthest = 4;
        const SymmetricAxes axes = symmetric_axes(products);
        Vec3 move = Vec3::Zero();
        const double largest = axes.values[2];
        for (int i = 0; i < 3; ++i)
            if (axes.values[i] > hardly * largest)
                move += axes.vectors.col(i).dot(sum) / axes.values[i] * axes.vectors.col(i);
        return move.norm() > farthest ? Vec3(farthest * move.normalized()) : move;
    }
};

// The outcome for the sheets of a soup, by numbers of its facets.
struct Thickening {
    std::vector<std::int32_t> sheet_of;     // #F as before; the sheet of each; -1: of none, so that it stays
    std::vector<std::int32_t> sheets;       // one facet of each sheet that becomes a wall
    std::vector<std::int32_t> infinite;     // one facet of each that stays, because a vertex has no finite coordinates
    std::vector<std::int32_t> unordered;    // one at each edge where sheets lie on one another: each wall ends there
    std::vector<std::int32_t> turned_over;  // facets of which a side is turned over now: too sharp a bend
    double largest_move = 0;                // the largest move of a vertex, units of the surface
};

class Thickener {
 public:
    Thickener(Soup& soup, double thickness)
        : soup_(soup), height_(thickness / 2), facet_count_(soup.facets.size()), same_(6 * soup.facets.size()) {}

    Thickening run() {
        std::vector<std::int32_t> number;  // of proper facets in the soup
        for (std::size_t f = 0; f < facet_count_; ++f) {
            if (has_repeated_vertex(soup_.facets[f])) continue;
            proper_.push_back(soup_.facets[f]);
            number.push_back(f);
        }
        number_ = std::move(number);
        find_sheets();
        if (done_.sheets.empty()) return std::move(done_);
        join_sides();
        const std::vector<Vec3> old = soup_.vertices;
        make_vertices();
        add_backs();
        add_rims();
        find_turned_over(old);
        return std::move(done_);
    }

 private:
    // Facets that hang together over edges, some of which are open.
    void find_sheets() {
        UnionFind together(proper_.size());
        const EdgeCorners edges(proper_);
        edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
            for (const auto& c : corners) together.join(corners[0].corner / 3, c.corner / 3);
        });
        const Components pieces = together.take();
        std::vector<char> is_open(pieces.count, 0);
        std::vector<char> is_finite(pieces.count, 1);
        edges.for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
            if (corners.size() == 1) is_open[pieces.of[corners[0].corner / 3]] = 1;
        });
        for (std::size_t f = 0; f < proper_.size(); ++f)
            for (const std::int32_t v : proper_[f]) is_finite[pieces.of[f]] &= soup_.vertices[v].allFinite();
        done_.sheet_of.assign(facet_count_, -1);
        std::vector<std::int32_t> sheet(pieces.count, -1);
        for (std::size_t f = 0; f < proper_.size(); ++f) {
            const std::int32_t piece = pieces.of[f];
            if (!is_open[piece]) continue;
            if (sheet[piece] < 0) {
                std::vector<std::int32_t>& list = is_finite[piece] ? done_.sheets : done_.infinite;
                sheet[piece] = count_of(done_.sheets);
                list.push_back(number_[f]);
            }
            if (is_finite[piece]) done_.sheet_of[number_[f]] = sheet[piece];
        }
    }
    bool is_of_sheet(std::int32_t corner) const { return done_.sheet_of[number_[corner / 3]] >= 0; }

    void join_sides() {
        EdgeCorners(proper_).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
            if (!is_of_sheet(corners[0].corner)) return;
            if (corners.size() == 1) rims_.push_back(corners[0].corner);
            if (corners.size() == 2) {
                const std::int32_t one = corners[0].corner, two = corners[1].corner;
                const bool agree = start_vertex(proper_, one) != start_vertex(proper_, two);
                join(one, false, two, !agree);
                join(one, true, two, agree);
            }
            if (corners.size() > 2) join_around(low, corners);
        });
    }
    void join_around(std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        const RadialOrder order = radial_order(soup_.vertices, proper_, low, corners);
        if (order.corners.empty()) {
            done_.unordered.push_back(number_[corners[0].corner / 3]);
            for (const EdgeCorners::Corner& c : corners) rims_.push_back(c.corner);
        }
        for (std::size_t i = 0; i < order.corners.size(); ++i) {
            const std::int32_t one = order.corners[i], two = order.corners[(i + 1) % order.corners.size()];
            join(one, has_back_ahead(proper_, low, one), two, !has_back_ahead(proper_, low, two));
        }
    }
    // Joins two sides at both ends of their common edge.
    void join(std::int32_t one, bool back_of_one, std::int32_t two, bool back_of_two) {
        const bool agree = start_vertex(proper_, one) != start_vertex(proper_, two);
        const std::int32_t start = agree ? next_corner(two) : two, end = agree ? two : next_corner(two);
        same_.join(side_corner(one, back_of_one), side_corner(start, back_of_two));
        same_.join(side_corner(next_corner(one), back_of_one), side_corner(end, back_of_two));
    }

    void make_vertices() {
        const std::size_t old_count = soup_.vertices.size();
        std::vector<MovedPlanes> planes;
        std::vector<std::int32_t> vertex_of_root(6 * proper_.size(), -1), planes_of(old_count, -1), at;
        wall_vertex_.assign(6 * proper_.size(), -1);
        for (std::int32_t side = 0; side < count_of(wall_vertex_); ++side) {
            const std::int32_t f = side / 6, i = side % 3, v = proper_[f][i];
            if (!is_of_sheet(3 * f)) continue;
            std::int32_t& mine = vertex_of_root[same_.root(side)];
            if (mine < 0) {
                mine = count_of(planes);
                planes.emplace_back();
                const bool is_first = planes_of[v] < 0;
                if (is_first) planes_of[v] = mine;
                at.push_back(is_first ? v : copy_of(v));
            }
            wall_vertex_[side] = at[mine];
            add_plane(planes[mine], f, i, side % 6 >= 3);
        }
        for (std::size_t g = 0; g < planes.size(); ++g) {
            const Vec3 move = height_ * planes[g].meeting_point();
            soup_.vertices[at[g]] += move;
            done_.largest_move = std::max(done_.largest_move, move.norm());
        }
    }
    std::int32_t copy_of(std::int32_t v) {
        const Vec3 place = soup_.vertices[v];
        soup_.vertices.push_back(place);
        if (!soup_.vertex_number.empty()) {
            if (next_number_ < 0)
                next_number_ = 1 + *std::max_element(soup_.vertex_number.begin(), soup_.vertex_number.end());
            soup_.vertex_number.push_back(next_number_++);
        }
        return count_of(soup_.vertices) - 1;
    }
    void add_plane(MovedPlanes& planes, std::int32_t f, std::int32_t i, bool is_back) const {
        const Triangle& t = proper_[f];
        const Vec3 normal = doubled_area_vector(soup_.vertices, t);
        if (normal.isZero(0)) return;
        const Vec3 &a = soup_.vertices[t[i]], &b = soup_.vertices[t[(i + 1) % 3]], &c = soup_.vertices[t[(i + 2) % 3]];
        planes.add((is_back ? -1 : 1) * normal.normalized(), angle_between(b - a, c - a));
    }

    void add_facet(const Triangle& t, std::int32_t patch) {
        if (has_repeated_vertex(t)) return;
        soup_.facets.push_back(t);
        soup_.patch.push_back(patch);
        if (!soup_.polygon.empty()) soup_.polygon.push_back(soup_.polygon.back() + 1);
    }
    void add_backs() {
        std::vector<std::int32_t> back_of(soup_.patch_names.size(), -1);
        for (std::int32_t f = 0; f < count_of(proper_); ++f) {
            if (!is_of_sheet(3 * f)) continue;
            const std::int32_t* const front = &wall_vertex_[6 * f];
            soup_.facets[number_[f]] = {front[0], front[1], front[2]};
            const std::int32_t patch = soup_.patch[number_[f]];
            if (back_of[patch] < 0) back_of[patch] = add_patch(soup_, soup_.patch_names[patch] + "_back");
            add_facet({front[3], front[5], front[4]}, back_of[patch]);
        }
    }
    void add_rims() {
        const std::int32_t patch = add_patch(soup_, "rim");
        std::vector<RimEnd> ends;
        for (const std::int32_t corner : rims_) {
            const auto at = [&](std::int32_t c, bool is_back) { return wall_vertex_[side_corner(c, is_back)]; };
            const std::int32_t next = next_corner(corner);
            const std::int32_t front = at(corner, false), back = at(corner, true);
            const std::int32_t next_front = at(next, false), next_back = at(next, true);
            add_facet({next_front, front, back}, patch);
            add_facet({next_front, back, next_back}, patch);
            if (front != back) ends.push_back({start_vertex(proper_, corner), back, front});
            if (next_front != next_back) ends.push_back({start_vertex(proper_, next), next_front, next_back});
        }
        close_seams(std::move(ends), patch);
    }
    // Closes the polygons that the ends of closing triangles leave where rims of more than two sheets meet.
    void close_seams(std::vector<RimEnd> ends, std::int32_t patch) {
        std::sort(ends.begin(), ends.end());
        std::vector<RimEnd> open;
        for (const RimEnd& end : ends)
            if (!std::binary_search(ends.begin(), ends.end(), RimEnd{end[0], end[2], end[1]})) open.push_back(end);
        std::vector<char> is_used(open.size(), 0);
        for (std::size_t first = 0; first < open.size(); ++first) {
            std::vector<std::int32_t> polygon;
            for (std::size_t e = first; e < open.size() && !is_used[e];) {
                is_used[e] = 1;
                polygon.push_back(open[e][1]);
                const RimEnd next{open[e][0], open[e][2], -1};
                e = std::lower_bound(open.begin(), open.end(), next) - open.begin();
                if (e < open.size() && (open[e][0] != next[0] || open[e][1] != next[1])) break;
            }
            for (std::size_t i = 2; i < polygon.size(); ++i) add_facet({polygon[0], polygon[i - 1], polygon[i]}, patch);
        }
    }
    void find_turned_over(const std::vector<Vec3>& old) {
        for (std::int32_t f = 0; f < count_of(proper_); ++f) {
            if (!is_of_sheet(3 * f)) continue;
            const Vec3 before = doubled_area_vector(old, proper_[f]);
            const auto is_turned = [&](const std::int32_t* side) {
                return before.dot(doubled_area_vector(soup_.vertices, Triangle{side[0], side[1], side[2]})) <= 0;
            };
            if (!before.isZero(0) && (is_turned(&wall_vertex_[6 * f]) || is_turned(&wall_vertex_[6 * f + 3])))
                done_.turned_over.push_back(number_[f]);
        }
    }

    Soup& soup_;
    double height_;
    std::size_t facet_count_;
    UnionFind same_;                         // corners of sides
    std::vector<Triangle> proper_;           // facets with three vertices
    std::vector<std::int32_t> number_;       // of these in the soup
    std::vector<std::int32_t> rims_;         // corners at whose edges walls end
    std::vector<std::int32_t> wall_vertex_;  // of each corner of a side
    std::int32_t next_number_ = -1;
    Thickening done_;
};

}  // namespace

void thicken_step(Soup& soup, const StepRequest& request, StepReport& report) {
    RepairAction walls{"sheet became a wall", "sheets became walls"};
    RepairAction turned{"facet is turned over by a sharp bend", "facets are turned over by sharp bends"};
    RepairAction infinite{"sheet", "sheets"};
    RepairAction unordered{"edge at which sheets lie on one another", "edges at which sheets lie on one another"};
    turned.changes_surface = unordered.changes_surface = false;
    infinite.refused_because = "a vertex has no finite coordinates";
    const Soup before = soup;
    const Thickening done = Thickener(soup, request.amount).run();
    const auto tell = [&](RepairAction& action, const std::vector<std::int32_t>& facets) {
        for (const std::int32_t f : facets) {
            const Triangle& t = before.facets[f];
            const Vec3 where = (before.vertices[t[0]] + before.vertices[t[1]] + before.vertices[t[2]]) / 3;
            action.add({where, before.file_facets({f})});
        }
        report.actions.push_back(std::move(action));
    };
    tell(walls, done.sheets);
    tell(turned, done.turned_over);
    tell(infinite, done.infinite);
    tell(unordered, done.unordered);
    report.largest_move = done.largest_move;
}

}  // namespace kerf

// Triangles with links: corner 3 t + i stands for the edge of triangle t from its vertex i to the next one, and
// `partner_` has the corner on the other side, -1 at a rim. Edges longer than 4/3 of the wanted length at their ends
// are split in the middle, with flips between the sweeps, then points move to the middle of their neighbours. An edge
// is flipped where the angles opposite to it sum up to more than 180 degrees, which the sign of the sum of their
// cotangents tells.
//
// In space flips may go round in circles, so their number is bounded, and a flip must not make an edge that the patch
// or the surface has already. In split() and flip() the edge goes from a to b, p and q are the points opposite to it,
// and pa, aq, qb and bp the corners beyond the sides of the quadrilateral.
#include "surface/openings/inside/patch_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/core/check.h"
#include "base/geometry/triangle.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr std::int32_t most_patch_points = 200'000;  // beyond them it stays coarser

std::int32_t previous_corner(std::int32_t corner) { return next_corner(next_corner(corner)); }

// Returns the cotangent of the angle at `apex`; large for a triangle without area.
double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - apex, v = b - apex;
    return u.dot(v) / std::max(u.cross(v).norm(), 1e-12 * u.norm() * v.norm());
}

}  // namespace

PatchMesh::PatchMesh(std::vector<Vec3> points, std::vector<Triangle> triangles,
                     const std::vector<std::int32_t>& rim_sizes, std::vector<UndirectedEdge> taken)
    : points_(std::move(points)),
      triangles_(std::move(triangles)),
      taken_(std::move(taken)),
      rim_count_(count_of(points_)) {
    find_partners();
    find_sizes(rim_sizes);
}

void PatchMesh::find_partners() { partner_ = edge_partners(triangles_); }

// Sets the size of each point to half of the sum of its two edges of the rim.
void PatchMesh::find_sizes(const std::vector<std::int32_t>& rim_sizes) {
    next_.assign(points_.size(), 0);
    size_.assign(points_.size(), 0);
    std::int32_t first = 0;
    for (const std::int32_t count : rim_sizes) {
        for (std::int32_t i = 0; i < count; ++i) next_[first + i] = first + (i + 1) % count;
        for (std::int32_t i = first; i < first + count; ++i) {
            const double half = (points_[next_[i]] - points_[i]).norm() / 2;
            size_[i] += half;
            size_[next_[i]] += half;
        }
        first += count;
    }
    KERF_CHECK(first == rim_count_);
}

bool PatchMesh::is_within_rims() const {
    std::int32_t open = 0;
    for (std::int32_t c = 0; c < count_of(partner_); ++c) {
        const std::int32_t a = start(c), b = start(next_corner(c)), partner = partner_[c];
        const bool is_of_rim = a < rim_count_ && b < rim_count_ && next_[a] == b;
        if ((partner < 0) != is_of_rim || (partner >= 0 && start(partner) != b)) return false;
        open += partner < 0;
    }
    return open == rim_count_;
}

bool PatchMesh::spans_rims() const {
    const std::vector<UndirectedEdge> all = chords();
    return is_within_rims() && std::none_of(all.begin(), all.end(), [&](const UndirectedEdge& e) {
               return std::binary_search(taken_.begin(), taken_.end(), e);
           });
}

std::vector<UndirectedEdge> PatchMesh::chords() const {
    std::vector<UndirectedEdge> found;
    for (std::int32_t c = 0; c < count_of(partner_); ++c)
        if (c < partner_[c] && start(c) < rim_count_ && start(partner_[c]) < rim_count_)
            found.push_back(undirected(start(c), start(partner_[c])));
    return found;
}

void PatchMesh::refine(double growth) {
    relax();
    while (split_long(growth)) relax();
    constexpr int passes = 8;
    for (int pass = 0; pass < passes && count() > rim_count_; ++pass) {
        smooth();
        relax();
    }
}

bool PatchMesh::split_long(double growth) {
    constexpr double too_long = 4.0 / 3;
    const auto before = count_of(partner_);
    for (std::int32_t corner = 0; corner < before && count() < most_patch_points; ++corner) {
        if (corner > partner_[corner]) continue;  // of a rim, or looked at from the other side
        const std::int32_t a = start(corner), b = start(partner_[corner]);
        const Vec3 along = points_[b] - points_[a];
        const double length = along.norm(), size = (size_[a] + size_[b] + growth * length) / 2;
        if (length > too_long * size) split(corner, points_[a] + along / 2, size);
    }
    return count_of(partner_) > before;
}

void PatchMesh::link(std::int32_t a, std::int32_t b) {
    partner_[a] = b;
    if (b >= 0) partner_[b] = a;
}

void PatchMesh::split(std::int32_t corner, const Vec3& at, double size) {
    const std::int32_t other = partner_[corner], t = corner / 3, u = other / 3, v = count();
    const std::int32_t a = start(corner), b = start(other);
    const std::int32_t p = start(previous_corner(corner)), q = start(previous_corner(other));
    const std::int32_t pa = partner_[previous_corner(corner)], aq = partner_[next_corner(other)];
    const std::int32_t qb = partner_[previous_corner(other)], bp = partner_[next_corner(corner)];
    const auto w = count_of(triangles_), x = w + 1;
    points_.push_back(at);
    size_.push_back(size);
    triangles_[t] = {p, a, v};
    triangles_[u] = {a, q, v};
    triangles_.push_back({q, b, v});
    triangles_.push_back({b, p, v});
    partner_.resize(3 * triangles_.size(), -1);
    const std::array<std::int32_t, 4> fan = {t, u, w, x}, outside = {pa, aq, qb, bp};
    for (int i = 0; i < 4; ++i) {
        link(3 * fan[i], outside[i]);
        link(3 * fan[i] + 1, 3 * fan[(i + 1) % 4] + 2);
    }
}

void PatchMesh::relax() {
    std::vector<std::int32_t> open(partner_.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = open.size() - 1 - i;
    // Flips in space may go round in circles, hence the limit.
    for (std::size_t left = 10 * open.size(); !open.empty() && left > 0;) {
        const std::int32_t corner = open.back();
        open.pop_back();
        if (partner_[corner] < 0 || !should_flip(corner)) continue;
        --left;
        const std::int32_t t = corner / 3, u = partner_[corner] / 3;
        flip(corner);
        for (const std::int32_t side : {3 * t, 3 * t + 1, 3 * u, 3 * u + 1}) open.push_back(side);
    }
}

bool PatchMesh::should_flip(std::int32_t corner) const {
    const std::int32_t other = partner_[corner];
    const std::int32_t ia = start(corner), ib = start(other);
    const std::int32_t ip = start(previous_corner(corner)), iq = start(previous_corner(other));
    const Vec3 &a = points_[ia], &b = points_[ib], &p = points_[ip], &q = points_[iq];
    constexpr double hardly = 1e-6;
    if (cotangent(p, a, b) + cotangent(q, a, b) > -hardly || ip == iq || has_edge(previous_corner(corner), iq))
        return false;
    if (ip < rim_count_ && iq < rim_count_ && std::binary_search(taken_.begin(), taken_.end(), undirected(ip, iq)))
        return false;
    const Vec3 old = doubled_area_vector(a, b, p) + doubled_area_vector(b, a, q);
    const double least = 1e-9 * old.squaredNorm();
    return doubled_area_vector(p, a, q).dot(old) > least && doubled_area_vector(q, b, p).dot(old) > least;
}

// Whether a triangle around the start of the corner has an edge from there to a point.
bool PatchMesh::has_edge(std::int32_t corner, std::int32_t to) const {
    const auto reaches = [&](std::int32_t c) { return start(next_corner(c)) == to || start(previous_corner(c)) == to; };
    for (std::int32_t c = corner;;) {
        if (reaches(c)) return true;
        c = partner_[previous_corner(c)];
        if (c == corner) return false;
        if (c < 0) break;
    }
    for (std::int32_t c = partner_[corner]; c >= 0; c = partner_[c]) {
        c = next_corner(c);
        if (reaches(c)) return true;
    }
    return false;
}

void PatchMesh::flip(std::int32_t corner) {
    const std::int32_t other = partner_[corner], t = corner / 3, u = other / 3;
    const std::int32_t a = start(corner), b = start(other);
    const std::int32_t p = start(previous_corner(corner)), q = start(previous_corner(other));
    const std::int32_t pa = partner_[previous_corner(corner)], aq = partner_[next_corner(other)];
    const std::int32_t qb = partner_[previous_corner(other)], bp = partner_[next_corner(corner)];
    triangles_[t] = {p, a, q};
    triangles_[u] = {q, b, p};
    link(3 * t, pa);
    link(3 * t + 1, aq);
    link(3 * u, qb);
    link(3 * u + 1, bp);
    link(3 * t + 2, 3 * u + 2);
}

void PatchMesh::smooth() {
    std::vector<std::int32_t> first(points_.size() + 1, 0), around(partner_.size());  // triangles at each point
    for (const Triangle& t : triangles_)
        for (const std::int32_t v : t) ++first[v + 1];
    for (std::size_t v = 0; v < points_.size(); ++v) first[v + 1] += first[v];
    std::vector<std::int32_t> end(first.begin(), first.end() - 1);
    for (std::int32_t c = 0; c < count_of(partner_); ++c) around[end[start(c)]++] = c / 3;
    for (std::int32_t v = rim_count_; v < count(); ++v) {
        const std::span<const std::int32_t> mine(around.data() + first[v], around.data() + first[v + 1]);
        Vec3 sum = Vec3::Zero();  // each neighbour twice
        for (const std::int32_t t : mine)
            for (const std::int32_t w : triangles_[t]) sum += points_[w] - points_[v];
        const Vec3 to = points_[v] + sum / (2.0 * mine.size());
        if (keeps_sides(v, to, mine)) points_[v] = to;
    }
}

bool PatchMesh::keeps_sides(std::int32_t point, const Vec3& to, std::span<const std::int32_t> around) const {
    return std::all_of(around.begin(), around.end(), [&](std::int32_t t) {
        std::array<Vec3, 3> corners = {points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]};
        const Vec3 before = doubled_area_vector(corners);
        for (int i = 0; i < 3; ++i)
            if (triangles_[t][i] == point) corners[i] = to;
        constexpr double least_part = 0.01;
        return doubled_area_vector(corners).dot(before) > least_part * before.squaredNorm();
    });
}

}  // namespace kerf

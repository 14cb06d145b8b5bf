// Recovery goes from the least change to the largest, and each step is repeated as long as it makes many of the missing
// triangles. While no face is constrained, missing edges are made by flips that remove other edges first, to a depth
// that grows from round to round (Si 2015, si2015). Then faces that are there are constrained, and missing triangles
// are made, with edges that other triangles need kept. What is left gets vertices behind it, and at last is split
// (fill/shell/inside/boundary_splitting.h). These two may lead into a dead end that depends on a number chosen by
// trial, so each begins anew from a copy for the next number of its list, until nothing is missing.
//
// Notation: a triangle is "given" if it is of the surface, and "missing" if it is to become a face: a given one, or a
// part that stands for one that was split. "Origin" is the given triangle of a part. A surface whose triangles were
// split is enclosed by the faces of the parts, without pairs that are one face seen from both sides, and by caps.
#include "fill/shell/inside/face_recovery.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "fill/delaunay/enclosing_faces.h"
#include "fill/shell/inside/boundary_splitting.h"
#include "fill/shell/inside/flip_recovery.h"
#include "fill/shell/inside/missing_triangles.h"

namespace kerf {

namespace {

// To remove an edge, others are removed first only as deep as it must be: that changes least.
constexpr int most_depth_of_rounds = 12, most_rounds_in_vain = 3;
constexpr FlipLimits anything = {40, true}, anything_and_vertices = {40, true, NewVertices::allowed};
// A step over all missing triangles is repeated as long as it leaves fewer of them than this share.
constexpr double most_left = 0.95;
// Offsets of BoundarySplitting. A smaller one may find triangles that another loses: parts of the boundary may be
// nearer to each other then.
constexpr std::array offsets = {1e-2, 1e-4, 1e-6};
// Most cells that a vertex behind a triangle removes, see FlipRecovery::insert_behind(). One number may find triangles
// that another loses.
constexpr std::array<std::size_t, 4> most_removed_cells = {200, 1000, 60, 20};
// Where long thin triangles lie close together, splits make others of the kind, and there is no end.
constexpr std::int64_t most_parts_of_a_triangle = 60, most_parts_of_any = 600;

Triangle ascending(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// Returns the triangles without pairs of opposite ones. No triangle may be there twice in one direction.
std::vector<Triangle> without_opposites(std::vector<Triangle> triangles) {
    std::sort(triangles.begin(), triangles.end(),
              [](const Triangle& s, const Triangle& t) { return ascending(s) < ascending(t); });
    std::vector<Triangle> left;
    for (const Triangle& t : triangles)
        if (!left.empty() && ascending(left.back()) == ascending(t))
            left.pop_back();
        else
            left.push_back(t);
    return left;
}

// The edges of a closed surface whose vertices are numbered from 0 to below `vertices`. 6 bytes a triangle and 4 a
// vertex.
class SurfaceEdges {
 public:
    SurfaceEdges() = default;
    // Takes each edge in the direction in which it ascends: on a closed surface that is once.
    SurfaceEdges(const std::vector<Triangle>& triangles, std::size_t vertices) : start_(vertices + 1) {
        const auto for_each_ascending = [&](const auto& visit) {
            for (const Triangle& t : triangles)
                for (int i = 0; i < 3; ++i)
                    if (t[i] < t[(i + 1) % 3]) visit(t[i], t[(i + 1) % 3]);
        };
        for_each_ascending([&](std::int32_t a, std::int32_t) { ++start_[a]; });
        std::inclusive_scan(start_.begin(), start_.end(), start_.begin());
        other_.resize(start_.back());
        for_each_ascending([&](std::int32_t a, std::int32_t b) { other_[--start_[a]] = b; });
    }

    // Returns whether the surface has an edge, in either direction. Linear in the number of edges from its smaller
    // vertex to greater ones.
    bool contains(std::int32_t a, std::int32_t b) const {
        if (a > b) std::swap(a, b);
        if (a < 0 || a >= std::ssize(start_) - 1) return false;
        return std::find(other_.begin() + start_[a], other_.begin() + start_[a + 1], b) !=
               other_.begin() + start_[a + 1];
    }

 private:
    // The greater ends of all edges, in a list by their smaller ends, and the place in it at which those of a vertex
    // start.
    std::vector<std::int32_t> start_, other_;
};

class FaceRecovery {
 public:
    FaceRecovery(SpatialTriangulation& triangulation, const std::vector<Triangle>& triangles)
        : t_(triangulation), triangles_(triangles), flips_(triangulation, [this](std::int32_t a, std::int32_t b) {
              return edges_.contains(a, b) || missing_.has_edge(a, b);
          }) {}

    RecoveredFaces run() {
        RecoveredFaces result;
        result.faces = find_faces(t_, triangles_);
        result.missing = std::count(result.faces.begin(), result.faces.end(), SpatialTriangulation::none);
        if (result.missing > 0) {
            edges_ = SurfaceEdges(triangles_, t_.points().size());
            recover_edges(result.faces);
            result.faces = find_faces(t_, triangles_);
        }
        constrain(result.faces);
        repeat_for_missing([&](std::int32_t number) { recover(number, anything); });
        if (missing_.missing_count() > 0) add_vertices(result);
        result.lost = missing_.missing_origins();
        if (result.split > 0 && result.lost.empty())
            result.faces = find_faces(t_, boundary(result.faces));
        else if (result.missing > 0)
            result.faces = find_faces(t_, triangles_);
        return result;
    }

 private:
    bool has_edge(std::int32_t a, std::int32_t b) { return crossing_of(t_, a, b).has_end; }

    // --- edges, while no face is constrained ---

    void recover_edges(const std::vector<CellFace>& faces) {
        std::vector<UndirectedEdge> edges = missing_edges(faces);
        int in_vain = 0;
        for (int depth = 1; depth <= most_depth_of_rounds && in_vain < most_rounds_in_vain; ++depth) {
            const std::size_t before = edges.size();
            recover(edges, {depth});
            in_vain = edges.size() < before ? std::max(0, in_vain - 1) : in_vain + 1;
        }
        repeat([&] { return edges.size(); }, [&] { recover(edges, anything); });
    }

    std::vector<UndirectedEdge> missing_edges(const std::vector<CellFace>& faces) {
        std::vector<UndirectedEdge> edges;
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            for (int i = 0; i < 3 && faces[k] == SpatialTriangulation::none; ++i)
                edges.push_back(undirected(triangles_[k][i], triangles_[k][(i + 1) % 3]));
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        std::erase_if(edges, [&](const UndirectedEdge& edge) { return has_edge(edge[0], edge[1]); });
        return edges;
    }

    // Makes edges, and removes those from the list that are there then.
    void recover(std::vector<UndirectedEdge>& edges, const FlipLimits& limits) {
        std::erase_if(edges, [&](const UndirectedEdge& edge) { return flips_.recover_edge(edge[0], edge[1], limits); });
    }

    template <class Count, class Round>
    static void repeat(const Count& count, const Round& round) {
        for (bool goes_on = count() > 0; goes_on;) {
            const double before = count();
            round();
            goes_on = count() > 0 && count() < most_left * before;
        }
    }

    // --- triangles ---

    void constrain(const std::vector<CellFace>& faces) {
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            if (faces[k] == SpatialTriangulation::none)
                missing_.add(triangles_[k], k);
            else
                t_.constrain(faces[k]);
    }

    template <class Visit>
    void repeat_for_missing(const Visit& visit) {
        repeat([&] { return missing_.missing_count(); }, [&] { for_each_missing(visit); });
    }

    // Visits all missing triangles, also those that come on the way, as long as there are not too many.
    template <class Visit>
    void for_each_missing(const Visit& visit) {
        for (std::int32_t number = 0; number < missing_.count() && missing_.count() < most_triangles_; ++number)
            if (missing_.is_missing(number)) visit(number);
    }

    bool recover(std::int32_t number, const FlipLimits& limits) {
        const Triangle triangle = missing_.triangle(number);
        for (int i = 0; i < 3; ++i)
            if (!flips_.recover_edge(triangle[i], triangle[(i + 1) % 3], limits)) return false;
        if (!flips_.recover_face(triangle, limits)) return false;
        t_.constrain(find_face(t_, triangle));
        missing_.set_made(number);
        return true;
    }

    // --- vertices ---

    void add_vertices(RecoveredFaces& result) {
        const SpatialTriangulation flipped = t_;
        const MissingTriangles missing = missing_;
        for (const std::size_t most_removed : most_removed_cells) {
            t_ = flipped;
            missing_ = missing;
            most_triangles_ = std::numeric_limits<std::int64_t>::max();
            repeat_for_missing([&](std::int32_t number) { recover_with_vertices(number, most_removed); });
            result.split = missing_.missing_count();
            if (result.split > 0) result.caps = split_missing();
            if (missing_.missing_count() == 0) return;
        }
    }

    void recover_with_vertices(std::int32_t number, std::size_t most_removed) {
        const Triangle triangle = missing_.triangle(number);
        const auto& p = t_.points();
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            if (flips_.recover_edge(a, b, anything_and_vertices)) continue;
            if (!flips_.insert_behind(triangle, (p[a] + p[b]) / 2, most_removed)) return;
            if (!flips_.recover_edge(a, b, anything)) return;
        }
        if (recover(number, anything_and_vertices)) return;
        if (flips_.insert_behind(triangle, (p[triangle[0]] + p[triangle[1]] + p[triangle[2]]) / 3, most_removed))
            recover(number, anything);
    }

    // --- splits ---

    // Splits missing triangles and returns the caps; none if some are still missing.
    std::vector<Tetrahedron> split_missing() {
        const SpatialTriangulation unsplit = t_;
        const MissingTriangles missing = missing_;
        most_triangles_ = missing.count() + most_parts_of_any + most_parts_of_a_triangle * missing.missing_count();
        for (const double offset : offsets) {
            t_ = unsplit;
            missing_ = missing;
            BoundarySplitting splitting(t_, triangles_, missing_, offset);
            while (missing_.missing_count() > 0 && missing_.count() < most_triangles_ && split_all(splitting)) {
            }
            if (missing_.missing_count() == 0) return splitting.caps();
        }
        return {};
    }

    // Splits or makes missing triangles; false if there was none for which that is possible.
    bool split_all(BoundarySplitting& splitting) {
        bool any = false;
        for_each_missing([&](std::int32_t number) { any |= split_side(splitting, number); });
        if (any) return true;
        for_each_missing([&](std::int32_t number) { any |= recover(number, anything) || split(splitting, number); });
        return any;
    }

    // Splits at an edge between parts of different given triangles.
    bool split_side(BoundarySplitting& splitting, std::int32_t number) {
        const Triangle triangle = missing_.triangle(number);
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            const std::vector<std::int32_t> numbers = missing_.at_edge(a, b);
            if (numbers.size() != 2 || missing_.origin(numbers[0]) == missing_.origin(numbers[1])) continue;
            if (!flips_.recover_edge(a, b, anything) && splitting.split_edge(a, b)) return true;
        }
        return false;
    }

    // Splits at an edge that is not there; in the middle if all are.
    bool split(BoundarySplitting& splitting, std::int32_t number) {
        const Triangle triangle = missing_.triangle(number);
        bool has_edges = true;
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            if (has_edge(a, b)) continue;
            if (splitting.split_edge(a, b)) return true;
            has_edges = false;
        }
        return has_edges && splitting.split_triangle(number);
    }

    // Returns the triangles that were faces by themselves or were made, without pairs that are the same face seen from
    // both sides: between them there are only caps.
    std::vector<Triangle> boundary(const std::vector<CellFace>& faces) const {
        std::vector<Triangle> all;
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            if (faces[k] != SpatialTriangulation::none) all.push_back(triangles_[k]);
        for (std::int32_t k = 0; k < missing_.count(); ++k)
            if (missing_.is_made(k)) all.push_back(missing_.triangle(k));
        return without_opposites(std::move(all));
    }

    SpatialTriangulation& t_;
    const std::vector<Triangle>& triangles_;
    SurfaceEdges edges_;
    MissingTriangles missing_;
    FlipRecovery flips_;
    std::int64_t most_triangles_ =
        std::numeric_limits<std::int64_t>::max();  // bound of the number of triangles, missing now or before
};

}  // namespace

RecoveredFaces recover_faces(SpatialTriangulation& triangulation, const std::vector<Triangle>& triangles) {
    return FaceRecovery(triangulation, triangles).run();
}

}  // namespace kerf

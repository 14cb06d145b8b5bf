#include "shell/face_recovery.h"

#include <algorithm>
#include <array>
#include <span>

#include "delaunay/faces.h"
#include "shell/boundary_splitting.h"
#include "shell/flip_recovery.h"

namespace kerf {

namespace {

constexpr std::array rounds = {FlipLimits{0},
                               FlipLimits{0},
                               FlipLimits{1},
                               FlipLimits{2, NewVertices::allowed},
                               FlipLimits{2, NewVertices::allowed},
                               FlipLimits{2, NewVertices::allowed},
                               FlipLimits{2, NewVertices::allowed},
                               FlipLimits{2, NewVertices::allowed}};
constexpr std::array rounds_without_vertices = {FlipLimits{0, NewVertices::none, true},
                                                FlipLimits{1, NewVertices::none, true},
                                                FlipLimits{2, NewVertices::none, true}};
// With more of all triangles still missing, those that are thin and close together, vertices would not help.
constexpr double most_missing_share = 0.1;
constexpr FlipLimits beside_splits = {2, NewVertices::none, true};
// Where long thin triangles lie close together, splits make others of the kind, and there is no end.
constexpr std::int64_t most_parts_of_a_triangle = 60, most_parts_of_any = 600;

class FaceRecovery {
 public:
    FaceRecovery(Triangulation& triangulation, const std::vector<Triangle>& triangles, const RecoveryOptions& options)
        : t_(triangulation),
          options_(options),
          triangles_(triangles),
          flips_(triangulation, missing_),
          splitting_(triangulation, triangles, missing_, options.offset) {}

    RecoveredFaces run() {
        RecoveredFaces result;
        result.faces = find_faces(t_, triangles_);
        find_missing(result.faces);
        result.missing = missing_.missing_count();
        if (result.missing == 0) return result;
        if (options_.adds_vertices)
            flip_all(rounds);
        else
            flip_all(rounds_without_vertices);
        result.split = missing_.missing_count();
        most_triangles_ = missing_.count() + most_parts_of_any + most_parts_of_a_triangle * result.split;
        while (missing_.missing_count() > 0 && split_all()) {
        }
        result.lost = missing_.missing_origins();
        if (result.lost.empty()) result.faces = find_faces(t_, boundary(result.faces));
        result.caps = splitting_.caps();
        return result;
    }

 private:
    void find_missing(const std::vector<CellFace>& faces) {
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            if (faces[k] == Triangulation::none)
                missing_.add(triangles_[k], static_cast<std::int32_t>(k));
            else
                t_.constrain(faces[k]);
    }

    void flip_all(std::span<const FlipLimits> all) {
        for (const FlipLimits& limits : all) {
            const double share = static_cast<double>(missing_.missing_count()) / static_cast<double>(triangles_.size());
            if (limits.new_vertices == NewVertices::allowed && share > most_missing_share) return;
            for (std::int32_t k = 0; k < missing_.count(); ++k)
                if (missing_.is_missing(k)) recover(k, limits);
        }
    }

    bool recover(std::int32_t number, const FlipLimits& limits) {
        if (!flips_.recover(missing_.triangle(number), limits)) return false;
        missing_.set_made(number);
        return true;
    }

    // Those that come of a split, too. False if none could be made or split, or there are too many.
    bool split_all() {
        bool any = false;
        for (std::int32_t k = 0; k < missing_.count() && missing_.count() < most_triangles_; ++k)
            if (missing_.is_missing(k) && split_sides(k)) any = true;
        if (any) return true;
        for (std::int32_t k = 0; k < missing_.count() && missing_.count() < most_triangles_; ++k)
            if (missing_.is_missing(k) && (recover(k, beside_splits) || split(k))) any = true;
        return any && missing_.count() < most_triangles_;
    }

    // At edges between parts of different given triangles.
    bool split_sides(std::int32_t number) {
        const Triangle triangle = missing_.triangle(number);
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            const std::vector<std::int32_t> numbers = missing_.at_edge(a, b);
            if (numbers.size() != 2 || missing_.origin(numbers[0]) == missing_.origin(numbers[1])) continue;
            if (!flips_.recover_edge(a, b, beside_splits) && splitting_.split_edge(a, b)) return true;
        }
        return false;
    }

    // At an edge that is not there; in the middle if all are.
    bool split(std::int32_t number) {
        const Triangle triangle = missing_.triangle(number);
        bool has_edges = true;
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            if (crossing_of(t_, a, b).has_end) continue;
            if (splitting_.split_edge(a, b)) return true;
            has_edges = false;
        }
        return has_edges && splitting_.split_triangle(number);
    }

    // What was there by itself, and what was made.
    std::vector<Triangle> boundary(const std::vector<CellFace>& faces) const {
        std::vector<Triangle> all;
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            if (faces[k] != Triangulation::none) all.push_back(triangles_[k]);
        for (std::int32_t k = 0; k < missing_.count(); ++k)
            if (missing_.is_made(k)) all.push_back(missing_.triangle(k));
        return all;
    }

    Triangulation& t_;
    RecoveryOptions options_;
    const std::vector<Triangle>& triangles_;
    MissingTriangles missing_;
    FlipRecovery flips_;
    BoundarySplitting splitting_;
    std::int64_t most_triangles_ = 0;
};

}  // namespace

RecoveredFaces recover_faces(Triangulation& triangulation, const std::vector<Triangle>& triangles,
                             const RecoveryOptions& options) {
    return FaceRecovery(triangulation, triangles, options).run();
}

}  // namespace kerf

#include "support/notched_box.h"

#include <algorithm>
#include <array>
#include <vector>

#include "support/random_triangulation.h"

namespace kerf::test {

namespace {

class NotchedBox {
 public:
    NotchedBox(int notches, double gap, double width, SeededNumbers& random)
        : n_(notches), gap_(gap), width_(width), random_(random) {}

    Soup build() {
        for (int k = 0; k < n_; ++k)
            for (int side = -1; side <= 1; ++side) add_lines(k + 0.5 + side * width_, side == 0);
        lines_.push_back(add_line(n_, false));
        lines_.insert(lines_.begin(), add_line(0, false));
        for (std::size_t i = 0; i + 1 < lines_.size(); ++i) add_strips(lines_[i], lines_[i + 1]);
        add_walls();
        soup_.patch.assign(soup_.facets.size(), 0);
        soup_.patch_names = {"notched box"};
        return std::move(soup_);
    }

 private:
    struct Line {  // at the same place along y below and along x above
        std::array<std::int32_t, 2> below, above;
    };
    std::int32_t add(double x, double y, double z) {
        soup_.vertices.emplace_back(x, y, z);
        return static_cast<std::int32_t>(soup_.vertices.size()) - 1;
    }
    Line add_line(double at, bool is_ridge) {
        const double deep = -1, high = n_ * n_ + 1.0, end = n_;
        return {{add(0, at, is_ridge ? -gap_ / 2 : deep), add(end, at, is_ridge ? end * at - gap_ / 2 : deep)},
                {add(at, 0, is_ridge ? gap_ / 2 : high), add(at, end, is_ridge ? end * at + gap_ / 2 : high)}};
    }
    void add_lines(double at, bool is_ridge) { lines_.push_back(add_line(at, is_ridge)); }
    void add_quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        soup_.facets.insert(soup_.facets.end(), {{a, b, c}, {a, c, d}});
    }
    void add_strips(const Line& l, const Line& m) {
        add_quad(l.below[0], m.below[0], m.below[1], l.below[1]);
        add_quad(l.above[0], m.above[0], m.above[1], l.above[1]);
    }
    // Across x, with notches below, and across y, with notches above.
    void add_walls() {
        const Line first = lines_.front(), last = lines_.back();
        for (const int end : {0, 1}) {
            std::vector<std::int32_t> across_x, across_y;
            for (const Line& line : lines_) {
                across_x.push_back(line.below[end]);
                across_y.push_back(line.above[end]);
            }
            std::reverse(across_y.begin(), across_y.end());
            const Line& corners = end == 0 ? first : last;
            across_x.insert(across_x.end(), {corners.above[1], corners.above[0]});
            across_y.insert(across_y.end(), {corners.below[0], corners.below[1]});
            add_wall(across_x, 1, end == 0);
            add_wall(across_y, 0, end == 1);
        }
    }
    void add_wall(const std::vector<std::int32_t>& loop, int axis, bool is_turned) {
        std::vector<Vec2> corners;
        for (const std::int32_t v : loop) corners.emplace_back(soup_.vertices[v][axis], soup_.vertices[v][2]);
        const RandomTriangulation wall(corners, 1e-3, random_);
        for (const auto& [a, b, c] : wall.triangles())
            soup_.facets.push_back(is_turned ? Triangle{loop[a], loop[c], loop[b]}
                                             : Triangle{loop[a], loop[b], loop[c]});
    }

    int n_;
    double gap_, width_;
    SeededNumbers& random_;
    Soup soup_;
    std::vector<Line> lines_;
};

}  // namespace

Soup notched_box(int notches, double gap, double width, SeededNumbers& random) {
    return NotchedBox(notches, gap, width, random).build();
}

}  // namespace kerf::test

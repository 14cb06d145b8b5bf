#include "viewer/render/line_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace kerf::view {

namespace {

constexpr float least_length = 1.5f;  // least length of a line, in widths of its text
constexpr float gap_share = 0.35f;    // least gap between two texts, in heights of a text
constexpr std::size_t most_labels = 80;

// The visible part of the line of a value in a square of the picture.
struct Piece {
    float value = 0, length = 0;
    Eigen::Vector2f sum = {0, 0};    // sum of the segments' middles, weighted by length
    Eigen::Vector2f place = {0, 0};  // the middle of a segment nearest to the centre of mass
    float nearest = std::numeric_limits<float>::infinity();
    std::size_t rank = 0;  // number among the pieces of the value, the longest first
};

std::vector<Piece> pieces_of(std::span<const SeenSegment> segments, float side) {
    std::map<std::tuple<float, int, int>, Piece> pieces;
    const auto piece_of = [&](const SeenSegment& s) -> Piece& {
        const Eigen::Vector2f middle = (s.from + s.to) / 2;
        return pieces[{s.value, static_cast<int>(std::floor(middle.x() / side)),
                       static_cast<int>(std::floor(middle.y() / side))}];
    };
    for (const SeenSegment& s : segments) {
        Piece& piece = piece_of(s);
        const float length = (s.to - s.from).norm();
        piece.value = s.value;
        piece.length += length;
        piece.sum += length * (s.from + s.to) / 2;
    }
    for (const SeenSegment& s : segments) {
        Piece& piece = piece_of(s);
        const Eigen::Vector2f middle = (s.from + s.to) / 2;
        const float distance = piece.length > 0 ? (middle - piece.sum / piece.length).norm() : 0;
        if (distance >= piece.nearest) continue;
        piece.nearest = distance;
        piece.place = middle;
    }
    std::vector<Piece> all;
    for (const auto& [key, piece] : pieces) all.push_back(piece);
    std::stable_sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) {
        return a.value != b.value ? a.value < b.value : a.length > b.length;
    });
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].value == all[i - 1].value) all[i].rank = all[i - 1].rank + 1;
    std::stable_sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.rank < b.rank; });
    return all;
}

}  // namespace

std::vector<LineLabel> places_on_lines(std::span<const SeenSegment> segments,
                                       const std::function<Eigen::Vector2f(float value)>& size, const LabelArea& area,
                                       float spacing, std::span<const LabelArea> taken) {
    std::vector<LineLabel> labels;
    std::vector<LabelArea> used(taken.begin(), taken.end());
    std::map<float, Eigen::Vector2f> sizes;
    for (const Piece& piece : pieces_of(segments, spacing)) {
        if (labels.size() == most_labels) break;
        if (!sizes.contains(piece.value)) sizes[piece.value] = size(piece.value);
        const Eigen::Vector2f half = sizes[piece.value] / 2;
        const LabelArea own{piece.place - half, piece.place + half};
        const bool fits = (own.low.array() >= area.low.array()).all() && (own.high.array() <= area.high.array()).all();
        if (!fits || piece.length < least_length * 2 * half.x()) continue;
        const float gap = gap_share * 2 * half.y();
        const bool is_covered = std::any_of(used.begin(), used.end(), [&](const LabelArea& other) {
            return (own.low.array() < other.high.array() + gap).all() &&
                   (other.low.array() < own.high.array() + gap).all();
        });
        const bool is_told = std::any_of(labels.begin(), labels.end(), [&](const LineLabel& other) {
            return other.value == piece.value && (other.place - piece.place).norm() < spacing;
        });
        if (is_covered || is_told) continue;
        labels.push_back({piece.value, piece.place});
        used.push_back(own);
    }
    return labels;
}

}  // namespace kerf::view

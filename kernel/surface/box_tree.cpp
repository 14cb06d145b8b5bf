#include "surface/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/check.h"

namespace kerf {

namespace {

constexpr std::int32_t boxes_of_leaf = 4;

}  // namespace

BoxTree::BoxTree(std::vector<Eigen::AlignedBox3d> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    KERF_CHECK(std::none_of(boxes_.begin(), boxes_.end(), [](const auto& box) { return box.isEmpty(); }));
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.push_back({{}, 0, static_cast<std::int32_t>(boxes_.size())});
    for (std::size_t node = 0; node < nodes_.size(); ++node) split(node);
}

void BoxTree::split(std::size_t node) {
    const auto [first, count] = std::pair(nodes_[node].first, nodes_[node].count);
    const auto begin = order_.begin() + first, end = begin + count;
    Eigen::AlignedBox3d centres;
    for (auto i = begin; i != end; ++i) {
        nodes_[node].box.extend(boxes_[*i]);
        centres.extend(boxes_[*i].center());
    }
    if (count <= boxes_of_leaf) return;
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::int32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::int32_t a, std::int32_t b) {
        return std::pair(boxes_[a].center()[axis], a) < std::pair(boxes_[b].center()[axis], b);
    });
    nodes_[node].left = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({{}, first, half});
    nodes_.push_back({{}, first + half, count - half});
}

std::vector<std::int32_t> BoxTree::around(const Eigen::AlignedBox3d& box) const {
    std::vector<std::int32_t> found;
    traverse([&](const Eigen::AlignedBox3d& other) { return other.contains(box); },
             [&](std::int32_t i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace kerf

#include "viewer/model/inside/replayer.h"

#include <array>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/core/error.h"
#include "cut/cut/split.h"
#include "viewer/model/tree.h"

namespace kerf::view {

namespace {

// Half-edges, points and keys of a closed surface with half as many vertices as facets.
std::size_t estimated_bytes(const Surface& surface) {
    constexpr std::size_t per_facet = 90;
    return per_facet * surface.facet_count();
}

bool splits_facets(const Cut* cut) { return cut && !cut->split_parent.facets.empty(); }

std::shared_ptr<const Surface> build(Half half) {
    std::variant<Surface, ManifoldDefect> built = Surface::build(std::move(half.arrays), std::move(half.partner));
    if (!std::holds_alternative<Surface>(built))
        throw Error(ErrorCode::internal, "The half of a cut in the trace is no closed surface. Repeat the run.");
    return std::make_shared<const Surface>(std::get<Surface>(std::move(built)));
}

}  // namespace

Replayer::Replayer(std::shared_ptr<const Trace> trace, std::size_t limit_bytes)
    : trace_(std::move(trace)), limit_(limit_bytes) {}

Replayer::Replayer(const Replayer& other, std::shared_ptr<const Trace> trace, NodeId node)
    : Replayer(std::move(trace), other.limit_) {
    for (auto entry = other.entries_.rbegin(); entry != other.entries_.rend(); ++entry)
        if (!lies_below(entry->node, node)) keep(entry->node, entry->surface);
}

std::shared_ptr<const Surface> Replayer::keep(NodeId node, std::shared_ptr<const Surface> surface) {
    if (const auto old = places_.find(node); old != places_.end()) {
        bytes_ -= old->second->bytes;
        entries_.erase(old->second);
    }
    entries_.push_front({node, surface, estimated_bytes(*surface)});
    places_[node] = entries_.begin();
    bytes_ += entries_.front().bytes;
    while (bytes_ > limit_ && entries_.size() > 1) {
        bytes_ -= entries_.back().bytes;
        places_.erase(entries_.back().node);
        entries_.pop_back();
    }
    return surface;
}

std::shared_ptr<const Surface> Replayer::surface(NodeId node) {
    if (const auto kept = places_.find(node); kept != places_.end()) {
        entries_.splice(entries_.begin(), entries_, kept->second);
        return entries_.front().surface;
    }
    const Cut* cut = trace_->find(node);
    if (!splits_facets(cut)) return uncut_surface(node);
    return keep(node, std::make_shared<const Surface>(cut->split_parent));
}

std::shared_ptr<const Surface> Replayer::uncut_surface(NodeId node) {
    const bool is_its_own = !splits_facets(trace_->find(node));
    if (is_its_own && places_.contains(node)) return surface(node);
    if (std::optional<Surface> first = trace_->root_surface(node)) {
        auto root = std::make_shared<const Surface>(*std::move(first));
        return is_its_own ? keep(node, root) : root;
    }
    const Cut* parent_cut = trace_->find(parent_of(node));
    if (!parent_cut || !parent_cut->made())
        throw Error(ErrorCode::usage, fmt::format("The tree of {} has no node {}.", trace_->input, node.value()));
    const std::shared_ptr<const Surface> parent = surface(parent_of(node));
    std::array<Half, 2> halves = split(*parent, parent_cut->side, parent_cut->interface, parent_of(node));
    const NodeId sibling = sibling_of(node);
    if (!splits_facets(trace_->find(sibling)) && !places_.contains(sibling))
        keep(sibling, build(std::move(halves[side_of(sibling)])));
    auto made = build(std::move(halves[side_of(node)]));
    return is_its_own ? keep(node, made) : made;
}

}  // namespace kerf::view

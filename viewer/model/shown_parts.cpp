#include "viewer/model/shown_parts.h"

#include <algorithm>

#include "base/core/name_pattern.h"

namespace kerf::view {

namespace {

bool holds(const std::vector<std::string>& ascending, const std::string& name) {
    return std::binary_search(ascending.begin(), ascending.end(), name);
}

}  // namespace

bool Visibility::is_hidden(NodeId wanted) const {
    for (; wanted > no_node; wanted = parent_of(wanted))
        if (std::binary_search(hidden.begin(), hidden.end(), wanted)) return true;
    return false;
}

const std::string* region_of(const Document& document, NodeId node) {
    const TreeRow* row = document.tree.find(node);
    if (!row || !row->region.is_valid() || row->region >= RegionIndex(document.region_names.size())) return nullptr;
    return &document.region_names[row->region.value()];
}

std::vector<char> hidden_patches(const ViewState& state, const Document& document) {
    const std::vector<std::string>& patterns = state.visibility.hidden_patches;
    std::vector<char> hidden;
    for (const std::string& patch : document.patch_names)
        hidden.push_back(std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
            return pattern == patch || matches_pattern(pattern, patch);
        }));
    if (std::find(hidden.begin(), hidden.end(), 1) == hidden.end()) hidden.clear();
    return hidden;
}

bool is_hidden(const ViewState& state, const std::string& region) {
    return holds(state.visibility.hidden_regions, region);
}

bool shows_region(const ViewState& state, const Document& document, const std::string& region) {
    if (is_hidden(state, region)) return false;
    const std::optional<std::string>& only = state.visibility.isolated_region;
    if (!only || *only == region) return true;
    const std::vector<std::string>& names = document.region_names;
    return std::find(names.begin(), names.end(), *only) == names.end();
}

bool shows_node(const ViewState& state, const Document& document, NodeId node) {
    const Visibility& visibility = state.visibility;
    if (visibility.is_hidden(node) || (visibility.isolated && !lies_below(node, *visibility.isolated))) return false;
    const std::string* region = region_of(document, node);
    return !region || shows_region(state, document, *region);
}

bool is_glass(const ViewState& state, const std::string& region) {
    return holds(state.visibility.glass_regions, region);
}

bool is_glass(const ViewState& state, const Document& document, NodeId part) {
    const std::string* region = region_of(document, part);
    return region && is_glass(state, *region);
}

bool is_last_patch(const ViewState& state, const Document& document, const std::string& patch) {
    const std::vector<std::string>& hidden = state.visibility.hidden_patches;
    return std::all_of(document.patch_names.begin(), document.patch_names.end(), [&](const std::string& name) {
        return name == patch || std::find(hidden.begin(), hidden.end(), name) != hidden.end();
    });
}

void reveal_region(ViewState& state, const std::string& region) {
    Visibility& visibility = state.visibility;
    set_member(visibility.hidden_regions, region, false);
    if (visibility.isolated_region && *visibility.isolated_region != region) visibility.isolated_region.reset();
}

}  // namespace kerf::view

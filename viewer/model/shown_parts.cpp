#include "viewer/model/shown_parts.h"

#include <algorithm>

namespace kerf::view {

namespace {

bool holds(const std::vector<std::string>& ascending, const std::string& name) {
    return std::binary_search(ascending.begin(), ascending.end(), name);
}

}  // namespace

bool ViewState::is_hidden(NodeId wanted) const {
    for (; wanted > 0; wanted /= 2)
        if (std::binary_search(hidden.begin(), hidden.end(), wanted)) return true;
    return false;
}

const std::string* region_of(const Document& document, NodeId node) {
    const TreeRow* row = document.tree.find(node);
    if (!row || row->region < 0 || row->region >= std::ssize(document.region_names)) return nullptr;
    return &document.region_names[static_cast<std::size_t>(row->region)];
}

bool is_hidden(const ViewState& state, const std::string& region) { return holds(state.hidden_regions, region); }

bool shows_region(const ViewState& state, const Document& document, const std::string& region) {
    if (is_hidden(state, region)) return false;
    if (!state.isolated_region || *state.isolated_region == region) return true;
    const std::vector<std::string>& names = document.region_names;
    return std::find(names.begin(), names.end(), *state.isolated_region) == names.end();
}

bool shows_node(const ViewState& state, const Document& document, NodeId node) {
    if (state.is_hidden(node) || (state.isolated && !lies_below(node, *state.isolated))) return false;
    const std::string* region = region_of(document, node);
    return !region || shows_region(state, document, *region);
}

bool is_glass(const ViewState& state, const std::string& region) { return holds(state.glass_regions, region); }

bool is_glass(const ViewState& state, const Document& document, NodeId part) {
    const std::string* region = region_of(document, part);
    return region && is_glass(state, *region);
}

void reveal_region(ViewState& state, const std::string& region) {
    set_member(state.hidden_regions, region, false);
    if (state.isolated_region && *state.isolated_region != region) state.isolated_region.reset();
}

}  // namespace kerf::view

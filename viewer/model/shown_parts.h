// The parts of a document that a view shows, by their nodes and by their regions.
#pragma once

#include <string>
#include <vector>

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Returns the name of the region in which a part, or all of a node, lies, where there are several regions; else null.
const std::string* region_of(const Document& document, NodeId node);

/// Returns whether a region is hidden by its name.
bool is_hidden(const ViewState& state, const std::string& region);
/// Returns whether a region is neither hidden nor beside the region that is isolated, if the document has that one.
/// O(log n) in the hidden regions, O(n) in all if one is isolated.
bool shows_region(const ViewState& state, const Document& document, const std::string& region);
/// Returns whether neither a node nor its region is hidden, or beside an isolated one. A node of several regions has no
/// region.
bool shows_node(const ViewState& state, const Document& document, NodeId node);
/// Returns whether a region is drawn as glass.
bool is_glass(const ViewState& state, const std::string& region);
/// Returns whether a part lies in a region that is drawn as glass.
bool is_glass(const ViewState& state, const Document& document, NodeId part);

/// Returns 1 for each patch that is hidden by its name, and 0 for each other one; empty if none is.
std::vector<char> hidden_patches(const ViewState& state, const Document& document);

/// Returns whether nothing of the surface would be seen without a patch, as all others are hidden.
bool is_last_patch(const ViewState& state, const Document& document, const std::string& patch);

/// Shows a region again, whatever has hidden it.
void reveal_region(ViewState& state, const std::string& region);

}  // namespace kerf::view

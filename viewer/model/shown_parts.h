// Which parts of a document a view shows, by their nodes and by their regions.
#pragma once

#include <string>

#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// The name of the region of several in which a part, or all of a node, lies; else null.
const std::string* region_of(const Document& document, NodeId node);

bool is_hidden(const ViewState& state, const std::string& region);
/// Neither hidden nor beside the region that is isolated. O(log n).
bool shows_region(const ViewState& state, const Document& document, const std::string& region);
/// Neither it nor its region is hidden, or beside what is isolated; a node of several regions has none.
bool shows_node(const ViewState& state, const Document& document, NodeId node);
/// A region is drawn as glass.
bool is_glass(const ViewState& state, const std::string& region);
/// It lies in one that is.
bool is_glass(const ViewState& state, const Document& document, NodeId part);

/// Shows a region again, whatever has hidden it.
void reveal_region(ViewState& state, const std::string& region);

}  // namespace kerf::view

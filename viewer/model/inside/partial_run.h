// The folder of a run that is under way, or was interrupted, as it is at one moment.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "viewer/model/document.h"

namespace kerf::view {

/// The state of the folder DIR.kerf-partial.
struct PartialRun {
    bool exists = false;
    bool is_alive = false;   ///< its process lives, or runs on another host, where nobody can tell
    std::set<NodeId> parts;  ///< parts that are cut out: their surfaces are there
    std::set<NodeId> taken;  ///< parts that are, or were, meshed in this run
    std::set<NodeId> finished;
    std::set<NodeId> failed;
    std::vector<TreeRow> outcomes;  ///< tets and seconds of finished parts that were not known before

    bool is_at_the_same(const PartialRun& o) const {
        return exists == o.exists && is_alive == o.is_alive && parts == o.parts && taken == o.taken &&
               finished == o.finished && failed == o.failed;
    }
};

/// Reads the state of such a folder. `known` are finished parts whose outcome need not be read. Files that cannot be
/// read are passed over.
PartialRun look_at_partial_run(const std::string& partial, const std::set<NodeId>& known);

/// Returns the parts that workers have taken.
std::set<NodeId> parts_taken(const std::string& partial);

}  // namespace kerf::view

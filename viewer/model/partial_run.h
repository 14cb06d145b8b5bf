// The folder of a run that is under way, or was interrupted, as it is at one moment.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "viewer/model/document.h"

namespace kerf::view {

/// What lies in DIR.kerf-partial.
struct PartialRun {
    bool exists = false;
    bool is_alive = false;   ///< its process lives, or runs on another host, where nobody can tell
    std::set<NodeId> parts;  ///< that are cut out: their surfaces are there
    std::set<NodeId> taken;  ///< that are, or were, meshed in this run
    std::set<NodeId> finished;
    std::set<NodeId> failed;
    std::vector<TreeRow> outcomes;  ///< tets and seconds of finished parts that were not known before

    bool is_at_the_same(const PartialRun& o) const {
        return exists == o.exists && is_alive == o.is_alive && parts == o.parts && taken == o.taken &&
               finished == o.finished && failed == o.failed;
    }
};

/// `known`: finished parts whose outcome need not be read. What cannot be read is passed over.
PartialRun look_at_partial_run(const std::string& partial, const std::set<NodeId>& known);

/// The parts that workers have taken.
std::set<NodeId> parts_taken(const std::string& partial);

}  // namespace kerf::view

// Parts whose reading can be ended.
#pragma once

#include <functional>

#include "base/core/error.h"
#include "files/part/part.h"

namespace kerf {

/// The parts of another source, which must outlive it, with a question before each load: unless `is_cancelled` is
/// empty, it is called, and true ends the load with Error(cancelled).
class WatchedParts : public PartSource {
 public:
    WatchedParts(const PartSource& parts, const std::function<bool()>& is_cancelled)
        : parts_(parts), is_cancelled_(is_cancelled) {}
    const MeshOutline& outline() const override { return parts_.outline(); }
    Part load(PartIndex index) const override {
        end_if_cancelled();
        return parts_.load(index);
    }
    Part load_only(PartIndex index, PartContent content) const override {
        end_if_cancelled();
        return parts_.load_only(index, content);
    }
    const RegionWalls& walls() const override { return parts_.walls(); }

 private:
    void end_if_cancelled() const {
        if (is_cancelled_ && is_cancelled_()) throw Error(ErrorCode::cancelled, "Writing was cancelled.");
    }

    const PartSource& parts_;
    const std::function<bool()>& is_cancelled_;
};

}  // namespace kerf

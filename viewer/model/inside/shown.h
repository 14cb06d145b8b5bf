// The document that is shown, and the one that was shown before the last change.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>

#include "viewer/model/document.h"
#include "viewer/model/inside/replayer.h"
#include "viewer/model/inside/run_process.h"
#include "viewer/model/inside/store.h"

namespace kerf::view {

/// A cut that is to be made again.
struct CutAgain {
    NodeId node = root_node;
    RunRequest options;
    std::optional<Plane> plane;
};

/// A document with all that belongs to it.
struct Shown {
    static constexpr std::size_t store_bytes = std::size_t{4} << 30;

    Document document;
    std::shared_ptr<Replayer> replayer;      ///< replays its trace; only the loader's thread looks inside
    std::set<NodeId> folder_parts;           ///< parts whose files in its folder are those of the tree
    std::shared_ptr<ScratchFolder> scratch;  ///< the scratch folder that holds its folder, if one does
    std::deque<CutAgain> cuts_again;         ///< cuts that wait for the one under way, because each changes the trace
    Store store{store_bytes};
};

/// Two documents to compare, one of which is shown. `now` stays where it is, but its members are replaced: only its
/// address may be kept.
struct ShownPair {
    Shown now;
    std::optional<Shown> other;
    bool shows_before = false;  ///< `now` is the one before, `other` the one after

    /// Makes `before`, with all of `now` but its document, the other one. `now` then is for a new document, whose store
    /// is empty.
    void set_aside(Document before);
    void swap();
};

}  // namespace kerf::view

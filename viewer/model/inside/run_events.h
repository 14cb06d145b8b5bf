// Reads the lines of an events file (run/report/event_log.h) as they come.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/model/document.h"

namespace kerf::view {

/// One line of an events file. Numbers that it does not tell are negative or 0.
struct RunEvent {
    enum class Kind { run, stage, parts, part, end, other };
    struct Part {
        NodeId id = no_node;
        NodeState state = NodeState::waiting;
        double load = -1, volume = -1, seconds = -1;
        std::int64_t facets = -1, tets = -1;
        std::int32_t rank = -1;
        std::string message;
        std::string filled_by;  ///< TreeRow::filled_by
        std::int64_t core_tets = 0;
    };
    Kind kind = Kind::other;
    double seconds = 0;                ///< seconds since the start of the run
    std::string input, output, trace;  ///< of `run`: paths, absolute or empty
    double scale = 1;                  ///< of `run`: the factor of the input's coordinates
    std::string stage;                 ///< of `stage`: its name
    std::vector<Part> parts;           ///< of `parts`: all parts; of `part`: the one that has ended
    std::int64_t parts_done = 0, parts_total = 0;
    double load_done = 0;
    int exit_code = 0;
    std::string message;  ///< of `end`: the reason of an end without success, or empty
};

/// Reads an events file while it is written. A file that is not there yet has no events.
class EventTail {
 public:
    explicit EventTail(std::string path) : path_(std::move(path)) {}
    const std::string& path() const { return path_; }

    /// Returns the events that have come since the last call. Lines that are no events are passed over.
    std::vector<RunEvent> read_new();

 private:
    std::string path_;
    std::uintmax_t position_ = 0;
    std::string rest_;  // a line that has no end yet
};

/// Fills a tree with the facts that an event tells of parts; makes the tree where there is none.
void apply_to_tree(const RunEvent& event, Tree& tree);
/// Fills stage, counts and times with those of an event.
void apply_to_progress(const RunEvent& event, Progress& progress);

}  // namespace kerf::view

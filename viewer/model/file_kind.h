// What kind of thing lies under a path.
#pragma once

#include <string>

namespace kerf::view {

struct OpenedPath {
    enum class Kind {
        surface,  ///< or what nobody knows: the reader of surfaces says what is wrong
        trace,
        events,
        run,          ///< a finished one
        partial_run,  ///< one that is under way, or was interrupted
    };
    Kind kind = Kind::surface;
    std::string folder;   ///< of a run, absolute: where it is or will be when it is finished
    std::string partial;  ///< of one that is not: where it is now
};

/// Without ".", ".." and a slash at the end.
std::string absolute_path(const std::string& path);

/// Whether something lies there that can be looked at; not for an empty path.
bool exists(const std::string& path);

/// Looks at names and the first bytes. Throws Error(io) for a folder that is no run.
OpenedPath tell_kind(const std::string& path);

}  // namespace kerf::view

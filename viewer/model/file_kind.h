// The kind of thing that lies under a path.
#pragma once

#include <string>

namespace kerf::view {

/// A path, as far as its names and first bytes tell.
struct OpenedPath {
    enum class Kind {
        surface,  ///< a surface, or anything unknown, whose error the reader of surfaces tells
        trace,
        events,
        run,          ///< a finished run
        partial_run,  ///< a run that is under way, or was interrupted
    };
    Kind kind = Kind::surface;
    std::string folder;   ///< absolute path of a run's folder, also before it is finished
    std::string partial;  ///< folder in which a run that is not finished is now
};

/// Returns the absolute path without ".", ".." and a slash at the end.
std::string absolute_path(const std::string& path);

/// Returns whether a file or folder that can be looked at lies there; false for an empty path.
bool exists(const std::string& path);

/// Returns the kind by names and the first bytes. Throws Error(io) for a folder that is no run.
OpenedPath tell_kind(const std::string& path);

}  // namespace kerf::view

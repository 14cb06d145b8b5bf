// A folder that lives as long as an object.
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "base/core/error.h"

namespace kerf {

/// A new folder, which is removed with all that is in it when the object is destroyed.
class TemporaryFolder {
 public:
    /// Makes the folder under the path `stem`, a dot and six characters. Throws Error(io), "Cannot `action`: ...
    /// `advice`".
    TemporaryFolder(const std::string& stem, const std::string& action, const std::string& advice)
        : path_(stem + ".XXXXXX") {
        if (::mkdtemp(path_.data())) return;
        const std::string reason = std::generic_category().message(errno);
        throw Error(ErrorCode::io, "Cannot " + action + ": " + reason + ". " + advice);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }

 private:
    std::string path_;
};

}  // namespace kerf

#include "files/io/folder_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

std::vector<std::string> list_files(const std::string& folder) {
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string path = entry->path().lexically_relative(folder).string();
        std::error_code ignored;  // an entry that goes meanwhile is none
        if (entry->is_symlink(ignored) || !entry->is_directory(ignored))
            files.push_back(path);
        else if (fs::is_empty(entry->path(), ignored))
            files.push_back(path + "/");
    }
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
        throw Error(ErrorCode::io, fmt::format("Cannot read the folder {}: {}. Check its permissions, or choose "
                                               "another folder.",
                                               folder, error.message()));
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace kerf

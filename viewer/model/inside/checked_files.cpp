#include "viewer/model/inside/checked_files.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <system_error>

#include <nlohmann/json.hpp>

#include "files/io/listed_files.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

// The lists of the folders that were asked for, so that a part does not cost a look at the report of all parts.
class Lists {
 public:
    std::shared_ptr<const ListedFiles> of(const std::string& folder) {
        std::error_code error;
        const fs::file_time_type written = fs::last_write_time(folder + "/report.json", error);
        if (error) return nullptr;
        const std::lock_guard lock(mutex_);
        Known& known = known_[folder];
        if (!known.files || known.written != written)
            known = {written, std::make_shared<const ListedFiles>(folder, read_report_json(folder))};
        return known.files;
    }

 private:
    struct Known {
        fs::file_time_type written;
        std::shared_ptr<const ListedFiles> files;
    };
    std::mutex mutex_;
    std::map<std::string, Known> known_;
};

}  // namespace

std::string checked_file(const std::string& folder, const std::string& path) {
    static Lists lists;
    const std::shared_ptr<const ListedFiles> files = lists.of(folder);
    return files ? files->verified(path) : folder + "/" + path;
}

}  // namespace kerf::view

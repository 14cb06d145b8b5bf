// The bytes of files, to compare runs by.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

namespace kerf::test {

inline std::string bytes_of_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The files of a folder, without its sub-folders, by their names.
inline std::map<std::string, std::string> contents(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file()) files[entry.path().filename()] = bytes_of_file(entry.path());
    return files;
}

/// All files below a folder by their paths, links by where they lead; folders, which end with '/', are empty.
inline std::map<std::string, std::string> contents_below(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        if (entry.is_symlink())
            files[name] = "-> " + std::filesystem::read_symlink(entry.path()).string();
        else if (entry.is_regular_file())
            files[name] = bytes_of_file(entry.path());
        else
            files[name + "/"] = "";
    }
    return files;
}

/// contents_below() without the report, which has what ranks, workers and time make.
inline std::map<std::string, std::string> result_of_run(const std::string& folder) {
    auto files = contents_below(folder);
    files.erase("report.json");
    return files;
}

}  // namespace kerf::test

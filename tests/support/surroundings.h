// What lies around a run: nothing but its named outputs may change.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace kerf::test {

/// The folders of all files that a command line of kerf names, as they were.
class Surroundings {
 public:
    explicit Surroundings(const std::vector<std::string>& arguments);
    /// A line for each file that was created, changed or removed since then and is no output, nor beside one under a
    /// name that a run may use; empty if there is none.
    std::string changes() const;

 private:
    using Files = std::map<std::string, std::string>;  // path -> what tells a change
    Files snapshot() const;
    bool is_output(const std::string& path) const;

    std::set<std::string> folders_;
    std::vector<std::string> outputs_;
    Files before_;
};

}  // namespace kerf::test

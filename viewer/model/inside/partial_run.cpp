#include "viewer/model/inside/partial_run.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/core/host_name.h"
#include "files/io/run_folder.h"
#include "files/part/vtu_reader.h"
#include "run/work/journal.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

// The number between a prefix and an ending; 0 if the name is another one.
NodeId number_in(const std::string& name, std::string_view prefix, std::string_view ending) {
    NodeId number = 0;
    if (!name.starts_with(prefix) || !name.ends_with(ending) || name.size() < prefix.size() + ending.size()) return 0;
    const char* end = name.data() + name.size() - ending.size();
    const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, number);
    return error == std::errc() && stop == end && number > 0 ? number : 0;
}

// Large runs have folders below, which are searched, too.
std::set<NodeId> numbers_in(const fs::path& folder, std::string_view prefix, std::string_view ending) {
    std::set<NodeId> numbers;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        const NodeId number = number_in(entry->path().filename(), prefix, ending);
        if (number && !entry->is_directory(ignored)) numbers.insert(number);
    }
    return numbers;
}

// The lock holds "process 123 on host". To try the lock itself could keep a run out that starts at this moment.
bool is_alive(const fs::path& partial) {
    std::ifstream file(partial / "work/lock");
    std::string word, host;
    pid_t process = 0;
    file >> word >> process >> word >> host;
    if (process <= 0) return false;
    return host != host_name() || ::kill(process, 0) == 0 || errno == EPERM;
}

}  // namespace

std::set<NodeId> parts_taken(const std::string& partial) { return numbers_in(partial + "/work/taken", "", ""); }

PartialRun look_at_partial_run(const std::string& partial, const std::set<NodeId>& known) {
    PartialRun run;
    std::error_code ignored;
    run.exists = fs::is_directory(partial, ignored);
    if (!run.exists) return run;
    run.is_alive = is_alive(partial);
    run.parts = numbers_in(partial + "/parts", "part_", ".surface.vtu");
    std::erase_if(run.parts, [&](NodeId part) {
        return !is_complete_part_file(partial + "/parts/" + part_surface_file_name(part));
    });
    run.taken = parts_taken(partial);
    run.failed = numbers_in(partial + "/failed", "part_", ".txt");
    for (const NodeId part : numbers_in(partial + "/work/journal", "", "")) {
        if (known.contains(part)) {
            run.finished.insert(part);
            continue;
        }
        const auto entry = read_journal_entry(partial + "/" + journal_file_name(part));
        if (!entry) continue;
        run.finished.insert(part);
        TreeRow row;
        row.id = part;
        row.tets = entry->outcome.result.tets;
        row.core_tets = entry->outcome.result.core_tets;
        row.filled_by = name_of_filler(entry->outcome.result.mesher, entry->outcome.result.strategy);
        row.seconds = entry->outcome.seconds;
        run.outcomes.push_back(row);
    }
    return run;
}

}  // namespace kerf::view

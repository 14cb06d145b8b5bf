// The folder of a run lies beside its final place until finish_run() moves it there. It is kept from the beginning,
// with the options of the run in it, so that after an error or a kill the next run into it finds finished parts, and a
// user can go on by its name alone. Options that finished parts were made with are replaced only when this run has cut
// its surface: until then it may still fail, and the parts would be lost to a run with the older options. A transient
// run, that of a mesh in memory, has a temporary folder without journal, saved options and hashes.
#include "run/run/inside/result_folder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/parallel/process_memory.h"
#include "files/io/folder_files.h"
#include "files/io/output_file.h"
#include "files/io/text_file.h"
#include "files/part/part_store.h"
#include "run/request/saved_run.h"
#include "run/run/inside/range_of_rank.h"
#include "run/run/inside/write_stage.h"
#include "run/run/shared_folder.h"

namespace kerf {

namespace {

// Saves the options: a run that is continued by the name of its folder has nothing else to go by.
void save(const RunRequest& request, const Input& input, const RunFolder& folder) {
    std::error_code ignored;
    if (request.sizes.background)
        std::filesystem::remove(folder.saved_run_file(), ignored);
    else
        save_run(folder.saved_run_file(), request, input.file_hash);
}

// Files of vtu hold all that those of the store do; a run with failed parts is continued from the latter.
void remove_stored_parts(const RunChoices& choices, const RunFolder& folder, int exit_code) {
    if (!has_vtu(choices.formats) || exit_code != 0) return;
    remove_run_files(folder.partial_path(), [](const std::string& file) { return is_stored_part(file); });
}

// Sum of the peaks of the ranks, each with that of the largest worker for each of its workers.
std::int64_t peak_memory(const RunContext& run, const std::vector<PartReport>& parts) {
    std::int64_t largest_worker = 0, sum = 0;
    for (const PartReport& part : parts) largest_worker = std::max(largest_worker, part.result.peak_rss_bytes);
    for (const std::int64_t bytes : all_gather(run.ranks, own_peak_rss_bytes()))
        sum += bytes + run.plan.request().workers.count * largest_worker;
    return sum;
}

std::vector<std::string> find_other_files(const RunFolder& folder, const std::vector<RunFile>& written) {
    std::set<std::string> known;
    for (const RunFile& file : written) known.insert(file.path);
    std::vector<std::string> files = list_files(folder.partial_path());
    std::erase_if(files, [&](const std::string& file) {
        return known.contains(file) || file.starts_with("work/") || file.ends_with('/') ||
               !is_named_like_run_file(file);
    });
    return files;
}

// The hashes that ranks and workers have told of files that they wrote, by the names of the files.
std::map<std::string, FileHash> hashes_of_parts(const std::vector<PartReport>& parts) {
    std::map<std::string, FileHash> hashes;
    for (const PartReport& part : parts) {
        hashes["parts/" + part_surface_file_name(part.id)] = part.surface_hash;
        if (part.result.code == 0) hashes["parts/" + stored_part_file_name(part.id)] = part.result.file_hash;
    }
    return hashes;
}

// Returns all files of the folder but those of the work under way and the report: the `written` ones, which are known,
// and the others, of which each rank reads a share. The same on every rank. A surface or a stored part that does not
// have the hash with which it was written is Error(io) on every rank alike.
std::vector<RunFile> list_run_files(const RunContext& run, const RunFolder& folder,
                                    const std::vector<PartReport>& parts, std::vector<RunFile> written) {
    Communicator& ranks = run.ranks;
    const std::vector<std::string> found = in_agreement(
        ranks, [&] { return run.is_root() ? find_other_files(folder, written) : std::vector<std::string>(); });
    const std::vector<std::string> files = all_gather(ranks, found).front();
    const std::map<std::string, FileHash> expected = hashes_of_parts(parts);
    const LeafRange share = range_of_rank(count_of(files), ranks);
    const std::vector<RunFile> own = in_agreement(ranks, [&] {
        std::vector<RunFile> described;
        for (std::int32_t i = share.first; i < share.last; ++i) {
            tell_progress(run.listener, "hash", i, files.size());
            described.push_back(describe_file(folder.partial_path(), files[i]));
            const auto hash = expected.find(described.back().path);
            if (hash != expected.end() && described.back().hash != hash_text(hash->second))
                throw Error(ErrorCode::io, fmt::format("{} is not what was written: the disk or the memory has damaged "
                                                       "it. Continue the run to write it again.",
                                                       folder.file(hash->first)));
        }
        return described;
    });
    const std::vector<RunFile> others = gather_items(ranks, own);
    written.insert(written.end(), others.begin(), others.end());
    sort_files(written);
    return written;
}

// Hours of work are not lost to a command line that differs by mistake.
void refuse_to_lose_parts(const RunRequest& request, const Input& input, const RunFolder& folder) {
    const std::size_t finished = folder.finished_parts();
    if (finished == 0) return;
    const std::string others =
        request.volume ? differences_of_runs(folder.saved_run_file(), request, input.file_hash) : "having cells";
    if (others.empty()) return;
    throw Error(
        ErrorCode::usage,
        fmt::format("{} holds {} finished part{} of an interrupted run, which differs in {}. kerf mesh --resume "
                    "{} goes on with that one. To start anew, remove it, or choose another --output.",
                    folder.partial_path(), finished, finished == 1 ? "" : "s", others, request.output));
}

}  // namespace

RunFolder open_folder(const RunContext& run, const Input& input) {
    const RunRequest& request = run.plan.request();
    return open_together(run.ranks, [&] {
        if (request.transient) return RunFolder::create_transient(request.output);
        RunFolder folder = RunFolder::create(request.output, [&](const std::string& saved) {
            return request.volume && is_same_run(saved, request, input.file_hash);
        });
        refuse_to_lose_parts(request, input, folder);
        return folder;
    });
}

void keep_folder(const RunContext& run, const Input& input, RunFolder& folder) {
    const RunRequest& request = run.plan.request();
    in_agreement(run.ranks, [&] {
        if (!run.is_root() || !request.volume || request.transient) return;
        if (folder.finished_parts() == 0) save(request, input, folder);  // else the options are those of the finished
        folder.keep();                                                   // parts, until this run knows its own
    });
}

std::size_t clear_folder(const RunContext& run, const Input& input, RunFolder& folder,
                         const std::vector<PartReport>& parts) {
    const RunRequest& request = run.plan.request();
    return in_agreement(run.ranks, [&] {
        if (!run.is_root() || request.transient) return std::size_t{0};
        const std::size_t finished = folder.finished_parts();
        std::vector<NodeId> leaves;
        if (request.volume)
            for (const PartReport& part : parts) leaves.push_back(part.id);
        folder.keep_only(leaves);
        if (request.volume) save(request, input, folder);
        return finished;
    });
}

RunReport finish_run(const RunContext& run, std::optional<RunFolder>& folder, RunReport report) {
    const RunRequest& request = run.plan.request();
    report.peak_rss_bytes = peak_memory(run, report.parts);
    if (request.transient) {
        report.seconds.wall = run.longest(run.whole);
        in_agreement(run.ranks, [&] {
            if (run.is_root() && !request.outputs.report_file.empty())
                write_output_file(request.outputs.report_file, to_json(report));
        });
        return report;
    }
    report.folder.files = run.timed(report.seconds.hash, [&] {
        in_agreement(run.ranks, [&] {
            if (run.is_root() && request.volume) remove_stored_parts(run.plan.choices, *folder, report.exit_code);
        });
        return list_run_files(run, *folder, report.parts, std::move(report.folder.files));
    });
    if (!run.is_root()) folder.reset();  // nobody uses it when it moves
    report.seconds.wall = run.longest(run.whole);
    in_agreement(run.ranks, [&] {
        if (!run.is_root()) return;
        const std::string json = to_json(report);
        write_text_file(folder->file("report.json"), json);
        report.folder.path = folder->commit(report.exit_code == 0);
        report.folder.kept_valid_run = report.folder.path != folder->final_path();
        if (!request.outputs.report_file.empty()) write_output_file(request.outputs.report_file, json);
    });
    return report;
}

Error with_way_to_go_on(const RunRequest& request, std::optional<RunFolder>& folder, const Error& error) {
    if (!folder || !request.volume || request.transient) return error;
    std::size_t finished = 0;
    try {
        finished = folder->finished_parts();
    } catch (const Error&) {  // it cannot be read
        return error;
    }
    if (finished == 0 && error.code() != ErrorCode::cancelled) {
        folder->discard();
        return error;
    }
    const bool are_all = finished >= static_cast<std::size_t>(request.parts);
    const std::string again = request.sizes.background ? "the same call into " : "kerf mesh --resume ";
    return {error.code(),
            fmt::format("{} {}{} parts are finished; {}{} {}.", error.what(), are_all ? "All " : "", finished, again,
                        request.output, are_all ? "writes the files that are missing" : "does the others"),
            error.elements()};
}

}  // namespace kerf

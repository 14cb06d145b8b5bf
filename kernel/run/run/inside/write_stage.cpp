// Formats have three kinds of files. Those of the whole are written first, by the root rank; those of parts by the
// threads of each rank, each of which loads a part once and writes it in all formats; merged files, which are read in
// one piece, by the root rank at the end. Threads take the next part of the share by a counter, while the thread that
// called waits and tells the progress: it alone may talk to the listener, which may throw. An error of any of them
// moves the counter to its end, so that the others stop after their part. A file that several ranks have written has no
// size (-1) in their lists; the root rank describes it when all have ended.
#include "run/run/inside/write_stage.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "fill/mesh/adjacency.h"
#include "run/run/inside/range_of_rank.h"

namespace kerf {

namespace {

// One format and the files that this rank has written of it.
struct FormatFiles {
    const Format* format;
    std::unique_ptr<ExportFiles> files;
};

std::string below(const std::string& folder, const std::string& sub_folder) {
    return sub_folder.empty() ? folder : folder + "/" + sub_folder;
}

// The names that lie in the sub-folder, as seen from there.
std::set<std::string> names_below(const std::set<std::string>& names, const std::string& sub_folder) {
    if (sub_folder.empty()) return names;
    std::set<std::string> below;
    for (const std::string& name : names)
        if (name.starts_with(sub_folder + "/")) below.insert(name.substr(sub_folder.size() + 1));
    return below;
}

std::vector<FormatFiles> open_formats(std::span<const FormatPlace> formats, const WriteTarget& target) {
    std::vector<FormatFiles> opened;
    for (const auto& [format, sub_folder] : formats) {
        const std::string place = target.place.empty() ? "" : below(target.place, sub_folder);
        opened.push_back({format, std::make_unique<ExportFiles>(below(target.folder, sub_folder), place,
                                                                names_below(target.own, sub_folder), target.options)});
    }
    return opened;
}

void write_part(const PartSource& parts, PartIndex index, const std::vector<FormatFiles>& formats) {
    Part part = parts.load(index);
    for (const auto& [format, files] : formats) {
        if (!format->write_part) continue;
        if (format->needs_face_neighbours && part.mesh.neighbours.empty()) connect_tets(part.mesh);
        format->write_part(parts, index, part, *files);
    }
}

// The threads of one rank that write its share of the parts; the first error of any of them ends all.
class PartWriters {
 public:
    PartWriters(const PartSource& parts, const std::vector<FormatFiles>& formats, LeafRange share,
                const PartWritten& part_written)
        : parts_(parts), formats_(formats), share_(share), part_written_(part_written), next_(share.first) {}

    /// Returns when all are written. `while_waiting` is called now and then, with the number that is done.
    template <class WhileWaiting>
    void run(int threads, WhileWaiting while_waiting) {
        {
            std::vector<std::jthread> running;
            const JoinAtEnd stop_at_end{*this};
            for (int i = 0; i < std::min(threads, share_.last - share_.first); ++i)
                running.emplace_back([this] { write_some(); });
            std::unique_lock lock(mutex_);
            while (!error_ && done_ < share_.last - share_.first) {
                changed_.wait_for(lock, std::chrono::milliseconds(100));
                const std::int32_t done = done_;
                lock.unlock();
                while_waiting(done);
                lock.lock();
            }
        }
        if (error_) std::rethrow_exception(error_);
    }

 private:
    // Ends the counter before the threads are joined, also when `while_waiting` throws: it is destroyed before them.
    struct JoinAtEnd {
        PartWriters& writers;
        ~JoinAtEnd() { writers.next_ = writers.share_.last; }
    };

    void write_some() {
        for (std::int32_t next = next_++; next < share_.last; next = next_++) {
            std::exception_ptr error;
            try {
                write_part(parts_, PartIndex(next), formats_);
                if (part_written_) part_written_(PartIndex(next));
            } catch (...) {
                error = std::current_exception();
            }
            const std::lock_guard lock(mutex_);
            ++done_;
            if (error && !error_) error_ = error;
            if (error_) next_ = share_.last;
            changed_.notify_one();
        }
    }

    const PartSource& parts_;
    const std::vector<FormatFiles>& formats_;
    LeafRange share_;
    const PartWritten& part_written_;
    std::atomic<std::int32_t> next_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::int32_t done_ = 0;
    std::exception_ptr error_;
};

// The files of all formats, with paths relative to the run folder.
std::vector<RunFile> list_files_of(const std::vector<FormatFiles>& formats, const std::string& folder) {
    std::vector<RunFile> all;
    for (const auto& [format, files] : formats)
        for (RunFile& file : files->list()) {
            file.path = std::filesystem::path(files->folder() + "/" + file.path).lexically_relative(folder).string();
            all.push_back(std::move(file));
        }
    return all;
}

}  // namespace

bool has_vtu(const std::vector<const Format*>& formats) {
    return std::find(formats.begin(), formats.end(), &find_format("vtu")) != formats.end();
}

std::vector<FormatPlace> places_in_run_folder(const std::vector<const Format*>& formats) {
    std::vector<FormatPlace> places;
    for (const Format* format : formats)
        places.push_back({format, format == &find_format("vtu") ? "" : fmt::format("export/{}", format->name)});
    return places;
}

std::vector<RunFile> write_parts(Communicator& ranks, const PartSource& parts, std::span<const FormatPlace> formats,
                                 const WriteTarget& target, int threads, RunListener* listener,
                                 const PartWritten& part_written) {
    const std::vector<FormatFiles> opened = open_formats(formats, target);
    const auto check = [&](std::int32_t done, std::int32_t total) { tell_progress(listener, "write", done, total); };
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return;
        for (const auto& [format, files] : opened)
            if (format->write_whole) format->write_whole(parts, *files);
    });
    const LeafRange share = range_of_rank(count_of(parts.outline().parts), ranks);
    const bool any_in_parts =
        std::any_of(formats.begin(), formats.end(), [](const FormatPlace& f) { return f.format->write_part; });
    const std::vector<RunFile> own = in_agreement(ranks, [&] {
        if (any_in_parts)
            PartWriters(parts, opened, share, part_written).run(threads, [&](std::int32_t done) {
                check(done, share.last - share.first);
            });
        if (ranks.rank() == 0)
            for (const auto& [format, files] : opened) {
                check(0, 1);
                if (format->is_merged_only()) format->write_merged(parts, {}, *files, "mesh");
            }
        return list_files_of(opened, target.folder);
    });
    std::vector<RunFile> all = gather_items(ranks, own);
    sort_files(all);
    in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return;
        for (RunFile& file : all)
            if (file.bytes < 0) file = describe_file(target.folder, file.path);  // several ranks have written it
    });
    return all;
}

}  // namespace kerf

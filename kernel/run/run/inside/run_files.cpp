#include "run/run/inside/run_files.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "files/io/folder_files.h"
#include "run/run/inside/range_of_rank.h"

namespace kerf {

namespace {

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

}  // namespace

std::vector<RunFile> list_run_files(Communicator& ranks, const RunFolder& folder, const std::vector<PartReport>& parts,
                                    std::vector<RunFile> written,
                                    const std::function<void(std::size_t, std::size_t)>& progress) {
    const std::vector<std::string> found = in_agreement(
        ranks, [&] { return ranks.rank() == 0 ? find_other_files(folder, written) : std::vector<std::string>(); });
    const std::vector<std::string> files = all_gather(ranks, found).front();
    const std::map<std::string, FileHash> expected = hashes_of_parts(parts);
    const LeafRange share = range_of_rank(static_cast<std::int32_t>(files.size()), ranks);
    const std::vector<RunFile> own = in_agreement(ranks, [&] {
        std::vector<RunFile> described;
        for (std::int32_t i = share.first; i < share.last; ++i) {
            progress(static_cast<std::size_t>(i), files.size());
            described.push_back(describe_file(folder.partial_path(), files[static_cast<std::size_t>(i)]));
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

}  // namespace kerf

#include "solve/run/useful_ranks.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/file_bytes.h"
#include "files/io/json.h"

namespace kerf {

namespace {

constexpr std::int64_t least_tets_of_rank = 20'000;  // with fewer, ranks wait for each other
// The bytes of a facet with many digits as text, times so many facets that there are cells for a rank, whatever their
// sizes.
constexpr std::int64_t least_bytes_of_rank = 1'250'000;

int between_one_and(std::int64_t most, std::int64_t ranks) {
    return std::clamp<std::int64_t>(ranks, 1, std::max<std::int64_t>(1, most));
}

}  // namespace

int useful_ranks_of_run(const std::string& folder) {
    try {
        const auto report = parse_json(read_file(folder + "/report.json"));
        return between_one_and(report.at("parts").size(),
                               report.at("totals").at("tets").get<std::int64_t>() / least_tets_of_rank);
    } catch (const nlohmann::json::exception&) {
        return 1;  // the reader of the run says why
    } catch (const Error&) {
        return 1;
    }
}

int useful_ranks_of_surface(const std::string& file, std::int32_t parts) {
    constexpr std::int64_t any = 1 << 20;
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    return error ? 1 : between_one_and(parts > 0 ? parts : any, bytes / least_bytes_of_rank);
}

}  // namespace kerf

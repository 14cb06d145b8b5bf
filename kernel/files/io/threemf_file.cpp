#include "files/io/threemf_file.h"

#include <algorithm>
#include <cstdint>

#include "base/core/error.h"
#include "files/io/compressed.h"
#include "files/io/zip_archive.h"

namespace kerf {

bool is_threemf(std::string_view content) {
    return is_zip(content) && content.find("_rels/.rels") != content.npos && content.find(".model") != content.npos;
}

void check_growth_of_zip(std::string_view content, const std::string& path) {
    const std::uint64_t most = most_content(content.size());
    std::uint64_t claimed = 0;
    for (const ZipEntry& entry : zip_entries(content, path)) claimed += std::min(entry.size, most + 1);
    if (claimed > most)
        throw Error(ErrorCode::input, path + ": the archive grows to more than " + std::to_string(surface_growth) +
                                          " times its size, as no surface does. If it is one all the same, export it "
                                          "as STL, OBJ or PLY.");
}

}  // namespace kerf

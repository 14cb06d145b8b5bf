#include "files/part/curved_nodes_file.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/record.h"
#include "files/io/checked_file.h"
#include "files/io/file_bytes.h"
#include "files/io/run_manifest.h"

namespace kerf {

std::string curved_nodes_file(const std::string& folder) { return fmt::format("{}/{}", folder, curved_nodes_name); }

void write_curved_nodes(const std::string& path, const CurvedNodes& nodes) {
    const Bytes record = to_record(nodes);
    CheckedFile file(path, "wb");
    file.write(record.data(), record.size());
    file.close();
}

CurvedNodes read_curved_nodes(const std::string& path) {
    std::optional<CurvedNodes> nodes = from_record<CurvedNodes>(read_file(path));
    if (!nodes || nodes->ids.size() != nodes->points.size() ||
        std::adjacent_find(nodes->ids.begin(), nodes->ids.end(), std::greater_equal<>()) != nodes->ids.end())
        throw Error(ErrorCode::io, fmt::format("{} is damaged. Run kerf mesh again.", path));
    return *std::move(nodes);
}

}  // namespace kerf

#include "files/io/obj_writer.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "files/io/output_file.h"

namespace kerf {

namespace {

std::string group_name(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
    return name.empty() ? "_" : name;
}

}  // namespace

void write_obj(const std::string& path, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
               const std::vector<std::int32_t>& patch, const std::vector<std::string>& patch_names) {
    KERF_CHECK(are_in_range(facets, vertices.size()) && patch.size() == facets.size());
    std::string text = "# Surface of Kerf\n";
    for (const Vec3& p : vertices) fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x(), p.y(), p.z());
    std::vector<std::vector<std::int32_t>> of_patch(patch_names.size());
    for (std::size_t f = 0; f < facets.size(); ++f) of_patch[patch[f]].push_back(f);
    for (std::size_t p = 0; p < of_patch.size(); ++p) {
        if (!of_patch[p].empty()) text += "g " + group_name(patch_names[p]) + "\n";
        for (const std::int32_t f : of_patch[p])
            fmt::format_to(std::back_inserter(text), "f {} {} {}\n", facets[f][0] + 1, facets[f][1] + 1,
                           facets[f][2] + 1);
    }
    write_output_file(path, text);
}

}  // namespace kerf

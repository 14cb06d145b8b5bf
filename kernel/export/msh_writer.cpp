#include "export/msh_writer.h"

#include <fmt/format.h>

namespace kerf::msh {

void write_names(ExportFile& file, const Tags& tags, const std::vector<std::string>& patch_names) {
    file.write(fmt::format("$PhysicalNames\n{}\n", patch_names.size() + tags.bodies()));
    std::int32_t patch = 0;
    for (const std::string& name : names_of_patches(patch_names))
        file.write(fmt::format("2 {} \"{}\"\n", Tags::physical_patch(patch++), name));
    if (tags.bodies() == 1) file.write(fmt::format("3 {} \"volume\"\n", tags.physical_body(0)));
    for (std::int32_t body = 0; body < tags.bodies() && tags.bodies() > 1; ++body)
        file.write(fmt::format("3 {} \"body_{}\"\n", tags.physical_body(body), body + 1));
    file.write("$EndPhysicalNames\n");
}

}  // namespace kerf::msh

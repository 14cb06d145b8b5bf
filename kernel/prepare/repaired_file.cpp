#include "prepare/repaired_file.h"

#include "io/obj_writer.h"
#include "io/output_file.h"
#include "io/stl_writer.h"
#include "prepare/surface_file.h"

namespace kerf {

RepairedFile repair_file(const std::string& path, const InputOptions& options, const std::string& output) {
    require_surface_file("--output", output);
    refuse_to_overwrite(path, "--output", output);
    require_writable("--output", output);
    options.check();
    RepairedFile repaired{check_input(path, options)};
    if (repaired.checked.diagnosis.clean()) apply_repairs(repaired.checked);
    repaired.is_unchanged = !repaired.checked.ladder.changed();
    const Soup& soup = repaired.checked.soup;
    if (output.ends_with(".stl"))
        write_stl(output, soup.vertices, soup.facets);
    else
        write_obj(output, soup.vertices, soup.facets, soup.patch, soup.patch_names);
    return repaired;
}

}  // namespace kerf

#include "cli/check.h"

#include "io/offenders_writer.h"
#include "io/output_file.h"
#include "io/standard_streams.h"

namespace kerf {

namespace {

void print_patches(FileDiagnosis found, const InputOptions& options) {
    const std::vector<PatchSummary> patches = patches_of_run(std::move(found), options);
    std::vector<std::string> names;
    for (const PatchSummary& patch : patches) names.push_back(patch.name);
    const std::string spellings = spellings_text(names);
    print_data(to_text(patches) + (spellings.empty() ? "" : "\n" + spellings));
}

}  // namespace

int check_surface(const CheckRequest& request) {
    refuse_to_overwrite(request.path, "--offenders", request.offenders_file);
    require_writable("--offenders", request.offenders_file);
    FileDiagnosis found = diagnose_file(request.path, request.options, request.needle_angle_deg);
    if (request.list_patches && !found.refused) {
        print_patches(std::move(found), request.options);
        return 0;
    }
    const Diagnosis& diagnosis = found.checked.diagnosis;
    if (!request.offenders_file.empty() && !found.refused)
        write_offenders(request.offenders_file, found.checked.soup, diagnosis);
    if (request.json)
        print_data(to_json(found));
    else if (diagnosis.defects.size() > 1)
        print_data(to_text(found) + "--json lists all, --offenders FILE.vtu shows them in ParaView.\n");
    else
        print_data(to_text(found));
    return found.exit_code();
}

}  // namespace kerf

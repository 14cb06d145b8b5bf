// kerf quality: the quality of the cells of a mesh, alone or beside another one.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "cli/answer.h"
#include "cli/commands.h"
#include "files/io/output_file.h"
#include "files/io/standard_streams.h"
#include "files/quality/compared_quality.h"

namespace kerf {

namespace {

struct QualityRequest {
    std::string mesh;     // folder of a run, or a file
    std::string compare;  // the mesh to compare with; empty: none
    bool json = false;    // to standard output in place of the tables
    bool verbose = false;
    std::string picture;  // SVG; empty: none
    std::string fail_below, fail_above;
};

std::string quality_lines(const ComparedQuality& compared, const QualityRequest& request) {
    if (request.verbose) return to_text(compared, QualityDetail::all);
    return to_text(compared, QualityDetail::brief) + (request.picture.empty()
                                                          ? "Histograms: -v prints, --picture FILE.svg draws them.\n"
                                                          : "Histograms: " + request.picture + "\n");
}

int show_quality(const QualityRequest& request) {
    const QualityGate gate = QualityGate::parse(request.fail_below, request.fail_above);
    for (const std::string& input : {request.mesh, request.compare})
        refuse_to_overwrite(input, "--picture", request.picture);
    require_writable("--picture", request.picture, output_kind::histograms);
    const ComparedQuality compared = compare_quality(request.mesh, request.compare);
    const std::vector<std::string> missed = gate.missed_by(compared.mesh);
    if (!request.picture.empty()) write_output_file(request.picture, to_picture(compared));
    print_data(request.json ? to_json(compared, missed) : quality_lines(compared, request));
    for (const std::string& sentence : missed) tell(fmt::format("kerf: {}\n", sentence));
    return missed.empty() ? 0 : static_cast<int>(ErrorCode::quality);
}

}  // namespace

void add_quality_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<QualityRequest>();
    CLI::App* command = kerf.add_subcommand("quality", "Measure the cells of a mesh, alone or beside another one.");
    command
        ->add_option(
            "mesh", request->mesh,
            "Folder of a run, or .msh (Gmsh), .mesh (MEDIT), .vtu, .vtk, .node or .ele (TetGen) of any program.")
        ->required()
        ->type_name("DIR|FILE");
    command->add_flag("--json", request->json, "Print everything as JSON.");
    command->add_flag("-v,--verbose", request->verbose, "Print all tables, and a histogram of each measure.");
    command
        ->add_option("--picture", request->picture,
                     "Write the distributions and accumulated distributions of all measures as SVG.")
        ->type_name("FILE");
    command->add_option("--compare", request->compare, "Another mesh, to be put beside this one.")->type_name("OTHER");
    command
        ->add_option("--fail-below", request->fail_below,
                     fmt::format("Limits, with commas between, as min-dihedral=5: exit with 6 if a cell or boundary "
                                 "triangle has less. For {}.",
                                 limit_names(BadEnd::small)))
        ->type_name("LIST");
    command
        ->add_option("--fail-above", request->fail_above,
                     fmt::format("The same for what has more, as radius-edge=10. For {}.", limit_names(BadEnd::large)))
        ->type_name("LIST");
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return show_quality(*request); }); });
}

}  // namespace kerf

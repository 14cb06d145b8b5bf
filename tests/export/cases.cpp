#include "export/cases.h"

#include <fstream>
#include <map>

#include "support/places.h"
#include "support/run_in_process.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"

namespace kerf::test {

namespace {

ExportCase two_solids() {
    Soup a = box(Vec3::Zero(), Vec3(1, 1, 1), 6), b = box(Vec3(3, 0, 0), Vec3(5, 1, 1), {8, 4, 4});
    for (Soup* soup : {&a, &b}) soup->patch.assign(soup->facets.size(), 0);
    a.patch_names = {"inlet pipe, left (1)"};
    b.patch_names = {"K\u00f6rper \"zwei\" <&> 2'"};
    return {"two_solids", join(a, b), 5};
}

ExportCase many_patches() {
    ExportCase many{"many_patches", box(Vec3::Zero(), Vec3(4, 2, 1), {16, 8, 4}), 4};
    many.surface.patch_names.clear();
    for (int p = 0; p < 300; ++p) many.surface.patch_names.push_back("patch " + std::to_string(p));
    for (std::size_t f = 0; f < many.surface.facets.size(); ++f)
        many.surface.patch[f] = static_cast<std::int32_t>(f % 300);
    return many;
}

}  // namespace

const std::vector<ExportCase>& export_cases() {
    static const std::vector<ExportCase> cases = {
        {"one_part", box(Vec3::Zero(), Vec3(1, 2, 3), 4), 1},
        two_solids(),
        many_patches(),
        {"voids", block_with_cavities({3, 2, 1}), 6},
        {"straight_cuts", plate_with_hole(32), 4, true},
        {"inner_parts", box(Vec3::Zero(), Vec3::Ones(), 20), 64, false, true},
    };
    return cases;
}

std::string run_of(const ExportCase& wanted, const std::string& formats) {
    static const TemporaryFolder folder;
    static std::map<std::string, std::string> runs;
    const std::string name = formats.empty() ? wanted.name : wanted.name + "." + formats;
    std::string& run_folder = runs[name];
    if (!run_folder.empty()) return run_folder;
    const std::string input = folder.file(name + ".stl");
    std::ofstream(input, std::ios::binary) << to_ascii_stl(wanted.surface);
    run_folder = folder.file(name);
    RunRequest options;
    options.input = input;
    options.output = run_folder;
    options.outputs.formats = formats;
    options.workers.program = test::worker_program();
    options.workers.count = 2;
    options.parts = wanted.parts;
    if (wanted.straight_cuts) options.cut.contour = ContourMethod::straight;
    if (wanted.cut_by_volume) options.cut.criterion = Criterion::volume;
    SingleRank rank;
    const RunReport report = kerf::run(options, 2, rank);
    EXPECT_EQ(report.exit_code, 0) << wanted.name;
    EXPECT_EQ(report.parts.size(), static_cast<std::size_t>(wanted.parts)) << wanted.name;
    return run_folder;
}

}  // namespace kerf::test

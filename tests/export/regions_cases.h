// Runs with regions, for the laws of formats.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "files/part/joined_parts.h"
#include "files/part/run_parts.h"
#include "support/run_in_process.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf::test {

using Cube = std::array<std::int32_t, 3>;

struct RegionsCase {
    const char* name;
    Cube cubes;
    RegionOfCube region;
    std::int32_t parts;
    std::vector<std::string> names = {};  // those of the test body if empty
};

// Three that meet at an edge; one whose walls are all that there is of patch 1.
inline const std::vector<RegionsCase> regions_cases = {
    {"three", {2, 2, 1}, [](Cube c) { return c[0] + 2 * c[1] - 1; }, 7},
    {"one_in_another",
     {3, 3, 3},
     [](Cube c) {
         return c == Cube{1, 1, 1} ? 1 : 0;
     },
     5},
};

// With the formats of the list, or the default. Run once.
class FinishedRegions {
 public:
    explicit FinishedRegions(const RegionsCase& wanted, const std::string& formats = "") {
        constexpr std::int32_t fineness = 2;
        const Cube cubes = {fineness * wanted.cubes[0], fineness * wanted.cubes[1], fineness * wanted.cubes[2]};
        const VoxelBody body = voxel_body(cubes, refined(wanted.region, fineness));
        Input input = make_input(body.facets.vertices, body.facets.facets, body.sides,
                                 wanted.names.empty() ? body.names : wanted.names, body.facets.patch);
        RunRequest options;
        options.outputs.formats = formats;
        EXPECT_EQ(run_parts(std::move(input), path(), wanted.parts, options).exit_code, 0);
        parts_ = std::make_unique<RunParts>(path());
        EXPECT_EQ(parts_->outline().parts.size(), static_cast<std::size_t>(wanted.parts));
    }
    std::string path() const { return folder_.file("out"); }
    const RunParts& parts() const { return *parts_; }

 private:
    TemporaryFolder folder_;
    std::unique_ptr<RunParts> parts_;
};

// Each run once.
inline const FinishedRegions& finished_regions(const RegionsCase& wanted) {
    static std::map<std::string, std::unique_ptr<FinishedRegions>> runs;
    auto& run = runs[wanted.name];
    if (!run) run = std::make_unique<FinishedRegions>(wanted);
    return *run;
}

// Calls check(parts) with the parts of every case as they are, and joined into three pieces and one.
template <class Check>
void for_each_regions_source(const Check& check) {
    for (const RegionsCase& each : regions_cases) {
        SCOPED_TRACE(each.name);
        const RunParts& parts = finished_regions(each).parts();
        check(parts);
        for (const std::int32_t pieces : {3, 1}) {
            SCOPED_TRACE(fmt::format("into {}", pieces));
            check(JoinedParts(parts, pieces));
        }
    }
}

}  // namespace kerf::test

// kerf decompose and --trace as a user sees them.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "files/io/run_folder.h"
#include "files/io/surface_reader.h"
#include "files/part/vtu_writer.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/run_laws.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class Decompose : public testing::Test {
 protected:
    ChildResult run(const std::string& command, const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {command, test::asset_path("pipe_with_holes"), "-o", folder_.file("out")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        ChildResult result = test::run_kerf(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return result;
    }

    test::TemporaryFolder folder_;
};

TEST_F(Decompose, PrintsTheTreeUnlessQuiet) {
    const auto prints = [&](const std::string& command, const std::vector<std::string>& more, const char* header) {
        return run(command, more).log.find(header) != std::string::npos;
    };
    const char *nodes = "source  products", *levels = "level   cuts  parts";
    EXPECT_TRUE(prints("decompose", {"-n", "3"}, nodes));
    EXPECT_TRUE(prints("decompose", {"-n", "40"}, levels));
    EXPECT_TRUE(prints("mesh", {"-n", "3", "-v"}, nodes));
    EXPECT_FALSE(prints("mesh", {"-n", "3"}, nodes));
    EXPECT_EQ(run("decompose", {"-n", "3", "-q"}).log, "");
}

TEST_F(Decompose, WritesSurfacesAsStlOnRequest) {
    run("decompose", {"-n", "3", "-q"});
    const auto without = test::contents(folder_.file("out/parts"));
    run("decompose", {"-n", "3", "-q", "--stl"});
    const auto with = test::contents(folder_.file("out/parts"));
    EXPECT_EQ(without.size(), 3u);
    EXPECT_EQ(with.size(), 6u);
    for (const auto& [name, bytes] : without) EXPECT_TRUE(with.at(name) == bytes) << name;
    const auto report = nlohmann::json::parse(test::bytes_of_file(folder_.file("out/report.json")));
    for (const auto& part : report["parts"]) {
        const std::string name = "out/parts/" + part_stl_file_name(part["id"].get<NodeId>());
        EXPECT_EQ(read_surface(folder_.file(name)).facets.size(), part["surface_faces"].get<std::size_t>()) << name;
    }
}

// Values of an array of a file, without the size before them.
template <class T>
std::vector<T> array_of(const std::string& bytes, const VtuHeader& header, const std::string& name) {
    const VtuHeader::Array* array = header.find(name);
    EXPECT_TRUE(array) << name;
    std::vector<T> values(array ? static_cast<std::size_t>(array->components * array->tuples) : 0);
    if (array) std::memcpy(values.data(), bytes.data() + array->position + 8, values.size() * sizeof(T));
    return values;
}

// Bars with large facets, which straight cuts divide, and with small ones, some way apart along any direction.
TEST_F(Decompose, BodiesAreSharedOutBeforeOneIsCut) {
    for (int seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(static_cast<std::uint64_t>(seed));
        const int bodies = 2 + seed % 4, fineness = 1 + seed / 4 * 2;
        const Vec3 size(random.between(0.5, 2), random.between(0.5, 2), random.between(0.5, 2));
        const Vec3 direction = seed % 2 ? Vec3(Vec3::UnitX()) : Vec3(1, random.share(), -random.share()).normalized();
        const double step = size.norm() * random.between(1.05, 3);
        Soup soup;
        for (int i = 0; i < bodies; ++i) {
            const Vec3 low = i * step * direction;
            soup = test::join(std::move(soup), test::box(low, low + size, 2 * fineness));
        }
        std::ofstream(folder_.file("bars.off")) << test::to_off(soup);
        const ChildResult result = test::run_kerf(
            {"decompose", folder_.file("bars.off"), "-o", folder_.file("out"), "-n", std::to_string(bodies), "-q"});
        ASSERT_EQ(result.exit_code, 0) << result.log;
        const std::vector<Part> parts = test::read_part_surfaces(folder_.file("out"));
        EXPECT_EQ(parts.size(), static_cast<std::size_t>(bodies));
        for (const Part& part : parts) {
            EXPECT_EQ(part.facets.size(), soup.facets.size() / static_cast<std::size_t>(bodies));
            for (std::size_t f = 0; f < part.facets.size(); ++f) EXPECT_FALSE(part.is_interface(f));
        }
    }
}

TEST_F(Decompose, OneFileHoldsAllSurfaces) {
    run("decompose", {"-n", "3", "-q"});
    const auto files = test::contents(folder_.file("out"));
    const std::string& bytes = files.at("surfaces.vtu");
    const VtuHeader header = parse_vtu_header(bytes, "surfaces.vtu");
    const auto points = array_of<double>(bytes, header, "Points");
    const auto corners = array_of<std::int64_t>(bytes, header, "connectivity");
    const auto part = array_of<std::int32_t>(bytes, header, "Part");
    std::map<std::int32_t, double> volumes;  // by the divergence theorem
    for (std::size_t cell = 0; cell < part.size(); ++cell) {
        const auto corner = [&](std::size_t k) {
            return Vec3(Eigen::Map<const Vec3>(&points.at(3 * static_cast<std::size_t>(corners.at(3 * cell + k)))));
        };
        volumes[part[cell]] += corner(0).dot(corner(1).cross(corner(2))) / 6;
    }
    const auto report = nlohmann::json::parse(files.at("report.json"));
    EXPECT_EQ(volumes.size(), 3u);
    for (const auto& of_report : report["parts"]) {
        const int id = of_report["id"].get<int>();
        EXPECT_NEAR(volumes[id] / of_report["surface_volume"].get<double>(), 1, 1e-9);
        EXPECT_NE(files.at("surfaces.pvtu").find("parts/" + part_surface_file_name(NodeId(id))), std::string::npos);
    }
    run("decompose", {"-n", "3", "-q", "--workers", "3"});
    EXPECT_TRUE(test::contents(folder_.file("out")).at("surfaces.vtu") == bytes);
}

TEST_F(Decompose, ReportHasTheSizesOfTheSurfaces) {
    run("decompose", {"-n", "4", "-q"});
    const auto report = nlohmann::json::parse(test::bytes_of_file(folder_.file("out/report.json")));
    double volume = 0;
    for (const auto& part : report["parts"]) {
        volume += part["surface_volume"].get<double>();
        EXPECT_GT(part["surface_vertices"].get<double>(), 100);
    }
    EXPECT_NEAR(volume / report["input"]["volume"].get<double>(), 1, 1e-12);
    EXPECT_EQ(report["totals"]["volume"], volume);
}

TEST_F(Decompose, TraceChangesNoResult) {
    for (const std::string command : {"mesh", "decompose"}) {
        SCOPED_TRACE(command);
        run(command, {"-n", "5", "-q"});
        const auto parts = test::contents(folder_.file("out/parts"));
        auto files = test::contents(folder_.file("out"));
        run(command, {"-n", "5", "-q", "--trace", folder_.file("run.trace")});
        EXPECT_TRUE(test::contents(folder_.file("out/parts")) == parts);
        auto traced_files = test::contents(folder_.file("out"));
        const auto report = nlohmann::json::parse(files.extract("report.json").mapped());
        const auto traced_report = nlohmann::json::parse(traced_files.extract("report.json").mapped());
        EXPECT_TRUE(traced_files == files);
        EXPECT_EQ(traced_report["mesh_hash"], report["mesh_hash"]);
        EXPECT_GT(test::bytes_of_file(folder_.file("run.trace")).size(), 1000u);
    }
}

TEST_F(Decompose, TraceInTheOutputFolderIsRefused) {
    const ChildResult result = test::run_kerf({"decompose", test::asset_path("cube"), "-o", folder_.file("out"), "-n",
                                               "2", "--trace", folder_.file("other/../out/cube.trace")});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.log.find("lies in the output folder"), std::string::npos) << result.log;
    EXPECT_EQ(folder_.names(), std::vector<std::string>());
}

}  // namespace
}  // namespace kerf

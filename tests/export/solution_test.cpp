// Exports of a solution have its values; other programs judge all formats in tests/oracles/compare_exports.py.
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "files/io/tet_mesh_reader.h"
#include "files/part/joined_parts.h"
#include "files/part/solution_parts.h"
#include "files/part/vtu_reader.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/solved_run.h"
#include "support/temporary_folder.h"

namespace kerf::test {
namespace {

class SolutionExport : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        ASSERT_EQ(run_kerf({"mesh", asset_path("cube"), "-o", folder_->file("out/mesh"), "-n", "4", "-q"}).exit_code,
                  0);
        write_solution(folder_->file("out/mesh"), folder_->file("out/solution"), "../mesh", {"slow", "fast"});
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static std::unique_ptr<TemporaryFolder> folder_;
};
std::unique_ptr<TemporaryFolder> SolutionExport::folder_;

// As solved_run.h has made them: functions of the place.
void expect_values(const Part& part, const std::vector<PartValues>& all) {
    ASSERT_EQ(all.size(), 8u);  // four of each case
    for (const PartValues& values : all) {
        const bool is_fast = values.name.ends_with(" fast");
        if (values.of == PartValues::Of::tets) {
            EXPECT_EQ(std::get<std::vector<float>>(values.numbers), std::vector<float>(part.mesh.tets.size(), 1));
            continue;
        }
        for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) {
            const double x = part.mesh.vertices[v].x();
            const auto last = static_cast<std::size_t>(values.components) - 1;
            const double expected = values.components == 1 ? x : values.components == 6 ? 6 * x : 0;
            EXPECT_NEAR(values.number((last + 1) * v + last), expected, 1e-6);
            if (values.components == 3) {
                EXPECT_EQ(values.number(3 * v), x * (is_fast ? 2 : 1));
            }
        }
    }
}

TEST_F(SolutionExport, PartsAndPiecesOfThemHaveTheValues) {
    const auto parts = open_parts(folder_->file("out"));
    EXPECT_EQ(parts->outline().values.size(), 8u);
    for (std::int32_t rank = 0; rank < 4; ++rank) {
        const Part part = parts->load(PartIndex(rank));
        expect_values(part, part.values);
    }
    const JoinedParts joined(*parts, 2);
    for (std::int32_t rank = 0; rank < 2; ++rank) {
        const Part piece = joined.load(PartIndex(rank));
        expect_values(piece, piece.values);
    }
    EXPECT_TRUE(open_parts(folder_->file("out/mesh"))->outline().values.empty());
}

TEST_F(SolutionExport, FilesHaveTheValues) {
    ASSERT_EQ(
        run_kerf({"export", folder_->file("out"), "--format", "vtu", "--into", "2", "-o", folder_->file("vtu"), "-q"})
            .exit_code,
        0);
    for (const auto& entry : std::filesystem::directory_iterator(folder_->file("vtu/parts"))) {
        const Part part = read_part(entry.path());
        expect_values(part, read_values(entry.path()));
    }
    for (const std::vector<std::string>& file :
         {std::vector<std::string>{"a.vtu"}, {"a.msh"}, {"b.msh", "--msh-version", "2.2"}, {"c.msh", "--msh-ascii"}}) {
        std::vector<std::string> command = {"merge", folder_->file("out/solution"), "-o", folder_->file(file[0])};
        command.insert(command.end(), file.begin() + 1, file.end());
        ASSERT_EQ(run_kerf(command).exit_code, 0);
        const TetFile merged = read_tets_with_scalars(folder_->file(file[0]));
        std::int64_t found = 0;
        for (const NodeScalar& scalar : merged.node_scalars) {
            if (!scalar.name.starts_with("VonMises")) continue;
            ++found;
            for (std::size_t v = 0; v < merged.mesh.vertices.size(); ++v)
                ASSERT_NEAR(scalar.values[v], merged.mesh.vertices[v].x(), 1e-6) << file[0];
        }
        EXPECT_EQ(found, 2) << file[0];
    }
}

// The rows of a section of a text file of Gmsh: behind the line of its name, or of "name" in the section.
std::vector<std::vector<double>> rows_behind(const std::string& text, const std::string& begin) {
    std::istringstream lines(text.substr(text.find(begin) + begin.size()));
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(lines, line) && !line.starts_with("$End");) {
        std::istringstream numbers(line);
        if (std::vector<double> row{std::istream_iterator<double>(numbers), {}}; row.size() > 1) rows.push_back(row);
    }
    return rows;
}

// Values are linear functions of the place, so that means of ends are what there is in the middle of an edge.
TEST_F(SolutionExport, OfOrder2HasValuesAtTheNodesOfEdges) {
    const std::string file = folder_->file("of_order_2.msh");
    ASSERT_EQ(run_kerf({"merge", folder_->file("out/solution"), "-o", file, "--msh-version", "2.2", "--msh-ascii",
                        "--order", "2", "-q"})
                  .exit_code,
              0);
    const std::string text = bytes_of_file(file);
    const auto nodes = rows_behind(text, "$Nodes\n");
    const auto values = rows_behind(text, "\"VonMises slow\"\n");
    const auto parts = open_parts(folder_->file("out/mesh"));
    EXPECT_GT(std::ssize(nodes), parts->outline().vertices + parts->outline().tets());
    ASSERT_EQ(values.size(), nodes.size());
    std::map<double, double> of_tags;
    for (const auto& row : values) of_tags[row[0]] = row[1];
    for (const auto& row : nodes) ASSERT_NEAR(of_tags.at(row[0]), row[1], 1e-6);
}

// What is asked of a run is asked of that under the solution, or refused with the command that shows the solution.
TEST_F(SolutionExport, IsVerifiedAndMeasured) {
    const std::string solution = folder_->file("verified");
    write_solution(folder_->file("out/mesh"), solution, "../out/mesh", {""});
    const auto refused = [](const std::vector<std::string>& command, int exit_code, const std::string& words) {
        const ChildResult result = run_kerf(command);
        EXPECT_EQ(result.exit_code, exit_code) << result.log;
        EXPECT_NE((result.log + output_of(result)).find(words), std::string::npos) << result.log;
    };
    refused({"verify", folder_->file("out")}, 0, "Every law holds.");
    refused({"verify", solution}, 0, "a solution on " + folder_->file("out/mesh"));
    EXPECT_EQ(output_of(run_kerf({"quality", solution, "--json"})).substr(100),
              output_of(run_kerf({"quality", folder_->file("out/mesh"), "--json"})).substr(100));
    EXPECT_EQ(run_kerf({"report", solution, "-o", folder_->file("a.html"), "-q"}).exit_code, 0);
    const std::string page = bytes_of_file(folder_->file("a.html"));
    EXPECT_NE(page.find(R"("fields":[{"name":)"), std::string::npos) << "values are drawn";
    EXPECT_NE(page.find(R"("solution":{)"), std::string::npos);
    refused({"solve", solution, "--list-patches"}, 2, "Name " + folder_->file("out/mesh"));
    std::ofstream(solution + "/parts/part_0004.vtu", std::ios::app) << "x";
    refused({"verify", solution}, 8, "part_0004.vtu is not as the run has written it");
    std::filesystem::remove(solution + "/parts/part_0004.vtu");
    refused({"verify", solution}, 8, "part_0004.vtu is missing");
}

TEST_F(SolutionExport, DoesNotWriteAmongTheFilesOfOthers) {
    EXPECT_EQ(run_kerf({"merge", folder_->file("out/solution"), "-o", folder_->file("out/mesh/parts/part_0004.vtu")})
                  .exit_code,
              7)
        << "inside of its mesh";
    write_solution(folder_->file("out/mesh"), folder_->file("again/solution"), "../../out/mesh", {""});
    EXPECT_EQ(
        run_kerf({"export", folder_->file("again"), "--format", "msh", "-o", folder_->file("again/solution/x"), "-q"})
            .exit_code,
        2)
        << "inside of the solution";
    EXPECT_FALSE(std::filesystem::exists(folder_->file("again/report.json")));
}

}  // namespace
}  // namespace kerf::test

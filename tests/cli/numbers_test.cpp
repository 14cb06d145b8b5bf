// Laws over the numbers and lengths that commands take: a number, or a sentence that says what would be one.
#include <cmath>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/file_contents.h"
#include "support/lines.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

class Numbers : public testing::Test {
 protected:
    Numbers() {
        const Soup soup = test::icosphere(2);
        test::write_off(ball_, soup.vertices, soup.facets);
    }

    test::TemporaryFolder folder_;
    const std::string ball_ = folder_.file("ball.off");
};

// Options of a command whose value is named by up to three capitals, as numbers are, or by two of them.
std::vector<std::pair<std::string, int>> numeric_options(const std::string& command) {
    std::vector<std::pair<std::string, int>> options;
    for (const std::string& line : test::lines_of(test::output_of(test::run_kerf({command, "--help"})))) {
        if (!line.starts_with("  -")) continue;
        std::istringstream heading(line.substr(0, line.find("  ", 3)));
        std::string name, value, more;
        while (heading >> name && name.ends_with(','))
            ;
        heading >> value >> more;
        const bool is_number = !value.empty() && value.size() <= 3 &&
                               value.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == value.npos && value != "DIR" &&
                               value != "OUT";
        if (is_number || value == "LOW" || value == "SIZE") options.emplace_back(name, value == "LOW" ? 2 : 1);
    }
    return options;
}

struct Case {
    std::vector<std::string> command;
    std::vector<std::string> refused, any;  // values that no number can have, and values that some may have
};

// No message may speak of what is not a number; the value itself, in quotes, is not Kerf's.
std::string without_quoted(std::string text, const std::string& value) {
    const std::string quoted = "'" + value + "'";
    for (std::size_t at = text.find(quoted); at != text.npos; at = text.find(quoted)) text.erase(at, quoted.size());
    return text;
}

TEST_F(Numbers, OfAllCommandsAreRefusedOrObeyed) {
    const std::vector<std::string> no_numbers = {"abc", "nan", "inf", "1,5", ""}, some = {"abc", "nan", "-1"};
    // Options that commands share with kerf mesh are looked at there.
    std::vector<Case> cases = {{{"mesh", ball_, "--dry-run"}, some, {"1e-300", "1e300"}},
                               {{"check", ball_}, some, {"1e-300", "1e300"}},
                               {{"export", folder_.file("none"), "-f", "vtu"}, no_numbers, {}},
                               {{"merge", folder_.file("none"), "-o", folder_.file("a.msh")}, no_numbers, {}}};
#if KERF_HAS_SOLVER
    cases.push_back({{"solve", ball_, "--case", folder_.file("no.toml"), "-o", folder_.file("out")}, no_numbers, {}});
#endif
#if KERF_HAS_VIEWER
    cases.push_back({{"screenshot", ball_, "-o", folder_.file("a.png")}, no_numbers, {}});
#endif
    std::set<std::string> seen;
    for (const Case& one : cases)
        for (const auto& [option, values] : numeric_options(one.command.front())) {
            const bool is_of_mesh = one.command.front() != "mesh" && one.command.front() != "check";
            if (is_of_mesh && seen.contains(option)) continue;
            if (!is_of_mesh) seen.insert(option);
            const auto run = [&, option = option, values = values](const std::string& value) {
                std::vector<std::string> arguments = one.command;
                arguments.push_back(option);
                arguments.insert(arguments.end(), static_cast<std::size_t>(values), value);
                return test::run_kerf(arguments);
            };
            for (const std::string& value : one.refused) {
                SCOPED_TRACE("kerf " + one.command.front() + " " + option + " '" + value + "'");
                const ChildResult result = run(value);
                EXPECT_EQ(result.end, ChildResult::End::exited) << result.describe();
                EXPECT_EQ(result.exit_code, 2) << result.log;
                EXPECT_NE(result.log.find(option), std::string::npos) << result.log;
                EXPECT_NE(result.log.find("must be"), std::string::npos) << result.log;
            }
            for (const std::string& value : one.any) {
                SCOPED_TRACE("kerf " + one.command.front() + " " + option + " " + value);
                const ChildResult result = run(value);
                EXPECT_EQ(result.end, ChildResult::End::exited) << result.describe();
                // A surface can be scaled to what no surface may be.
                const bool is_sane = std::set<int>({0, 2, 5}).contains(result.exit_code) ||
                                     (option == "--scale" && result.exit_code == 3);
                EXPECT_TRUE(is_sane) << result.exit_code << result.log;
                const std::string said = without_quoted(test::output_of(result) + result.log, value);
                for (const char* word : {"nan", "inf "}) EXPECT_EQ(said.find(word), std::string::npos) << said;
            }
        }
    EXPECT_GE(seen.size(), 18u) << "the page is read as it is written";
}

TEST_F(Numbers, WithACommaGetTheirPoint) {
    const ChildResult result = test::run_kerf({"mesh", ball_, "--dry-run", "--deviation", "1,5%"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.log.find("Write 1.5%, with a point."), std::string::npos) << result.log;
}

nlohmann::json options_of(const std::string& folder) {
    return nlohmann::json::parse(test::bytes_of_file(folder + "/report.json")).at("options");
}

// Cells become a size: asked for itself, that gives the same bytes, whatever the number of workers.
TEST_F(Numbers, OfCellsAreASize) {
    const auto mesh = [&](const std::string& output, std::vector<std::string> more) {
        more.insert(more.begin(), {"mesh", ball_, "-q", "-n", "3", "-o", folder_.file(output)});
        const ChildResult result = test::run_kerf(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return test::contents(folder_.file(output + "/parts"));
    };
    for (const std::string surface : {"split", "remesh"}) {
        SCOPED_TRACE(surface);
        const auto parts = mesh(surface, {"--cells", "20k", "--surface", surface, "--workers", "1"});
        const auto report = nlohmann::json::parse(test::bytes_of_file(folder_.file(surface + "/report.json")));
        const double size = report.at("options").at("size");
        EXPECT_EQ(report.at("options").at("cells"), 0) << "what is in effect";
        EXPECT_EQ(report.at("cells").at("asked"), 20'000);
        EXPECT_EQ(report.at("cells").at("size"), size);
        EXPECT_NEAR(report.at("cells").at("forecast").get<double>(), 20'000, 1'500);
        EXPECT_NEAR(report.at("totals").at("tets").get<double>(), 20'000, 3'000);
        EXPECT_EQ(test::run_kerf({"verify", folder_.file(surface), "-q"}).exit_code, 0);
        EXPECT_TRUE(parts == mesh("sized", {"--size", fmt::format("{}", size), "--surface", surface}));
        EXPECT_TRUE(parts == mesh("again", {"--cells", "20000", "--surface", surface, "--workers", "2"}));
        const ChildResult dry =
            test::run_kerf({"mesh", ball_, "-n", "3", "--cells", "20k", "--surface", surface, "--dry-run"});
        const std::string said = test::output_of(dry) + dry.log;
        for (const std::string& words : {std::string("20,000 asked for"), fmt::format("size {}", size)})
            EXPECT_NE(said.find(words), std::string::npos) << said;
    }
}

// The diagonal of the ball's box is its own, whatever is written.
TEST_F(Numbers, PercentIsOfTheDiagonal) {
    const double diagonal = 2 * std::sqrt(3.0);
    const Soup box = test::box(Vec3(-1, -1, -1), Vec3(1, 1, 1), 4);
    test::write_off(folder_.file("box.off"), box.vertices, box.facets);
    const auto mesh = [&](const std::string& output, std::vector<std::string> more) {
        more.insert(more.begin(), {"mesh", folder_.file("box.off"), "-q", "-n", "2", "-o", folder_.file(output)});
        const ChildResult result = test::run_kerf(more);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return test::contents(folder_.file(output + "/parts"));
    };
    const auto number = [&](double percent) { return fmt::format("{}", percent / 100 * diagonal); };
    const auto relative =
        mesh("relative", {"--size", "10%", "--size-in", "sphere:0,0,0,0.3=5%", "--weld", "1e-6%", "--deviation", "1%"});
    const auto absolute = mesh("absolute", {"--size", number(10), "--size-in", "sphere:0,0,0,0.3=" + number(5),
                                            "--weld", number(1e-6), "--deviation", number(1)});
    EXPECT_TRUE(relative == absolute);
    EXPECT_EQ(options_of(folder_.file("relative")), options_of(folder_.file("absolute")));
    EXPECT_EQ(options_of(folder_.file("relative")).at("size"), 10.0 / 100 * diagonal);
    EXPECT_GT(relative.size(), 0u);
}

}  // namespace
}  // namespace kerf

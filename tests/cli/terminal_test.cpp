// What people are told: little by default, all of it with -v; colours and a bar on a terminal alone.
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include <gtest/gtest.h>

#include "support/lines.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

// What a shell command prints on a terminal of 80 columns.
std::string printed_on_terminal(const std::string& command) {
    int terminal = -1;
    winsize size{25, 80, 0, 0};
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        ::_exit(127);
    }
    std::string text;
    char bytes[4096];
    for (ssize_t n = 0; (n = ::read(terminal, bytes, sizeof bytes)) > 0;)
        text.append(bytes, static_cast<std::size_t>(n));
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(terminal);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text;
    return text;
}

class Terminal : public testing::Test {
 protected:
    Terminal() {
        const Soup soup = test::icosphere(2);
        test::write_off(ball_, soup.vertices, soup.facets);
    }
    std::string mesh(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"mesh", ball_, "-n", "2", "-o", folder_.file("out")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult result = test::run_kerf(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return result.log;
    }

    test::TemporaryFolder folder_;
    const std::string ball_ = folder_.file("ball.off");
};

bool has_label(const std::string& text, const std::string& label) {
    const std::vector<std::string> lines = test::lines_of(text);
    return std::any_of(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.starts_with(label + " "); });
}

TEST_F(Terminal, ARunEndsWithFiveLines) {
    std::vector<std::string> labels;
    for (const std::string& line : test::lines_of(mesh({})))
        if (!line.starts_with("volume ")) labels.push_back(line.substr(0, line.find(' ')));
    EXPECT_EQ(labels, (std::vector<std::string>{"mesh", "quality", "time", "verified", "result"}));
    const std::string verbose = mesh({"-v"});
    for (const std::string label : {"plan", "input", "parts", "interfaces", "mesh", "filled", "improved", "quality",
                                    "time", "processes", "verified", "mesh hash", "result"})
        EXPECT_TRUE(has_label(verbose, label)) << label << ":\n" << verbose;
    EXPECT_NE(verbose.find("; next: kerf "), std::string::npos) << verbose;
    EXPECT_EQ(verbose.find('\033'), std::string::npos) << "a log has no colours";
}

TEST_F(Terminal, HasColoursAndABar) {
    const std::string command =
        "TERM=xterm '" + test::kerf_program() + "' mesh '" + ball_ + "' -n 2 -o '" + folder_.file("out") + "'";
    const std::string coloured = printed_on_terminal(command), plain = printed_on_terminal("NO_COLOR=1 " + command);
    EXPECT_NE(coloured.find("\033[1mverified    \033[0m\033[32myes"), std::string::npos) << coloured;
    EXPECT_NE(plain.find("verified    yes"), std::string::npos) << plain;
    EXPECT_EQ(plain.find("\033[1m"), std::string::npos) << plain;
    for (const std::string& text : {coloured, plain})
        EXPECT_NE(text.find("volume  [===="), std::string::npos) << "the bar needs no colour: " << text;
    EXPECT_EQ(mesh({}).find("[="), std::string::npos);
}

TEST_F(Terminal, QualityIsADozenLinesUnlessAskedForAll) {
    mesh({"-q"});
    const auto lines = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"quality", folder_.file("out")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::lines_of(test::output_of(test::run_kerf(arguments)));
    };
    EXPECT_LE(lines({}).size(), 12u);
    EXPECT_GT(lines({"-v"}).size(), 50u);
    EXPECT_NE(lines({}).back().find("-v"), std::string::npos);
}

}  // namespace
}  // namespace kerf

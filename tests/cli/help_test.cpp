// Help, manual and completion: laws over all commands, and what a wrong word is answered.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "help/inside/old_spellings.h"
#include "run/request/run_request.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/lines.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

bool is_heading(const std::string& line) { return !line.empty() && line.front() != ' ' && line.back() == ':'; }
bool is_entry(const std::string& line) { return line.starts_with("  ") && line.size() > 2 && line[2] != ' '; }

// "-o, --output DIR" of an entry.
std::string heading_of_entry(const std::string& line) { return line.substr(2, line.find("  ", 2) - 2); }

std::string printed(const std::vector<std::string>& arguments) {
    const ChildResult result = test::run_kerf(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments.front() << ": " << result.log;
    return test::output_of(result);
}

struct HelpPage {
    std::string command;  // empty: of kerf itself
    std::vector<std::string> lines;

    std::set<std::string> long_options() const {
        std::set<std::string> names;
        for (const std::string& line : lines) {
            if (!is_entry(line)) continue;
            std::istringstream words(heading_of_entry(line));
            for (std::string word; words >> word;)
                if (word.starts_with("--")) names.insert(word.substr(0, word.find(',')));
        }
        return names;
    }
    // Heading -> options below it.
    std::map<std::string, std::set<std::string>> groups() const {
        std::map<std::string, std::set<std::string>> all;
        HelpPage group;
        for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
            if (!is_heading(*line)) {
                group.lines.push_back(*line);
                continue;
            }
            const std::set<std::string> options = group.long_options();
            if (!options.empty()) all[line->substr(0, line->size() - 1)] = options;
            group.lines.clear();
        }
        return all;
    }
};

// Of every command whose program was built.
std::vector<HelpPage> help_pages() {
    std::vector<HelpPage> pages = {{"", test::lines_of(printed({"--help"}))}};
    const std::vector<std::string> lines = pages.front().lines;
    for (auto line = std::find(lines.begin(), lines.end(), "Commands:"); line != lines.end() && !line->empty();
         ++line) {
        if (!is_entry(*line)) continue;
        const std::string command = line->substr(2, line->find(' ', 2) - 2);
        const ChildResult help = test::run_kerf({command, "--help"});
        if (help.log.find("build it with") != help.log.npos) continue;
        EXPECT_EQ(help.exit_code, 0) << command << ": " << help.log;
        pages.push_back({command, test::lines_of(test::output_of(help))});
    }
    // kerf, mesh, decompose, check, verify, export, merge, quality, report, repair, remesh, wrap, help
    constexpr std::size_t always = 13;
    EXPECT_EQ(pages.size(), always + (KERF_HAS_VIEWER ? 2 : 0) + (KERF_HAS_SOLVER ? 1 : 0));
    return pages;
}

TEST(Help, FitsAScreenOrIsGrouped) {
    for (const HelpPage& page : help_pages()) {
        SCOPED_TRACE("kerf " + page.command);
        for (const std::string& line : page.lines) EXPECT_LE(line.size(), 80u) << line;
        const auto groups = page.groups();
        EXPECT_TRUE(page.lines.size() <= 50 || groups.size() >= 3);
        EXPECT_TRUE(groups.contains("Options") == (groups.size() == 1)) << "an option is outside of the groups";
    }
}

// What the user has not given is described by the text; 0 often means something else.
TEST(Help, PrintsNoNumberAsDefaultBesideAnOption) {
    for (const HelpPage& page : help_pages())
        for (const std::string& line : page.lines) {
            if (!is_entry(line) || line[2] != '-') continue;
            const std::string heading = heading_of_entry(line);
            EXPECT_EQ(heading.find_first_of("0123456789"), heading.npos) << page.command << ": " << line;
            EXPECT_EQ(heading.find_first_of("{}[]"), heading.npos) << page.command << ": " << line;
        }
}

TEST(Help, HasEveryOptionOfTheTableInItsGroup) {
    HelpPage mesh;
    for (const HelpPage& page : help_pages())
        if (page.command == "mesh") mesh = page;
    auto groups = mesh.groups();
    RunRequest options;
    for (const OptionField& field : option_fields(options)) {
        EXPECT_TRUE(std::count(std::begin(option_group::all), std::end(option_group::all), field.group)) << field.name;
        EXPECT_TRUE(groups[field.group].contains("--" + field.name)) << field.group << ": " << field.name;
        const bool has_value =
            !std::holds_alternative<bool*>(field.value) && !std::holds_alternative<OptionField::Choice>(field.value);
        EXPECT_EQ(field.value_name.empty(), !has_value) << field.name;
    }
}

// Whether `name` stands there by itself, not as the beginning of a longer one.
bool has_word(const std::string& text, const std::string& name) {
    for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        const char next = at + name.size() < text.size() ? text[at + name.size()] : ' ';
        if (!std::isalnum(static_cast<unsigned char>(next)) && next != '-' && next != '\\') return true;
    }
    return false;
}

std::string in_roff(const std::string& name) {
    std::string text;
    for (const char c : name) text += c == '-' ? "\\-" : std::string(1, c);
    return text;
}

TEST(Manual, AndCompletionKnowEveryOption) {
    const std::string bash = printed({"--completion", "bash"}), zsh = printed({"--completion", "zsh"});
    const std::vector<std::string> fish = test::lines_of(printed({"--completion", "fish"}));
    for (const HelpPage& page : help_pages()) {
        SCOPED_TRACE("kerf " + page.command);
        const std::string manual = printed({"--man", page.command.empty() ? "kerf" : page.command});
        const std::string key = "_kerf_words['kerf" + (page.command.empty() ? "" : " " + page.command) + "']=";
        const std::string words = bash.substr(bash.find(key), bash.find('\n', bash.find(key)) - bash.find(key));
        const std::size_t begin = page.command.empty() ? 0 : zsh.find("\n_kerf_" + page.command + "()");
        const std::string function = zsh.substr(begin, zsh.find("\n}", begin) - begin);
        const std::string seen = page.command.empty() ? "use_subcommand" : "from " + page.command + "'";
        for (const std::string& option : page.long_options()) {
            EXPECT_TRUE(has_word(manual, in_roff(option))) << option;
            EXPECT_TRUE(has_word(words, option)) << option;
            EXPECT_TRUE(has_word(page.command.empty() ? zsh : function, option)) << option;
            EXPECT_TRUE(std::any_of(fish.begin(), fish.end(), [&](const std::string& line) {
                return line.find(seen) != line.npos && has_word(line, " -l " + option.substr(2));
            })) << option;
        }
    }
}

TEST(Manual, IsFreeOfWarnings) {
    const test::TemporaryFolder folder;
    for (const HelpPage& page : help_pages()) {
        const std::string command = page.command.empty() ? "kerf" : page.command, file = folder.file(command + ".1");
        std::ofstream(file) << printed({"--man", command});
        const ChildResult set =
            test::run_program("/bin/sh", {"-c", "groff -man -ww -Tascii '" + file + "' 2>&1 >/dev/null"});
        EXPECT_EQ(set.exit_code, 0);
        EXPECT_EQ(test::output_of(set), "") << command;
    }
}

TEST(Manual, OfNoCommandIsRefused) {
    EXPECT_EQ(test::run_kerf({"--man", "saw"}).exit_code, 2);
    const ChildResult shell = test::run_kerf({"--completion", "tcsh"});
    EXPECT_EQ(shell.exit_code, 2);
    EXPECT_NE(shell.log.find("bash, fish, zsh"), std::string::npos) << shell.log;
}

// What bash offers after these words, of which the last one is being typed.
class BashCompletion : public testing::Test {
 protected:
    void SetUp() override {
        std::ofstream(folder_.file("completion")) << printed({"--completion", "bash"});
        std::ofstream(folder_.file("part.stl"));
        std::ofstream(folder_.file("part two.stl"));
    }
    std::set<std::string> offers(const std::string& words) const {
        const ChildResult result = test::run_program(
            "/usr/bin/env", {"bash", "-c",
                             "cd '" + folder_.file(".") + "' && source ./completion && COMP_WORDS=(kerf " + words +
                                 ") && COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) && _kerf && printf "
                                 "'%s\\n' \"${COMPREPLY[@]}\""});
        EXPECT_EQ(result.exit_code, 0) << result.log;
        EXPECT_EQ(result.log, "");
        std::set<std::string> set;
        for (const std::string& line : test::lines_of(test::output_of(result))) set.insert(line);
        return set;
    }
    test::TemporaryFolder folder_;
};

using Words = std::set<std::string>;

TEST_F(BashCompletion, OffersCommandsOptionsValuesAndFiles) {
    EXPECT_EQ(offers("me"), (Words{"merge", "mesh"}));
    EXPECT_TRUE(offers("''").contains("screenshot"));
    EXPECT_EQ(offers("mesh part.stl --size-"),
              (Words{"--size-field", "--size-in", "--size-is", "--size-near", "--size-on", "--size-region"}));
    EXPECT_EQ(offers("mesh part.stl --cut ''"), (Words{"equidistant", "inertia", "volume"}));
    EXPECT_EQ(offers("mesh part.stl --cut = e"), (Words{"equidistant"})) << "bash takes --cut=e for three words";
    EXPECT_EQ(offers("mesh part.stl --cut ="), offers("mesh part.stl --cut ''"));
    EXPECT_TRUE(offers("export out --format ''").contains("openfoam"));
    EXPECT_EQ(offers("mesh p"), (Words{"part two.stl", "part.stl"}));
    EXPECT_EQ(offers("mesh --stl p"), offers("mesh p")) << "a flag takes no value";
    EXPECT_EQ(offers("mesh part.stl --size-field p"), offers("mesh p"));
    EXPECT_EQ(offers("mesh part.stl --size p"), Words{""}) << "a number is no file";
    EXPECT_FALSE(offers("verify --").contains("--size")) << "an option of another command";
#if KERF_HAS_VIEWER
    EXPECT_EQ(offers("screenshot part.stl --theme ''"), (Words{"dark", "light"}));
    EXPECT_TRUE(offers("view part.stl --color ''").contains("min-dihedral"));
    EXPECT_TRUE(offers("view part.stl --stage ''").contains("triangulation"));
#endif
}

void expect_suggestion(const std::vector<std::string>& arguments, const std::string& suggestion) {
    const ChildResult result = test::run_kerf(arguments);
    EXPECT_EQ(result.exit_code, 2);
    if (suggestion.empty())
        EXPECT_EQ(result.log.find("Did you mean"), std::string::npos) << result.log;
    else
        EXPECT_NE(result.log.find("Did you mean " + suggestion + "?"), std::string::npos) << result.log;
    EXPECT_NE(result.log.find("--help"), std::string::npos) << result.log;
}

TEST(Suggestion, IsTheNearestWord) {
    const std::string cube = test::asset_path("cube");
    expect_suggestion({"mehs", cube}, "mesh");
    expect_suggestion({"screen-shot"}, "screenshot");
    expect_suggestion({"saw"}, "");
    expect_suggestion({"--versoin"}, "--version");
    expect_suggestion({"mesh", cube, "--sizes", "3"}, "--size");
    expect_suggestion({"mesh", cube, "--sizes=3"}, "--size");
    expect_suggestion({"mesh", cube, "--optimise", "3"}, "--optimise-surface");
    expect_suggestion({"merge", "out", "--outptu", "a.msh"}, "--output");
    expect_suggestion({"mesh", cube, "--qwertz"}, "");
    expect_suggestion({"mesh", "--tetgen", "--sizes"}, "");  // its value
    expect_suggestion({"mesh", cube, "-size", "3"}, "--size");
    expect_suggestion({"help", "mehs"}, "mesh");
}

TEST(Suggestion, NamesAnUnknownOptionOfOneDash) {
    const std::string cube = test::asset_path("cube");
    const auto expect = [](const std::vector<std::string>& arguments, const std::string& option) {
        const ChildResult result = test::run_kerf(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_NE(result.log.find("'" + option + "' is not an option of kerf"), std::string::npos) << result.log;
    };
    expect({"mesh", cube, "-x"}, "-x");
    expect({"mesh", cube, "-n4", "-qx", "-o", "out"}, "-qx");
    expect({"verify", "-x", "out"}, "-x");
    expect({"-x"}, "-x");
    EXPECT_EQ(test::run_kerf({"mesh", cube, "-qn4", "--print-config"}).exit_code, 0);
}

TEST(HelpCommand, PrintsTheHelpOfACommand) {
    EXPECT_EQ(printed({"help"}), printed({"--help"}));
    for (const HelpPage& page : help_pages()) {
        if (page.command.empty()) continue;
        EXPECT_EQ(printed({"help", page.command}), printed({page.command, "--help"}));
    }
}

// In Kerf's words, with the command that would be right.
TEST(UsageErrors, SayWhatIsMissingOrTooMuch) {
    const std::string cube = test::asset_path("cube");
    const auto expect = [](const std::vector<std::string>& arguments, const std::string& sentence) {
        const ChildResult result = test::run_kerf(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_NE(result.log.find(sentence), std::string::npos) << result.log;
        EXPECT_NE(result.log.find("\nExample: kerf " + arguments.front() + " "), std::string::npos) << result.log;
    };
    expect({"mesh", cube, "--size"}, "--size needs a value: --size H. Wanted mean edge length");
    expect({"mesh", cube, "-o", "a", "-o", "b"}, "--output is given more than once. Choose one.");
    expect({"merge", "out", "out", "-o", "a.msh"}, "kerf merge takes no further arguments, but there is out");
    expect({"mesh", cube, "--resume", "out"}, "INPUT and --resume do not go together");
    expect({"mesh"}, "kerf mesh needs INPUT: Closed surface");
    expect({"verify"}, "kerf verify needs DIR: Folder of the run");
    expect({"merge", "out"}, "kerf merge needs --output FILE: File, whose ending");
    expect({"merge", "out", "-o", "a.msh", "--msh-version", "5"},
           "--msh-version is '5', but it must be one of 4.1, 2.2.");
    expect({"quality"}, "kerf quality needs DIR|FILE: Folder of a run");
}

TEST(OldSpellings, AnswerWithTheNewOnes) {
    const std::vector<HelpPage> pages = help_pages();
    for (const OldSpelling& old : old_spellings) {
        std::istringstream commands{std::string(old.commands)};
        for (std::string command; commands >> command;) {
            const auto page =
                std::find_if(pages.begin(), pages.end(), [&](const HelpPage& one) { return one.command == command; });
            if (page == pages.end()) continue;  // its program was not built
            SCOPED_TRACE("kerf " + command + " " + std::string(old.option));
            const std::string value = old.value.empty() ? "3" : std::string(old.value);
            const ChildResult result = test::run_kerf({command, "a.stl", std::string(old.option), value});
            EXPECT_EQ(result.exit_code, 2);
            EXPECT_NE(result.log.find(" is " + std::string(old.now) + " now."), std::string::npos) << result.log;
            EXPECT_EQ(test::run_kerf({command, "a.stl", std::string(old.option) + "=" + value}).log, result.log);
            const std::string option(old.now.substr(0, old.now.find(' ')));
            EXPECT_TRUE(page->long_options().contains(option)) << option;
            EXPECT_EQ(page->long_options().contains(std::string(old.option)), !old.value.empty());
        }
    }
    // The value of another option is no old spelling.
    const ChildResult value = test::run_kerf({"mesh", "none.stl", "-o", "--remesh"});
    EXPECT_EQ(value.log.find(" now."), std::string::npos) << value.log;
}

// What is printed as a config file with these options; without its comments.
std::set<std::string> config_with(std::vector<std::string> options) {
    options.insert(options.begin(), {"mesh", "--print-config"});
    std::set<std::string> values;
    for (const std::string& line : test::lines_of(printed(options)))
        if (!line.starts_with('#')) values.insert(line);
    return values;
}

TEST(Spellings, OfOptionsMeanTheSame) {
    EXPECT_EQ(printed({"-V"}), printed({"--version"}));
    EXPECT_EQ(config_with({"-j", "3"}), config_with({"--workers", "3"}));
    EXPECT_EQ(config_with({"--tetgen", "q1.2"}), config_with({"--tetgen-switches", "q1.2"}));
    EXPECT_TRUE(config_with({"--tetgen", "q1.2"}).contains("tetgen-switches = \"q1.2\""));
    EXPECT_EQ(config_with({"--surface", "auto"}), config_with({}));
    const std::vector<std::pair<const char*, int>> megabytes = {
        {"500", 500},     {"500M", 500}, {"2G", 2048},    {"2GB", 2048}, {"2GiB", 2048},
        {"1.5GiB", 1536}, {"0", 0},      {"1T", 1048576}, {"1024K", 1},  {"1K", 1}};
    for (const auto& [text, value] : megabytes)
        EXPECT_TRUE(config_with({"--memory", text}).contains("memory = " + std::to_string(value))) << text;
    for (const char* text : {"2X", "G", "-1G", "1.5", "1e30T", "2G ", "GiB", "nanG"}) {
        const ChildResult result = test::run_kerf({"mesh", "--print-config", "--memory", text});
        EXPECT_EQ(result.exit_code, 2) << text;
        EXPECT_NE(result.log.find("--memory is "), std::string::npos) << result.log;
        EXPECT_NE(result.log.find("2G"), std::string::npos) << result.log;
    }
}

TEST(Help, IsShortForOneLetter) {
    for (const HelpPage& page : help_pages()) {
        if (page.command.empty()) continue;
        const HelpPage brief = {page.command, test::lines_of(printed({page.command, "-h"}))};
        SCOPED_TRACE("kerf " + page.command);
        EXPECT_EQ(brief.lines.front(), page.lines.front());
        if (page.groups().size() == 1) {
            EXPECT_EQ(brief.lines, page.lines);
            continue;
        }
        const std::set<std::string> all = page.long_options(), some = brief.long_options();
        EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
        EXPECT_LE(some.size(), 15u);
        EXPECT_GE(some.size(), 7u);
        EXPECT_NE(brief.lines.back().find("--help lists all "), std::string::npos) << brief.lines.back();
    }
}

TEST(Suggestion, OfAChoiceAreAllOfThem) {
    const ChildResult result = test::run_kerf({"mesh", test::asset_path("cube"), "--cut", "inert"});
    EXPECT_EQ(result.exit_code, 2);
    for (const char* choice : {"inertia", "volume", "equidistant"})
        EXPECT_NE(result.log.find(choice), std::string::npos) << result.log;
}

}  // namespace
}  // namespace kerf

// Everything that may happen to a run, at random: kills of program, worker, rank and launcher, limits of memory, files
// and disk, damaged files, foreign files, odd options and inputs. Whatever happens, the outcome is by the contract: its
// code, its message, nothing of others touched, and what can go on ends with the bytes of an undisturbed run.
//
// Trials are known by their seeds, each of which is a test. KERF_TORTURE_SEED: only this one. KERF_TORTURE_MINUTES: all
// from this one (1) on, for so long; a failure names its seed.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numeric>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "files/io/folder_files.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/mutation.h"
#include "support/places.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/started_run.h"
#include "support/surroundings.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string command_text(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + quoted(word);
    return text;
}

class Trial {
 public:
    // `outcomes`: how often each came, of undisturbed runs, disturbed ones, and those that went on.
    Trial(unsigned seed, std::map<std::string, int>& outcomes) : random_(seed), outcomes_(outcomes) {
        std::ofstream(folder_.file("thesis.txt")) << "years of work";
        input_ = make_input();
        options_ = make_options();
    }
    void run();

 private:
    using Expected = std::map<std::string, std::string>;

    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_()) % limit; }
    bool one_in(std::uint32_t times) { return below(times) == 0; }
    template <class T>
    const T& any_of(const std::vector<T>& values) {
        return values[below(static_cast<std::uint32_t>(values.size()))];
    }
    std::string make_input();
    Words make_options();
    Words command(const std::string& output) const;
    Words under_ranks(Words words);
    test::Surroundings surroundings() const {
        return test::Surroundings({input_, "-o", folder_.file("out"), "-o", folder_.file("whole")});
    }
    void note(const std::string& what) { story_ += what + "\n"; }

    ChildResult run_to_end(const std::string& program, const Words& words);
    void expect_contract(const ChildResult& result, bool was_killed, bool is_silent);
    void disturb();
    void kill_something();
    void limit_something();
    void close_streams();
    void put_foreign_file();
    void tamper_with_remains();
    void go_on(const Expected& expected);
    void tamper_with_result();

    std::mt19937 random_;
    std::map<std::string, int>& outcomes_;
    test::TemporaryFolder folder_;
    std::string input_, story_;
    double volume_ = 0;  // of the input
    Words options_;
};

std::string Trial::make_input() {
    Soup soup;
    switch (below(7)) {
        case 0:
            volume_ = 1;
            return test::asset_path("cube");
        case 1:
            soup = test::icosphere(static_cast<int>(1 + below(3)));
            break;
        case 2:
            soup = test::torus(3, 1, 24, 12);
            break;
        case 3:
            soup = test::nested_boxes(static_cast<int>(1 + below(3)), 4);
            break;
        case 4:
            soup = test::plate_with_hole(16);
            break;
        case 5:
            soup = test::join(test::box(), test::translated(test::box(), Vec3(3, 0, 0)));
            break;
        default:
            soup = test::box(Vec3::Zero(), Vec3::Ones(), 8);
    }
    const std::string path =
        folder_.file(any_of(std::vector<std::string>{"input.off", "in put.off", "\xFF.off", "line\nend.off"}));
    test::write_off(path, soup.vertices, soup.facets);
    volume_ = enclosed_volume(soup.vertices, soup.facets);
    if (one_in(12)) {
        const std::string bytes = test::bytes_of_file(path);
        std::ofstream(path, std::ios::binary) << test::mutate(bytes, bytes, random_());
    }
    return path;
}

Words Trial::make_options() {
    struct Option {
        std::string name;
        Words values, refused;
    };
    static const std::vector<Option> table = {{"--cut", {"inertia", "volume", "equidistant"}, {"saw"}},
                                              {"--axis", {"auto", "x", "y", "z"}, {"w"}},
                                              {"--balance", {"nodes", "faces", "volume", "inertia", "work"}, {""}},
                                              {"--contour", {"min-cut", "edges", "straight"}, {"none"}},
                                              {"--surface", {"keep", "split"}, {"lose"}},
                                              {"--radius-edge", {"0", "1.2", "1.4", "2"}, {"1", "nan"}},
                                              {"--size", {"0.1", "0.5"}, {"1e-7", "1e-300", "-1"}},
                                              {"--max-volume", {"1e-3", "1e-4", "0"}, {"inf"}},
                                              {"--attempts", {"1", "3"}, {"0"}},
                                              {"--weld", {"0", "1e-9"}, {"1e-400"}},
                                              {"--voids", {"as-given", "parity"}, {"some"}},
                                              {"--feature-angle", {"0", "40"}, {"180"}},
                                              {"--optimise-surface", {"0", "2"}, {"1.5"}},
                                              {"--keep-largest", {}, {}},
                                              {"--tetgen-switches", {"q1.5", "q1.4a0.01"}, {"r", "h"}},
                                              {"--stl", {}, {}},
                                              {"--memory", {"0", "2000", "150"}, {"20"}},
                                              {"--timeout", {"0", "100"}, {"-1"}}};
    Words options = {"-n", std::to_string(one_in(20) ? below(2000) : 1 + below(8))};
    // Some tenths of a second, so that there is something to disturb.
    if (volume_ > 0 && !one_in(3))
        options.insert(options.end(), {"--size", fmt::format("{}", std::cbrt(volume_) / 25)});
    for (std::uint32_t i = below(4); i > 0; --i) {
        const Option& option = any_of(table);
        if (std::find(options.begin(), options.end(), option.name) != options.end()) continue;
        options.push_back(option.name);
        if (!option.values.empty()) options.push_back(any_of(one_in(30) ? option.refused : option.values));
    }
    return options;
}

Words Trial::command(const std::string& output) const {
    Words words = {"mesh", input_, "-o", folder_.file(output)};
    words.insert(words.end(), options_.begin(), options_.end());
    return words;
}

// The words for env, or for the program itself.
Words Trial::under_ranks(Words words) {
    words.insert(words.begin(), test::kerf_program());
#ifdef KERF_MPIRUN
    if (one_in(4)) {
        const Words launcher = {
            "OMPI_ALLOW_RUN_AS_ROOT=1",  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", KERF_MPIRUN, "--oversubscribe", "-n",
            std::to_string(2 + below(2))};
        words.insert(words.begin(), launcher.begin(), launcher.end());
    }
#endif
    return words;
}

ChildResult Trial::run_to_end(const std::string& program, const Words& words) {
    note(program + " " + command_text(words));
    const test::Surroundings around = surroundings();
    ChildResult result = test::run_program(program, words);
    EXPECT_EQ(around.changes(), "");
    note("  " + result.describe() + ": " + result.log);
    return result;
}

// Codes of the contract that a run may have, each with its message.
void Trial::expect_contract(const ChildResult& result, bool was_killed, bool is_silent) {
    ++outcomes_[result.end == ChildResult::End::exited ? fmt::format("code {}", result.exit_code)
                                                       : fmt::format("signal {}", result.signal)];
    EXPECT_NE(result.end, ChildResult::End::timed_out) << "it hangs";
    if (was_killed) return;
    EXPECT_EQ(result.end, ChildResult::End::exited) << result.describe();
    const Words codes = {"0", "2", "3", "4", "5", "7", "130"};
    EXPECT_TRUE(std::find(codes.begin(), codes.end(), std::to_string(result.exit_code)) != codes.end())
        << result.exit_code;
    if (result.exit_code != 0 && !is_silent) {
        EXPECT_NE(result.log.find("kerf: "), std::string::npos) << "no message";
    }
}

void Trial::kill_something() {
    const bool with_workers = one_in(2);
    Words words = command("out");
    words.insert(words.end(), {"--workers", std::to_string(1 + below(2))});
    words = under_ranks(words);
    note("env " + command_text(words));
    const test::Surroundings around = surroundings();
    test::StartedRun run("/usr/bin/env", words);
    const std::uint32_t wanted = below(4);
    if (one_in(2))
        test::await(
            [&] { return test::finished_parts(folder_.file("out")) >= wanted || test::has_ended(run.process()); });
    std::vector<pid_t> all;
    for (std::uint32_t times = 1 + below(3); times > 0; --times) {
        std::this_thread::sleep_for(std::chrono::milliseconds(below(one_in(2) ? 60 : 600)));
        for (const std::string name : {"kerf", "kerf-worker"})
            for (const pid_t process : test::descendants_of(run.process(), name)) all.push_back(process);
        std::vector<pid_t> victims = with_workers ? run.workers() : test::descendants_of(run.process(), "kerf");
        if (!with_workers) victims.push_back(run.process());
        if (victims.empty() || test::has_ended(run.process())) continue;
        const pid_t victim = any_of(victims);
        const int signal = any_of(std::vector<int>{SIGKILL, SIGTERM, SIGINT, with_workers ? SIGSEGV : SIGKILL});
        note(fmt::format("  signal {} to {}", signal, with_workers ? "a worker" : "the program"));
        ::kill(victim, signal);
    }
    const ChildResult result = run.wait();
    note("  " + result.describe() + ": " + result.log);
    // Ranks notice in a moment that their launcher was killed.
    for (const pid_t process : all) EXPECT_TRUE(test::await([&] { return test::has_ended(process); })) << "an orphan";
    // A launcher has codes of its own for ranks that were killed.
    expect_contract(result, !with_workers, false);
    EXPECT_EQ(around.changes(), "");
}

void Trial::limit_something() {
    const std::string limit = any_of(
        Words{"ulimit -f " + std::to_string(1 + below(400)), "ulimit -v " + std::to_string(100'000 + below(300'000)),
              "ulimit -n " + std::to_string(5 + below(30)), "ulimit -t " + std::to_string(1 + below(5))});
    Words words = command("out");
    words.insert(words.begin(), test::kerf_program());
    const ChildResult result = run_to_end("/bin/sh", {"-c", limit + "; exec " + command_text(words)});
    // The loader has a code of its own where not even the libraries find room, and a used up processor is a kill.
    const bool has_no_room = result.exit_code == 127 && result.log.find("shared librar") != std::string::npos;
    expect_contract(result, has_no_room || limit.starts_with("ulimit -t"), false);
}

void Trial::close_streams() {
    Words words = command("out");
    words.insert(words.begin(), test::kerf_program());
    const std::string ending = any_of(Words{"2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&-", ">/dev/full"});
    const ChildResult result = run_to_end("/bin/sh", {"-c", "exec " + command_text(words) + " " + ending});
    expect_contract(result, false, true);
}

// Where it is in the way, the run is refused and nothing else happens.
void Trial::put_foreign_file() {
    const std::string name = any_of(Words{"out", "out.kerf-partial", "out.failed", "out.kerf-partial-older"});
    const std::string folder = folder_.file(name);
    const bool existed = fs::exists(folder);
    fs::create_directories(folder + "/parts");
    const std::string file = folder + any_of(Words{"/notes.txt", "/parts/notes.txt"});
    std::ofstream(file) << "years of work";
    note("put " + file);
    const ChildResult result = run_to_end(test::kerf_program(), command("out"));
    expect_contract(result, false, false);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_EQ(test::bytes_of_file(file), "years of work");
    fs::remove(file);
    if (!existed) fs::remove_all(folder);
}

void Trial::tamper_with_remains() {
    const std::string partial = folder_.file("out.kerf-partial");
    std::vector<std::string> files = list_files(partial);
    std::erase_if(files, [](const std::string& file) { return file.ends_with('/'); });
    for (std::uint32_t times = below(4); times > 0 && !files.empty(); --times) {
        const std::string path = partial + "/" + any_of(files);
        note("damage " + path);
        const std::string bytes = test::bytes_of_file(path);
        if (one_in(4))
            fs::remove(path);
        else
            std::ofstream(path, std::ios::binary) << test::mutate(bytes, bytes, random_());
    }
}

void Trial::disturb() {
    for (std::uint32_t times = 1 + below(3); times > 0; --times) {
        switch (below(6)) {
            case 0:
                limit_something();
                break;
            case 1:
                close_streams();
                break;
            case 2:
                put_foreign_file();
                break;
            case 3:
                tamper_with_remains();
                break;
            default:
                kill_something();
        }
    }
}

// By its name if that is known, else by the same command; the result is that of an undisturbed run.
void Trial::go_on(const Expected& expected) {
    bool is_done = false;
    ++outcomes_[fmt::format("{} parts waited", test::finished_parts(folder_.file("out")))];
    if (fs::exists(folder_.file("out.kerf-partial/work/run.json")) && one_in(2)) {
        const ChildResult resumed = run_to_end(test::kerf_program(), {"mesh", "--resume", folder_.file("out")});
        expect_contract(resumed, false, false);
        is_done = resumed.exit_code == 0;  // what the run needs to be resumed may have been damaged
    }
    if (!is_done) {
        const ChildResult again = run_to_end(test::kerf_program(), command("out"));
        EXPECT_EQ(again.exit_code, 0);
    }
    EXPECT_TRUE(test::contents(folder_.file("out/parts")) == expected) << "other bytes";
    EXPECT_EQ(run_to_end(test::kerf_program(), {"verify", folder_.file("out")}).exit_code, 0);
}

void Trial::tamper_with_result() {
    std::vector<std::string> files = list_files(folder_.file("out"));
    std::erase_if(files, [](const std::string& file) { return file.ends_with('/'); });
    const std::string path = folder_.file("out/" + any_of(files)), bytes = test::bytes_of_file(path);
    std::string changed = test::mutate(bytes, bytes, random_());
    if (changed == bytes) return;
    note("change " + path);
    std::ofstream(path, std::ios::binary) << changed;
    const ChildResult verified = run_to_end(test::kerf_program(), {"verify", folder_.file("out")});
    EXPECT_TRUE(verified.exit_code == 7 || verified.exit_code == 8) << verified.exit_code;
    EXPECT_EQ(verified.end, ChildResult::End::exited);
}

void Trial::run() {
    const ChildResult undisturbed = run_to_end(test::kerf_program(), command("whole"));
    expect_contract(undisturbed, false, false);
    if (undisturbed.exit_code == 0) {
        const Expected expected = test::contents(folder_.file("whole/parts"));
        disturb();
        go_on(expected);
        tamper_with_result();
    } else {
        disturb();
    }
    EXPECT_EQ(test::bytes_of_file(folder_.file("thesis.txt")), "years of work");
    if (testing::Test::HasFailure()) std::cerr << story_;
}

double from_environment(const char* name, double otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atof(text) : otherwise;
}

std::vector<unsigned> seeds() {
    const auto first = static_cast<unsigned>(from_environment("KERF_TORTURE_SEED", 1));
    if (std::getenv("KERF_TORTURE_SEED") || std::getenv("KERF_TORTURE_MINUTES")) return {first};
    std::vector<unsigned> all(20);
    std::iota(all.begin(), all.end(), first);
    return all;
}

class Torture : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seed, Torture, testing::ValuesIn(seeds()),
                         [](const auto& test) { return std::to_string(test.param); });

TEST_P(Torture, EveryOutcomeIsByTheContract) {
    const std::chrono::duration<double> time(60 * from_environment("KERF_TORTURE_MINUTES", 0));
    const auto start = std::chrono::steady_clock::now();
    unsigned seed = GetParam();
    std::map<std::string, int> outcomes;
    do {
        SCOPED_TRACE(fmt::format("KERF_TORTURE_SEED={}", seed));
        Trial(seed++, outcomes).run();
    } while (std::chrono::steady_clock::now() - start < time && !HasFailure());
    std::cerr << seed - GetParam() << " trials;";
    for (const auto& [outcome, count] : outcomes) std::cerr << ' ' << outcome << ": " << count << ';';
    std::cerr << '\n';
}

}  // namespace
}  // namespace kerf

// Whether every facet of hard surfaces is recovered: random ones of all families of support/hard_surfaces.h.
//
//     recovery_bench [COUNT] [FIRST SEED] [--family NAME] [--pass NAME] [--most-facets N] [--failures FILE]
//     recovery_bench --seed N                 one of them, in all passes
//     recovery_bench --seed N --write FILE    as OBJ with all digits
//     recovery_bench --seed N --reduce FILE   the smallest surface that fails like that one, as OBJ
//     recovery_bench FILE.obj                 of any format
//
// Each surface is filled in several passes: `raw`, no point added; `shaped`, with a bound of radius over edge; `core`,
// around a lattice core; `mesh`, all that --mesher lattice does, which must not have asked TetGen. Each pass is a child
// process of its own with a limit of time, and its mesh has to obey all laws; of many surfaces, one that has failed in
// a pass is spared the others. Seconds are those of the processor. The exit code is 1 if any has failed.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"
#include "bench/bench.h"
#include "bench/recovery_passes.h"
#include "bench/surface_reduction.h"
#include "files/io/obj_writer.h"
#include "run/prepare/input.h"
#include "support/hard_surfaces.h"

namespace kerf {

namespace {

using bench::Outcome;
using bench::RecoveryPass;

struct Failure {
    std::size_t facets;
    std::uint64_t seed;
    std::string family, pass, reason;
};

// A fill that has taken long.
struct Slow {
    double seconds;
    std::size_t facets;
    std::uint64_t seed;
    std::string pass;
};

struct Tally {
    int surfaces = 0, skipped = 0, recovered = 0;  // in all passes
    std::int64_t facets = 0;
    std::vector<double> seconds = std::vector<double>(bench::recovery_passes().size());
    std::vector<int> failed = std::vector<int>(bench::recovery_passes().size());
    std::vector<Slow> slowest;  // of all, the slowest first
};

struct Request {
    std::uint64_t count = 10'000, first = 0;
    int most_facets = 2000;
    std::string family, pass, failures, input, write_to, reduce_to;
    bool is_one = false;
};

void keep_slowest(std::vector<Slow>& fills) {
    constexpr std::size_t most = 10;
    std::stable_sort(fills.begin(), fills.end(), [](const Slow& a, const Slow& b) { return a.seconds > b.seconds; });
    fills.resize(std::min(fills.size(), most));
}

// The passes in which it has failed: of many surfaces the first one alone.
std::vector<Failure> test_surface(const SurfaceArrays& surface, std::uint64_t seed, const Request& request,
                                  Tally& tally) {
    std::vector<Failure> failures;
    const auto passes = bench::recovery_passes();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!request.pass.empty() && request.pass != passes[i].name) continue;
        const Outcome outcome = bench::outcome_in_child(passes[i], surface);
        tally.seconds[i] += outcome.seconds;
        tally.slowest.push_back({outcome.seconds, surface.facets.size(), seed, passes[i].name});
        if (request.is_one)
            fmt::print("{:8} {:8.3f} s  {}\n", passes[i].name, outcome.seconds,
                       outcome.failure.empty() ? outcome.remark : outcome.failure);
        if (outcome.failure.empty()) continue;
        ++tally.failed[i];
        failures.push_back({surface.facets.size(), seed, "", passes[i].name, outcome.failure});
        if (!request.is_one) break;
    }
    ++tally.surfaces;
    tally.facets += static_cast<std::int64_t>(surface.facets.size());
    if (failures.empty()) ++tally.recovered;
    keep_slowest(tally.slowest);
    return failures;
}

void print_table(const std::vector<Tally>& tallies) {
    fmt::print("{:12} {:>8} {:>8} {:>8} {:>10}", "family", "surfaces", "skipped", "facets", "recovered");
    for (const RecoveryPass& pass : bench::recovery_passes()) fmt::print("  {:>17}", pass.name);
    fmt::print("\n");
    Tally all;
    const auto print = [](const std::string& name, const Tally& tally) {
        fmt::print("{:12} {:8} {:8} {:8} {:10}", name, tally.surfaces, tally.skipped, tally.facets, tally.recovered);
        for (std::size_t i = 0; i < tally.failed.size(); ++i)
            fmt::print("  {:5} in {:6.1f} s", tally.failed[i], tally.seconds[i]);
        fmt::print("\n");
    };
    for (std::size_t k = 0; k < tallies.size(); ++k) {
        const Tally& tally = tallies[k];
        if (tally.surfaces + tally.skipped == 0) continue;
        print(test::hard_families()[k].name, tally);
        all.surfaces += tally.surfaces, all.skipped += tally.skipped, all.facets += tally.facets;
        all.recovered += tally.recovered;
        all.slowest.insert(all.slowest.end(), tally.slowest.begin(), tally.slowest.end());
        for (std::size_t i = 0; i < tally.failed.size(); ++i) {
            all.failed[i] += tally.failed[i];
            all.seconds[i] += tally.seconds[i];
        }
    }
    print("all", all);
    keep_slowest(all.slowest);
    fmt::print("slowest:\n");
    for (const Slow& slow : all.slowest)
        fmt::print("{:6} facets  --seed {:<8} {:7} {:.3f} s\n", slow.facets, slow.seed, slow.pass, slow.seconds);
}

void write_failures(std::vector<Failure> failures, const std::string& path) {
    std::stable_sort(failures.begin(), failures.end(),
                     [](const Failure& a, const Failure& b) { return a.facets < b.facets; });
    std::string text;
    for (const Failure& f : failures)
        text += fmt::format("{:6} facets  --seed {:<8} {:12} {:7} {}\n", f.facets, f.seed, f.family, f.pass, f.reason);
    if (path.empty())
        fmt::print("{}", text);
    else
        std::ofstream(path) << text;
}

int test_many(const Request& request) {
    const std::size_t families = test::hard_families().size();
    std::vector<Tally> tallies(families);
    std::vector<Failure> failures;
    const std::uint64_t step = request.family.empty() ? 1 : families;
    std::uint64_t seed = request.first;
    if (!request.family.empty()) {
        const std::size_t number = test::hard_family_number(request.family);
        while (seed % families != number) ++seed;
    }
    for (std::uint64_t k = 0; k < request.count; ++k, seed += step) {
        Tally& tally = tallies[seed % families];
        const auto surface = test::hard_surface(seed, request.most_facets);
        if (!surface) {
            ++tally.skipped;
            continue;
        }
        for (Failure& failure : test_surface(surface->surface, seed, request, tally)) {
            failure.family = surface->family;
            failures.push_back(std::move(failure));
        }
        if ((k + 1) % 500 == 0) {
            fmt::print(stderr, "{} surfaces, {} failures\n", k + 1, failures.size());
            if (!request.failures.empty()) write_failures(failures, request.failures);
        }
    }
    print_table(tallies);
    write_failures(failures, request.failures);
    return failures.empty() ? 0 : 1;
}

void write_surface(const SurfaceArrays& surface, const std::string& path) {
    write_obj(path, surface.vertices, surface.facets, std::vector<std::int32_t>(surface.facets.size(), 0), {"surface"});
}

int test_one(const SurfaceArrays& surface, const Request& request) {
    fmt::print("{} facets, {} vertices\n", surface.facets.size(), surface.vertices.size());
    if (!request.write_to.empty()) {
        write_surface(surface, request.write_to);
        return 0;
    }
    if (!request.reduce_to.empty()) {
        for (const RecoveryPass& pass : bench::recovery_passes()) {
            if (!request.pass.empty() && request.pass != pass.name) continue;
            if (bench::outcome_in_child(pass, surface).failure.empty()) continue;
            const SurfaceArrays small = bench::reduced(surface, [&](const SurfaceArrays& candidate) {
                return !bench::outcome_in_child(pass, candidate).failure.empty();
            });
            write_surface(small, request.reduce_to);
            fmt::print("{}: {} facets are left\n", pass.name, small.facets.size());
            return 0;
        }
        fmt::print("It fails in no pass.\n");
        return 1;
    }
    Tally tally;
    return test_surface(surface, request.first, request, tally).empty() ? 0 : 1;
}

Request request_of(const std::vector<std::string>& words) {
    Request request;
    const std::map<std::string, std::string Request::*> texts = {{"--family", &Request::family},
                                                                 {"--pass", &Request::pass},
                                                                 {"--failures", &Request::failures},
                                                                 {"--write", &Request::write_to},
                                                                 {"--reduce", &Request::reduce_to}};
    int numbers = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const bool is_option = word.starts_with("--");
        if (is_option && i + 1 == words.size()) throw Error(ErrorCode::usage, fmt::format("{} needs a value.", word));
        if (word == "--seed") {
            request.first = std::stoull(words[++i]);
            request.is_one = true;
        } else if (word == "--most-facets") {
            request.most_facets = std::stoi(words[++i]);
        } else if (is_option) {
            const auto text = texts.find(word);
            if (text == texts.end()) throw Error(ErrorCode::usage, fmt::format("There is no option {}.", word));
            request.*(text->second) = words[++i];
        } else if (word.find('.') != std::string::npos) {
            request.input = word;
            request.is_one = true;
        } else {
            (numbers++ == 0 ? request.count : request.first) = std::stoull(word);
        }
    }
    return request;
}

int run(const std::vector<std::string>& words) {
    const Request request = request_of(words);
    if (!request.is_one) return test_many(request);
    if (!request.input.empty()) return test_one(read_input(request.input).complex.arrays(), request);
    const auto surface = test::hard_surface(request.first, request.most_facets);
    if (!surface) throw Error(ErrorCode::usage, fmt::format("Facets of surface {} meet.", request.first));
    fmt::print("{}, ", surface->family);
    return test_one(surface->surface, request);
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

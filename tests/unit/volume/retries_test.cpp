#include "fill/volume/retries.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "base/core/bytes.h"
#include "fill/volume/meshers.h"

namespace kerf {
namespace {

std::vector<MesherOptions> options_to_try() {
    std::vector<MesherOptions> all;
    for (const std::string& name : mesher_names())
        for (const double radius_edge : {0.0, 1.2, 1.4, 2.0, 5.0})
            for (const double max_volume : {0.0, 1e-3}) {
                MesherOptions options;
                options.name = name;
                options.radius_edge = radius_edge;
                options.size = SizeField(max_volume);
                all.push_back(options);
            }
    all.emplace_back().tetgen.switches = "q1.3";
    return all;
}

TEST(MesherCalls, BeginAsAskedForAndAllDiffer) {
    for (const MesherOptions& wanted : options_to_try()) {
        const std::vector<MesherCall> calls = mesher_calls(wanted);
        EXPECT_TRUE(calls[0].fallback.empty());
        MesherOptions chosen = wanted;
        if (wanted.name == "auto") chosen.name = calls[0].options.name;
        EXPECT_EQ(to_bytes(calls[0].options), to_bytes(chosen));
        std::set<std::tuple<std::string, double, double, double, std::uint32_t, bool>> different;
        for (const MesherCall& call : calls) {
            different.emplace(call.options.name, call.options.radius_edge, call.options.size.reference_volume(),
                              call.options.tetgen.tolerance, call.options.tetgen.shuffle, call.cut_first);
            EXPECT_TRUE(call.options.size.reference_volume() == wanted.size.reference_volume() ||
                        call.fallback == calls.back().fallback);
            EXPECT_EQ(call.options.tetgen.switches, wanted.tetgen.switches);
            EXPECT_TRUE(call.options.radius_edge == 0 || call.options.radius_edge >= wanted.radius_edge);
        }
        EXPECT_EQ(different.size(), calls.size());
    }
}

// What TetGen does not end within its time the lattice does, unless its user has switches for it.
TEST(MesherCalls, AskTheLatticeOnceAfterTetGenUnlessThereAreSwitches) {
    const auto first_of_lattice = [](const MesherOptions& wanted) -> std::optional<std::size_t> {
        const std::vector<MesherCall> calls = mesher_calls(wanted);
        EXPECT_LE(std::count_if(calls.begin(), calls.end(),
                                [](const MesherCall& call) { return call.options.name == "lattice"; }),
                  1);
        for (std::size_t call = 0; call < calls.size(); ++call)
            if (calls[call].options.name == "lattice") return call;
        return std::nullopt;
    };
    for (const MesherOptions& wanted : options_to_try()) {
        const bool has_switches = !wanted.tetgen.switches.empty();
        const std::optional<std::size_t> call = first_of_lattice(wanted);
        ASSERT_EQ(call.has_value(), !has_switches);
        if (wanted.name != "tetgen" || has_switches) continue;
        const std::vector<MesherCall> calls = mesher_calls(wanted);
        EXPECT_EQ(next_call(calls, 1, MesherFailure::timed_out), call);
        MesherOptions lattice = wanted;
        lattice.name = "lattice";
        EXPECT_EQ(to_bytes(calls[*call].options), to_bytes(lattice)) << "all that was asked for";
    }
    MesherOptions with_switches;
    with_switches.name = "tetgen";
    with_switches.tetgen.switches = "q1.3";
    EXPECT_FALSE(first_of_lattice(with_switches));
}

TEST(MesherCalls, EndWhateverFails) {
    for (const MesherOptions& wanted : options_to_try())
        for (const MesherFailure failure : {MesherFailure::failed, MesherFailure::timed_out}) {
            const std::vector<MesherCall> calls = mesher_calls(wanted);
            std::size_t call = 0, count = 1;
            while (const auto next = next_call(calls, call, failure)) {
                ASSERT_GT(*next, call);
                call = *next;
                ++count;
            }
            EXPECT_EQ(call, calls.size() - 1);
            const auto easier = std::count_if(calls.begin(), calls.end(), std::mem_fn(&MesherCall::easier));
            EXPECT_EQ(count, failure == MesherFailure::failed ? calls.size() : 2 + static_cast<std::size_t>(easier));
        }
}

}  // namespace
}  // namespace kerf

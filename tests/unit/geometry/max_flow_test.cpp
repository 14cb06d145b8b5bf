#include "base/geometry/max_flow.h"

#include <array>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace kerf {
namespace {

struct Graph {
    struct Edge {
        std::int32_t a, b;
        double capacity;
    };
    std::vector<std::array<double, 2>> terminals;  // from the source, to the sink
    std::vector<Edge> edges;

    // Capacity of the cut whose sink side is the set of bits.
    double cut(unsigned sink_side) const {
        double sum = 0;
        for (std::size_t v = 0; v < terminals.size(); ++v) sum += terminals[v][sink_side >> v & 1 ? 0 : 1];
        for (const auto& [a, b, capacity] : edges)
            if ((sink_side >> a & 1) != (sink_side >> b & 1)) sum += capacity;
        return sum;
    }
};

Graph random_graph(std::mt19937& random) {
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    Graph graph;
    graph.terminals.resize(pick(1, 8));
    const auto n = static_cast<int>(graph.terminals.size());
    // Small whole numbers: sums are exact, and zeros and equal cuts are frequent.
    for (auto& [source, sink] : graph.terminals)
        source = pick(0, 2) ? pick(0, 9) : 0, sink = pick(0, 2) ? pick(0, 9) : 0;
    for (int i = pick(0, 3 * n); i-- > 0 && n > 1;) {
        const int a = pick(0, n - 1), b = (a + pick(1, n - 1)) % n;
        graph.edges.push_back({a, b, static_cast<double>(pick(0, 6))});
    }
    return graph;
}

MaxFlow build(const Graph& graph) {
    MaxFlow flow(static_cast<std::int32_t>(graph.terminals.size()));
    for (std::size_t v = 0; v < graph.terminals.size(); ++v)
        flow.add_terminal(static_cast<std::int32_t>(v), graph.terminals[v][0], graph.terminals[v][1]);
    for (const auto& [a, b, capacity] : graph.edges) flow.add_edge(a, b, capacity);
    return flow;
}

unsigned sink_side(const MaxFlow& flow, std::size_t nodes) {
    unsigned side = 0;
    for (std::size_t v = 0; v < nodes; ++v) side |= unsigned{flow.on_sink_side(static_cast<std::int32_t>(v))} << v;
    return side;
}

constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();

TEST(MaxFlow, CutIsMinimalOnRandomGraphs) {
    constexpr unsigned seed = 1;
    std::mt19937 random(seed);
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", graph " << i);
        const Graph graph = random_graph(random);
        const std::size_t nodes = graph.terminals.size();
        double minimum = std::numeric_limits<double>::infinity();
        for (unsigned side = 0; side < 1u << nodes; ++side) minimum = std::min(minimum, graph.cut(side));
        unsigned common = ~0u;  // nodes on the sink's side of every minimum cut
        for (unsigned side = 0; side < 1u << nodes; ++side)
            if (graph.cut(side) == minimum) common &= side;
        MaxFlow flow = build(graph);
        ASSERT_TRUE(flow.solve(unlimited));
        ASSERT_EQ(graph.cut(sink_side(flow, nodes)), minimum);
        ASSERT_EQ(sink_side(flow, nodes), common) << "free nodes count to the source";
    }
}

TEST(MaxFlow, GridIsCutAtItsBottleneck) {
    constexpr std::int32_t width = 60, height = 40, bottleneck = 23;
    MaxFlow flow(width * height);
    for (std::int32_t y = 0; y < height; ++y) {
        flow.add_terminal(y * width, 1e6, 0);
        flow.add_terminal(y * width + width - 1, 0, 1e6);
        for (std::int32_t x = 0; x + 1 < width; ++x)
            flow.add_edge(y * width + x, y * width + x + 1, x == bottleneck ? 0.5 : 1);
        if (y > 0)
            for (std::int32_t x = 0; x < width; ++x) flow.add_edge((y - 1) * width + x, y * width + x, 1);
    }
    ASSERT_TRUE(flow.solve(unlimited));
    for (std::int32_t v = 0; v < width * height; ++v) EXPECT_EQ(flow.on_sink_side(v), v % width > bottleneck);
}

TEST(MaxFlow, StopsAtItsLimit) {
    Graph graph;
    graph.terminals.assign(64, {0, 0});
    graph.terminals.front() = {5, 0};
    graph.terminals.back() = {0, 5};
    for (std::int32_t v = 1; v < 64; ++v) graph.edges.push_back({v - 1, v, 1});
    EXPECT_FALSE(build(graph).solve(3));
    EXPECT_TRUE(build(graph).solve(unlimited));
}

TEST(MaxFlow, WithoutEdgesEveryNodeGoesToItsStrongerTerminal) {
    MaxFlow flow(3);
    flow.add_terminal(0, 2, 1);
    flow.add_terminal(1, 1, 2);
    flow.add_terminal(2, 1, 1);
    ASSERT_TRUE(flow.solve(unlimited));
    EXPECT_FALSE(flow.on_sink_side(0));
    EXPECT_TRUE(flow.on_sink_side(1));
    EXPECT_FALSE(flow.on_sink_side(2));
}

}  // namespace
}  // namespace kerf

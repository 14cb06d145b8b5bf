// The cells around a part, against all cells of all parts.
#include <algorithm>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "export/cases.h"
#include "files/export/inside/ghosts.h"
#include "files/part/parts_of_order.h"
#include "files/part/run_parts.h"
#include "run/run/edge_numbering.h"

namespace kerf::ghosts_test {
namespace {

// Counts how often parts are loaded.
class CountedParts : public PartSource {
 public:
    explicit CountedParts(const PartSource& parts) : parts_(parts), loads_(parts.outline().parts.size(), 0) {}
    const MeshOutline& outline() const override { return parts_.outline(); }
    Part load(PartIndex index) const override {
        {
            const std::lock_guard lock(mutex_);
            ++loads_[index];
        }
        return parts_.load(index);
    }
    const Array<PartIndex, int>& loads() const { return loads_; }

 private:
    const PartSource& parts_;
    mutable std::mutex mutex_;
    mutable Array<PartIndex, int> loads_;
};

// As its definition has it.
Ghosts expected_ghosts(const MeshOutline& outline, const Array<PartIndex, Part>& parts, PartIndex of) {
    const Part& part = parts[of];
    const auto boundary = part.global_id.begin() + part.mesh.boundary_vertex_count;
    const std::set<std::int64_t> vertices(part.global_id.begin(), boundary);
    std::set<std::int64_t> nodes;
    for (std::int64_t n = 0; n < part.node_count(); ++n) nodes.insert(part.node_id(n));
    Ghosts ghosts;
    std::map<std::int64_t, Vec3> others;
    for (const PartIndex index : parts.ids()) {
        if (index == of) continue;
        const Part& other = parts[index];
        for (std::int64_t t = 0; t < other.tet_count(); ++t) {
            const auto is_shared = [&](std::int32_t v) { return vertices.contains(other.global_id[v]); };
            const Tetrahedron& tet = other.mesh.tets[t];
            if (std::none_of(tet.begin(), tet.end(), is_shared)) continue;
            ghosts.cells.push_back({outline.first_tet(index) + t, index, nodes_of_tet(other, t)});
            const auto add = [&](std::int32_t n) {
                if (!nodes.contains(other.node_id(n))) others[other.node_id(n)] = other.node_point(n);
            };
            if (other.order() == 1) std::for_each(tet.begin(), tet.end(), add);
            if (other.order() == 1) continue;
            const std::array<std::int32_t, 10> all = other.nodes_of_tet(t);
            std::for_each(all.begin(), all.end(), add);
        }
    }
    for (const auto& [id, point] : others) ghosts.nodes.push_back({id, point});
    return ghosts;
}

void expect_equal(const Ghosts& found, const Ghosts& wanted) {
    ASSERT_EQ(found.cells.size(), wanted.cells.size());
    for (std::size_t i = 0; i < found.cells.size(); ++i) {
        const GhostCell &a = found.cells[i], &b = wanted.cells[i];
        EXPECT_EQ(a.number, b.number);
        EXPECT_EQ(a.part, b.part);
        EXPECT_TRUE(std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end()));
    }
    ASSERT_EQ(found.nodes.size(), wanted.nodes.size());
    for (std::size_t i = 0; i < found.nodes.size(); ++i) {
        EXPECT_EQ(found.nodes[i].id, wanted.nodes[i].id);
        EXPECT_EQ(found.nodes[i].point, wanted.nodes[i].point);
    }
}

void expect_ghosts(const PartSource& source) {
    const MeshOutline& outline = source.outline();
    const CountedParts counted(source);
    GhostFinder keeps_all, keeps_none(0);
    Array<PartIndex, Part> parts;
    for (const PartIndex index : outline.parts.ids()) parts.push_back(source.load(index));
    for (const PartIndex index : outline.parts.ids()) {
        SCOPED_TRACE(index.value());
        const Ghosts wanted = expected_ghosts(outline, parts, index);
        expect_equal(keeps_all.ghosts_of(counted, parts[index]), wanted);
        expect_equal(keeps_none.ghosts_of(source, parts[index]), wanted);
    }
    EXPECT_LE(*std::max_element(counted.loads().begin(), counted.loads().end()), 1) << "kept";
}

TEST(Ghosts, AreTheCellsOfOthersWhateverIsKept) {
    for (const auto& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        expect_ghosts(RunParts(test::run_of(each)));
    }
}

TEST(Ghosts, OfOrder2HaveTheNodesOnEdges) {
    const auto& cases = test::export_cases();
    const auto voids = std::find_if(cases.begin(), cases.end(), [](const auto& each) { return each.name == "voids"; });
    ASSERT_NE(voids, cases.end());
    const RunParts parts(test::run_of(*voids));
    SingleRank alone;
    const auto of_order_2 = parts_of_order(parts, 2, [&] { return number_edges_together(alone, parts, nullptr); });
    ASSERT_TRUE(of_order_2);
    ASSERT_EQ(of_order_2->outline().order, 2);
    expect_ghosts(*of_order_2);
}

TEST(Ghosts, ThreadsLoadAPartOnce) {
    const RunParts run(test::run_of(test::export_cases().back()));
    const CountedParts counted(run);
    GhostFinder finder;
    std::atomic<std::int32_t> next = 0;
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&] {
                for (std::int32_t p = next++; p < std::ssize(run.outline().parts); p = next++)
                    finder.ghosts_of(counted, run.load(PartIndex(p)));
            });
    }
    EXPECT_EQ(*std::max_element(counted.loads().begin(), counted.loads().end()),
              run.outline().parts.size() > 1 ? 1 : 0);
}

}  // namespace
}  // namespace kerf::ghosts_test

#include "files/part/part_store.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/parallel/process_memory.h"
#include "files/io/file_bytes.h"
#include "support/io_error.h"
#include "support/random_part.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

constexpr std::int64_t first_interior = 7'000'000'000;

class PartStore : public testing::Test {
 protected:
    test::TemporaryFolder folder_;
    std::string file_ = folder_.file("part_0008.part");
    FileHash hash_;
};

TEST_F(PartStore, PartsComeBackAsTheyWere) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const Part part = test::random_part(seed);
        const FileHash written = write_stored_part(file_, part);
        const Part back = read_stored_part(file_, first_interior, PartContent::all, &hash_);
        EXPECT_EQ(hash_, written);
        EXPECT_EQ(written, digest_of(read_file(file_)));
        EXPECT_EQ(back.id, part.id);
        EXPECT_EQ(back.mesh.vertices, part.mesh.vertices);
        EXPECT_EQ(back.mesh.boundary_vertex_count, part.mesh.boundary_vertex_count);
        EXPECT_EQ(back.mesh.tets, part.mesh.tets);
        EXPECT_EQ(back.facets, part.facets);
        EXPECT_EQ(back.patch, part.patch);
        EXPECT_EQ(back.facet, part.facet);
        EXPECT_EQ(back.neighbour, part.neighbour);
        EXPECT_EQ(back.tet_at_facet, part.tet_at_facet);
        EXPECT_EQ(back.global_id, part.global_id);
        EXPECT_EQ(back.patch_names, part.patch_names);
        EXPECT_TRUE(back.patch_names.is_consistent());
        ASSERT_EQ(back.shared.size(), part.shared.size());
        for (std::size_t g = 0; g < part.shared.size(); ++g) {
            EXPECT_EQ(back.shared[g].parts, part.shared[g].parts);
            EXPECT_EQ(back.shared[g].vertices, part.shared[g].vertices);
        }
        ASSERT_EQ(back.shared_edges.size(), part.shared_edges.size());
        for (std::size_t g = 0; g < part.shared_edges.size(); ++g) {
            EXPECT_EQ(back.shared_edges[g].parts, part.shared_edges[g].parts);
            EXPECT_EQ(back.shared_edges[g].edges, part.shared_edges[g].edges);
        }
    }
}

TEST_F(PartStore, InteriorNumbersAreThoseOfTheReader) {
    const Part part = test::random_part(4);
    write_stored_part(file_, part);
    Part renumbered = part;
    for (std::size_t v = static_cast<std::size_t>(part.mesh.boundary_vertex_count); v < part.global_id.size(); ++v)
        renumbered.global_id[v] += 100;
    EXPECT_EQ(write_stored_part(folder_.file("other"), renumbered), write_stored_part(file_, part));
    EXPECT_EQ(read_stored_part(file_, first_interior + 100).global_id, renumbered.global_id);
}

TEST_F(PartStore, SomeContentIsThatOfTheWhole) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const Part part = test::random_part(seed);
        write_stored_part(file_, part);
        const auto read = [&](PartContent content) { return read_stored_part(file_, first_interior, content); };
        EXPECT_EQ(read(PartContent::surface).mesh.vertices, boundary_of(part).mesh.vertices);
        EXPECT_EQ(read(PartContent::surface).global_id, boundary_of(part).global_id);
        EXPECT_EQ(read(PartContent::surface).facets, part.facets);
        EXPECT_TRUE(read(PartContent::surface).mesh.tets.empty());
        EXPECT_EQ(read(PartContent::cells).mesh.tets, part.mesh.tets);
        EXPECT_EQ(read(PartContent::cells).global_id, part.global_id);
        EXPECT_TRUE(read(PartContent::cells).mesh.vertices.empty());
        EXPECT_EQ(read(PartContent::vertices).mesh.vertices, part.mesh.vertices);
        EXPECT_EQ(read(PartContent::vertices).global_id, part.global_id);
    }
}

// What the pieces of a part are together.
Part joined_pieces(const StoredParts& parts) {
    Part joined;
    parts.load_in_pieces(PartIndex(0), {[&](const Part& part) { joined = part; },
                                        [&](const Part& part, std::size_t first, std::span<const Vec3> points) {
                                            EXPECT_EQ(part.global_id, joined.global_id);
                                            EXPECT_EQ(first, joined.mesh.vertices.size());
                                            joined.mesh.vertices.insert(joined.mesh.vertices.end(), points.begin(),
                                                                        points.end());
                                        },
                                        [&](const Part&, std::size_t first, std::span<const Tetrahedron> tets) {
                                            EXPECT_EQ(first, joined.mesh.tets.size());
                                            joined.mesh.tets.insert(joined.mesh.tets.end(), tets.begin(), tets.end());
                                        }});
    return joined;
}

TEST_F(PartStore, PiecesAreTheWhole) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        Part part = test::random_part(seed);
        if (seed == 1)  // more than one piece
            while (part.mesh.tets.size() < 300'000)
                part.mesh.tets.insert(part.mesh.tets.end(), part.mesh.tets.begin(), part.mesh.tets.end());
        const FileHash written = write_stored_part(file_, part, false);
        const StoredParts parts({{{part.id}}, part.vertex_count(), {}}, {{file_, first_interior, written}});
        const Part joined = joined_pieces(parts);
        EXPECT_EQ(joined.mesh.vertices, part.mesh.vertices);
        EXPECT_EQ(joined.mesh.tets, part.mesh.tets);
        EXPECT_EQ(joined.facets, part.facets);
        EXPECT_EQ(joined.global_id, part.global_id);
    }
}

TEST_F(PartStore, WhatIsNotAsItWasIsRefused) {
    const Part part = test::random_part(5);
    const FileHash written = write_stored_part(file_, part);
    const std::string bytes = read_file(file_);
    const StoredParts parts({{{part.id}}, part.vertex_count(), {}}, {{file_, first_interior, written}});
    EXPECT_EQ(parts.load(PartIndex(0)).global_id, part.global_id);
    const std::size_t step = 1 + bytes.size() / 150;  // behind its head; each place costs two files
    for (std::size_t at = 0; at < bytes.size(); at += at < 40 ? 1 : step) {
        SCOPED_TRACE(at);
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 16);
        std::ofstream(file_, std::ios::binary) << damaged;
        EXPECT_NE(test::io_error([&] { parts.load(PartIndex(0)); }).find(file_), std::string::npos);
        EXPECT_NE(test::io_error([&] { joined_pieces(parts); }).find(file_), std::string::npos);
        std::ofstream(file_, std::ios::binary) << bytes.substr(0, at);
        EXPECT_NE(test::io_error([&] { joined_pieces(parts); }).find(file_), std::string::npos);
        EXPECT_NE(test::io_error([&] { parts.load(PartIndex(0)); }).find(file_), std::string::npos);
    }
    std::ofstream(file_, std::ios::binary) << bytes << 'x';
    EXPECT_NE(test::io_error([&] { parts.load(PartIndex(0)); }), "");
    std::filesystem::remove(file_);
    EXPECT_NE(test::io_error([&] { parts.load(PartIndex(0)); }), "");
}

// One bit of a head may ask for 50 GB, which would be filled with zeros.
TEST_F(PartStore, ADamagedHeadCostsNoMemory) {
    write_stored_part(file_, test::random_part(5));
    const std::string bytes = read_file(file_);
    const std::int64_t before = own_peak_rss_bytes();
    for (std::size_t at = 8; at < 32; ++at)
        for (const int bit : {1, 16, 128}) {
            SCOPED_TRACE(testing::Message() << "byte " << at << ", bit " << bit);
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ bit);
            std::ofstream(file_, std::ios::binary) << damaged;
            EXPECT_NE(test::io_error([&] { read_stored_part(file_, first_interior); }), "");
        }
    EXPECT_LT(own_peak_rss_bytes() - before, 50'000'000);
}

TEST_F(PartStore, AFullDiskIsAnErrorThatNamesTheFile) {
    const std::string message = test::io_error([&] { write_stored_part("/dev/full", test::random_part(1)); });
    EXPECT_NE(message.find("/dev/full"), message.npos) << message;
}

}  // namespace
}  // namespace kerf

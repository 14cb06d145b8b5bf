// What is written is read back: bit for bit, with patches and regions where the format holds them.
#include "files/io/surface_writers.h"

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/io/output_kind.h"
#include "files/io/surface_reader.h"
#include "support/file_contents.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

struct Written {
    const char* name;
    void (*write)(const std::string&, const Soup&);
    bool has_patches;
};
const std::vector<Written> formats = {
    {"a.ply", write_ply, false}, {"a.off", write_off, false}, {"a.vtp", write_vtp, true}, {"a.vtk", write_vtk, true}};

TEST(SurfaceWriters, GiveBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    for (Soup soup : {test::box(Vec3(-1, 2, 1.0 / 3), Vec3(5, 7, 11), 3), test::icosphere(2, 1e-5, Vec3(100, 0, 0))}) {
        soup.patch_names.front() = "a name, \xC3\xBC & \"more\" <x>";
        for (const auto& [name, write, has_patches] : formats) {
            SCOPED_TRACE(name);
            write(folder.file(name), soup);
            const Soup read = read_surface(folder.file(name));
            EXPECT_EQ(read.vertices, soup.vertices);
            EXPECT_EQ(read.facets, soup.facets);
            EXPECT_TRUE(read.notes.empty());
            if (!has_patches) continue;
            EXPECT_EQ(read.patch, soup.patch);
            EXPECT_EQ(read.patch_names, soup.patch_names);
        }
    }
}

TEST(SurfaceWriters, KeepTheRegionsOnTheSidesOfFacets) {
    const test::TemporaryFolder folder;
    Soup soup = test::box();
    soup.sides.assign(soup.facets.size(), {RegionIndex::none(), RegionIndex(0)});
    soup.sides[3] = {RegionIndex(1), RegionIndex(0)};
    soup.region_names = {"steel", "core (hot)"};
    for (const auto& [name, write, has_patches] : formats) {
        if (!has_patches) continue;
        write(folder.file(name), soup);
        const Soup read = read_surface(folder.file(name));
        EXPECT_EQ(read.sides, soup.sides) << name;
        EXPECT_EQ(read.region_names, soup.region_names) << name;
    }
}

TEST(SurfaceWriters, AreKnownAsSurfacesOfKerf) {
    const test::TemporaryFolder folder;
    for (const auto& [name, write, has_patches] : formats) {
        write(folder.file(name), test::box());
        EXPECT_TRUE(output_kind::surface.is(test::bytes_of_file(folder.file(name)).substr(0, 1024))) << name;
        EXPECT_THROW(write(folder.file("no/such/") + name, test::box()), Error);
    }
}

}  // namespace
}  // namespace kerf

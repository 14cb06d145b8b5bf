// The size that is found for a number of tetrahedra gives that number, on surfaces that are kept and remeshed ones.
#include "run/prepare/cells.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "fill/volume/mesher.h"
#include "run/prepare/size_reader.h"
#include "run/request/run_choices.h"
#include "support/assets.h"
#include "support/shapes.h"

namespace kerf {
namespace {

Input input_from(const Soup& soup) { return make_input(soup.vertices, soup.facets, soup.patch, soup.patch_names); }

RunRequest with_cells(std::int64_t cells, Remeshing remeshing = Remeshing::never) {
    RunRequest options;
    options.sizes.cells = cells;
    options.remeshing = remeshing;
    return options;
}

double tets_of(const SizedInput& sized) {
    const SurfaceArrays surface = sized.input.complex.arrays();
    MesherOptions mesher({}, read_size_field(sized.sizes, surface, sized.input.patch_names));
    mesher.improve = false;  // which changes less than 3 % of the number
    return static_cast<double>(mesh_volume(surface, mesher).mesh.tets.size());
}

// Within what is promised, and the size is one that can be written down and asked for.
void expect_cells(const Input& input, const RunRequest& options, double tolerance = 0.15) {
    SCOPED_TRACE(testing::Message() << options.sizes.cells << " cells of " << input.path << ", "
                                    << static_cast<int>(options.remeshing));
    const SizedInput sized = remesh_and_size(input, options);
    ASSERT_TRUE(sized.found);
    EXPECT_EQ(sized.found->cells, options.sizes.cells);
    EXPECT_EQ(sized.sizes.cells, 0) << "what is in effect is the size";
    EXPECT_EQ(sized.sizes.size, sized.found->size);
    EXPECT_EQ(std::stod(fmt::format("{:.4g}", sized.found->size)), sized.found->size);
    EXPECT_TRUE(sized.input.notes.size() == input.notes.size()) << sized.input.notes.back();
    const auto cells = static_cast<double>(options.sizes.cells);
    EXPECT_LE(std::abs(std::log(sized.found->tets / cells)), 0.05);
    EXPECT_NEAR(tets_of(sized) / cells, 1, tolerance);
}

TEST(Cells, AreAsManyAsAskedForWhereFacetsAreKept) {
    const Input bodies[] = {read_input(test::asset_path("cylinder")), read_input(test::asset_path("hollow_box")),
                            read_input(test::asset_path("wing_in_box")), input_from(test::icosphere(4)),
                            input_from(test::box(Vec3::Zero(), Vec3(3, 1, 0.3), {30, 10, 3}))};
    for (const Input& body : bodies)
        for (const double per_facet : {5, 15, 40})
            expect_cells(body, with_cells(std::llround(per_facet * static_cast<double>(body.facets))));
}

// From a few facets, and from many: the size decides alone.
TEST(Cells, AreAsManyAsAskedForWhereTheSurfaceIsRemeshed) {
    const Input bodies[] = {input_from(test::icosphere(3)), input_from(test::prism(48, 1, 3)),
                            input_from(test::box(Vec3::Zero(), Vec3(3, 1, 0.3), 1))};
    for (const Input& body : bodies)
        for (const std::int64_t cells : {5'000, 100'000}) expect_cells(body, with_cells(cells, Remeshing::always));
}

// Of sizes that differ less is known.
TEST(Cells, CountWhatIsFinerAtPlaces) {
    const Input ball = input_from(test::icosphere(4));
    for (const std::int64_t cells : {60'000, 150'000}) {
        RunRequest options = with_cells(cells);
        options.sizes.inside = {"sphere:0.5,0,0,0.3=0.04"};
        expect_cells(ball, options, 0.2);
        options.remeshing = Remeshing::always;
        expect_cells(ball, options, 0.2);
    }
}

// Even without any size there are more: one sentence says so, and the least that there will be.
TEST(Cells, FewerThanTheFacetsNeedAreNoted) {
    const Input ball = input_from(test::icosphere(4));
    const SizedInput sized = remesh_and_size(ball, with_cells(1'000));
    ASSERT_TRUE(sized.found);
    EXPECT_EQ(sized.found->size, 0);
    EXPECT_EQ(sized.sizes.constant_max_volume(), 0);
    EXPECT_NEAR(sized.found->tets / tets_of(sized), 1, 0.25);
    ASSERT_EQ(sized.input.notes.size(), ball.notes.size() + 1);
    for (const char* words : {"--cells asks for 1 k", "the facets need about", "--surface remesh", "--cells 1"})
        EXPECT_NE(sized.input.notes.back().find(words), std::string::npos) << sized.input.notes.back();
}

TEST(Cells, AreNoBusinessOfWhoAsksForNone) {
    const Input ball = input_from(test::icosphere(2));
    RunRequest options;
    options.sizes.size = 0.3;
    EXPECT_EQ(forecast_sizes(ball, options).size, 0.3);
    const SizedInput sized = remesh_and_size(ball, choices_of(options).request);
    EXPECT_FALSE(sized.found);
    EXPECT_EQ(sized.sizes.size, 0.3);
}

TEST(Cells, ExcludeOtherSizesEverywhere) {
    for (const char* option : {"size", "max-volume"}) {
        RunRequest options = with_cells(1000);
        set_options(options, {{option, "0.1"}}, "the test");
        try {
            choices_of(options).request;
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            for (const std::string& name : {std::string("--cells"), "--" + std::string(option)})
                EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace kerf

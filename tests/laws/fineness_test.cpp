// --fineness: each step has more cells than the one before it, on surfaces that are kept and on remeshed ones; medium
// is what nobody has asked for, and a size overrules it.
#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/run_in_process.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

class AnyFineness : public testing::Test {
 protected:
    struct Outcome {
        std::int64_t tets;
        std::string hash;
    };
    Outcome outcome_of(const std::string& input, const std::vector<OptionText>& texts) {
        RunRequest options;
        set_options(options, texts, "the test");
        const RunReport report = test::run_parts(input, folder_.file("out"), 2, options);
        EXPECT_EQ(report.exit_code, 0);
        EXPECT_TRUE(report.verification.passed);
        return {report.mesh.tets, report.mesh.hash};
    }
    std::string needles() const {
        const Soup soup = test::prism(48, 1, 3);
        test::write_off(folder_.file("needles.off"), soup.vertices, soup.facets);
        return folder_.file("needles.off");
    }
    test::TemporaryFolder folder_;
};

TEST_F(AnyFineness, HasMoreCellsWithEachStep) {
    for (const std::string& input : {test::asset_path("cube"), test::asset_path("hollow_box"), needles()}) {
        SCOPED_TRACE(input);
        const Outcome coarse = outcome_of(input, {{"fineness", "coarse"}}), usual = outcome_of(input, {}),
                      fine = outcome_of(input, {{"fineness", "fine"}});
        EXPECT_LT(coarse.tets, usual.tets);
        EXPECT_GT(static_cast<double>(fine.tets), 1.5 * static_cast<double>(usual.tets));
        EXPECT_EQ(outcome_of(input, {{"fineness", "medium"}}).hash, usual.hash);
    }
}

TEST_F(AnyFineness, IsOverruledByASize) {
    for (const std::string& input : {test::asset_path("cube"), needles()})
        for (const OptionText& size :
             {OptionText{"size", "10%"}, OptionText{"max-volume", "0.01"}, OptionText{"cells", "20k"}}) {
            SCOPED_TRACE(input + ", " + size.name);
            const std::string hash = outcome_of(input, {size}).hash;
            for (const char* fineness : {"coarse", "fine"})
                EXPECT_EQ(outcome_of(input, {size, {"fineness", fineness}}).hash, hash) << fineness;
        }
}

}  // namespace
}  // namespace kerf

#include "surface/repair/repair_advice.h"

#include <string>

#include <gtest/gtest.h>

#include "support/damage.h"
#include "support/shapes.h"
#include "surface/repair/repair_step.h"

namespace kerf {
namespace {

// "stitch,holes"
std::string names_of(std::span<const RepairKind> steps) {
    std::string names;
    for (const RepairKind step : steps) names += (names.empty() ? "" : ",") + std::string(name(step));
    return names;
}

bool needs_nothing(const std::string& advice) { return advice.starts_with("nothing needs to be done"); }

TEST(RepairAdvice, NamesTheStepsThatMendAKind) {
    for (std::size_t k = 0; k < defect_kind_count; ++k) {
        const auto kind = static_cast<DefectKind>(k);
        const std::string text = advice({kind, Severity::error, {}, {}}), steps = names_of(repairs_for(kind));
        const std::size_t named = text.find("--repair ");
        if (needs_nothing(text)) continue;
        if (steps.empty())
            EXPECT_EQ(named, text.npos) << text;
        else
            EXPECT_EQ(text.substr(named, steps.size() + 9), "--repair " + steps) << text;
    }
}

TEST(RepairAdvice, StepsAreInTheOrderOfTheLadder) {
    for (std::size_t k = 0; k < defect_kind_count; ++k) {
        const auto steps = repairs_for(static_cast<DefectKind>(k));
        EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
    }
}

Defect error_of(DefectKind kind) { return {kind, Severity::error, {}, {}}; }

TEST(RepairAdvice, TheLevelIsTheLeastThatHasAStepForEachError) {
    Diagnosis diagnosis;
    EXPECT_EQ(level_for(diagnosis), RepairLevel::none) << "nothing is wrong";
    diagnosis.defects = {{DefectKind::needle, Severity::warning, {}, {}}};
    EXPECT_EQ(level_for(diagnosis), RepairLevel::none) << "warnings need no repair";
    diagnosis.defects.push_back(error_of(DefectKind::duplicate_facet));
    EXPECT_EQ(level_for(diagnosis), RepairLevel::exact);
    diagnosis.defects.push_back(error_of(DefectKind::open_edge));
    EXPECT_EQ(level_for(diagnosis), RepairLevel::near);
    diagnosis.defects.push_back(error_of(DefectKind::self_intersection));
    EXPECT_EQ(level_for(diagnosis), RepairLevel::full);
    for (const DefectKind hopeless : {DefectKind::one_sided, DefectKind::flat, DefectKind::body_gap}) {
        Diagnosis with = diagnosis;
        with.defects.push_back(error_of(hopeless));
        EXPECT_EQ(level_for(with), RepairLevel::none) << name(hopeless) << ": no level has its step";
    }
}

TEST(RepairAdvice, AHoleIsFilledByALevelThatAddsArea) {
    Soup open = test::box();
    test::remove_facet(open, 3);
    EXPECT_EQ(level_for(diagnose(open)), RepairLevel::near);
}

}  // namespace
}  // namespace kerf

#include "surface/repair/repair_plan.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "surface/repair/repair_step.h"

namespace kerf {
namespace {

RepairPlan plan(const std::string& text) { return parse_repair_plan("repair", text); }

std::string steps_of(const RepairPlan& plan) {
    std::string names;
    for (const RepairStep& step : plan.steps) names += (names.empty() ? "" : ",") + std::string(name(step.kind));
    return names;
}

TEST(RepairPlan, ALevelHasTheStepsOfThoseBelow) {
    EXPECT_TRUE(plan("").empty());
    EXPECT_TRUE(plan("none").empty());
    for (const RepairLevel level : {RepairLevel::exact, RepairLevel::near, RepairLevel::full}) {
        const RepairPlan own = plan_of(level), below = plan_of(static_cast<RepairLevel>(static_cast<int>(level) - 1));
        EXPECT_EQ(steps_of(plan(name(level))), steps_of(own));
        EXPECT_GT(own.steps.size(), below.steps.size());
        for (const RepairStep& step : below.steps) EXPECT_NE(own.find(step.kind), nullptr);
    }
}

TEST(RepairPlan, StepsAreInTheOrderOfTheLadderHoweverTheyAreGiven) {
    EXPECT_EQ(steps_of(plan("holes=12,weld,stitch=1e-3")), "weld,stitch,holes");
    EXPECT_EQ(plan("holes=12,weld").find(RepairKind::holes)->amount->of(7), 12);
    EXPECT_EQ(plan("stitch=2%").find(RepairKind::stitch)->amount->of(50), 1);
    EXPECT_FALSE(plan("stitch").find(RepairKind::stitch)->amount);
}

TEST(RepairPlan, AStepChangesWhatTheLevelHas) {
    const std::string all = steps_of(plan("near"));
    EXPECT_EQ(steps_of(plan("near,holes=12")), all);
    EXPECT_EQ(plan("near,holes=12").find(RepairKind::holes)->amount->of(1), 12);
    EXPECT_EQ(plan("near,no-holes").find(RepairKind::holes), nullptr);
    EXPECT_NE(plan("near,caps").find(RepairKind::caps), nullptr);
    EXPECT_EQ(plan("near,bound=2").bound.of(9), 2);
    EXPECT_EQ(plan("full,bodies=regions").bodies, BodyRepair::regions);
    EXPECT_EQ(plan("full,bodies=unite").bodies, BodyRepair::unite);
}

TEST(RepairPlan, WhatIsNoRepairIsRefusedWithTheWords) {
    for (const char* wrong :
         {"holse", "holes=", "holes=2", "holes=1.5", "weld=-1", "weld=0", "weld=nan", "orient=3", "bound", "bound=0",
          "bodies=some", "no-thing", "no-holes=3", "near full", "weld,,stitch", "FULL", "none=1", "=", "full=,"}) {
        try {
            plan(wrong);
            ADD_FAILURE() << wrong;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage) << wrong;
            EXPECT_NE(std::string(error.what()).find("--repair"), std::string::npos) << error.what();
        }
    }
}

TEST(RepairPlan, EveryStepWithAWordIsNamedInTheWordsAndInOneLevelOrNone) {
    for (const RepairStepRow& row : repair_step_rows())
        EXPECT_EQ(&row, &repair_step_rows()[static_cast<std::size_t>(row.kind)]);
    for (const RepairStepRow& row : rows_with_words()) {
        EXPECT_FALSE(is_preparation(row.kind)) << row.name;
        EXPECT_NE(repair_words().find(row.name), std::string::npos) << row.name;
        EXPECT_EQ(steps_of(plan(row.name)), row.name);
    }
}

TEST(RepairPlan, PreparationsComeFirstAndHaveNoWords) {
    RepairPlan near = plan("near");
    const std::string others = steps_of(near);
    near.put({RepairKind::span, Length(4)});
    near.put({RepairKind::merge, Length(0.1)});
    EXPECT_EQ(steps_of(near), "merge,span," + others);
    EXPECT_FALSE(near.only_prepares());
    RepairPlan only;
    EXPECT_TRUE(only.only_prepares());
    only.put({RepairKind::largest});
    EXPECT_TRUE(only.only_prepares());
    EXPECT_FALSE(only.empty());
    for (const RepairStepRow& row : repair_step_rows()) {
        if (is_preparation(row.kind)) {
            EXPECT_THROW(plan(row.name), Error) << row.name;
        }
    }
}

}  // namespace
}  // namespace kerf

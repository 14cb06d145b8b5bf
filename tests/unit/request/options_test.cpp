#include "run/request/run_choices.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/path_text.h"
#include "run/request/config_file.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

template <class Change>
void expect_refused(const std::string& name, Change change) {
    SCOPED_TRACE(name);
    RunRequest options;
    change(options);
    try {
        choices_of(options);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("--" + name), std::string::npos) << error.what();
    }
}

TEST(RunRequest, WorkersDefaultToTheCores) {
    RunRequest options;
    EXPECT_EQ(choices_of(options, 4).request.workers.count, 4);
    EXPECT_EQ(choices_of(options, 0).request.workers.count, 1);
    options.workers.count = 2;
    EXPECT_EQ(choices_of(options, 4).request.workers.count, 2);
}

TEST(RunChoices, HaveTheMeaningOfTexts) {
    RunRequest request;
    request.outputs.formats = "msh,openfoam";
    request.outputs.fields = "all";
    request.outputs.patch_types = {"in=wall"};
    request.input_options.regions = {"a=1,2,3"};
    request.input_options.repairs.fill_hole_edges = 7;
    request.workers.memory_mb = 500;
    request.parts = 3;
    const RunChoices choices = choices_of(request);
    EXPECT_EQ(choices.formats, parse_formats("msh,openfoam"));
    EXPECT_TRUE(choices.has_format("openfoam") && !choices.has_format("vtu"));
    EXPECT_TRUE(choices.fields.all());
    EXPECT_EQ(choices.patch_types.at(0).type, "wall");
    EXPECT_EQ(choices.input.seeds.at(0).point, Vec3(1, 2, 3));
    ASSERT_NE(choices.input.repairs.find(RepairKind::span), nullptr);
    const DecomposeOptions cuts = choices.decompose_options(SizeField(0.25));
    EXPECT_EQ(cuts.parts, 3);
    EXPECT_EQ(cuts.cut.size.reference_volume(), 0.25);
    EXPECT_EQ(cuts.cut.load().size.reference_volume(), 0.25);
    EXPECT_LT(cuts.cut.max_interface_points, CutOptions().max_interface_points);
    EXPECT_TRUE(choices_of({}).has_format("vtu"));
}

TEST(RunRequest, ValuesOutOfRangeAreNamed) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_refused("workers", [](RunRequest& o) { o.workers.count = -1; });
    expect_refused("parts", [](RunRequest& o) { o.parts = -1; });
    expect_refused("repair", [](RunRequest& o) { o.input_options.repairs.plan = "nonsense"; });
    for (const double bad : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
        expect_refused("size", [&](RunRequest& o) { o.sizes.size = bad; });
        expect_refused("max-volume", [&](RunRequest& o) { o.sizes.max_volume = bad; });
        expect_refused("radius-edge", [&](RunRequest& o) { o.mesher.radius_edge = bad; });
    }
    expect_refused("radius-edge", [](RunRequest& o) { o.mesher.radius_edge = 1; });
    expect_refused("timeout", [&](RunRequest& o) { o.workers.timeout_seconds = nan; });
    expect_refused("memory", [](RunRequest& o) { o.workers.memory_mb = -1; });
    expect_refused("attempts", [](RunRequest& o) { o.workers.attempts = 0; });
    for (const double bad : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
        expect_refused("scale", [&](RunRequest& o) { o.input_options.scale = bad; });
        expect_refused("weld", [&](RunRequest& o) { o.input_options.repairs.weld_tolerance = bad; });
        expect_refused("feature-angle", [&](RunRequest& o) { o.input_options.feature_angle_deg = bad; });
    }
    expect_refused("feature-angle", [](RunRequest& o) { o.input_options.feature_angle_deg = 180; });
    expect_refused("fill-holes", [](RunRequest& o) { o.input_options.repairs.fill_hole_edges = -1; });
    expect_refused("optimise-surface", [](RunRequest& o) { o.input_options.optimisation_sweeps = -1; });
}

TEST(OptionFields, HaveDistinctNamesAndAHelp) {
    RunRequest options;
    std::set<std::string> names;
    for (const OptionField& field : option_fields(options)) {
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
        EXPECT_EQ(field.help.back(), '.') << field.name;
    }
}

TEST(OptionFields, ChoicesReachTheirValues) {
    RunRequest options;
    int choices = 0;
    for (const OptionField& field : option_fields(options)) {
        const auto* choice = std::get_if<OptionField::Choice>(&field.value);
        if (!choice) continue;
        ++choices;
        SCOPED_TRACE(field.name);
        for (int i = 0; i < static_cast<int>(choice->names.size()); ++i) {
            choice->set(i);
            EXPECT_EQ(choice->get(), i);
        }
    }
    EXPECT_GE(choices, 4);
    EXPECT_EQ(options.cut.axis, 2);
    EXPECT_EQ(options.cut.criterion, Criterion::equidistant);
    EXPECT_EQ(options.cut.balance, Balance::work);
    EXPECT_EQ(options.cut.contour, ContourMethod::straight);
    EXPECT_EQ(options.input_options.voids, Voids::parity);
}

TEST(WithoutRepairs, LeavesNoStepWhicheverOptionAsksForIt) {
    int spellings = 0;
    InputOptions all;
    for (const OptionField& field : input_option_fields(all)) {
        InputOptions options;
        for (const OptionField& own : input_option_fields(options)) {
            if (own.name != field.name) continue;
            if (auto* const* flag = std::get_if<bool*>(&own.value)) **flag = true;
            if (own.is_number()) own.set_text(std::holds_alternative<std::int32_t*>(own.value) ? "3" : "0.1");
            if (own.name == "repair") own.set_text("exact");
        }
        const RepairPlan plan = repair_plan_of(options);
        spellings += !plan.empty();
        EXPECT_TRUE(repair_plan_of(without_repairs(options)).empty()) << field.name;
        EXPECT_FALSE(without_repairs(options).wraps()) << field.name;
    }
    EXPECT_EQ(spellings, 6) << "weld, keep-largest, fill-holes, repair, cap and thicken";
}

TEST(RepairPlanOf, PutsTheStepOfEachSpellingInItsPlace) {
    InputOptions options;
    options.repairs.plan = "exact";
    options.repairs.weld_tolerance = Length::percent(2);
    options.repairs.fill_hole_edges = 7;
    options.repairs.keep_largest = options.repairs.cap = true;
    options.repairs.thicken = 0.5;
    const RepairPlan plan = repair_plan_of(options);
    EXPECT_EQ(plan.find(RepairKind::merge)->amount->of(50), 1);
    EXPECT_EQ(plan.find(RepairKind::span)->amount->of(50), 7);
    EXPECT_EQ(plan.find(RepairKind::thicken)->amount->of(50), 0.5);
    EXPECT_FALSE(plan.find(RepairKind::caps)->amount);
    EXPECT_NE(plan.find(RepairKind::clean), nullptr);
    EXPECT_TRUE(std::is_sorted(plan.steps.begin(), plan.steps.end(),
                               [](const RepairStep& a, const RepairStep& b) { return a.kind < b.kind; }));
}

TEST(OptionFields, TextGivesTheValueBack) {
    RunRequest options;
    options.parts = 7;
    options.sizes.size = 0.1;
    options.sizes.on = {"inlet=1", "out;let=2"};
    options.mesher.tetgen.switches = "q1.2 a";
    options.outputs.stl = true;
    options.cut.axis = 1;
    RunRequest copy;
    const std::vector<OptionField> fields = option_fields(options), copied = option_fields(copy);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        SCOPED_TRACE(fields[i].name);
        copied[i].set_text(fields[i].text());
        EXPECT_EQ(copied[i].text(), fields[i].text());
    }
    EXPECT_EQ(copy.parts, 7);
    EXPECT_EQ(copy.sizes.size, 0.1);
    EXPECT_EQ(copy.sizes.on, options.sizes.on);
    EXPECT_EQ(copy.mesher.tetgen.switches, "q1.2 a");
    EXPECT_TRUE(copy.outputs.stl);
    EXPECT_EQ(copy.cut.axis, 1);
}

TEST(OptionFields, TextThatIsNoValueIsRefused) {
    RunRequest options;
    const auto is_refused = [](const OptionField& field, const std::string& text) {
        try {
            field.set_text(text);
            return false;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("--" + field.name), std::string::npos) << error.what();
            return true;
        }
    };
    for (const OptionField& field : option_fields(options)) {
        SCOPED_TRACE(field.name);
        const bool is_text =
            std::holds_alternative<std::string*>(field.value) || std::holds_alternative<OptionField::List>(field.value);
        for (const char* text : {"luck", "", "1x"}) EXPECT_EQ(is_refused(field, text), !is_text) << text;
        if (!field.is_number()) continue;
        for (const char* text : {"nan", "inf", "-inf", "1,5", "-1", "1e400", " 1", "2 %", "nan%"})
            EXPECT_TRUE(is_refused(field, text)) << text;
        const bool is_length = std::holds_alternative<Length*>(field.value);
        EXPECT_EQ(is_refused(field, "3%"), !is_length);
        EXPECT_STRNE(field.range.words, NumberRange().words) << "what it may be is said";
    }
}

TEST(OptionFields, CountsMayHaveAUnit) {
    RunRequest options;
    const auto set = [&](const std::string& text) {
        set_options(options, {{"cells", text}}, "the test");
        return options.sizes.cells;
    };
    EXPECT_EQ(set("50000"), 50'000);
    EXPECT_EQ(set("50k"), 50'000);
    EXPECT_EQ(set("50K"), 50'000);
    EXPECT_EQ(set("1.5M"), 1'500'000);
    EXPECT_EQ(set("2G"), 2'000'000'000);
    EXPECT_EQ(set("0"), 0);
    for (const char* text : {"k", "1.5", "5kB", "50 k", "-1k", "nank", "1e10M", "1e13"}) EXPECT_THROW(set(text), Error);
}

TEST(RunRequest, PercentagesAreOfTheDiagonal) {
    RunRequest options;
    options.sizes.size = Length::percent(2);
    options.sizes.chord_error = Length::percent(0.5);
    options.deviation = Length::percent(0.002);
    options.sizes.inside = {"sphere:1,2,3,4=1%", "box:0,0,0,1,1,1=7"};
    options.sizes.on = {"in=let 5%=3%"};
    options.sizes.near = {"a=2%:10%", "b=1:10%", "c=1e-3:2"};
    options = choices_of(options).request;
    EXPECT_TRUE(options.sizes.size.is_percent()) << "nobody knows yet";
    EXPECT_EQ(options.deviation.of(50), 0.001);
    options.sizes.resolve_lengths(50);
    EXPECT_EQ(options.sizes.size, 1.0);
    EXPECT_EQ(options.sizes.chord_error, 0.25);
    EXPECT_EQ(options.sizes.inside, (std::vector<std::string>{"sphere:1,2,3,4=0.5", "box:0,0,0,1,1,1=7"}));
    EXPECT_EQ(options.sizes.on, (std::vector<std::string>{"in=let 5%=1.5"}));
    EXPECT_EQ(options.sizes.near, (std::vector<std::string>{"a=1:5", "b=1:5", "c=1e-3:2"}));
    RunRequest absolute;
    absolute.sizes.size = 1;
    EXPECT_EQ(options.sizes.max_volume, absolute.sizes.constant_max_volume());
}

TEST(RunRequest, TraceMustLieOutsideOfTheOutputFolder) {
    const auto is_refused = [](const std::string& trace, const std::string& output) {
        RunRequest options;
        options.outputs.trace_file = trace;
        options.output = output;
        try {
            choices_of(options);
            return false;
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
    };
    for (const char* output : {"out", "out/", "./out", "a/../out"}) {
        SCOPED_TRACE(output);
        EXPECT_TRUE(is_refused("out/run.trace", output));
        EXPECT_TRUE(is_refused("out/parts/run.trace", output));
        EXPECT_TRUE(is_refused("out", output));
        EXPECT_FALSE(is_refused("out.trace", output));
        EXPECT_FALSE(is_refused("run.trace", output));
        EXPECT_FALSE(is_refused("other/out/run.trace", output));
    }
}

// Some value of the field's type, other for every seed; texts hold what a path may hold.
std::string some_text(const OptionField& field, std::mt19937& random) {
    const auto number = [&](std::uint32_t most) { return static_cast<std::int32_t>(random() % most); };
    if (const auto* choice = std::get_if<OptionField::Choice>(&field.value))
        return choice->names[static_cast<std::size_t>(number(static_cast<std::uint32_t>(choice->names.size())))];
    if (std::holds_alternative<bool*>(field.value)) return number(2) ? "true" : "false";
    const bool is_length = std::holds_alternative<Length*>(field.value);
    if (is_length || std::holds_alternative<double*>(field.value)) {
        const double any = std::ldexp(static_cast<double>(random()), number(1800) - 900);
        const double within = std::isfinite(field.range.most) ? field.range.most * (1 + number(8)) / 9 : any + 2;
        return fmt::format("{}{}", field.range.contains(any) ? any : within, is_length && number(2) ? "%" : "");
    }
    if (field.is_number())
        return fmt::format("{}", 1 + number(1'000'000) % static_cast<std::int32_t>(std::min(4096.0, field.range.most)));
    std::string text;
    for (int i = number(12); i > 0; --i) text += static_cast<char>(1 + number(255));
    return text;
}

TEST(ConfigFile, GivesEveryOptionBack) {
    const test::TemporaryFolder folder;
    std::mt19937 random(1);
    for (int seed = 0; seed < 200; ++seed) {
        RunRequest options, copy;
        const std::vector<OptionField> fields = option_fields(options), copied = option_fields(copy);
        for (const OptionField& field : fields) field.set_text(some_text(field, random));
        const std::string text = to_config(fields);
        std::ofstream(folder.file("config"), std::ios::binary) << text;
        for (const ConfigEntry& entry : read_config(folder.file("config"))) set_option(copied, entry);
        for (std::size_t i = 0; i < fields.size(); ++i)
            EXPECT_EQ(copied[i].text(), fields[i].text()) << fields[i].name << " in\n" << text;
        EXPECT_EQ(to_config(copied), text);
    }
}

TEST(OptionLists, GiveTheirItemsBack) {
    std::mt19937 random(1);
    constexpr std::string_view letters = "ab;\\=,: ";
    for (int seed = 0; seed < 1000; ++seed) {
        std::vector<std::string> items(random() % 4);
        for (std::string& item : items)
            for (std::uint32_t i = 1 + random() % 5; i > 0; --i) item += letters[random() % letters.size()];
        EXPECT_EQ(split_items(join_items(items)), items) << join_items(items);
    }
    EXPECT_TRUE(split_items("").empty());
    EXPECT_EQ(split_items("a;;b"), (std::vector<std::string>{"a", "b"}));
}

TEST(ConfigFile, TakesListsAsArraysAndAsText) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.file("config"))
        << "size-in = ['sphere:0,0,0,1=0.5', 'box:0,0,0,1,1,1=1']\nsize-on = 'a=1;b=2'\n";
    RunRequest options;
    const std::vector<OptionField> fields = option_fields(options);
    for (const ConfigEntry& entry : read_config(folder.file("config"))) set_option(fields, entry);
    EXPECT_EQ(options.sizes.inside, (std::vector<std::string>{"sphere:0,0,0,1=0.5", "box:0,0,0,1,1,1=1"}));
    EXPECT_EQ(options.sizes.on, (std::vector<std::string>{"a=1", "b=2"}));
}

TEST(PathText, GivesAnyBytesBack) {
    std::mt19937 random(1);
    for (int seed = 0; seed < 1000; ++seed) {
        std::string path = seed % 2 ? "bytes:" : "";
        for (std::uint32_t i = random() % 9; i > 0; --i) path += static_cast<char>(1 + random() % 255);
        EXPECT_EQ(path_of_text(path_text(path)), path);
        EXPECT_NO_THROW((void)nlohmann::json(path_text(path)).dump());
    }
    EXPECT_EQ(path_text("/a/\xC3\xA4 %41"), "/a/\xC3\xA4 %41") << "readable where it can be";
}

}  // namespace
}  // namespace kerf

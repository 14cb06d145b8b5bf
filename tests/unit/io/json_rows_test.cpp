#include "files/io/json_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/io/run_manifest.h"

namespace kerf {
namespace {

using Json = nlohmann::ordered_json;

std::ptrdiff_t lines_of(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

// Of every kind of value, a few levels deep.
Json random_json(std::mt19937& engine, int depth) {
    const auto kind = engine() % (depth > 0 ? 7 : 5);
    if (kind == 0) return nullptr;
    if (kind == 1) return static_cast<std::int64_t>(engine()) - (1LL << 31);
    if (kind == 2) return std::uniform_real_distribution<double>(-1e3, 1e3)(engine);
    if (kind == 3) return "line\n\"end\" \xc3\xaf " + std::to_string(engine() % 10);
    if (kind == 4) return engine() % 2 == 0;
    Json json = kind == 5 ? Json::array() : Json::object();
    for (auto i = engine() % 4; i-- > 0;)
        kind == 5 ? json.push_back(random_json(engine, depth - 1))
                  : void(json["name " + std::to_string(i)] = random_json(engine, depth - 1));
    return json;
}

TEST(JsonRows, SayWhatTheObjectSays) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 engine(seed);
        Json object = {{"schema", 1}};
        for (int i = 0; i < 5; ++i) object["member " + std::to_string(i)] = random_json(engine, 3);
        const std::string text = text_with_rows(object);
        EXPECT_EQ(Json::parse(text), object) << text;
        const std::string with_seal = sealed(text);
        EXPECT_TRUE(is_sealed(with_seal));
        object["report_hash"] = Json::parse(with_seal).at("report_hash");
        EXPECT_EQ(Json::parse(with_seal), object) << with_seal;
    }
}

TEST(JsonRows, ListsOfObjectsHaveALineForEach) {
    Json object = {{"options", {{"size", 1.5}, {"workers", 2}}}, {"numbers", {1, 2}}, {"rows", Json::array()}};
    const std::ptrdiff_t without = lines_of(text_with_rows(object));
    for (int rows = 1; rows < 20; ++rows) {
        object["rows"].push_back({{"id", rows}, {"neighbours", {1, 2, 3}}, {"inner", {{"a", 1}}}});
        EXPECT_EQ(lines_of(text_with_rows(object)), without + rows + 1);
    }
    EXPECT_NE(text_with_rows(object).find("\n    {\"id\":7,\"neighbours\":[1,2,3],\"inner\":{\"a\":1}},\n"),
              std::string::npos);
    EXPECT_NE(text_with_rows(object).find("\n    \"workers\": 2\n"), std::string::npos);
    EXPECT_EQ(Json::parse(text_with_rows(Json::object())), Json::object());
}

TEST(JsonRows, NumbersKeepSixDigits) {
    std::mt19937 engine(7);
    std::size_t characters = 0;
    for (int i = 0; i < 2000; ++i) {
        const double number = std::ldexp(std::uniform_real_distribution<double>(-1, 1)(engine), i % 600 - 300);
        EXPECT_NEAR(to_six_digits(number), number, 5.1e-6 * std::abs(number));
        EXPECT_EQ(to_six_digits(to_six_digits(number)), to_six_digits(number));
        characters += Json(to_six_digits(number)).dump().size();
    }
    EXPECT_LE(characters, 2000U * 13) << "sign, point, e-12; few numbers have no short text in nlohmann's";
    for (const double number : {0.0, 1.0, -3.0, 123456.0, 0.25, 1e300}) EXPECT_EQ(to_six_digits(number), number);
    EXPECT_TRUE(std::isnan(to_six_digits(std::numeric_limits<double>::quiet_NaN())));
    EXPECT_EQ(to_six_digits(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace kerf

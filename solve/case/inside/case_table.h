// Tables of a case file: the keys that each may have, and messages that refuse everything else.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "base/core/error.h"
#include "base/core/types.h"
#include "solve/case/elastic_case.h"

namespace kerf {

/// Reads the tables of one kind. `title` names such a table in messages: "a support". All functions throw Error(usage)
/// with the file and the line of the value that they refuse.
class CaseTable {
 public:
    using Read = std::function<void(const toml::node&)>;
    struct Key {
        std::string name;
        Read read;
    };

    CaseTable(const std::string& path, std::string title) : path_(path), title_(std::move(title)) {}

    [[noreturn]] void refuse(const toml::node& place, const std::string& what) const {
        throw Error(ErrorCode::usage, fmt::format("{}, line {}: {}", path_, place.source().begin.line, what));
    }

    void read(const toml::table& table, const std::vector<Key>& keys) const {
        for (const auto& [name, node] : table) {
            const auto known =
                std::find_if(keys.begin(), keys.end(), [&, n = name.str()](const Key& key) { return key.name == n; });
            if (known == keys.end()) {
                std::string names;
                for (const Key& key : keys) names += fmt::format("{}{}", names.empty() ? "" : ", ", key.name);
                refuse(node, fmt::format("{} has no '{}'. There are {}.", title_, name.str(), names));
            }
            known->read(node);
        }
    }

    double number(const toml::node& node, const char* what) const {
        const auto value = node.value<double>();
        if (!value || !std::isfinite(*value)) refuse(node, fmt::format("{} of {} is no number.", what, title_));
        return *value;
    }
    std::string text(const toml::node& node, const char* what) const {
        const auto value = node.value_exact<std::string>();
        if (!value || value->empty()) refuse(node, fmt::format("{} of {} is no text in quotes.", what, title_));
        return *value;
    }
    bool yes(const toml::node& node, const char* what) const {
        if (node.value_exact<bool>() != true) refuse(node, fmt::format("{} can only be true.", what));
        return true;
    }
    double number_above_zero(const toml::node& node, const char* what) const {
        const double value = number(node, what);
        if (value <= 0) refuse(node, fmt::format("{} must be above 0.", what));
        return value;
    }
    double number_from_zero(const toml::node& node, const char* what) const {
        const double value = number(node, what);
        if (value < 0) refuse(node, fmt::format("{} must not be negative.", what));
        return value;
    }
    template <std::size_t N>
    std::array<double, N> numbers(const toml::node& node, const char* what) const {
        std::array<double, N> values{};
        const toml::array* list = node.as_array();
        if (!list || list->size() != N)
            refuse(node, fmt::format("{} of {} is no list of {} numbers.", what, title_, N));
        for (std::size_t i = 0; i < N; ++i) values[i] = number((*list)[i], what);
        return values;
    }
    Vec3 vector(const toml::node& node, const char* what) const {
        const auto values = numbers<3>(node, what);
        return {values[0], values[1], values[2]};
    }
    /// Returns a direction of any length above 0 as a unit vector.
    Vec3 unit_vector(const toml::node& node, const char* what) const {
        const Vec3 direction = vector(node, what);
        if (direction.squaredNorm() == 0) refuse(node, fmt::format("{} of {} has no length.", what, title_));
        return direction.normalized();
    }
    /// Reads an axis: {point = [x, y, z], direction = [x, y, z]}.
    CaseAxis axis(const toml::node& node) const {
        const toml::table* table = node.as_table();
        bool has_point = false, has_direction = false;
        CaseAxis axis;
        const CaseTable own(path_, "an axis");
        if (table)
            own.read(*table, {{"point",
                               [&](const toml::node& n) {
                                   axis.point = own.vector(n, "point");
                                   has_point = true;
                               }},
                              {"direction", [&](const toml::node& n) {
                                   axis.direction = own.unit_vector(n, "direction");
                                   has_direction = true;
                               }}});
        if (!has_point || !has_direction) refuse(node, "an axis is {point = [x, y, z], direction = [x, y, z]}.");
        return axis;
    }
    /// Returns the node as a table; `example` shows in the message how such a table begins.
    const toml::table& table(const toml::node& node, const std::string& example) const {
        const toml::table* table = node.as_table();
        if (!table) refuse(node, fmt::format("{} is what is expected here.", example));
        return *table;
    }
    /// Returns the name of a set of loads.
    std::string case_name(const toml::node& node) const {
        const std::string name = text(node, "case");
        if (name.find('/') != name.npos || name.starts_with('.'))
            refuse(node, "the name of a case becomes that of a folder: no '/' in it, and no '.' at its beginning.");
        return name;
    }
    std::vector<std::string> texts(const toml::node& node, const char* what) const {
        const toml::array* list = node.as_array();
        if (!list) return {text(node, what)};
        std::vector<std::string> values;
        for (const toml::node& item : *list) values.push_back(text(item, what));
        if (values.empty()) refuse(node, fmt::format("{} of {} is an empty list.", what, title_));
        return values;
    }

 private:
    const std::string& path_;
    std::string title_;
};

}  // namespace kerf

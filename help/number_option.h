// Options that are numbers, with the same sentences for all commands (base/core/user_number.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/core/user_number.h"

namespace kerf {

/// Returns "into" of "--into", "parts" of "-n,--parts".
inline std::string long_name(const std::string& names) { return names.substr(names.rfind("--") + 2); }

template <class Value>
struct NumberOf {
    using Type = Value;
};
template <class Number>
struct NumberOf<std::optional<Number>> {
    using Type = Number;
};

/// Adds an option whose value must be a number in the range; parsing throws Error(usage) for any other. `value`, a
/// number or an optional one, has to live as long as the command.
template <class Value>
CLI::Option* add_number(CLI::App& app, const std::string& names, Value& value, const NumberRange& range,
                        const std::string& help) {
    return app.add_option_function<std::string>(
        names,
        [&value, range, name = long_name(names)](const std::string& text) {
            value = parse_number<typename NumberOf<Value>::Type>(name, text, range);
        },
        help);
}

/// Adds an option of `count` numbers behind one another.
template <class Number>
CLI::Option* add_numbers(CLI::App& app, const std::string& names, std::vector<Number>& values, int count,
                         const NumberRange& range, const std::string& help) {
    return app
        .add_option_function<std::vector<std::string>>(
            names,
            [&values, range, name = long_name(names)](const std::vector<std::string>& texts) {
                values.clear();
                for (const std::string& text : texts) values.push_back(parse_number<Number>(name, text, range));
            },
            help)
        ->expected(count);
}

}  // namespace kerf

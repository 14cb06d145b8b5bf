// Rows of numbers, of which text formats consist.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "export/export_files.h"

namespace kerf {

/// The numbers on one line, a separator between two.
inline void write_row(ExportFile& file, std::initializer_list<std::int64_t> numbers, std::string_view separator = " ") {
    bool is_first = true;
    for (const std::int64_t number : numbers) {
        if (!is_first) file.write(separator);
        file.number(number);
        is_first = false;
    }
    file.write("\n");
}

}  // namespace kerf

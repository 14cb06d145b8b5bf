// Writes rows of numbers for text formats.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "files/export/inside/export_files.h"
#include "files/export/whole_mesh.h"

namespace kerf {

/// A row of numbers on one line, with a separator between two.
class TextRow {
 public:
    explicit TextRow(ExportFile& file, std::string_view separator = " ") : file_(file), separator_(separator) {}

    TextRow& add(std::int64_t number) {
        if (!is_first_) file_.write(separator_);
        file_.number(number);
        is_first_ = false;
        return *this;
    }
    /// Adds the nodes of a cell, counted from `first`.
    TextRow& add(const CellNodes& nodes, std::int64_t first) {
        for (const std::int64_t node : nodes) add(node + first);
        return *this;
    }
    void end() { file_.write("\n"); }

 private:
    ExportFile& file_;
    std::string_view separator_;
    bool is_first_ = true;
};

inline void write_row(ExportFile& file, std::initializer_list<std::int64_t> numbers) {
    TextRow row(file);
    for (const std::int64_t number : numbers) row.add(number);
    row.end();
}

}  // namespace kerf

// A table of materials, by name.
#pragma once

#include <span>

#include "solve/case/material.h"

namespace kerf {

/// The units of a case's numbers: not given, N with mm (stresses in MPa, masses in t), or N with m.
enum class CaseUnits { unknown, mm, m };

/// A row of the table, in SI: Pa, kg/m^3, 1/K. Numbers that a source does not have are 0.
struct TableMaterial {
    const char* name;
    double young, poisson, density, expansion, yield;
    const char* grade;   ///< the exact grade
    const char* source;  ///< origin of the numbers
};

/// Returns all rows, in the order of the documentation.
std::span<const TableMaterial> table_materials();
/// Returns the row of the name, or nullptr if there is none.
const TableMaterial* find_table_material(const std::string& name);
/// Returns the names with commas between them.
std::string table_material_names();

/// Returns the material in the units of a case, which must be known.
Material in_units(const TableMaterial& row, CaseUnits units);

}  // namespace kerf

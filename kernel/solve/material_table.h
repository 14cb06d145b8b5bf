// Materials by name.
#pragma once

#include <span>

#include "solve/material.h"

namespace kerf {

/// Units in which the numbers of a case are: nothing said, N with mm (stresses in MPa, masses in t), or N with m.
enum class CaseUnits { unknown, mm, m };

/// A row of the table, in SI: Pa, kg/m^3, 1/K. What a source does not have is 0.
struct TableMaterial {
    const char* name;
    double young, poisson, density, expansion, yield;
    const char* grade;   ///< what exactly it is
    const char* source;  ///< of the numbers
};

/// All rows, in the order of the documentation.
std::span<const TableMaterial> table_materials();
/// Nothing, if there is none of the name.
const TableMaterial* find_table_material(const std::string& name);
/// The names with commas between them.
std::string table_material_names();

/// In the units of a case, which must be known.
Material in_units(const TableMaterial& row, CaseUnits units);

}  // namespace kerf

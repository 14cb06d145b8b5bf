#include "solve/case/inside/material_table.h"

#include <array>

#include <fmt/format.h>

#include "base/core/check.h"

namespace kerf {

namespace {

constexpr std::array<TableMaterial, 11> rows_of_materials = {{
    {"steel", 210e9, 0.3, 7850, 12e-6, 235e6, "S235, up to 40 mm",
     "EN 1993-1-1:2005, 3.2.6 and table 3.1; density: EN 1991-1-1:2002, table A.4"},
    {"stainless steel", 200e9, 0.3, 7900, 16e-6, 210e6, "1.4301, hot rolled strip or plate",
     "EN 1993-1-4:2006, 2.1.3 and table 2.1; density and expansion: EN 10088-1"},
    {"aluminium", 70e9, 0.3, 2700, 23e-6, 250e6, "EN AW-6082 T6, extruded, up to 5 mm",
     "EN 1999-1-1:2007, 3.2.5 and table 3.2b"},
    {"titanium", 113.8e9, 0.342, 4430, 8.6e-6, 880e6, "Ti-6Al-4V, annealed",
     "ASM Materials Properties Handbook: Titanium Alloys (1994)"},
    {"copper", 117e9, 0.33, 8910, 17e-6, 69e6, "C11000, annealed", "Copper Development Association, C11000"},
    {"cast iron", 110e9, 0.26, 7200, 11.7e-6, 165e6, "EN-GJL-250; yield: 0.1 % proof stress", "EN 1561, annex A"},
    {"ductile iron", 169e9, 0.275, 7100, 12.5e-6, 250e6, "EN-GJS-400-15", "EN 1563"},
    {"concrete", 33e9, 0.2, 2400, 10e-6, 0, "C30/37, without reinforcement",
     "EN 1992-1-1:2004, 3.1.3 and table 3.1; density, from 24 kN/m^3: EN 1991-1-1:2002, table A.1"},
    {"glass", 70e9, 0.2, 2500, 9e-6, 0, "soda lime", "EN 572-1:2012"},
    {"cortical bone", 17e9, 0.3, 0, 0, 115e6, "along a femur, as if isotropic, Poisson's ratio assumed; yield: tension",
     "Reilly and Burstein, J. Biomech. 8 (1975)"},
    {"trabecular bone", 985e6, 0.3, 300, 0, 4.1e6,
     "apparent density 0.3 g/cm^3, pooled sites, Poisson's ratio assumed; yield: tension",
     "Morgan, Bayraktar and Keaveny, J. Biomech. 36 (2003); Morgan and Keaveny, J. Biomech. 34 (2001)"},
}};

}  // namespace

std::span<const TableMaterial> table_materials() { return rows_of_materials; }

const TableMaterial* find_table_material(const std::string& name) {
    for (const TableMaterial& row : rows_of_materials)
        if (name == row.name) return &row;
    return nullptr;
}

std::string table_material_names() {
    std::string names;
    for (const TableMaterial& row : rows_of_materials)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
    return names;
}

Material in_units(const TableMaterial& row, CaseUnits units) {
    KERF_CHECK(units != CaseUnits::unknown);
    const double stress = units == CaseUnits::mm ? 1e-6 : 1, density = units == CaseUnits::mm ? 1e-12 : 1;
    Material material{row.name, row.young * stress, row.poisson, row.density * density};
    material.expansion = row.expansion;
    material.yield = row.yield * stress;
    return material;
}

}  // namespace kerf

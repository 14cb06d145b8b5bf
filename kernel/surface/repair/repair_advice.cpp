#include "surface/repair/repair_advice.h"

#include <algorithm>
#include <array>

#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

constexpr std::array cleaned_steps = {RepairKind::clean};
constexpr std::array closed_steps = {RepairKind::stitch, RepairKind::holes};
constexpr std::array opened_steps = {RepairKind::manifold};
constexpr std::array turned_steps = {RepairKind::orient};
constexpr std::array thickened_steps = {RepairKind::thicken};
constexpr std::array snapped_steps = {RepairKind::snap};
constexpr std::array divided_steps = {RepairKind::intersections};

// The least level that has one of the steps; none: they are done by name only, or there are none.
RepairLevel least_level(std::span<const RepairKind> steps) {
    RepairLevel least = RepairLevel::none;
    for (const RepairKind kind : steps) {
        const RepairLevel level = repair_step_rows()[static_cast<std::size_t>(kind)].level;
        if (level != RepairLevel::none && (least == RepairLevel::none || level < least)) least = level;
    }
    return least;
}

}  // namespace

std::span<const RepairKind> repairs_for(DefectKind kind) {
    switch (kind) {
        case DefectKind::flat:
            return thickened_steps;
        case DefectKind::degenerate_facet:
        case DefectKind::duplicate_facet:
        case DefectKind::coincident_shell:
            return cleaned_steps;
        case DefectKind::open_edge:
            return closed_steps;
        case DefectKind::non_manifold_edge:
        case DefectKind::non_manifold_vertex:
            return opened_steps;
        case DefectKind::inconsistent_orientation:
        case DefectKind::inverted_shell:
            return turned_steps;
        case DefectKind::ambiguous_shell:
        case DefectKind::touching_shells:
        case DefectKind::self_intersection:
            return divided_steps;
        case DefectKind::unlike_walls:
        case DefectKind::body_overlap:
        case DefectKind::body_gap:
            return snapped_steps;
        case DefectKind::empty:
        case DefectKind::non_finite:
        case DefectKind::absurd_magnitude:
        case DefectKind::unfit_polygon:
        case DefectKind::one_sided:
        case DefectKind::needle:
        case DefectKind::short_edge:
            return {};
    }
    return {};
}

RepairLevel level_for(const Diagnosis& diagnosis) {
    RepairLevel needed = RepairLevel::none;
    for (const Defect& defect : diagnosis.defects) {
        if (defect.severity != Severity::error) continue;
        const RepairLevel level = least_level(repairs_for(defect.kind));
        if (level == RepairLevel::none) return RepairLevel::none;
        needed = std::max(needed, level);
    }
    return needed;
}

}  // namespace kerf

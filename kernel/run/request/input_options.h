// Options of a surface file, for the time before it is cut.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/user_number.h"
#include "files/io/cad_body.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/enclosure/enclosure_options.h"
#include "surface/repair/repair_plan.h"
#include "surface/wrap/wrap.h"

namespace kerf {

/// Spellings of the steps that mend a surface: each is a step of the one plan, see repair_plan_of().
struct RepairOptions {
    Length weld_tolerance;             ///< vertices this close are merged; % of the file's diagonal; 0: only equal ones
    std::int32_t fill_hole_edges = 0;  ///< open loops of at most so many edges are spanned; 0: none
    bool keep_largest = false;         ///< only the connected component of the largest area stays
    std::string plan = {};             ///< steps of a ladder, see parse_repair_plan(); empty: none
    bool cap = false;                  ///< the step `caps`, beside those of `plan`
    Length thicken = {};               ///< the step `thicken` with this thickness, beside those; 0: none
};

/// Options of a surface file, applied before it is diagnosed and cut. `voids`, `fill_voids`, `regions` and
/// `feature_angle_deg` leave the geometry as it is.
struct InputOptions {
    double scale = 1;       ///< factor of all coordinates as they are read; other lengths are in units after it
    RepairOptions repairs;  ///< the steps that mend it
    Voids voids = Voids::as_given;
    std::vector<std::string> regions;      ///< NAME=x,y,z: points of regions, in units after scaling
    std::vector<std::string> more_files;   ///< files whose bodies are meshed with those of the input
    bool fill_voids = false;               ///< the spaces inside of voids are regions
    std::vector<std::string> holes;        ///< names of regions that are left empty; '*' stands for any characters
    EnclosureOptions air = {};             ///< the box whose air around the bodies is meshed in their place
    double feature_angle_deg = 0;          ///< patches between sharper edges where the file has one patch; 0: none
    std::int32_t optimisation_sweeps = 0;  ///< number of sweeps over vertices off the feature edges; 0: none moves
    CadOptions cad;                        ///< for STEP, IGES and BREP files
    bool wrap = false;                     ///< the surface is wrapped, see wrap(); also where there is a gap
    WrapOptions wrapping = {};             ///< the lengths of the wrap

    bool wraps() const { return wrap || wrapping.gap.number() > 0; }
    /// Throws Error(usage) naming option, value and range or form.
    void check() const;
};

/// Takes the first of the files of a command line as its input, the others as InputOptions::more_files.
void take_inputs(const std::vector<std::string>& files, std::string& input, InputOptions& options);

/// Returns the input and the files that are meshed with it.
std::vector<std::string> files_of(const std::string& input, const InputOptions& options);

/// Returns the options that are not at their defaults as a command line has them: {"--scale", "0.001", "--cap"}. `wrap`
/// is none of them.
std::vector<std::string> command_words(InputOptions options);

/// Returns the options without the steps that mend a surface and without a wrap: they read the files in the same way,
/// and leave the surface as it is read.
InputOptions without_repairs(InputOptions options);

/// Returns the plan of all of RepairOptions. Throws Error(usage), naming option, word and its alternatives.
RepairPlan repair_plan_of(const InputOptions& options);

/// Returns the points of `regions`. Throws Error(usage), naming option, value and form.
std::vector<RegionSeed> seeds_of(const InputOptions& options);

/// Options of a surface with the meaning of their texts.
struct InputChoices {
    /// Parses the texts. Throws Error(usage), naming option, value and form.
    InputChoices(const InputOptions& given = {});  // NOLINT(google-explicit-constructor): the same, understood

    InputOptions options;
    std::vector<RegionSeed> seeds;  ///< seeds_of() them
    RepairPlan repairs;             ///< repair_plan_of() them
};

}  // namespace kerf

// A surface that was opened, as options mend it and with what is wrong with it then; and the row of these states that a
// user goes through.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "prepare/input.h"
#include "prepare/input_files.h"
#include "surface/mass_properties.h"
#include "viewer/model/document.h"

namespace kerf::view {

/// What a run would cut; mass properties are those of one region.
struct OrientedSurface {
    std::int64_t vertices = 0, facets = 0;
    double volume = 0;
    std::optional<MassProperties> mass = {};
    std::vector<std::string> region_names = {};
};

struct CheckedSurface {
    InputOptions options;
    std::shared_ptr<const CheckedSoup> checked;
    std::shared_ptr<const NodeSurface> surface;  ///< of the soup; null where the options have not changed it
    std::optional<OrientedSurface> oriented;     ///< where it can be meshed
    std::string note;                            ///< of its slivers; empty: there are none
};

/// Options that read the same, and leave the surface as it is read.
InputOptions without_repairs(InputOptions options);

/// Whether both read and mend a surface in the same way.
bool same_input(InputOptions a, InputOptions b);

/// Checks files by options. `unrepaired`: what without_repairs() of them gives; null where they are such. Throws Error,
/// and what `poll` throws (check_files()).
CheckedSurface check_surface(const InputFiles& files, const InputOptions& options, const std::string& path,
                             const CheckedSoup* unrepaired, const std::function<void()>& poll);

/// States of one surface, in the order in which they were asked for; the first one is the surface as the file has it.
class RepairHistory {
 public:
    bool empty() const { return states_.empty(); }
    const CheckedSurface& unrepaired() const { return states_.front(); }
    const CheckedSurface& shown() const { return states_[shown_]; }

    void begin(CheckedSurface unrepaired);
    /// What was undone is forgotten.
    void add(CheckedSurface state);
    void clear();

    bool can_undo() const { return shown_ > 0; }
    bool can_redo() const { return shown_ + 1 < states_.size(); }
    void undo() { --shown_; }
    void redo() { ++shown_; }

 private:
    std::vector<CheckedSurface> states_;
    std::size_t shown_ = 0;
};

}  // namespace kerf::view

// A surface that was opened, as the options mend it and with the defects that are left; and the history of such states,
// through which a user goes back and on.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "run/prepare/input.h"
#include "run/prepare/input_files.h"
#include "surface/complex/mass_properties.h"
#include "viewer/model/document.h"

namespace kerf::view {

/// The figures of the surface that a run would cut; mass properties are there for a single region only.
struct OrientedSurface {
    std::int64_t vertices = 0, facets = 0;
    double volume = 0;
    std::optional<MassProperties> mass = {};
    std::vector<std::string> region_names = {};
};

/// A surface as its options mend it, with its check.
struct CheckedSurface {
    InputOptions options;
    std::shared_ptr<const CheckedSoup> checked;
    std::shared_ptr<const NodeSurface> surface;  ///< surface of the soup; null where the options have not changed it
    std::optional<OrientedSurface> oriented;     ///< there where the surface can be meshed
    std::string note;                            ///< note on its slivers; empty: there are none
};

/// Returns whether both options read and mend a surface in the same way.
bool same_input(InputOptions a, InputOptions b);

/// Checks files as the options mend them. `unrepaired` is the result for without_repairs(options), or null where the
/// options have no repairs. Throws Error, and lets exceptions of `check_cancelled` pass (check_files()).
CheckedSurface check_surface(const InputFiles& files, const InputOptions& options, const std::string& path,
                             const CheckedSoup* unrepaired, const std::function<void()>& check_cancelled);

/// States of one surface, in the order in which they were asked for; the first one is the surface as the file has it.
class RepairHistory {
 public:
    bool empty() const { return states_.empty(); }
    const CheckedSurface& unrepaired() const { return states_.front(); }
    const CheckedSurface& shown() const { return states_[shown_]; }

    void begin(CheckedSurface unrepaired);
    /// Adds a state behind the shown one and shows it; the states that were undone are forgotten.
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

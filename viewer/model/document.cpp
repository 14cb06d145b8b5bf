#include "viewer/model/document.h"

namespace kerf::view {

bool Document::is_opening() const { return !path.empty() && kind == Kind::none && error.empty(); }

bool Document::has_surfaces_alone() const { return kind == Kind::run && !folder.empty() && !options.volume; }

bool Document::has_problems() const { return !error.empty() || (checked && !checked->diagnosis.clean()); }

}  // namespace kerf::view

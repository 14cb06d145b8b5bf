// The size that gives a wanted number of tetrahedra.
#pragma once

#include <cstdint>
#include <optional>

#include "prepare/input.h"
#include "prepare/stage_listener.h"
#include "request/options.h"

namespace kerf {

/// What became of SizeOptions::cells.
struct FoundSize {
    std::int64_t cells = 0;  ///< that were asked for
    double size = 0;         ///< edge length that was found, four digits; 0: even without any there are more
    double tets = 0;         ///< forecast with it, of the whole in one piece
    int remeshings = 0;      ///< tries that it took, where the surface is remeshed
};

/// A surface to be cut, and the size that it shall be filled with.
struct SizedInput {
    Input input;
    RunOptions options;
    std::optional<FoundSize> found;  ///< where a number of tetrahedra was asked for
};

/// The options with a size in place of SizeOptions::cells, told from the input as it is: to be remeshed, if that is
/// asked for. As they are without such a number. Sizes at places stay, and count; an error of them is thrown as
/// read_size_field() does. O(#F) for each of some ten tries.
RunOptions with_forecast_size(const Input& input, RunOptions options);

/// remesh_where_asked(), and the options with a size in place of SizeOptions::cells: that with which the mesher of the
/// options is forecast to make this number of tetrahedra. Where the surface is remeshed, what its shape asks for is
/// known afterwards: it is remeshed up to four times, with sizes that are closer and closer, until the forecast is
/// within 5 % of the number, and the closest is taken. If even the coarsest mesh has more, that is what comes, with a
/// note in Input::notes. Depends on input and options alone. Throws as remesh_where_asked() and read_size_field() do.
SizedInput remesh_and_size(Input input, const RunOptions& options, StageListener* listener = nullptr);

/// What was found, in one line.
std::string found_size_text(const FoundSize& found);

}  // namespace kerf

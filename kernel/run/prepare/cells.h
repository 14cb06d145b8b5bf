// The size that gives a wanted number of tetrahedra.
#pragma once

#include <cstdint>
#include <optional>

#include "run/prepare/input.h"
#include "run/prepare/stage_listener.h"
#include "run/request/run_request.h"

namespace kerf {

/// The size that was found for SizeOptions::cells.
struct FoundSize {
    std::int64_t cells = 0;  ///< the number of tetrahedra that was asked for
    double size = 0;         ///< edge length, four digits; 0: even without any size there are more
    double tets = 0;         ///< the number forecast with it, of the whole in one piece
    int remeshings = 0;      ///< number of tries, where the surface is remeshed
};

/// A surface to be cut, and the size that it shall be filled with.
struct SizedInput {
    Input input;
    SizeOptions sizes;
    std::optional<FoundSize> found;  ///< none: no number of tetrahedra was asked for
};

/// Returns the sizes of the request with an edge length in place of SizeOptions::cells, forecast from the input as it
/// is, before it is remeshed, if that is asked for. Sizes without such a number are returned as they are. Sizes at
/// places stay, and count; errors of these are thrown as by read_size_field(). O(#F) for each of some ten tries.
SizeOptions forecast_sizes(const Input& input, const RunRequest& request);

/// Changes the surface as remesh_where_asked(), and puts a size in the place of SizeOptions::cells: the size with which
/// the mesher of the request is forecast to make this number of tetrahedra. Where the surface is remeshed, the demands
/// of its shape are known afterwards: it is remeshed up to four times, with sizes that are closer and closer, until the
/// forecast is within 5 % of the number, and the closest is taken. If even the coarsest mesh has more, that one is
/// taken, with a note in Input::notes. Depends on input and request alone. Throws as remesh_where_asked() and
/// read_size_field().
SizedInput remesh_and_size(Input input, const RunRequest& request, StageListener* listener = nullptr);

/// Returns a line for people about the size that was found.
std::string found_size_text(const FoundSize& found);

}  // namespace kerf

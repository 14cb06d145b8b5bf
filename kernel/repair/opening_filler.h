// Openings of a surface closed by patches that cross nothing.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "repair/opening.h"

namespace kerf {

/// What came of an opening.
struct FilledOpening {
    RimOpening opening;
    std::optional<PatchMesh> patch;        ///< none: it stays open
    PatchShape shape = PatchShape::plain;  ///< of the patch, or the last one tried
    bool crosses = false;                  ///< its patch crosses other facets

    double area() const;
    /// The largest distance of a point of the patch from the plane of its rim; 0 for a band.
    double height() const;
};

struct FillingRequest {
    double growth = 0;       ///< as PatchMesh::refine() has it
    bool may_cross = false;  ///< a patch that crosses facets away from its rims is better than none
    std::function<void()> poll = [] {};
};

/// A patch for each opening, in their order, of the first shape that meets neither the surface nor another patch but
/// at its rims; where two patches meet, the first one stays. Facets of the surface that cross each other have no say.
/// O(#F log #F) for each of a few rounds.
std::vector<FilledOpening> fill_openings(const OpenRims& all, std::vector<RimOpening> openings,
                                         const FillingRequest& request);

/// Appends patches to the soup, numbered on behind what the file has. O(#V) to begin with.
class PatchAppender {
 public:
    explicit PatchAppender(Soup& soup);

    /// `filled`: of an opening of this soup; `patch`: the number of its facets' patch.
    void append(const FilledOpening& filled, std::int32_t patch);

 private:
    Soup& soup_;
    std::int32_t next_vertex_ = 0, next_polygon_ = 0;  // numbers in the file, if there are some
};

/// A new patch, whose name is `name` or, if there is one of that name, that with a number. Returns its number.
std::int32_t add_patch(Soup& soup, const std::string& name);

}  // namespace kerf

// Openings of a surface, closed by patches that cross nothing.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "surface/openings/inside/opening.h"

namespace kerf {

/// An opening, and the patch that closes it, if one does.
struct FilledOpening {
    RimOpening opening;
    std::optional<PatchMesh> patch;        ///< none: the opening stays open
    PatchShape shape = PatchShape::plain;  ///< the shape of the patch, or the last one tried
    bool crosses = false;                  ///< its patch crosses other facets

    double area() const;
    /// The largest distance of a point of the patch from the plane of its rim; 0 for a band.
    double height() const;
};

struct FillingRequest {
    double growth = 0;       ///< see PatchMesh::refine()
    bool may_cross = false;  ///< prefers a patch that crosses facets away from its rims to none
    std::function<void()> check_cancelled = [] {};
};

/// Makes a patch for each opening, in their order, of the first shape that meets the surface and other patches only at
/// its rims; where two patches meet, the first one stays. Places where the surface crosses itself do not count. O(#F
/// log #F) for each of a few rounds.
std::vector<FilledOpening> fill_openings(const OpenRims& all, std::vector<RimOpening> openings,
                                         const FillingRequest& request);

/// Appends patches to the soup, with numbers behind those of the file. Its construction takes O(#V).
class PatchAppender {
 public:
    explicit PatchAppender(Soup& soup);

    /// Appends the patch of an opening of this soup. `patch`: the number of the patch that its facets are put into.
    void append(const FilledOpening& filled, std::int32_t patch);

 private:
    Soup& soup_;
    std::int32_t next_vertex_ = 0, next_polygon_ = 0;  // next numbers in the file, if it has some
};

/// Adds a patch to the soup, called `name` or, if there is one of that name, `name` with a number. Returns its number.
std::int32_t add_patch(Soup& soup, const std::string& name);

}  // namespace kerf

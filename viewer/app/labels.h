// Numbers in the scene: patches, isolines, the least and the largest value, and the value under the mouse.
#pragma once

#include <array>
#include <optional>

#include "viewer/app/view.h"

namespace kerf::view {

class Labels {
 public:
    explicit Labels(View& view) : view_(view) {}

    /// Places the numbers in the picture. Those of isolines are left out while the hand turns the scene (`held`) or the
    /// deformation moves: they would jump. Patches and isolines take another drawing of the scene each, so that in a
    /// scene at rest numbers stay as long as the view does.
    void place(bool held);
    /// Finds the value under the mouse in the scene as it is drawn, if `wanted`, which is false for pictures to be
    /// saved. It draws one pixel, only when mouse or view have moved, and builds no scene.
    void probe(bool wanted);

 private:
    // The view that the numbers were placed for: its matrix, viewport, and the number of its scene.
    struct NumberedView {
        Eigen::Matrix4f matrix;
        std::array<int, 4> viewport;
        std::int64_t scene;

        bool operator==(const NumberedView&) const = default;
    };
    // The view, and the place of the mouse in it, that the probe was made for.
    struct Probed {
        NumberedView view;
        float x, y;

        bool operator==(const Probed&) const = default;
    };

    NumberedView numbered_view() const;
    void place_numbers();
    void place_line_values();
    void place_extremes();

    View& view_;
    std::optional<NumberedView> numbered_;
    std::optional<Probed> probed_;
};

}  // namespace kerf::view

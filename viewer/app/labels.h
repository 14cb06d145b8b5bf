// Numbers in the scene: of patches, of isolines, of the least and the largest value, and the value under the mouse.
#pragma once

#include <array>
#include <optional>

#include "viewer/app/view.h"

namespace kerf::view {

class Labels {
 public:
    explicit Labels(View& view) : view_(view) {}

    /// While the hand turns it (`held`), or it moves, a picture has none: they would jump, and each takes another
    /// drawing.
    void place(bool held);
    /// Of what is drawn already: a pixel is drawn again when mouse or view have moved, and no scene is built. A picture
    /// to be kept has none (`wanted`).
    void probe(bool wanted);

 private:
    // Of a picture with numbers: the matrix, the viewport, and which scene it is of.
    struct NumberedView {
        Eigen::Matrix4f matrix;
        std::array<int, 4> viewport;
        std::int64_t scene;

        bool operator==(const NumberedView&) const = default;
    };
    // What the probe is of: a view, and a place of the mouse in it.
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

// The surfaces to try that come with the program, for the start page.
#pragma once

#include <vector>

#include "viewer/app/view.h"

namespace kerf::view {

class Gallery {
 public:
    explicit Gallery(View& view) : view_(view) {}

    /// Returns the examples, which are read once, when the start page is first shown; none before.
    const std::vector<Example>& examples();

 private:
    View& view_;
    std::vector<Example> examples_;
    bool has_looked_ = false;
};

}  // namespace kerf::view

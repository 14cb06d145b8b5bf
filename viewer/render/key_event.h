// Keys as they are pressed, one after the other: who looks at their state once a frame misses what is short.
#pragma once

namespace kerf::view {

/// A key that went down, or that repeats because it is held.
struct KeyEvent {
    int key = 0;  ///< as GLFW numbers them; names in app/keys.h
    bool control = false, shift = false;
    bool repeat = false;
};

}  // namespace kerf::view

// Events of keys, one after the other: a program that looks at the state of keys once a frame misses short ones.
#pragma once

namespace kerf::view {

/// A key that went down, or that repeats because it is held.
struct KeyEvent {
    int key = 0;  ///< number of the key, that of GLFW (app/keys.h)
    bool control = false, shift = false;
    bool repeat = false;
};

}  // namespace kerf::view

// The numbers of keys, which are those of GLFW, for code that knows no window.
#pragma once

namespace kerf::view {

enum Key : int {
    key_space = 32,
    key_0 = 48,
    key_a = 65,
    key_escape = 256,
    key_enter = 257,
    key_tab = 258,
    key_backspace = 259,
    key_delete = 261,
    key_right = 262,
    key_left = 263,
    key_down = 264,
    key_up = 265,
    key_page_up = 266,
    key_page_down = 267,
    key_home = 268,
    key_end = 269,
    key_f12 = 301,
    key_keypad_0 = 320,
    key_keypad_enter = 335,
    key_shift = 340,
    key_control = 341,
};

constexpr int key_of(char letter_or_digit) { return letter_or_digit; }  // 'A' to 'Z', '0' to '9'

}  // namespace kerf::view

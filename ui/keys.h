#pragma once
/// Names for the window system's key, button and modifier codes, so that input logic needs no window library.
/// window.cpp checks them against GLFW's.

namespace acentric::ui {

namespace key {
inline constexpr int space = 32, comma = 44, minus = 45, period = 46, slash = 47, digit0 = 48, digit1 = 49,
                     digit2 = 50, digit3 = 51, digit4 = 52, digit5 = 53, digit6 = 54, digit7 = 55,
                     digit8 = 56;
inline constexpr int equal = 61, a = 65, b = 66, c = 67, d = 68, e = 69, f = 70, g = 71, h = 72, i = 73,
                     j = 74, k = 75, l = 76, m = 77, n = 78, o = 79, p = 80, t = 84, u = 85, v = 86;
inline constexpr int q = 81, r = 82, s = 83, w = 87, x = 88, y = 89, z = 90, leftBracket = 91,
                     rightBracket = 93;
inline constexpr int escape = 256, enter = 257, tab = 258, backspace = 259, insert = 260, del = 261;
inline constexpr int right = 262, left = 263, down = 264, up = 265, pageUp = 266, pageDown = 267, home = 268;
inline constexpr int f1 = 290, f2 = 291, f3 = 292, f4 = 293, f5 = 294, f6 = 295, f7 = 296, f8 = 297,
                     f10 = 299, f11 = 300, f12 = 301;
inline constexpr int keypadEnter = 335;
inline constexpr int leftShift = 340, leftControl = 341, leftAlt = 342;
inline constexpr int rightShift = 344, rightControl = 345, rightAlt = 346;
}  // namespace key

namespace mouse {
inline constexpr int left = 0, right = 1, middle = 2;
}

namespace modifier {
inline constexpr int shift = 1, control = 2, alt = 4;
inline constexpr int all = shift | control | alt;  // locks left out
}  // namespace modifier

namespace key {
/// The modifier that a key is; 0: none.
constexpr int modifierOf(int code) {
  if (code == leftShift || code == rightShift) return modifier::shift;
  if (code == leftControl || code == rightControl) return modifier::control;
  return code == leftAlt || code == rightAlt ? modifier::alt : 0;
}
}  // namespace key

}  // namespace acentric::ui

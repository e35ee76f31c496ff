// The terminal as a whole screen. Only screen.cpp knows the library that draws it (ncurses).
#pragma once
#include <chrono>
#include <cstddef>
#include <vector>

#include "machine/rungctl/page.h"

namespace rung::rungctl {

class Screen {
public:
  enum class Key : uint8_t {
    None,
    Up,
    Down,
    PageUp,
    PageDown,
    Next,
    Resized,
    Letter,
    Gone
  }; // Gone: the terminal is closed
  struct Pressed {
    Key key = Key::None;
    char letter = 0;
  };

  // Takes the terminal; the destructor gives it back as it was. Throws std::runtime_error if standard input or output
  // is not a terminal, or one that cannot place a cursor.
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  size_t width() const;
  size_t height() const;
  void draw(const std::vector<Line>& lines);
  // Waits for a key, for at most that time.
  Pressed key(std::chrono::milliseconds wait);

private:
  void* terminal_ = nullptr;
  bool hasColours_ = false;
};

} // namespace rung::rungctl

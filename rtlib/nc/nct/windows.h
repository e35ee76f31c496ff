// The windows that MW 70 opens on the screen (man. §6.23, l.4152-4208).
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc::nct {

struct ScreenWindow {
  uint16_t identifier = 0;
  std::string_view title;
  std::string_view parameter1 = {}; // "": not used
  std::string_view parameter2 = {};
  bool hasViews = false; // parameter 1 is a view, 0 to 3, or -1: the last one
  uint16_t line = 0;
};

// In the order of their identifiers.
std::span<const ScreenWindow> screenWindows();
const ScreenWindow* findScreenWindow(int64_t identifier);

} // namespace rung::nc::nct

// Formatted text to the end of a text. Internal to the writers.
#pragma once
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace rung::view {

template <class... Args>
void put(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

} // namespace rung::view

// Appends formatted text to a string. fmt::format_to would be compiled again, with all of its formatting, in each
// source.
#pragma once
#include <string>

#include <fmt/format.h>

namespace rung {

void putFormatted(std::string& out, fmt::string_view format, fmt::format_args args);

template <class... Args>
void put(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  putFormatted(out, format, fmt::make_format_args(args...));
}

} // namespace rung

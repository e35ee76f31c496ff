// Any bytes as the texts of a program's files.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rung::fuzz {

// Name and text of each file; `border` is the byte that begins the next one, `extension` that of the names with its
// dot.
inline std::vector<std::pair<std::string, std::string>> splitFiles(std::string_view text, std::string_view extension,
                                                                   char border) {
  std::vector<std::pair<std::string, std::string>> files;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(border, begin), text.size());
    files.emplace_back("fuzz" + std::to_string(files.size()) + std::string(extension),
                       std::string(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return files;
}

} // namespace rung::fuzz

// The sources of a program on their way to a compiler process: the texts of all its files, the included ones among
// them, and how they are to be compiled. As bytes (docs/control-protocol.md) they go through sockets and pipes.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rung::compile {

inline constexpr size_t kMostBytes = size_t{16} << 20; // of packed sources
inline constexpr size_t kMostFiles = 1000;

struct Sources {
  std::string dialect;                       // empty: the first file says it
  std::string name;                          // of the project; empty: the program is called after its first file
  std::vector<std::string> files;            // in order; paths are names here, nobody opens them
  std::vector<std::string> includePaths;     // folders
  std::map<std::string, std::string> config; // of the dialect
  bool profile = false;                      // count and time every rung
  std::map<std::string, std::string> texts;  // by path
};

std::string packed(const Sources& sources);
// Nothing, and `problem` says why, where they are not packed sources, or too many files.
std::optional<Sources> unpacked(std::string_view bytes, std::string& problem);

} // namespace rung::compile

// See source_paths.h.
#include "machine/compile/source_paths.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace rung::compile {

namespace {

// What is before the parts of two paths that are equal at their ends: for /plc/mill/a.pmc and mill/a.pmc "/plc/" and
// "".
std::pair<std::string, std::string> prefixesOf(const std::string& a, const std::string& b) {
  size_t common = 0;
  for (size_t n = 1; n <= std::min(a.size(), b.size()) && a[a.size() - n] == b[b.size() - n]; ++n) {
    const auto begins = [n](const std::string& path) { return n == path.size() || path[path.size() - n - 1] == '/'; };
    if (begins(a) && begins(b)) common = n;
  }
  return {a.substr(0, a.size() - common), b.substr(0, b.size() - common)};
}

} // namespace

SourcePaths::SourcePaths(const std::vector<std::string>& program, const std::vector<std::string>& here) {
  if (program.empty() || here.empty()) return;
  const auto [there, begin] = prefixesOf(program.front(), here.front());
  if (there.size() != program.front().size()) there_ = there, here_ = begin; // otherwise they are other files
}

// A path that begins with "" is any that does not begin with '/'.
std::string SourcePaths::replaced(const std::string& path, const std::string& from, const std::string& to) {
  const bool isOf = from.empty() ? !path.starts_with('/') : path.starts_with(from);
  return isOf ? to + path.substr(from.size()) : path;
}

void rename(Sources& sources, const SourcePaths& paths) {
  for (std::string& file : sources.files) file = paths.ofProgram(file);
  for (std::string& folder : sources.includePaths) folder = paths.ofProgram(folder);
  for (auto& [key, value] : sources.config)
    if (sources.texts.contains(value)) value = paths.ofProgram(value);
  std::map<std::string, std::string> texts;
  for (auto& [path, text] : sources.texts) texts[paths.ofProgram(path)] = std::move(text);
  sources.texts = std::move(texts);
}

} // namespace rung::compile

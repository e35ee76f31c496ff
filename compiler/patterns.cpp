// Files by patterns (see project.h).
#include <algorithm>
#include <filesystem>
#include <fnmatch.h>

#include "compiler/project.h"

namespace rung::compiler {
namespace {

namespace fs = std::filesystem;

// What matches `part` and the parts after it in this folder.
void match(const fs::path& folder, fs::path::const_iterator part, fs::path::const_iterator end,
           std::vector<std::string>& found) {
  std::error_code error;
  if (part == end) {
    if (fs::is_regular_file(folder, error)) found.push_back(folder.string());
    return;
  }
  const auto next = std::next(part);
  if (!isPattern(part->string())) return match((folder / *part).lexically_normal(), next, end, found);
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const fs::path name = entry.path().filename();
    if (fnmatch(part->c_str(), name.c_str(), FNM_PERIOD) == 0) match(folder / name, next, end, found);
  }
}

} // namespace

bool isPattern(std::string_view text) { return text.find_first_of("*?[") != std::string_view::npos; }

std::vector<std::string> matchPattern(const std::string& folder, std::string_view pattern) {
  const fs::path parts(pattern);
  std::vector<std::string> found;
  match(parts.is_absolute() ? fs::path() : fs::path(folder), parts.begin(), parts.end(), found);
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace rung::compiler

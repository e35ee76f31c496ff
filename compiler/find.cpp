// Where a project file lies, and whether a file is part of its project (see project.h).
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "compiler/project.h"

namespace rung::compiler {

namespace fs = std::filesystem;

std::optional<std::string> findUpwards(const std::string& folder) {
  std::error_code error;
  fs::path above = fs::absolute(folder.empty() ? "." : folder, error).lexically_normal();
  if (!above.has_filename()) above = above.parent_path(); // written with a slash at its end
  for (fs::path shown = folder;; shown /= "..", above = above.parent_path()) {
    const fs::path file = (shown / kFileName).lexically_normal();
    if (fs::is_regular_file(file, error)) return file.string();
    if (above == above.root_path()) return std::nullopt;
  }
}

std::string productOf(const Project& project, std::string_view ending) {
  return (fs::path(project.folder) / (project.name + std::string(ending))).lexically_normal().string();
}

bool hasFile(const Project& project, const std::string& file) {
  std::error_code error;
  return std::any_of(project.files.begin(), project.files.end(),
                     [&](const std::string& own) { return fs::equivalent(own, file, error); });
}

} // namespace rung::compiler

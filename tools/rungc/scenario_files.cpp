// Which scenarios a command runs (see scenario_files.h).
#include "tools/rungc/scenario_files.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fnmatch.h>
#include <iterator>

#include "tools/scenario/scenario.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

Result<std::vector<std::string>> scenariosBelow(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code none;
    if (at->path().extension() == ".scn" && !at->is_directory(none))
      found.push_back(at->path().lexically_normal().string());
  }
  if (error) return failure(fmt::format("cannot read the folder '{}': {}", folder, error.message()));
  if (found.empty()) return failure(fmt::format("there is no scenario (*.scn) in or below '{}'", folder));
  std::ranges::sort(found);
  return found;
}

bool matches(const std::string& path, const std::string& filter) {
  if (filter.find_first_of("*?[") == std::string::npos) return path.find(filter) != std::string::npos;
  const std::string name = fs::path(path).filename().string();
  return fnmatch(filter.c_str(), path.c_str(), 0) == 0 || fnmatch(filter.c_str(), name.c_str(), 0) == 0;
}

} // namespace

Result<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    std::error_code none;
    if (!fs::is_directory(name, none)) {
      if (std::string problem = scenario::notAScenario(name); !problem.empty()) return failure(std::move(problem));
      files.push_back(name);
      continue;
    }
    Result<std::vector<std::string>> below = scenariosBelow(name);
    if (!below.ok()) return below.failure();
    std::ranges::move(below.value(), std::back_inserter(files));
  }
  return files;
}

std::vector<std::string> filtered(const std::vector<std::string>& files, const std::vector<std::string>& filters) {
  std::vector<std::string> out;
  std::ranges::copy_if(files, std::back_inserter(out), [&](const std::string& file) {
    return filters.empty() || std::ranges::any_of(filters, [&](const std::string& f) { return matches(file, f); });
  });
  return out;
}

} // namespace rung::rungc

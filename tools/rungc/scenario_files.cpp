// Which scenarios a command runs (see scenario_files.h).
#include "tools/rungc/scenario_files.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fnmatch.h>
#include <iterator>

#include "tools/rungc/commands.h"
#include "tools/scenario/scenario.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

using Files = std::vector<std::string>;

std::optional<Files> scenariosBelow(const std::string& folder, int& status) {
  Files found;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code none;
    if (at->path().extension() == ".scn" && !at->is_directory(none))
      found.push_back(at->path().lexically_normal().string());
  }
  if (error || found.empty()) {
    status = usageError(error ? fmt::format("cannot read the folder '{}': {}", folder, error.message())
                              : fmt::format("there is no scenario (*.scn) in or below '{}'", folder));
    return std::nullopt;
  }
  std::ranges::sort(found);
  return found;
}

std::optional<Files> ofProject(const std::string& named, int& status) {
  const auto project = openProject(named, {}, status);
  if (!project) return std::nullopt;
  if (!project->scenarios.empty()) return project->scenarios;
  status = usageError(fmt::format("{} has no scenario: no file matches its key scenarios", project->file));
  return std::nullopt;
}

std::optional<Files> oneFile(const std::string& name, int& status) {
  const std::string problem = scenario::notAScenario(name);
  if (problem.empty()) return Files{name};
  status = usageError(problem);
  return std::nullopt;
}

bool matches(const std::string& path, const std::string& filter) {
  if (filter.find_first_of("*?[") == std::string::npos) return path.find(filter) != std::string::npos;
  const std::string name = fs::path(path).filename().string();
  return fnmatch(filter.c_str(), path.c_str(), 0) == 0 || fnmatch(filter.c_str(), name.c_str(), 0) == 0;
}

} // namespace

std::optional<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names, int& status) {
  if (names.empty()) return ofProject("", status);
  std::vector<std::string> files;
  for (const std::string& name : names) {
    std::error_code none;
    std::optional<std::vector<std::string>> found;
    const bool isFolder = fs::is_directory(name, none);
    if (isFolder ? fs::is_regular_file(fs::path(name) / compiler::kFileName, none) : namesProject(name))
      found = ofProject(name, status);
    else
      found = isFolder ? scenariosBelow(name, status) : oneFile(name, status);
    if (!found) return std::nullopt;
    std::ranges::move(*found, std::back_inserter(files));
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

// See workspace.h.
#include "tools/lsp/workspace.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "compiler/project.h"

namespace rung::lsp {

void Workspace::open(const std::string& path, std::string text) {
  open_.insert_or_assign(path, std::move(text));
  changed();
}

void Workspace::close(const std::string& path) {
  open_.erase(path);
  changed();
}

bool Workspace::change(const std::string& path, const Range& range, std::string_view text, Unit unit) {
  const auto found = open_.find(path);
  if (found == open_.end()) return false;
  const size_t begin = offsetOf(found->second, range.begin, unit);
  const size_t end = std::max(begin, offsetOf(found->second, range.end, unit));
  found->second.replace(begin, end - begin, text);
  changed();
  return true;
}

void Workspace::changed() { current_.clear(); }

const std::string* Workspace::textOf(const std::string& path) const {
  const auto found = open_.find(path);
  return found == open_.end() ? nullptr : &found->second;
}

std::vector<std::string> Workspace::openPaths() const {
  std::vector<std::string> paths;
  for (const auto& [path, text] : open_) paths.push_back(path);
  return paths;
}

Program& Workspace::programOf(const std::string& path) {
  if (compiler::kindOfFile(path) == compiler::FileKind::Project) return checked(path, true);
  if (const auto project = compiler::findUpwards(std::filesystem::path(path).parent_path().string()))
    if (Program& program = checked(*project, true); program.fileOf(path)) return program;
  return checked(path, false);
}

Program& Workspace::checked(const std::string& path, bool isProject) {
  std::unique_ptr<Program>& program = programs_[path];
  if (program == nullptr) program = std::make_unique<Program>(path, isProject);
  if (current_.insert(program.get()).second) program->check(open_);
  return *program;
}

} // namespace rung::lsp

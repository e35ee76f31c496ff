// See file_kind.h.
#include "compiler/file_kind.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <vector>

#include "compiler/project.h"
#include "frontend/dialects/dialect.h"

namespace rung::compiler {
namespace {

struct Kind {
  std::string_view name;
  std::string_view use; // of the file {0}
};

// In the order of FileKind.
constexpr Kind kKinds[] = {{"a file of another kind", ""},
                           {"a program", "`rungc check {0}` checks it"},
                           {"a compiled program", "`rungc run {0}` runs it"},
                           {"a scenario", "`rungc test {0}` runs it"},
                           {"a mapping file", "`rungc map --check {0} PROGRAM` checks it"},
                           {"a binding file", "`rungc bind --members {0}` connects its members"},
                           {"a project file", "`rungc check --project {0}` checks its program"}};

const Kind& infoOf(FileKind kind) { return kKinds[static_cast<size_t>(kind)]; }

} // namespace

FileKind kindOfFile(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const std::string extension = name.extension().string();
  if (extension == ".so") return FileKind::Compiled;
  if (extension == ".scn") return FileKind::Scenario;
  if (extension == ".map") return FileKind::Map;
  if (extension == ".bind") return FileKind::Binding;
  if (extension == ".toml" && name != kFileName) return FileKind::Project; // rung.toml means its program
  const std::vector<std::string_view> programs = frontend::programExtensions();
  return std::ranges::find(programs, extension) != programs.end() ? FileKind::Program : FileKind::Other;
}

std::string otherKind(const std::string& path, FileKind wanted) {
  const FileKind kind = kindOfFile(path);
  if (kind == wanted || kind == FileKind::Other) return {};
  return fmt::format("'{}' is {}, not {}: {}", path, infoOf(kind).name, infoOf(wanted).name,
                     fmt::format(fmt::runtime(infoOf(kind).use), path));
}

} // namespace rung::compiler

// A session as a scenario (see recording.h).
#include "tools/scenario/recording.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "frontend/dialects/dialect.h"
#include "tools/scenario/names.h"

namespace rung::scenario {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

bool isSetting(const compiler::Project& project, const std::string& key, const std::string& value) {
  return std::ranges::any_of(project.config,
                             [&](const compiler::Setting& s) { return s.key == key && s.value == value; });
}

std::string relativeTo(const fs::path& folder, const std::string& file) {
  std::error_code none;
  const fs::path relative = fs::proximate(file, folder, none);
  return none ? file : relative.string();
}

// As a word, or the last words, of a statement.
std::string asWord(const std::string& text) {
  const bool plain = !text.starts_with('#') && text.find_first_of(" \t") == std::string::npos;
  return plain ? text : '"' + text + '"';
}

// Files that the control reads lie relative to the scenario; those of the compiler relative to the program.
std::string configValue(const std::string& dialect, const std::string& key, const std::string& value,
                        const fs::path& folder) {
  const frontend::Dialect* known = frontend::findDialect(dialect);
  const nc::ConfigKey* row = known == nullptr ? nullptr : nc::findConfigKey(known->configKeys, key);
  const bool file = row != nullptr && row->form == nc::ConfigForm::File && row->reader == nc::ConfigReader::Control;
  return file ? relativeTo(folder, value) : value;
}

// "" for a value that a scenario cannot write: a text that contains a quotation mark.
std::string expectationOf(const std::string& name, const Reading& reading) {
  switch (reading.kind) {
  case ValueKind::Int: return fmt::format("expect {} {}", name, reading.integer);
  case ValueKind::Real: return fmt::format("expect {} {}", name, reading.real);
  case ValueKind::Text: break;
  }
  const bool writable = reading.text.find_first_of("\"\n\r") == std::string::npos;
  return writable ? fmt::format("expect {} \"{}\"", name, reading.text) : std::string();
}

std::string withoutRung(std::string_view fault) { // the rung and the file in brackets may change
  return std::string(fault.substr(0, fault.find(" (")));
}

} // namespace

void Recording::add(std::string statement) { statements_.push_back({std::move(statement)}); }

void Recording::addProgram(std::string word, std::vector<std::string> files, const std::string& notAScenario) {
  if (start_.notAScenario.empty()) start_.notAScenario = notAScenario;
  statements_.push_back({std::move(word), std::move(files)});
}

const compiler::Project* Recording::ownProject(const std::string& folder) const {
  if (!start_.project || start_.programs != start_.project->files) return nullptr;
  const auto found = compiler::findUpwards(fs::absolute(folder).lexically_normal().string());
  std::error_code none;
  return found && fs::equivalent(*found, start_.project->file, none) ? &*start_.project : nullptr;
}

void Recording::writeStart(const std::string& path, const std::string& dialect, std::string& text) const {
  const fs::path folder = folderOf(path);
  const compiler::Project* project = ownProject(folder.string());
  if (project == nullptr) {
    text += "program";
    for (const std::string& program : start_.programs) text += " " + asWord(relativeTo(folder, program));
    text += fmt::format("\ndialect {}\n", dialect);
  }
  for (const auto& [key, value] : start_.config)
    if (project == nullptr || !isSetting(*project, key, value))
      text += fmt::format("config {} {}\n", key, asWord(configValue(dialect, key, value, folder)));
  if (start_.periodUs > 0) text += fmt::format("period {}us\n", start_.periodUs);
  for (const std::string& connect : start_.connects) text += connect + "\n";
}

Result<std::string> Recording::scenario(const std::string& path, const Session& session,
                                        const std::vector<std::string>& watched) const {
  if (!start_.notAScenario.empty()) return failure(start_.notAScenario);
  if (start_.project && !start_.project->includePaths.empty() && ownProject(folderOf(path).string()) == nullptr)
    return failure(fmt::format("the program needs the include folders of {}: save the scenario in the folder of the "
                               "project, and run the program of the project",
                               start_.project->file));
  std::string text = "# Written by the prompt of rungc run.\n";
  writeStart(path, session.instance().program().dialect, text);
  for (const Done& done : statements_) {
    text += done.statement;
    for (const std::string& file : done.files) text += " " + asWord(relativeTo(folderOf(path), file));
    text += "\n";
  }
  for (const std::string& name : watched) {
    const Result<Reading> reading = readName(session.instance(), session.nc(), name, false);
    if (const std::string line = reading.ok() ? expectationOf(name, reading.value()) : ""; !line.empty())
      text += line + "\n";
  }
  if (!session.unexpectedFault().empty())
    text += fmt::format("expect_fault {}\n", withoutRung(session.instance().faultText()));
  return text;
}

} // namespace rung::scenario

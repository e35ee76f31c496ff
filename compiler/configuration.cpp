// The checks (see configuration.h).
#include "compiler/configuration.h"

#include <functional>
#include <ranges>

#include <fmt/format.h>

#include "ir/support/diag/project.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/similar.h"

namespace rung::compiler {
namespace {

std::string_view firstPart(std::string_view key) { return key.substr(0, key.find('.')); }

// For keys of families, the first part must be similar: `timr.1` suggests tmr.N.
std::string suggestion(const frontend::Dialect& dialect, std::string_view key) {
  const auto isFamily = [](const nc::ConfigKey& row) { return row.key.find('<') != std::string_view::npos; };
  auto single = dialect.configKeys | std::views::filter(std::not_fn(isFamily));
  const std::string_view similar = text::mostSimilar(key, single, &nc::ConfigKey::key);
  if (!similar.empty() || key.find('.') == std::string_view::npos) return std::string(similar);
  const auto firstOf = [](const nc::ConfigKey& row) { return firstPart(row.key); };
  const std::string_view family =
      text::mostSimilar(firstPart(key), dialect.configKeys | std::views::filter(isFamily), firstOf);
  for (const nc::ConfigKey& row : dialect.configKeys)
    if (!family.empty() && row.key.starts_with(family)) return nc::shownKey(row);
  return {};
}

bool contains(const SourceManager& sources, const std::string& text) {
  for (uint32_t file = 0; file < sources.fileCount(); ++file)
    if (!sources.name(FileId{file}).ends_with(".toml") &&
        text::upper(sources.text(FileId{file})).find(text) != std::string::npos)
      return true;
  return false;
}

// By an identifier, or by the one before an attribute: `Feed` of `PLC.Input.Feed[2].Default`.
bool isNamed(const SourceManager& sources, std::string_view key) {
  const std::string name = text::upper(key);
  if (contains(sources, name)) return true;
  const size_t point = name.rfind('.');
  if (point == std::string::npos) return false;
  const std::string owner = name.substr(0, point);
  const std::string identifier = owner.substr(owner.rfind('.') + 1); // npos + 1 is 0
  return contains(sources, identifier.substr(0, identifier.find('[')));
}

} // namespace

std::string unknownKeyText(const frontend::Dialect& dialect, std::string_view key) {
  if (const frontend::ForeignWord* foreign = frontend::findForeign(dialect.foreignKeys, key))
    return fmt::format("'{}' is not a configuration key of {} programs; in this language: {}", key, dialect.name,
                       foreign->here);
  const std::string meant = suggestion(dialect, key);
  return fmt::format("'{}' is not a configuration key of {} programs{}; `rungc explain config` lists them", key,
                     dialect.name, text::didYouMean(meant));
}

std::optional<ConfigProblem> checkSetting(const frontend::Dialect& dialect, const std::string& key,
                                          std::string_view value) {
  const nc::ConfigKey* row = nc::findConfigKey(dialect.configKeys, key);
  if (row == nullptr) return ConfigProblem{key, unknownKeyText(dialect, key), true};
  std::string text = nc::wrongValue(*row, key, value);
  if (text.empty()) return std::nullopt;
  return ConfigProblem{key, std::move(text)};
}

void report(const ConfigProblem& problem, const frontend::Dialect& dialect, SourceRange range,
            Diagnostics& diagnostics) {
  if (!problem.isUnknown) {
    diagnostics.report(diag::ConfigValue, range) << problem.text;
    return;
  }
  DiagBuilder report = diagnostics.report(diag::UnknownConfigKey, range);
  report << problem.key << fmt::format("{} programs", dialect.name);
  if (const frontend::ForeignWord* foreign = frontend::findForeign(dialect.foreignKeys, problem.key))
    return frontend::explainForeign(report, {}, *foreign, false);
  report.meant({}, suggestion(dialect, problem.key));
  report.note("`rungc explain config` lists the keys");
}

std::vector<ConfigProblem> checkNamesOfProgram(const frontend::Dialect& dialect, const SourceManager& sources,
                                               ConfigPairs config) {
  std::vector<ConfigProblem> problems;
  for (const auto& [key, value] : config) {
    const nc::ConfigKey* row = nc::findConfigKey(dialect.configKeys, key);
    if (row != nullptr && row->key.starts_with('<') && !isNamed(sources, key))
      problems.push_back({key, unknownKeyText(dialect, key) + ", and no source names it", true});
  }
  return problems;
}

} // namespace rung::compiler

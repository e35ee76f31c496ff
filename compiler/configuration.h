// Checks a configuration before anything is made of it, whatever the command is: unknown keys, and values that the
// table of keys does not take. What only a simulated control knows of a value, tools/scenario/configuration.h checks.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::compiler {

struct ConfigProblem {
  std::string key;
  std::string text; // for people
  bool isUnknown = false;
};

using ConfigPairs = std::span<const std::pair<std::string, std::string>>;

std::optional<ConfigProblem> checkSetting(const frontend::Dialect& dialect, const std::string& key,
                                          std::string_view value);

// Keys by which only the program itself could ask (a parameter of a TECHNOL machine), and that no source names.
std::vector<ConfigProblem> checkNamesOfProgram(const frontend::Dialect& dialect, const SourceManager& sources,
                                               ConfigPairs config);

// Reports it at its place; the range may be invalid.
void report(const ConfigProblem& problem, const frontend::Dialect& dialect, SourceRange range,
            Diagnostics& diagnostics);

// "'slot_step' is not a configuration key of gsk programs; did you mean slot_steps? …"
std::string unknownKeyText(const frontend::Dialect& dialect, std::string_view key);

} // namespace rung::compiler

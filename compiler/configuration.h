// Checks a configuration before it is used, for any command: unknown keys, and values that the table of keys does not
// accept. tools/scenario/configuration.h checks what only a simulated control knows about values.
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
  std::string text; // message for the user
  bool isUnknown = false;
};

using ConfigPairs = std::span<const std::pair<std::string, std::string>>;

std::optional<ConfigProblem> checkSetting(const frontend::Dialect& dialect, const std::string& key,
                                          std::string_view value);

// Keys that only the program itself could read (a parameter of a TECHNOL machine), and that no source mentions.
std::vector<ConfigProblem> checkNamesOfProgram(const frontend::Dialect& dialect, const SourceManager& sources,
                                               ConfigPairs config);

// Reports the problem at its position; the range may be invalid.
void report(const ConfigProblem& problem, const frontend::Dialect& dialect, SourceRange range,
            Diagnostics& diagnostics);

// "'slot_step' is not a configuration key of gsk programs; did you mean slot_steps? …"
std::string unknownKeyText(const frontend::Dialect& dialect, std::string_view key);

} // namespace rung::compiler

// The textual form of a module: complete, canonical, and readable. Grammar: README.md beside this file.
//
// For every module that passes the verifier, parse(print(m)) equals m; for every printed text, print(parse(t)) equals
// t. The printer also accepts modules that do not pass, so that the verifier can show its errors in them.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "ir/core/module.h"

namespace rung::ir {

std::string print(const Module& module);

// For a module that passes the verifier: equal for modules with the same text, otherwise different with high
// probability; the same on every machine. Much faster than printing.
uint64_t hashOf(const Module& module);

// One rung as `print` shows it. `remark(i)` returns a text to be printed under operation i (or under the transfer, for
// i == ops.size()); empty: none. Remarks are printed as comments, so the result can still be parsed as part of a
// module.
using Remark = std::function<std::string(size_t index)>;
std::string printRung(const Module& module, RoutineId routine, uint32_t rung, const Remark& remark = {});

// The position and the reason of a parse error; line and column (in bytes) count from 1.
struct ParseError {
  uint32_t line = 0;
  uint32_t column = 0;
  std::string message;
};

struct ParseOutcome {
  std::optional<Module> module;
  ParseError error; // the first one; valid if there is no module
};

// Checks the form only; run the verifier on the result.
ParseOutcome parse(std::string_view text);

} // namespace rung::ir

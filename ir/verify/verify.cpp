// Runs the rules, and formats their errors (see verify.h).
#include "ir/verify/verify.h"

#include <fmt/format.h>

#include "ir/support/put.h"
#include "ir/text/text.h"
#include "ir/verify/rules.h"

namespace rung::ir {

// Most rungs and declarations that `render` shows; one usually suffices, and a text of thousands does not help.
constexpr int kMaxShown = 20;

std::string_view ruleName(Rule rule) {
  constexpr std::string_view kNames[kRuleCount] = {"names",    "spaces",   "slots",    "symbols", "spans",   "copies",
                                                   "tasks",    "schedule", "routines", "calls",   "header",  "form",
                                                   "regions",  "scope",    "types",    "yields",  "places",  "windows",
                                                   "slot use", "host",     "loops",    "profile", "transfer"};
  return kNames[static_cast<int>(rule)];
}

std::vector<VerifyError> verify(const Module& module, Mode mode) {
  std::vector<VerifyError> errors;
  ModuleCheck check(module, mode, errors);
  if (!checkModule(check)) return errors;
  checkRungs(check);
  if (errors.empty()) checkCalls(check);
  return errors;
}

std::string render(const Module& module, const std::vector<VerifyError>& errors) {
  std::string out;
  int shown = 0;
  for (size_t i = 0; i < errors.size();) {
    if (shown++ == kMaxShown) {
      put(out, "and {} more errors\n", errors.size() - i);
      break;
    }
    const VerifyError& error = errors[i];
    const bool inRung = error.routine.valid() && error.rung != RUNG_NONE;
    if (error.routine.valid()) put(out, "routine {}: ", module.at(error.routine).name);
    if (!inRung || error.op == RUNG_NONE) {
      if (inRung) put(out, "rung {}: ", error.rung);
      put(out, "[{}] {}\n", ruleName(error.rule), error.message);
      ++i;
      if (!inRung) continue;
      out += printRung(module, error.routine, error.rung);
      continue;
    }
    // All errors at operations of this rung, which are consecutive.
    size_t end = i;
    while (end < errors.size() && errors[end].routine == error.routine && errors[end].rung == error.rung &&
           errors[end].op != RUNG_NONE)
      ++end;
    put(out, "rung {}:\n", error.rung);
    out += printRung(module, error.routine, error.rung, [&](size_t op) {
      std::string text;
      for (size_t k = i; k < end; ++k)
        if (errors[k].op == op)
          text += fmt::format("{}[{}] {}", text.empty() ? "" : "; ", ruleName(errors[k].rule), errors[k].message);
      return text;
    });
    i = end;
  }
  return out;
}

} // namespace rung::ir

// Statements about values, messages, the log and the fault (see expectations.h).
#include "tools/scenario/expectations.h"

#include <fmt/format.h>
#include <optional>
#include <utility>

#include "tools/scenario/names.h"

namespace rung::scenario {

using runtime::Ref;

std::string setValue(EngineRun& run, const Statement& s) {
  const bool quantity = s.name.starts_with("NC.");
  if (quantity && s.value.kind == ValueKind::Text) return "a variable of the NC is a number, not a text";
  if (quantity) return run.nc().setQuantity(std::string_view(s.name).substr(3), s.value.real);
  const std::optional<Ref> place = run.nc().writePlace(run.instance().program(), s.name);
  if (!place) {
    const std::optional<sim::NcCell> now = run.nc().readCell(s.name);
    if (std::string wrong = now ? cellProblem(*now, s.value) : ""; !wrong.empty()) return wrong;
    const auto problem = run.nc().writeCell(s.name, cellOf(s.value));
    return problem ? *problem : unknownName(run.instance().program(), run.nc(), s.name);
  }
  run.nc().beforeWrite(run.instance(), *place);
  return writeValue(run.instance(), run.nc().control(), *place, s.value);
}

std::string expectValue(const EngineRun& run, const Statement& s) {
  const Result<Reading> reading = readName(run.instance(), run.nc(), s.name, wantsReal(s));
  return reading.ok() ? checkValue(reading.value(), s) : reading.error();
}

std::string expectRange(const EngineRun& run, const Statement& s) {
  const Result<Reading> reading = readName(run.instance(), run.nc(), s.name, wantsReal(s));
  return reading.ok() ? checkRange(reading.value(), s) : reading.error();
}

// Of several messages with this number, one must (or none may) have the properties.
std::string expectMessage(const EngineRun& run, const Statement& s) {
  std::string seen;
  std::string difference;
  for (const nc::ShownMessage& message : run.nc().control().messages(run.instance())) {
    seen += fmt::format("{}{}", seen.empty() ? "" : ", ", message.number);
    if (message.number != s.number) continue;
    std::string own = messageDifference(message, s.keys);
    if (own.empty()) return s.on ? std::string() : fmt::format("message {} is displayed", s.number);
    if (difference.empty()) difference = std::move(own);
  }
  if (!s.on) return {};
  return difference.empty()
             ? fmt::format("message {} is not displayed; there is {}", s.number, seen.empty() ? "none" : seen)
             : difference;
}

std::string expectLog(EngineRun& run, const Statement& s) {
  std::string seen;
  for (const std::string& line : run.unreadLog()) {
    if (line.find(s.value.text) != std::string::npos) {
      run.unreadLog().clear();
      return {};
    }
    seen += "\n  " + line;
  }
  return fmt::format("no log entry contains \"{}\"{}{}", s.value.text, seen.empty() ? "" : "; there are:", seen);
}

std::string expectFault(const EngineRun& run, const Statement& s) {
  if (!run.instance().faulted()) return fmt::format("the program runs; expected the fault \"{}\"", s.value.text);
  const std::string text = run.instance().faultText();
  return text.find(s.value.text) != std::string::npos
             ? std::string()
             : fmt::format("the fault is \"{}\", expected \"{}\"", text, s.value.text);
}

} // namespace rung::scenario

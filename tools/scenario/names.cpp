// Names of a scenario in a running program (see names.h).
#include "tools/scenario/names.h"

#include <fmt/format.h>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>

#include "rtlib/nc/fanuc/messages.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/nc/signals.h"
#include "rtlib/text/similar.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {
namespace {

constexpr std::string_view kQuantity = "NC.";

// Names of values of the program or the NC in a statement.
std::vector<std::string> valueNames(const Statement& s) {
  const Words named = StatementInfo::of(s).words;
  if (named == Words::Value) return {s.name};
  if (named != Words::Values) return {};
  std::vector<std::string> names = s.words;
  for (const KeyValue& item : s.keys)
    if (!item.key.empty()) names.push_back(item.key);
  return names;
}

} // namespace

Result<Reading> readName(const runtime::Instance& instance, const sim::SimulatedNc& nc, std::string_view name,
                         bool wantReal) {
  if (name.starts_with(kQuantity)) {
    if (const auto quantity = nc.quantity(name.substr(kQuantity.size()))) return realReading(*quantity);
    return failure(fmt::format("the simulated NC has no variable '{}'", name));
  }
  if (const std::optional<runtime::Ref> place = nc.readPlace(instance.program(), name))
    return readValue(instance, nc.control(), *place, wantReal);
  if (const std::optional<sim::NcCell> cell = nc.readCell(name)) return cellReading(*cell, wantReal);
  return failure(unknownName(instance.program(), nc, name));
}

NamedValue::NamedValue(std::string name, const runtime::Instance& instance, const sim::SimulatedNc& nc)
    : name_(std::move(name)), place_(nc.readPlace(instance.program(), name_)) {}

void NamedValue::locate(const runtime::Instance& instance, const sim::SimulatedNc& nc) {
  place_ = nc.readPlace(instance.program(), name_);
}

std::optional<Reading> NamedValue::read(const runtime::Instance& instance, const sim::SimulatedNc& nc) const {
  if (place_) return readValue(instance, nc.control(), *place_, false);
  if (name_.starts_with(kQuantity))
    return realReading(nc.quantity(std::string_view(name_).substr(kQuantity.size())).value_or(0));
  const std::optional<sim::NcCell> cell = nc.readCell(name_);
  return cell ? std::optional(cellReading(*cell, false)) : std::nullopt;
}

std::vector<std::string> namesOf(const rung_program& program, const sim::SimulatedNc& nc) {
  std::vector<std::string> names;
  std::unordered_set<std::string_view> seen;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    if ((symbol.flags & RUNG_SYMBOL_HIDDEN) != 0) continue;
    names.emplace_back(symbol.name);
    seen.insert(symbol.name);
  }
  const nc::SignalTable* signals = nc::signalsOf(program.dialect);
  if (signals == nullptr) return names;
  for (const nc::Signal& signal : *signals) // programs name only some rows of areas and structures
    if (seen.insert(signal.symbol).second && nc.readPlace(program, signal.symbol)) names.emplace_back(signal.symbol);
  return names;
}

std::string unknownName(const rung_program& program, const sim::SimulatedNc& nc, std::string_view name) {
  if (std::string problem = nc.cellProblem(name); !problem.empty()) return problem;
  if (const std::string address = nc::fanuc::addressOfMessage(program, name); !address.empty())
    return fmt::format("'{}' is a message, not a name of this program; its bit is {}", name, address);
  const std::vector<std::string> names = namesOf(program, nc);
  return fmt::format("'{}' is not a name of this program{}", name,
                     text::didYouMean(text::mostSimilar(nc::headOf(name), names)));
}

std::vector<Problem> unknownNames(const Scenario& scenario, const rung_program& program,
                                  std::span<const rung_program* const> next, const sim::SimulatedNc& nc) {
  std::vector<Problem> problems;
  const rung_program* running = &program;
  const auto check = [&](const Statement& s, const std::string& name) {
    if (name.starts_with(kQuantity)) return; // some quantities exist only once they have been set
    const bool isMessage = s.kind == Kind::Expect && isMessageWord(name);
    if (!nc.readPlace(*running, name) && !nc.readCell(name) && !nc.cellMayCome(name))
      problems.push_back(problemAt(s, unknownName(*running, nc, name) + std::string(isMessage ? kMessageNote : "")));
  };
  for (const Statement& s : scenario.statements) {
    if (StatementInfo::of(s).program == OtherProgram::TakesOver) {
      running = next.front();
      next = next.subspan(1);
    }
    for (const std::string& name : valueNames(s)) check(s, name);
  }
  return problems;
}

std::vector<Problem> unfitValues(const Scenario& scenario, const runtime::Instance& instance,
                                 const sim::SimulatedNc& nc) {
  std::vector<Problem> problems;
  for (const Statement& s : scenario.statements) {
    const StatementInfo& info = StatementInfo::of(s);
    if (info.program == OtherProgram::TakesOver) break;
    const auto place = info.sets ? nc.readPlace(instance.program(), s.name) : std::nullopt;
    if (!place) continue;
    if (std::string problem = valueProblem(instance, *place, s.value); !problem.empty())
      problems.push_back(problemAt(s, std::move(problem)));
  }
  return problems;
}

Result<std::string> printedLine(const Statement& print, const runtime::Instance& instance, const sim::SimulatedNc& nc,
                                uint64_t scans) {
  std::string line = fmt::format("{:.3f} ms, scan {}:", static_cast<double>(instance.nowUs()) / 1000, scans);
  bool first = true;
  for (const KeyValue& item : print.keys) {
    line += std::exchange(first, false) ? " " : ", ";
    const std::string& text = item.key.empty() ? item.value.text : item.key;
    const bool isText = item.key.empty() && !text.starts_with('#'); // in quotes, # does not begin a comment
    const Result<Reading> reading = isText ? failure(text) : readName(instance, nc, text, false);
    if (!reading.ok() && !item.key.empty()) return reading.failure();
    line += reading.ok() ? fmt::format("{} = {}", text, show(reading.value())) : text;
  }
  return line;
}

} // namespace rung::scenario

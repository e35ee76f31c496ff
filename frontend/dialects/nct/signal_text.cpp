// Explains predefined names (see signal_text.h, reference.h).
#include "frontend/dialects/nct/signal_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/nct/read/symbols.h"
#include "frontend/dialects/nct/reference.h"
#include "rtlib/nc/nct/service_functions.h"
#include "rtlib/nc/signals.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::frontend::nct {
namespace {

// What the elements of a signal belong to; the groups are those of signals.csv.
std::string_view unitOf(const nc::Signal& signal) {
  struct Unit {
    std::string_view group, unit;
  };
  constexpr Unit kUnits[] = {
      {"machine-panel", "panel"}, {"handwheel", "handwheel"},      {"sensor", "card"}, {"analog", "analog input"},
      {"drive", "drive or card"}, {"position-switches", "switch"}, {"axis", "axis"},   {"spindle", "spindle"},
      {"channel", "channel"},     {"plc-parameters", "parameter"}};
  for (const Unit& unit : kUnits)
    if (std::string_view(signal.group).starts_with(unit.group)) return unit.unit;
  return "element";
}

std::string explainSignal(std::string_view name) {
  for (const nc::Signal& signal : nc::nctSignals()) {
    if (!text::equalsIgnoringCase(signal.symbol, name)) continue;
    std::string text = fmt::format("[nct] {}: {}, {}", signal.symbol, typeText(signal),
                                   signal.direction == nc::Direction::In ? "NC to PLC" : "PLC to NC");
    if (placeText(signal) != "-") text += fmt::format(", bit {}", placeText(signal));
    text += fmt::format("\n  {}\n", nc::meaningWithNote(signal));
    if (signal.count > 1) text += fmt::format("  Index: {}.\n", indexText(signal));
    return text + fmt::format("  Group {}. Manual: l.{}.\n", signal.group, signal.manualLine);
  }
  return "";
}

// Explains the text after a signal's name: a bit that does not exist, an index that leads into another signal.
std::string explainPart(std::string_view name, std::string_view part) {
  const nc::Signal* signal = nc::findSignal(nc::nctSignals(), name);
  if (signal == nullptr || part.empty()) return "";
  const size_t comma = std::min(part.find(','), part.size());
  std::string_view bit = part.substr(0, comma);
  if (text::takePrefixIgnoringCase(bit, ".") && signal->type != nc::SignalType::Bit &&
      text::numberIn<uint32_t>(bit).value_or(0) > 31)
    return fmt::format("[nct] {0}.{1}: there is no bit {1}; a double word has the bits 00 to 31\n", name, bit);
  std::string_view index = part.substr(comma);
  if (!text::takePrefixIgnoringCase(index, ",#")) return "";
  const nc::Signal* other = signalAfter(*signal, text::numberIn<uint32_t>(index).value_or(0));
  return other == nullptr ? "" : fmt::format("[nct] {},#{} is {}: {}\n", name, index, other->symbol, other->meaning);
}

std::string explainFlag(std::string_view name) {
  constexpr std::string_view kMeanings[] = {
      "the instruction was not executed: address or operand out of range, wrong format, NaN",
      "result too small",
      "result too large",
      "carry of an addition, borrow of a subtraction",
      "compared value greater",
      "values equal",
      "compared value lower"};
  for (size_t bit = 0; bit < std::size(kFlagNames); ++bit)
    if (text::equalsIgnoringCase(kFlagNames[bit], name))
      return fmt::format("[nct] {}: flag, bit 0000.{:02}, read only\n  {}\n  Manual: l.721-777.\n", kFlagNames[bit],
                         bit, kMeanings[bit]);
  return "";
}

std::string explainQuantity(std::string_view name) {
  const auto index = nc::nct::findScopeSymbol(name);
  if (!index) return "";
  const nc::nct::ScopeSymbol& symbol = nc::nct::scopeSymbols()[*index];
  return fmt::format("[nct] {}: quantity of SCP\n  {}\n  Parameter 1: {}. Parameter 2: {}.\n  Manual: l.{}.\n",
                     symbol.name, symbol.meaning, parameterText(symbol.param1), parameterText(symbol.param2),
                     symbol.line);
}

// Explains a service function such as "MW 70" or "mr104".
std::string explainFunction(std::string_view word) {
  for (const nc::nct::FunctionAccess access : {nc::nct::FunctionAccess::Read, nc::nct::FunctionAccess::Write}) {
    std::string_view digits = word;
    if (!text::takePrefixIgnoringCase(digits, mnemonicOf(access)) || digits.empty()) continue;
    digits.remove_prefix(std::min(digits.find_first_not_of(" #"), digits.size()));
    const auto code = text::numberIn<uint32_t>(digits);
    if (!code) return "";
    const nc::nct::ServiceFunction* function = nc::nct::findServiceFunction(*code);
    if (function == nullptr || function->access != access) return "";
    std::string text = fmt::format("[nct] {} {}: {}\n", mnemonicOf(access), *code, function->title);
    for (const nc::nct::BlockWord& w : function->words)
      text +=
          fmt::format("  Word {}{}: {}.\n", w.first, w.first == w.last ? "" : fmt::format(" to {}", w.last), w.meaning);
    text += "  Execution codes:";
    for (const nc::nct::ExecutionCode& c : nc::nct::executionCodes())
      if (function->hasCode(c.code)) text += fmt::format("\n    {} {}", c.code, c.meaning);
    return text + fmt::format("\n  Manual: {}, l.{}.\n", function->section, function->line);
  }
  return "";
}

} // namespace

const nc::Signal* signalAfter(const nc::Signal& signal, int64_t words) {
  const auto isIn = [&](const nc::Signal& one) {
    const int64_t offset = signal.byteOffset / 4 + words - one.byteOffset / 4;
    const bool isBit = one.type == nc::SignalType::Bit;
    return offset >= 0 && offset < std::max<int64_t>(1, int64_t{one.count} * one.strideBytes / 4) &&
           isBit == (signal.type == nc::SignalType::Bit) && (!isBit || one.bit == signal.bit);
  };
  if (isIn(signal) || words == 0) return nullptr;
  const auto found = std::ranges::find_if(nc::nctSignals(), isIn);
  return found == nc::nctSignals().end() ? nullptr : &*found;
}

std::string_view typeText(const nc::Signal& signal) {
  if (signal.type == nc::SignalType::Bit) return "bit";
  return nc::elementBytes(signal.type) == 8 ? "double" : "double word";
}

std::string indexText(const nc::Signal& signal) {
  if (signal.count < 2) return "-";
  const uint32_t step = signal.strideBytes / 4;
  const uint32_t last = (signal.count - 1) * step;
  return step == 1 ? fmt::format("#0 to #{} ({})", last, unitOf(signal))
                   : fmt::format("#0, #{} to #{} ({})", step, last, unitOf(signal));
}

std::string placeText(const nc::Signal& signal) {
  std::string_view address = signal.address;
  if (signal.type != nc::SignalType::Bit || address.starts_with('(')) return "-";
  if (address.ends_with('?')) address.remove_suffix(1);
  return std::string(address);
}

std::string parameterText(const nc::nct::ScopeParameter& parameter) {
  if (parameter.limit == nc::nct::ScopeLimit::PlcNvram)
    return fmt::format("{}, {} to PLCNVRAM-{}", parameter.meaning, parameter.min, parameter.max);
  if (parameter.min == parameter.max || parameter.min < 0) return std::string(parameter.meaning);
  return fmt::format("{}, {} to {}", parameter.meaning, parameter.min, parameter.max);
}

std::string explainWord(std::string_view word) {
  const std::string_view name = word.substr(0, word.find_first_of(",."));
  const std::string_view signal = aliasOf(name);
  return explainPart(signal, word.substr(name.size())) + explainSignal(signal) + explainFlag(name) +
         explainQuantity(name) + explainFunction(word);
}

} // namespace rung::frontend::nct

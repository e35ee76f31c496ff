// Names and addresses of signals.
#include "frontend/dialects/gsk/read/signals.h"

#include <vector>

#include <fmt/format.h>

#include "frontend/dialects/gsk/language.h"
#include "frontend/network/explain.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::gsk {
namespace {

std::string_view groupOf(Machine machine) { return machine == Machine::Mill ? "mc" : "tc"; }

std::string_view machineNote(std::string_view group) {
  if (group == "mc") return " Only the milling control GSK25iMc has it.";
  if (group == "tc") return " Only the turning control GSK25iTc has it.";
  return "";
}

std::string manualOf(const nc::Signal& signal) {
  return fmt::format("Manual: l.{}.{}", signal.manualLine, machineNote(signal.group));
}

// The signal of another machine that an operand of `length` bytes is or contains a bit of; null if there is none.
const nc::Signal* foreignSignal(Machine machine, const network::Address& address, uint32_t length) {
  if (kLanguage.at(address.area).use == network::AreaUse::Memory) return nullptr;
  static const std::vector<const nc::Signal*> kOfOneMachine = [] {
    std::vector<const nc::Signal*> found;
    for (const nc::Signal& signal : nc::gskSignals())
      if (std::string_view(signal.group) != "both") found.push_back(&signal);
    return found;
  }();
  for (const nc::Signal* signal : kOfOneMachine) {
    if (signal->group == groupOf(machine)) continue;
    // A byte operand may contain a single bit of the other machine among signals of both.
    if (signal->type == nc::SignalType::Bit && !address.isBit) continue;
    for (uint32_t i = 0; i < length; ++i) {
      network::Address byte = address;
      byte.byte += i;
      if (covers(kLanguage, *signal, byte)) return signal;
    }
  }
  return nullptr;
}

} // namespace

void watchSignals(network::Context& context, Machine machine) {
  if (machine == Machine::Any) return;
  context.onPlace = [&diagnostics = context.diagnostics, machine](const Word& word, const network::Address& address,
                                                                  uint32_t length) {
    const nc::Signal* signal = foreignSignal(machine, address, length);
    if (signal == nullptr) return;
    const bool onMill = machine == Machine::Mill;
    diagnostics.report(diag::SignalOfOtherMachine, word.range)
            .note(fmt::format("{}: {}", signal->symbol, signal->meaning))
        << signal->symbol << (onMill ? "turning" : "milling") << (onMill ? "mill" : "turn");
  };
}

std::string explainWord(std::string_view word) {
  if (text::equalsIgnoringCase(word, "FUNC"))
    return "[gsk] FUNC: a functional instruction, by its number or mnemonic; its parameters follow in PRM lines\n";
  if (text::equalsIgnoringCase(word, "PRM")) return "[gsk] PRM: a parameter of the functional instruction above\n";
  if (text::equalsIgnoringCase(word, "TABLE"))
    return "[gsk] TABLE: in the box of a ladder, the table of the functional instruction follows\n";
  return network::explainWord(kLanguage, word, &manualOf);
}

} // namespace rung::frontend::gsk

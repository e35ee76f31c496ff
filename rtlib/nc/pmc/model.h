// The PMC family: the GSK25i and the FANUC PMC that it follows. One control serves both (rtlib/nc/control/pmc); this is
// the table of what differs between them. Lines (l.) and P numbers in comments of the family's code are those of GSK's
// manual and inventory.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "rtlib/nc/pmc/axis_commands.h"
#include "rtlib/nc/pmc/services.h"
#include "rtlib/nc/service.h"
#include "rtlib/nc/signal.h"

namespace rung::nc::pmc {

// M, further M codes of a block, S, T, B (second auxiliary function), external operation (EF of G81, l.9450).
enum class FunctionLine : uint8_t { M, M2, M3, M4, M5, S, T, B, External };
inline constexpr uint32_t kFunctionLines = 9;
inline constexpr uint32_t kMostM = 5; // lines of M codes, the first ones

struct BitPlace {
  uint8_t byte = 0, bit = 0;
};

struct FunctionSignals {
  uint16_t code = 0;     // F
  uint8_t codeBytes = 0; // 0: no code is handed over
  BitPlace strobe;       // F; byte 0: the CNC has no such line
  BitPlace done;         // G, in the high-speed mode
};

// How an A bit leads to a message.
enum class MessageRule : uint8_t {
  ByBit,      // number 8·byte + bit + 1, shown while the bit is 1 (P57)
  ByTextList, // the number begins its text in the program; shown while the bit and the display (@DISPB) are 1
};

// Bits that the code of programs has as constants: in Z where the control has that area, otherwise in R.
struct ConstantRelays {
  uint32_t inR = 0, inZ = 0; // bytes
  uint8_t mask = 0;          // 0: none
};

struct Model {
  const SignalTable& (*signals)() = nullptr;
  std::array<FunctionSignals, kFunctionLines> functions = {}; // by FunctionLine
  std::span<const AxisCommand> axisCommands;
  std::span<const AxisGroup> axisGroups;
  std::span<const ServiceRow> services; // by ServiceKind, from 1
  int64_t windowRefused = 0;            // end code of a window request that no CNC answers
  ConstantRelays constants;
  bool inverted = false; // bits of overrides are 0 where the value's bit is 1
  MessageRule messages = MessageRule::ByBit;

  const ServiceRow& service(ServiceKind kind) const { return services[static_cast<size_t>(kind) - 1]; }
};

// The value of an override in percent, 0-254: 255 counts as 0, so that all bits 1 and all bits 0 stop (l.5701).
constexpr uint8_t overridePercent(const Model& model, uint8_t signals) {
  const auto percent = static_cast<uint8_t>(model.inverted ? ~signals : signals);
  return percent == 255 ? 0 : percent;
}

} // namespace rung::nc::pmc

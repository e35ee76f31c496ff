// PMC axis control, what the PLCs of the family have in common: commands, their block, and the signals of the groups
// that transfer them. Each dialect has its table of commands and of groups (DIALECT/axis_commands.h). Line numbers (l.)
// are of GSK's manual (Table 9-2, l.7713-7803; groups l.3332-3372, 7591-7629). Used by the compiler for checks and
// addresses, by the control to take blocks, and by the reference page.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc::pmc {

// Whether the CNC keeps the command in its buffer while another one runs.
enum class AxisBuffering : uint8_t {
  Buffered,  // unless EMCUF is 1
  Alone,     // always as if EMCUF were 1 (man. l.8002-8012)
  Immediate, // changes the running command with every EBUF, only ECLR ends it (man. l.7735, 7771-7803)
};

// Data 1 (two bytes) or data 2 (four bytes). Without `meaning` the field is not used.
struct AxisField {
  std::string_view meaning;
  std::string_view unit;
  int64_t min = 0;
  int64_t max = 0;
};

struct AxisCommand {
  uint8_t code = 0;
  std::string_view title;
  AxisBuffering buffering = AxisBuffering::Buffered;
  AxisField data1;
  AxisField data2;
  uint16_t line = 0;      // of Table 9-2; 0: another dialect
  uint16_t blockLine = 0; // of its data block
};

// Codes that have a name here.
enum AxisCode : uint8_t {
  kAxisRapid = 0,
  kAxisFeed = 1,
  kAxisFeedPerTurn = 2,
  kAxisSkip = 3,
  kAxisDwell = 4,
  kAxisManualReturn = 5,
  kAxisContinuous = 6,
  kAxisReference1 = 7,
  kAxisReference4 = 10,
  kAxisSpeed = 16,
  kAxisAux1 = 18,
  kAxisAux2 = 20,
  kAxisAux3 = 21,
  kAxisMachineCoordinate = 32,
};
constexpr bool isAxisReference(uint8_t code) { return code >= kAxisReference1 && code <= kAxisReference4; }

// Null for a code that is not in the table, whose rows are in the order of their codes.
const AxisCommand* findAxisCommand(std::span<const AxisCommand> table, uint64_t code);

// The block of the instruction (man. l.3290-3298).
inline constexpr uint32_t kAxisBlockBytes = 8;
inline constexpr uint32_t kAxisCommandAt = 1; // bit 7 is EMSBK (P51)
inline constexpr uint32_t kAxisData1At = 2;
inline constexpr uint32_t kAxisData2At = 4;
inline constexpr uint8_t kAxisCommandBits = 0x7F;

inline constexpr int64_t kAxisStop = -1; // as a command of ServiceKind::MoveAxis: stop the axis

// Byte addresses. The seven bytes from `command` are a program block: EC and EMSBK, EIF0-15, EID0-31.
struct AxisGroup {
  char letter = 'A';
  uint16_t control = 0;        // G: EBUF ECLR ESTP ESOF ESBK EMCUF ELCKZ EFIN
  uint16_t command = 0;        // G
  uint16_t status = 0;         // F: EBSY EOTN EOTP EGEN EDEN EIAL ECKZ EINP
  uint16_t strobes = 0;        // F: EMF3 EMF2 EABUF EMF in bits 3-0
  uint16_t code = 0;           // F: code of an auxiliary function
  uint16_t overrideCancel = 0; // G, bit 5; 0: the group has none
  uint16_t feedOverride = 0;   // G; 0: the group has none
  constexpr uint16_t data1() const { return static_cast<uint16_t>(command + 1); }
  constexpr uint16_t data2() const { return static_cast<uint16_t>(command + 3); }
};
inline constexpr uint32_t kMostAxisGroups = 8;

// Bits of the control byte.
inline constexpr uint8_t kEfinBit = 0, kElckzBit = 1, kEmcufBit = 2, kEsbkBit = 3, kEsofBit = 4, kEstpBit = 5,
                         kEclrBit = 6, kEbufBit = 7;
// Bits of the status byte.
inline constexpr uint8_t kEinpBit = 0, kEckzBit = 1, kEialBit = 2, kEdenBit = 3, kEgenBit = 4, kEotpBit = 5,
                         kEotnBit = 6, kEbsyBit = 7;
// Bits of the strobes.
inline constexpr uint8_t kEmfBit = 0, kEabufBit = 1, kEmf2Bit = 2, kEmf3Bit = 3;

} // namespace rung::nc::pmc

// PMC axis control, what the PLCs of the family have in common: commands, their block, and the signals of the groups
// that transfer them. Each dialect has its table of commands and of groups (DIALECT/axis_commands.h). Line numbers (l.)
// are of GSK's manual (Table 9-2, l.7713-7803; groups l.3332-3372, 7591-7629). Used by the compiler for checks and
// addresses, by the control to take blocks, and by the reference page.
#pragma once
#include <array>
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
  uint16_t line = 0;      // of Table 9-2
  uint16_t blockLine = 0; // of its data block
};

// Their codes.
enum AxisCode : uint8_t {
  kAxisRapid = 0,
  kAxisFeed = 1,
  kAxisFeedPerTurn = 2,
  kAxisSkip = 3,
  kAxisDwell = 4,
  kAxisManualReturn = 5,
  kAxisContinuous = 6,
  kAxisReference1 = 7,
  kAxisReference2 = 8,
  kAxisReference3 = 9,
  kAxisReference4 = 10,
  kAxisSpeed = 16,
  kAxisAux1 = 18,
  kAxisAux2 = 20,
  kAxisAux3 = 21,
  kAxisMachineCoordinate = 32,
};
constexpr bool isAxisReference(uint8_t code) { return code >= kAxisReference1 && code <= kAxisReference4; }

// What differs in the data of the commands.
struct AxisData {
  AxisField rapid;              // speed of a rapid movement
  std::string_view feedPerTurn; // units
  std::string_view length;
};

inline constexpr size_t kAxisCommands = 16;

// The commands of a control, in the order of their codes. Programs of FANUC machines have 5, 6 and 16 of them.
constexpr std::array<AxisCommand, kAxisCommands> axisCommandsWith(const AxisData& data) {
  using enum AxisBuffering;
  constexpr AxisField kNone = {};
  constexpr AxisField kFeed = {"feed", "mm/min or deg/min", 1, UINT16_MAX};
  constexpr AxisField kJogFeed = {"speed", "mm/min or deg/min", 1, UINT16_MAX};
  constexpr AxisField kTurns = {"speed", "r/min", INT16_MIN, INT16_MAX};
  constexpr AxisField kTime = {"time", "ms", 1, 9'999'999};
  constexpr AxisField kDirection = {"direction: 0 positive, 1 negative", "", 0, 1};
  constexpr AxisField kFunction = {"code of the auxiliary function", "", 0, UINT8_MAX};
  const AxisField feedPerTurn = {"feed", data.feedPerTurn, 1, UINT16_MAX};
  const AxisField distance = {"distance, incremental", data.length, INT32_MIN, INT32_MAX};
  const AxisField coordinate = {"machine coordinate", data.length, INT32_MIN, INT32_MAX};
  return {{
      {kAxisRapid, "rapid (G00)", Buffered, data.rapid, distance, 7714, 8293},
      {kAxisFeed, "cutting feed per minute (G94 G01)", Buffered, kFeed, distance, 7715, 8305},
      {kAxisFeedPerTurn, "cutting feed per revolution (G95 G01)", Buffered, feedPerTurn, distance, 7716, 8315},
      {kAxisSkip, "skip, feed per minute (G31 G01)", Alone, kFeed, distance, 7717, 8325},
      {kAxisDwell, "dwell (G04)", Buffered, kNone, kTime, 7718, 8335},
      {kAxisManualReturn, "manual reference point return", Alone, kNone, kNone, 7719, 8345},
      {kAxisContinuous, "continuous feed (JOG)", Immediate, kJogFeed, kDirection, 7722, 8397},
      {kAxisReference1, "reference point 1 (G28)", Alone, data.rapid, kNone, 7723, 8355},
      {kAxisReference2, "reference point 2 (G30 P2)", Alone, data.rapid, kNone, 7724, 8365},
      {kAxisReference3, "reference point 3 (G30 P3)", Alone, data.rapid, kNone, 7725, 8377},
      {kAxisReference4, "reference point 4 (G30 P4)", Alone, data.rapid, kNone, 7726, 8387},
      {kAxisSpeed, "speed command (M3 S)", Immediate, kTurns, kNone, 7727, 8407},
      {kAxisAux1, "auxiliary function 1", Buffered, kNone, kFunction, 7728, 8427},
      {kAxisAux2, "auxiliary function 2", Buffered, kNone, kFunction, 7729, 8442},
      {kAxisAux3, "auxiliary function 3", Buffered, kNone, kFunction, 7730, 8457},
      {kAxisMachineCoordinate, "machine coordinates (G53)", Alone, data.rapid, coordinate, 7731, 8472},
  }};
}

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

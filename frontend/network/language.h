// What a language of this family has of its own, as plain data: a dialect fills it in one place, and everything that
// reads, checks and converts its programs asks here.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/sema/foreign_word.h"
#include "frontend/table/instruction.h"
#include "ir/support/diagnostics.h"
#include "rtlib/nc/signal.h"

namespace rung::frontend::network {

// The row of an instruction of this family of languages: what reading, checking and converting a program ask of it.
// lower/lowered_row.h adds the lowering.

// Instructions that shape the program; everything else is Plain.
enum class Control : uint8_t { Plain, LevelEnd, Sp, Spe, Jmp, Jmpe, Jmpb, Jmpc, Lbl, Call, CallU, Com, Come };

constexpr bool isEnd(Control control) { return control == Control::LevelEnd || control == Control::Spe; }

struct Row {
  frontend::InstructionInfo info;
  Control control = Control::Plain;
  // Numbers of this class that appear twice in a program give a warning.
  enum class Numbers : uint8_t { Free, Timer, Counter, Edge } numbers = Numbers::Free;
  bool ignoresCondition = false; // one value before it is accepted, and has no effect
  bool hasTable = false;
  uint32_t recordBytes = 0; // of an operand of kind Record
  bool built = true;        // else it is known, and refused by name
};

// The statements of a list (P12). Declarations are allowed in lists as in ladder text, for conversions.
// clang-format off
enum class Command : uint8_t {
  Load, LoadNot, And, AndNot, Or, OrNot, OrBlock, AndBlock, Out, OutNot, Set, Reset, Function, Parameter, Table,
  Dialect, Symbol, Const
};
// clang-format on
inline constexpr size_t kCommandCount = 18;
constexpr bool isBlock(Command command) { return command == Command::OrBlock || command == Command::AndBlock; }
constexpr bool isLogic(Command command) { return command <= Command::AndBlock; }
constexpr bool isContact(Command command) { return isLogic(command) && !isBlock(command); }
constexpr bool isClosed(Command contact) {
  return contact == Command::LoadNot || contact == Command::AndNot || contact == Command::OrNot;
}
constexpr bool isCoil(Command command) { return command >= Command::Out && command <= Command::Reset; }
constexpr bool isDeclaration(Command command) { return command == Command::Symbol || command == Command::Const; }

// A place in Language::areas.
enum class Area : uint8_t {};

enum class AreaUse : uint8_t { Input, Output, Memory };

// The first `bytes` of `every` are set on the control's screen, and not by the program.
struct Presets {
  uint32_t bytes = 0;
  uint32_t every = 1;
};

struct AreaInfo {
  char letter;
  uint32_t bytes;
  AreaUse use = AreaUse::Memory;
  bool retained = false; // through power-off
  std::string_view doc;
  bool shown = false; // memory whose bits the control shows, or passes on
  Presets presets{};
  uint32_t system = UINT32_MAX; // from this byte on it belongs to the control
  std::string_view instead{};   // what is written where other languages have bits in an area of this letter

  // Whether what a coil writes is seen by others than contacts and functions.
  constexpr bool seenOutside() const { return use == AreaUse::Output || shown; }
};

// When a level runs (P3).
enum class Turn : uint8_t {
  EverySlot, // whole, in each slot, on the inputs as they are
  Parts,     // a part in each slot: the main program, to which a JMPC leads
  LastSlot,  // whole, in the slot of the main program's last part
};

// What the control runs by itself, without a call.
struct Level {
  std::string_view name; // of its task, and of its module in a ladder
  std::string_view end;  // the function that ends it in a list; its row is a Control::LevelEnd
  Turn turn = Turn::Parts;
  Diag endMissing{}; // reported of `end`
  Diag endTwice{};

  // Whether it sees the inputs as they were when it began.
  constexpr bool latchesInputs() const { return turn != Turn::EverySlot; }
};

struct Language {
  std::string_view name;                                // of the dialect
  std::string_view listExtension;                       // of a file with a command list
  std::array<std::string_view, kCommandCount> commands; // their names, by Command
  std::span<const Row* const> rows;
  std::span<const AreaInfo> areas;
  const nc::SignalTable& (*signals)(); // names that need no declaration
  std::span<const Level> levels;       // in the order of a list, which is that of a slot; one runs in Parts
  std::string_view subprogram;         // before the number in a `module` statement
  std::string_view messageTexts;       // where they are given, instead of by statements of a ladder
  uint32_t maxSteps = 0;               // commands, parameters and table rows of a program
  uint32_t stackDepth = 0;             // values in the stack register
  uint32_t maxCallDepth = 0;
  ladder::FindBox findBox = nullptr;
  std::span<const frontend::ForeignWord> foreign; // commands and functions of other languages

  constexpr std::string_view nameOf(Command command) const { return commands[static_cast<size_t>(command)]; }
  constexpr const AreaInfo& at(Area area) const { return areas[static_cast<size_t>(area)]; }
  // In any case; null when there is none, or it is not a function.
  const Row* findFunction(std::string_view mnemonic) const;
  const Row* findFunction(uint64_t number) const;
  // By its name, in any case.
  std::optional<uint32_t> findLevel(std::string_view levelName) const;
  // The place in `levels` of the one that runs in parts.
  uint32_t mainLevel() const;
  const Row& endOf(uint32_t level) const;
  // The level that a Control::LevelEnd ends.
  uint32_t levelOf(const Row& end) const;
  // The one that shapes the program so: not the end of a level.
  const Row& rowOf(Control control) const;
  std::string_view mnemonicOf(Control control) const { return rowOf(control).info.mnemonic; }
  // With its number, as a list names it: "END1 (FUNC 0)".
  std::string fullNameOf(const Row& row) const;
  // A label or a subprogram as the operand of its instruction is written.
  std::string numbered(Control control, int64_t number) const;
  // The letter that it begins with.
  char letterOf(Control control) const;
  // Of the functions that are so, with "or" between them.
  std::string mnemonicsOf(bool (*isSo)(const Row& row)) const;
};

} // namespace rung::frontend::network

// The program between reading and lowering: units of networks. Both source forms are converted to it; a network is what
// a command list can express (P11): contacts in postfix order, then at most one function, then coils.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/network/address.h"
#include "frontend/network/language.h"
#include "frontend/network/operand_kind.h"
#include "ir/support/source.h"

namespace rung::frontend::network {

// The parts of a program that are not commands, as its author wrote them. If a conversion needs them, the readers of
// both forms store them with the network or unit that follows.

// Comments are without their ';', blanks at their ends and control characters. The title of a network is one of the
// comments of its gap, as the rule of titles (read/drawn_comments.h) finds it.
struct Item {
  enum class Kind : uint8_t { Comment, Blank, Dialect, Symbol, Const, Message, Data, Section };
  Kind kind = Kind::Comment;
  std::string text = {};    // of a comment or a section; of a declaration its name, number or section
  std::string value = {};   // of a declaration
  std::string comment = {}; // after a statement
  SourceRange range = {};   // of the value of a declaration
};
constexpr bool isDeclaration(Item::Kind kind) { return kind >= Item::Kind::Symbol && kind <= Item::Kind::Data; }
using Gap = std::vector<Item>;

inline constexpr uint32_t kNone = UINT32_MAX;

// A command as its author wrote it, for conversions. In ladder form it is the meaning of a part of the drawing.
struct Written {
  Command command = Command::Load;
  std::string_view operand; // FUNC: the mnemonic
  SourceRange range;        // of the statement or the element; for PRM and TABLE of a box, of the operand
  uint32_t line = 0;
  std::vector<std::string> before = {}; // comment lines; those before the first command are in the network's gap
  std::string comment = {};             // the comment on the same line
};

enum class Logic : uint8_t { Load, And, Or, OrBlock, AndBlock };

enum class Contact : uint8_t { Open, Closed, Falling }; // Falling: 1 for one run after the bit has become 0

struct LogicStep {
  Logic kind = Logic::Load;
  Contact contact = Contact::Open;
  Address bit;
  uint32_t line = 0;
  SourceRange range; // of the statement or the element
};

enum class Coil : uint8_t { Out, OutInverted, Set, Reset }; // in the order of their commands

Command commandOf(Logic kind, Contact contact = Contact::Open);
// The effect of a logic command on the stack register.
Logic logicOf(Command command);
// Of those commands that are logic commands.
std::vector<Logic> logicOf(std::span<const Written> commands);
constexpr Command commandOf(Coil kind) {
  return static_cast<Command>(static_cast<uint8_t>(Command::Out) + static_cast<uint8_t>(kind));
}
constexpr Coil coilOf(Command command) {
  return static_cast<Coil>(static_cast<uint8_t>(command) - static_cast<uint8_t>(Command::Out));
}

struct CoilStep {
  Coil kind = Coil::Out;
  Address bit;
  uint32_t line = 0;
  SourceRange range; // of the statement or the element
};

struct Param {
  const OperandKind* kind = nullptr;
  bool isAddress = false;
  bool bad = false; // an error was reported
  Address address;
  uint32_t bytes = 1; // from the address on; for a data table everything that could belong to it
  frontend::Access access = frontend::Access::None; // of the address
  int64_t value = 0;                                // constant, number, mask, label, subprogram, format as a00n
  SourceRange range;
};

// A function command with checked parameters.
struct Function {
  const Row* row = nullptr; // null: the network has none
  std::vector<Param> params;
  std::vector<int64_t> table;
  uint32_t length = 1; // in bytes, from the format
  uint32_t count = 1;  // of elements or bytes, from the format
  SourceRange range;
  uint32_t line = 0;
};

struct Network {
  FileId file;
  uint32_t firstLine = 0;
  uint32_t lastLine = 0;
  SourceRange range; // of its first command or its drawing
  std::string_view title;
  std::vector<LogicStep> logic;
  Function function;
  std::vector<CoilStep> coils;
  // What its author wrote, if Context::gaps are kept.
  Gap gap; // before it
  std::vector<Written> written;
  uint32_t steps = 0;
  bool bad = false;        // an error was reported; it is never lowered
  bool incomplete = false; // its error may hide a function command

  // Set by analyse(): indices of networks in the unit, of a unit in the program.
  uint32_t target = kNone;
  uint32_t callee = kNone;
  uint32_t com = kNone; // the COM network whose region contains this one
};

// The value of the condition of its function with this index, if that is a single contact of a bit that the control
// holds constant. Its other conditions may be anything.
std::optional<bool> constantCondition(const Language& language, const Network& network, size_t condition);

// The control type of its function.
inline Control controlOf(const Network& network) {
  return network.function.row == nullptr ? Control::Plain : network.function.row->control;
}

enum class UnitKind : uint8_t { Level, Subprogram };

struct Unit {
  UnitKind kind = UnitKind::Level;
  uint32_t number = 0;           // of a subprogram; for a level, its index in Language::levels
  SourceRange range;             // of the statement that opens the unit
  SourceRange nameRange;         // subprograms: the operand of SP
  std::vector<Network> networks; // the last one is the unit's end: that of the level, or SPE
  // What its author wrote, if Context::gaps are kept.
  Gap lead;                       // before `module`; in a list, before the end of the preceding level, or before SP
  std::string comment;            // the comment on the same line
  std::vector<Written> condition; // before SP, without effect (P13)
  // Set by analyse().
  std::vector<bool> runBy; // by level: whether it runs the unit
  bool leaves = false;     // a JMPC can leave it for the main program
};
inline std::span<const Network> withoutEnd(const Unit& unit) {
  return std::span(unit.networks).first(unit.networks.size() - 1);
}
// "LEVEL1", "LEVEL2", "P5".
std::string nameOf(const Language& language, const Unit& unit);

struct Program {
  explicit Program(const Language& language);

  std::vector<Unit> units;           // the levels by their index in the language, then subprograms
  std::vector<uint32_t> jumpTargets; // targets of JMPC in the main program; Network::target is an index here
};

// The network as a command list, one command per line, operands without leading zeros: the text from which keys are
// made.
std::string commandText(const Language& language, const Network& network);
// The identity of an instruction while its network changes: mnemonic and parameters; for a timer, a counter or an edge
// only its number.
std::string identityOf(const Language& language, const SourceManager& sources, const Function& function);

} // namespace rung::frontend::network

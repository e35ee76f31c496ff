// The properties of a language of this family, as plain data: a dialect defines them in one place, and all code that
// reads, checks and converts its programs uses them.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "frontend/ladder/text/ladder_file.h"
#include "frontend/sema/foreign_word.h"
#include "frontend/table/instruction.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diagnostics.h"
#include "rtlib/nc/signal.h"

namespace rung::frontend::network {

// The row of an instruction of this family of languages: its properties for reading, checking and converting programs.
// lower/lowered_row.h adds the lowering.

// Instructions that shape the program; everything else is Plain.
enum class Control : uint8_t {
  Plain,
  LevelEnd,
  Sp,
  Spe,
  Jmp,
  Jmpe,
  Jmpb,
  Jmpc,
  Lbl,
  Call,
  CallU,
  Com,
  Come,
  ProgramEnd, // after the last subprogram
};

constexpr bool isEnd(Control control) { return control == Control::LevelEnd || control == Control::Spe; }

struct Address;
struct Context;
struct Item;
struct Language;
struct Network;
struct Written;
class UnitAssembler;

// An index in Language::areas.
enum class Area : uint8_t {};

struct Row {
  frontend::InstructionInfo info;
  Control control = Control::Plain;
  // A number of this class that is used twice in a program gives a warning.
  enum class Numbers : uint8_t { Free, Timer, Counter, Edge } numbers = Numbers::Free;
  // The memory of its numbers, if a control has as many of them as its area has room for.
  struct Places {
    Area area{};
    uint32_t first = 0; // byte
    uint32_t bytes = 0; // of each number; 0: the numbers have no memory in an area
  } places;
  bool ignoresCondition = false; // one value before it is accepted, and has no effect
  bool hasTable = false;
  int64_t mostRow = -1;     // the highest number of such a row, the lowest is 0; -1: what fits the format
  uint8_t capacityAt = 1;   // of a row with a table: the parameter that is the number of its rows, 0 for 100
  uint32_t recordBytes = 0; // for an operand of kind Record
  bool built = true;        // otherwise it is known, and refused by name
  // Reports what is wrong although the kinds and ranges of the operands are right; may be null.
  void (*check)(Context& context, const Network& network) = nullptr;
  int8_t direction = -1; // the condition that is 0 to read a table and 1 to write it; what is read may be an input
  int8_t wide = 0;       // of a row with BCD numbers: the condition that is 0 for one byte and 1 for two
};

// The statements of a list (P12). Declarations are allowed in lists as in ladder text, for conversions.
// clang-format off
enum class Command : uint8_t {
  Load, LoadNot, And, AndNot, Or, OrNot, LoadFalling, OrBlock, AndBlock, Out, OutNot, Set, Reset, Function, Parameter, Table,
  Dialect, Symbol, Const
};
// clang-format on
inline constexpr size_t kCommandCount = 19;
constexpr bool isBlock(Command command) { return command == Command::OrBlock || command == Command::AndBlock; }
constexpr bool isLogic(Command command) { return command <= Command::AndBlock; }
constexpr bool isContact(Command command) { return isLogic(command) && !isBlock(command); }
constexpr bool isClosed(Command contact) {
  return contact == Command::LoadNot || contact == Command::AndNot || contact == Command::OrNot;
}
constexpr bool isCoil(Command command) { return command >= Command::Out && command <= Command::Reset; }
constexpr bool isDeclaration(Command command) { return command == Command::Symbol || command == Command::Const; }

enum class AreaUse : uint8_t { Input, Output, Memory };

// The first `bytes` of each group of `every` bytes are set on the control's screen, and not by the program.
struct Presets {
  uint32_t bytes = 0;
  uint32_t every = 1;
};

// Bytes `first` to `last` of an area.
struct ByteRange {
  uint32_t first = 0;
  uint32_t last = 0;
};

struct AreaInfo {
  char letter;
  uint32_t bytes; // 0: the control does not have the area
  AreaUse use = AreaUse::Memory;
  bool retained = false; // through power-off
  std::string_view doc;
  bool shown = false; // memory whose bits the control displays or passes on
  Presets presets{};
  uint32_t readOnly = UINT32_MAX;     // bytes from this one on are written by the control alone
  uint32_t system = UINT32_MAX;       // bytes from this one on belong to the control
  bool shared = false;                // with the other programs of the control
  std::string_view instead{};         // what to write instead, for a letter that other languages use for bits
  std::span<const ByteRange> parts{}; // the bytes that exist, ascending; empty: all

  // Whether what a coil writes is visible outside of contacts and functions.
  constexpr bool seenOutside() const { return use == AreaUse::Output || shown; }
  // Whether others than the program may read and write a byte.
  constexpr bool isUsedOutside(uint32_t byte) const { return shared || byte >= system; }
  // The number of bytes from `byte` to the end of its part; 0 if it does not exist.
  constexpr uint32_t room(uint64_t byte) const {
    if (parts.empty()) return byte < bytes ? bytes - static_cast<uint32_t>(byte) : 0;
    for (const ByteRange& part : parts)
      if (byte >= part.first && byte <= part.last) return part.last + 1 - static_cast<uint32_t>(byte);
    return 0;
  }
};

// When a level runs (P3).
enum class Turn : uint8_t {
  EverySlot, // completely, in each slot, with the present inputs
  Parts,     // one part in each slot: the main program, to which a JMPC leads
  LastSlot,  // completely, in the slot of the main program's last part
};

// A part of a program that the control runs without a call.
struct Level {
  std::string_view name; // of its task, and of its module in a ladder
  std::string_view end;  // the function that ends it in a list; its row is a Control::LevelEnd
  Turn turn = Turn::Parts;
  Diag endMissing{}; // reported if `end` is missing
  Diag endTwice{};
  bool optional = false; // a list need not have it

  // Whether it uses the inputs as they were at its beginning.
  constexpr bool latchesInputs() const { return turn != Turn::EverySlot; }
};

// A list that its form has opened.
class ListFile {
public:
  explicit ListFile(FileId file) : file_(file) {}
  virtual ~ListFile() = default;
  FileId file() const { return file_; }
  // Declarations apply to the whole program and are read from all files first.
  virtual void readDeclarations(Context& context) const = 0;
  virtual void read(Context& context, UnitAssembler& units) const = 0;

private:
  FileId file_;
};

// How lists of a language are read, formatted and written.
struct ListForm {
  std::shared_ptr<const ListFile> (*open)(const SourceManager& sources, FileId file);
  // A formatted list; nothing after errors, which are reported.
  std::optional<std::string> (*format)(const Language& language, SourceManager& sources, FileId file,
                                       Diagnostics& diagnostics);
  // The line of a command; `begins`: it is the first one of its network.
  std::string (*command)(const Language& language, const Written& command, bool begins);
  size_t commentColumn = 0;   // of the comments after commands
  bool blockComments = false; // comments between networks are in (* *), over lines
  // Of files with sections, in which declarations are: a file with the comments of `head` and these declarations around
  // its ladder. Null: lists have their declarations as statements.
  std::string (*frame)(std::span<const Item> head, std::span<const Item> declarations,
                       std::string_view ladder) = nullptr;
  // Declares a name as such a section does, from ladder text. Null: Names::addSymbol.
  void (*addSymbol)(Context& context, const frontend::Word& name, const frontend::Word& place,
                    std::string_view comment) = nullptr;
};

struct Language {
  std::string_view name;                            // of the dialect
  std::span<const std::string_view> listExtensions; // of files with command lists; the first one is written
  const ListForm& list;
  std::array<std::string_view, kCommandCount> commands; // names of the commands, by Command; "" for one it lacks
  std::span<const Row* const> rows;
  std::span<const AreaInfo> areas;
  const nc::SignalTable& (*signals)(); // names that need no declaration
  std::span<const Level> levels;       // in the order of a list, which is that of a slot; exactly one runs in Parts
  std::string_view subprogram;         // before the number in a `module` statement
  std::string_view emptyNote{};        // on a program without any command
  std::string_view messageTexts;       // a note on where they are configured, if not by statements of a ladder
  uint32_t maxSteps = 0;               // most commands, parameters and table rows of a program
  uint32_t stackDepth = 0;             // number of values in the stack register
  uint32_t maxCallDepth = 0;
  ladder::FindBox findBox = nullptr;
  std::span<const frontend::ForeignWord> foreign; // commands and functions of other languages
  // The highest number of a timer, a counter, an edge, a label or a subprogram of this row, if the row has no places;
  // null: that of the row.
  int64_t (*mostNumber)(const Language& language, const Row& row) = nullptr;
  std::string_view nameMarks{}; // characters of names beside letters, digits and _; if any, a name may begin with all
  bool namesIgnoreCase = false;
  bool hexadecimal = true;            // constants may be hexadecimal: 0x1F
  bool dummyCoils = false;            // one bit of memory is the coil of all outputs that nothing needs
  bool cutsConstants = false;         // of one that is too large for its length the low bytes count, with a warning
  Diag undeclared = diag::BadOperand; // reported for a name that is not declared
  bool needsProgramEnd = true;        // if it has an end of the program
  bool calledByNumber = false;        // how a function is named in advice: SUB 1, not FUNC END1
  // The value of a bit that the control holds constant, nothing for any other bit; null: no bit is constant.
  std::optional<bool> (*constantOf)(const Language& language, const Address& address) = nullptr;

  // Whether a file of this name is a command list.
  bool isList(std::string_view fileName) const;

  constexpr std::string_view nameOf(Command command) const { return commands[static_cast<size_t>(command)]; }
  constexpr const AreaInfo& at(Area area) const { return areas[static_cast<size_t>(area)]; }
  // Ignoring case; null for a word or number that is not that of a function.
  const Row* findFunction(std::string_view mnemonic) const;
  const Row* findFunction(uint64_t number) const;
  // Whether the language can compile it: a basic instruction, or a row that is built.
  bool isBuilt(const frontend::InstructionInfo& info) const;
  // By its name, ignoring case.
  std::optional<uint32_t> findLevel(std::string_view levelName) const;
  // The index in `levels` of the one that runs in parts.
  uint32_t mainLevel() const;
  const Row& endOf(uint32_t level) const;
  // The level that a Control::LevelEnd ends.
  uint32_t levelOf(const Row& end) const;
  // The row that shapes the program in this way, other than the end of a level; null if the language has none.
  const Row* findRowOf(Control control) const;
  // The same, of a row that the language has.
  const Row& rowOf(Control control) const;
  std::string_view mnemonicOf(Control control) const { return rowOf(control).info.mnemonic; }
  // With its number, as in a list: "END1 (FUNC 0)".
  std::string fullNameOf(const Row& row) const;
  // How a list calls it: "FUNC END1", "SUB 1".
  std::string callOf(const Row& row) const;
  // A label or a subprogram as an operand of its instruction.
  std::string numbered(Control control, int64_t number) const;
  // The letter with which it begins.
  char letterOf(Control control) const;
  // The mnemonics of the functions for which isSo holds, with "or" between them.
  std::string mnemonicsOf(bool (*isSo)(const Row& row)) const;
};

} // namespace rung::frontend::network

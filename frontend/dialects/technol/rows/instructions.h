// The table of TECHNOL: a row is the reference's InstructionInfo, what the statement is to the structure of a program
// (Role), what it does to the registers as far as it shows without its operands (Effect), what is checked beyond the
// kinds of its operands, and its lowering function. A new instruction is one row, one lowering function (often shared,
// distinguished by `variant`), one scenario.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "frontend/sema/foreign_word.h"
#include "frontend/table/instruction.h"

namespace rung::frontend::technol {

class Lowering;
struct CheckContext;
struct Operand;

enum class Role : uint8_t {
  Code,      // lowered where it is
  NoCode,    // accepted, does nothing
  Module,    // variant: ModuleKind
  ModuleEnd, // variant: ModuleKind
  Local,     // DATA_LOCAL
  LocalEnd,
  Stop,
  Dfm,
  Ds,
  Str,
  Equi,
  MemberSize, // DB DW DD DQ inside a structure; variant: bytes
  MechBegin,
  MechEnd,
  ProcBegin,
  ProcEnd,
  Timed,      // DFTMxx; variant: TimedKind
  Macro,      // DEF_T_MACRO and its like
  MacroBegin, // made by the use of a macro that has its own effect on the stack; variant: MacroStack
  MacroEnd,
};

enum Effect : uint16_t {
  kReadsRlo = 1,
  kSetsRlo = 2,
  kReadsDr = 4,
  kSetsDr = 8,
  kPushes = 16, // stores RLO when an equation is open (LDR)
  kJoins = 32,  // without operand: joins with the stored value
  kWaits = 64,  // of EX kind
  kJumps = 128,
  kKeepsDr = 256, // EX kind: DR is still there when it passes; else: it stays where there is nothing to put there
  kInitOnly = 512,
  kEndsInit = 1024,
  kEndsDone = 2048,
  kDeclares = 4096,     // its first operand names a variable that it declares; variant: nc::ExchangeKind
  kDrIfNotGiven = 8192, // kReadsDr holds only without the first operand that may be left out
};

using CheckFn = void (*)(const CheckContext& context, std::span<const Operand> operands, int variant);
using LowerFn = void (*)(Lowering& context, std::span<const Operand> operands, int variant);

struct Row {
  InstructionInfo info;
  Role role = Role::Code;
  uint16_t effects = 0;
  CheckFn check = nullptr; // of operands that are right each by itself
  LowerFn lower = nullptr;
  int variant = 0;
};

std::span<const Row> allRows();
// The same rows for the reference.
std::span<const InstructionInfo* const> instructionInfos();
// By mnemonic in any case, JLO for JL0; null when there is none. Mnemonics that only have a meaning as a service are
// rows too.
const Row* findRow(std::string_view mnemonic);

// How a name that is also a mnemonic, keyword or register may be used as a symbol (§1 of the inventory).
enum class Reserved : uint8_t { No, Warn, Yes };
Reserved reservedWord(std::string_view name);
bool isAssembler(std::string_view name);
// An instruction of another language, and what is written for it here; null when it is none of those that are known.
const ForeignWord* foreignWord(std::string_view word);

enum class ModuleKind : uint8_t {
  Data,
  Input,
  BlockInit,
  BlockDone,
  Main,
  Init,
  Clear,
  Halt,
  Done,
  Fast,
  Cont,
  Fastest,
  Cyclic,
};
inline constexpr int kModuleKinds = 13;
// Those that run every millisecond.
constexpr bool isFast(ModuleKind kind) {
  return kind == ModuleKind::Fast || kind == ModuleKind::Fastest || kind == ModuleKind::Cyclic;
}
// "MODULE_MAIN"
std::string_view moduleName(ModuleKind kind);

enum class TimedKind : uint8_t { Tenth, Second, TenSeconds, HundredSeconds };

} // namespace rung::frontend::technol

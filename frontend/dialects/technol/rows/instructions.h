// The table of TECHNOL: a row has the reference's InstructionInfo, the statement's part in the structure of a program
// (Role), its effect on the registers as far as that does not depend on its operands (Effect), the check beyond the
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
  Code,      // lowered in place
  NoCode,    // accepted, without effect
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
  Macro,      // DEF_T_MACRO and similar ones
  MacroBegin, // made by the use of a macro that declares its effect on the stack; variant: MacroStack
  MacroEnd,
};

enum Effect : uint16_t {
  kReadsRlo = 1,
  kSetsRlo = 2,
  kReadsDr = 4,
  kSetsDr = 8,
  kPushes = 16, // pushes RLO if an equation is open (LDR)
  kJoins = 32,  // without operand: combines with the pushed value
  kWaits = 64,  // of EX kind
  kJumps = 128,
  kKeepsDr = 256, // EX kind: DR is preserved when it passes; otherwise: preserved if there is nothing to store in it
  kInitOnly = 512,
  kEndsInit = 1024,
  kEndsDone = 2048,
  kDeclares = 4096,     // its first operand names a variable that it declares; variant: nc::ExchangeKind
  kDrIfNotGiven = 8192, // kReadsDr applies only without the first operand that may be left out
};

using CheckFn = void (*)(const CheckContext& context, std::span<const Operand> operands, int variant);
using LowerFn = void (*)(Lowering& context, std::span<const Operand> operands, int variant);

struct Row {
  InstructionInfo info;
  Role role = Role::Code;
  uint16_t effects = 0;
  CheckFn check = nullptr; // of operands that are each right by themselves
  LowerFn lower = nullptr;
  int variant = 0;
};

std::span<const Row> allRows();
// The same rows for the reference.
std::span<const InstructionInfo* const> instructionInfos();
// By mnemonic, ignoring case, JLO for JL0; null if there is none. Mnemonics that are only services are rows, too.
const Row* findRow(std::string_view mnemonic);

// How a name that is also a mnemonic, keyword or register may be used as a symbol (§1 of the inventory).
enum class Reserved : uint8_t { No, Warn, Yes };
Reserved reservedWord(std::string_view name);
bool isAssembler(std::string_view name);
// An instruction of another language, with its equivalent; null if it is unknown.
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
// Modules that run every millisecond.
constexpr bool isFast(ModuleKind kind) {
  return kind == ModuleKind::Fast || kind == ModuleKind::Fastest || kind == ModuleKind::Cyclic;
}
// "MODULE_MAIN"
std::string_view moduleName(ModuleKind kind);

enum class TimedKind : uint8_t { Tenth, Second, TenSeconds, HundredSeconds };

} // namespace rung::frontend::technol

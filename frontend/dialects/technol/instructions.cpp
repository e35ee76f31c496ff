// The instructions of TECHNOL (see instructions.h). Mnemonics, operands and lines of the manual are those of instructions.csv.
#include "frontend/dialects/technol/instructions.h"

#include <algorithm>
#include <array>

#include "frontend/dialects/technol/host_cells.h"
#include "frontend/dialects/technol/lexer.h"
#include "frontend/dialects/technol/lower.h"

namespace rung::frontend::technol {
namespace {

constexpr Row moduleRow(std::string_view name, ModuleKind kind, std::string_view ref, std::string_view doc) {
  return {.info = {.mnemonic = name, .title = "module", .group = "module", .ref = ref, .doc = doc}, .role = Role::Module, .variant = static_cast<int>(kind)};
}
constexpr Row moduleEndRow(std::string_view name, ModuleKind kind, std::string_view ref) {
  return {.info = {.mnemonic = name, .title = "end of a module", .group = "module", .ref = ref, .doc = "Ends the module."}, .role = Role::ModuleEnd, .variant = static_cast<int>(kind)};
}

constexpr Row kRows[] = {
    // ---- modules (man. ch. 5.1) --------------------------------------------------------------------------------------
    moduleRow("DATA", ModuleKind::Data, "5.1, l.2470", "Declarations, known in all files."),
    moduleEndRow("DATA_END", ModuleKind::Data, "5.1, l.2472"),
    moduleRow("MODULE_INPUT", ModuleKind::Input, "5.1, l.2501", "Runs first in every cycle."),
    moduleEndRow("MODULE_INPUT_END", ModuleKind::Input, "5.1, l.2503"),
    moduleRow("MODULE_BLOCK_INIT", ModuleKind::BlockInit, "5.1, l.2510", "Runs after the start of an NC block; may wait."),
    moduleEndRow("MODULE_BLOCK_INIT_END", ModuleKind::BlockInit, "5.1, l.2512"),
    moduleRow("MODULE_BLOCK_DONE", ModuleKind::BlockDone, "5.1, l.2530", "Runs at the end of an NC block; may wait."),
    moduleEndRow("MODULE_BLOCK_DONE_END", ModuleKind::BlockDone, "5.1, l.2532"),
    moduleRow("MODULE_MAIN", ModuleKind::Main, "5.1, l.2544", "Runs in every cycle; the parts of further files follow in their order."),
    moduleEndRow("MODULE_MAIN_END", ModuleKind::Main, "5.1, l.2546"),
    moduleRow("MODULE_INIT", ModuleKind::Init, "5.1, l.2556", "Runs once at every start of the PLC."),
    moduleEndRow("MODULE_INIT_END", ModuleKind::Init, "5.1, l.2558"),
    moduleRow("MODULE_CLEAR", ModuleKind::Clear, "5.1, l.2641", "Runs once at the command to clear the PLC."),
    moduleEndRow("MODULE_CLEAR_END", ModuleKind::Clear, "5.1, l.2643"),
    moduleRow("MODULE_HALT", ModuleKind::Halt, "5.1, l.2651", "Runs once after a serious fault."),
    moduleEndRow("MODULE_HALT_END", ModuleKind::Halt, "5.1, l.2653"),
    moduleRow("MODULE_DONE", ModuleKind::Done, "5.1, l.2602", "Runs once at the stop of the PLC."),
    moduleEndRow("MODULE_DONE_END", ModuleKind::Done, "5.1, l.2604"),
    moduleRow("MODULE_FAST", ModuleKind::Fast, "5.1, l.2660", "Runs every millisecond."),
    moduleEndRow("MODULE_FAST_END", ModuleKind::Fast, "5.1, l.2662"),
    moduleRow("MODULE_CONT", ModuleKind::Cont, "5.1, l.2671", "Runs last in every cycle."),
    moduleEndRow("MODULE_CONT_END", ModuleKind::Cont, "5.1, l.2673"),
    moduleRow("MODULE_FASTEST", ModuleKind::Fastest, "5.1, l.13481", "Runs at the fastest period, at most every millisecond."),
    moduleEndRow("MODULE_FASTEST_END", ModuleKind::Fastest, "5.1, l.13483"),
    moduleRow("MODULE_CYCLICOPERATION", ModuleKind::Cyclic, "5.1, l.13466", "Runs every millisecond in front of MODULE_FAST."),
    moduleEndRow("MODULE_CYCLICOPERATION_END", ModuleKind::Cyclic, "5.1, l.13468"),
    {.info = {.mnemonic = "DATA_LOCAL", .title = "local data", .group = "module", .ref = "5.1, l.2485",
              .doc = "Declarations known in this file only; may stand in other modules."}, .role = Role::Local},
    {.info = {.mnemonic = "DATA_LOCAL_END", .title = "end of local data", .group = "module", .ref = "5.1, l.2487",
              .doc = "Ends DATA_LOCAL."}, .role = Role::LocalEnd},
    {.info = {.mnemonic = "STOP", .title = "end of the program", .group = "module", .ref = "5.1, l.2337",
              .doc = "Stands behind the last module of the main file; what follows is not read."}, .role = Role::Stop},

    // ---- bit logic (man. ch. 3.5-3.7) -----------------------------------------------------------------------------
    {.info = {.mnemonic = "LDR", .title = "load a bit", .group = "bit logic",
              .operands = {OperandInfo{.name = "bit", .kind = "bit", .doc = "what RLO becomes"}},
              .ref = "3.5, l.174", .doc = "RLO becomes the bit. Where an equation is open already, RLO is stored on the stack first.",
              .example = "LDR  A1\nLA   -B1\nWR   OUT1"}, .effects = kPushes | kSetsRlo, .lower = lowerLoadBit},
    {.info = {.mnemonic = "LA", .title = "and", .group = "bit logic",
              .operands = {OperandInfo{.name = "bit", .kind = "bit", .doc = "joined with RLO; without it the value stored last", .optional = true}},
              .ref = "3.6, l.250", .doc = "RLO becomes RLO AND the bit. Without an operand it takes the value stored last off the stack and joins that.",
              .example = "LA  A2"}, .effects = kJoins | kSetsRlo | kReadsRlo, .lower = lowerJoin, .variant = kAnd},
    {.info = {.mnemonic = "LO", .title = "or", .group = "bit logic",
              .operands = {OperandInfo{.name = "bit", .kind = "bit", .doc = "joined with RLO; without it the value stored last", .optional = true}},
              .ref = "3.6, l.251", .doc = "RLO becomes RLO OR the bit. Without an operand it takes the value stored last off the stack and joins that.",
              .example = "LO  A2"}, .effects = kJoins | kSetsRlo | kReadsRlo, .lower = lowerJoin, .variant = kOr},
    {.info = {.mnemonic = "LX", .title = "exclusive or", .group = "bit logic",
              .operands = {OperandInfo{.name = "bit", .kind = "bit", .doc = "joined with RLO; without it the value stored last", .optional = true}},
              .ref = "3.6, l.252", .doc = "RLO becomes RLO EXCLUSIVE OR the bit. Without an operand it takes the value stored last off the stack and joins that.",
              .example = "LX  A2"}, .effects = kJoins | kSetsRlo | kReadsRlo, .lower = lowerJoin, .variant = kXor},
    {.info = {.mnemonic = "CA", .title = "complement", .group = "bit logic",
              .ref = "3.6, l.281", .doc = "RLO becomes NOT RLO."}, .effects = kReadsRlo | kSetsRlo, .lower = lowerComplement},
    {.info = {.mnemonic = "EDGE_H", .title = "rising edge", .group = "bit logic",
              .operands = {OperandInfo{.name = "bit", .kind = "plain bit", .doc = "the bit that is watched"}}, .stateful = true,
              .ref = "3.6, l.288", .doc = "RLO is 1 in the run in which the bit goes from 0 to 1, else 0. The first run after a start only takes the bit over."}, .effects = kSetsRlo, .lower = lowerEdge, .variant = 1},
    {.info = {.mnemonic = "EDGE_L", .title = "falling edge", .group = "bit logic",
              .operands = {OperandInfo{.name = "bit", .kind = "plain bit", .doc = "the bit that is watched"}}, .stateful = true,
              .ref = "3.6, l.289", .doc = "RLO is 1 in the run in which the bit goes from 1 to 0, else 0. The first run after a start only takes the bit over."}, .effects = kSetsRlo, .lower = lowerEdge, .variant = 0},
    {.info = {.mnemonic = "CHECK", .title = "check of the stack", .group = "bit logic",
              .ref = "3.6, l.232", .doc = "The compiler checks here that nothing is left on the stack."}, .lower = lowerCheck},
    {.info = {.mnemonic = "WR", .title = "write", .group = "bit write",
              .operands = {OperandInfo{.name = "bit", .kind = "plain bit", .access = Access::Write, .doc = "becomes RLO", .repeated = true}}, .terminating = true,
              .ref = "3.7, l.380", .doc = "Each bit becomes RLO; RLO and DR stay."}, .effects = kReadsRlo, .lower = lowerWrite},
    {.info = {.mnemonic = "FL", .title = "set or clear", .group = "bit write",
              .operands = {OperandInfo{.name = "value", .kind = "flag", .doc = "0 or 1", .min = 0, .max = 1}, OperandInfo{.name = "bit", .kind = "plain bit", .access = Access::Write, .doc = "becomes the value", .repeated = true}},
              .ref = "3.7, l.396", .doc = "Each bit becomes 0 or 1, whatever RLO is.",
              .example = "FL   1,LAMP,PUMP"}, .lower = lowerFlag, .variant = kAlways},
    {.info = {.mnemonic = "FL1", .title = "set or clear if RLO", .group = "bit write",
              .operands = {OperandInfo{.name = "value", .kind = "flag", .doc = "0 or 1", .min = 0, .max = 1}, OperandInfo{.name = "bit", .kind = "plain bit", .access = Access::Write, .doc = "becomes the value", .repeated = true}}, .terminating = true,
              .ref = "3.7, l.420", .doc = "As FL, but only while RLO is 1."}, .effects = kReadsRlo, .lower = lowerFlag, .variant = kIfRlo},
    {.info = {.mnemonic = "MOVR", .title = "move a bit", .group = "bit write",
              .operands = {OperandInfo{.name = "dst", .kind = "plain bit", .access = Access::Write, .doc = "becomes the source"}, OperandInfo{.name = "src", .kind = "bit", .doc = "is read"}},
              .ref = "3.7, l.447", .doc = "One bit becomes another; RLO and DR stay."}, .lower = lowerMoveBit, .variant = kAlways},
    {.info = {.mnemonic = "MOVR1", .title = "move a bit if RLO", .group = "bit write",
              .operands = {OperandInfo{.name = "dst", .kind = "plain bit", .access = Access::Write, .doc = "becomes the source"}, OperandInfo{.name = "src", .kind = "bit", .doc = "is read"}}, .terminating = true,
              .ref = "3.7, l.448", .doc = "As MOVR, but only while RLO is 1."}, .effects = kReadsRlo, .lower = lowerMoveBit, .variant = kIfRlo},

    // ---- jumps (man. ch. 3.8) -------------------------------------------------------------------------------------
    {.info = {.mnemonic = "JUM", .title = "jump", .group = "jump",
              .operands = {OperandInfo{.name = "adr", .kind = "label", .doc = "where control goes"}},
              .ref = "3.8, l.484", .doc = "Control goes to the label, which stands in the same unit."}, .effects = kJumps, .lower = lowerJump, .variant = kAlways},
    {.info = {.mnemonic = "JL0", .title = "jump if 0", .group = "jump",
              .operands = {OperandInfo{.name = "adr", .kind = "label", .doc = "where control goes"}}, .terminating = true,
              .ref = "3.8, l.485", .doc = "Control goes to the label when RLO is 0."}, .effects = kJumps | kReadsRlo, .lower = lowerJump, .variant = kIfNotRlo},
    {.info = {.mnemonic = "JL1", .title = "jump if 1", .group = "jump",
              .operands = {OperandInfo{.name = "adr", .kind = "label", .doc = "where control goes"}}, .terminating = true,
              .ref = "3.8, l.486", .doc = "Control goes to the label when RLO is 1."}, .effects = kJumps | kReadsRlo, .lower = lowerJump, .variant = kIfRlo},

    // ---- load and store (man. ch. 3.10) ---------------------------------------------------------------------------
    {.info = {.mnemonic = "LOD", .title = "load", .group = "data",
              .operands = {OperandInfo{.name = "val", .kind = "signed value", .doc = "is loaded"}},
              .ref = "3.10, l.673", .doc = "DR becomes the value, sign-extended to 64 bits. With REAL. or a real constant DR_REAL becomes it, and DR its integer.",
              .example = "LOD  WORD.SPEED\nLOD  -CNST.5"}, .effects = kSetsDr, .lower = lowerLoad},
    {.info = {.mnemonic = "STO", .title = "store", .group = "data",
              .operands = {OperandInfo{.name = "val", .kind = "cell", .access = Access::Write, .doc = "becomes DR"}},
              .ref = "3.10, l.740", .doc = "The cell becomes the low bits of DR; with REAL. it becomes DR_REAL."}, .effects = kReadsDr, .lower = lowerStore, .variant = kAlways},
    {.info = {.mnemonic = "STO1", .title = "store if 1", .group = "data",
              .operands = {OperandInfo{.name = "val", .kind = "cell", .access = Access::Write, .doc = "becomes DR"}}, .terminating = true,
              .ref = "3.10, l.771", .doc = "As STO, but only while RLO is 1."}, .effects = kReadsDr | kReadsRlo, .lower = lowerStore, .variant = kIfRlo},
    {.info = {.mnemonic = "STO0", .title = "store if 0", .group = "data",
              .operands = {OperandInfo{.name = "val", .kind = "cell", .access = Access::Write, .doc = "becomes DR"}}, .terminating = true,
              .ref = "3.10, l.783", .doc = "As STO, but only while RLO is 0."}, .effects = kReadsDr | kReadsRlo, .lower = lowerStore, .variant = kIfNotRlo},
    {.info = {.mnemonic = "MOVE", .title = "move", .group = "data",
              .operands = {OperandInfo{.name = "dst", .kind = "cell", .access = Access::Write, .doc = "becomes the source"}, OperandInfo{.name = "src", .kind = "cell", .doc = "is read"}},
              .ref = "3.10, l.795", .doc = "One cell becomes another of the same type; RLO and DR stay."}, .lower = lowerMove, .variant = kAlways},
    {.info = {.mnemonic = "MOVE1", .title = "move if 1", .group = "data",
              .operands = {OperandInfo{.name = "dst", .kind = "cell", .access = Access::Write, .doc = "becomes the source"}, OperandInfo{.name = "src", .kind = "cell", .doc = "is read"}}, .terminating = true,
              .ref = "3.10, l.797", .doc = "As MOVE, but only while RLO is 1."}, .effects = kReadsRlo, .lower = lowerMove, .variant = kIfRlo},

    // ---- timed blocks, timers, counters (man. ch. 3.11) -----------------------------------------------------------
    {.info = {.mnemonic = "DFTM01", .title = "every 0.1 s", .group = "timed block",
              .operands = {OperandInfo{.name = "end", .kind = "label", .doc = "ends the block"}}, .stateful = true,
              .ref = "3.11, l.857", .doc = "The statements up to the label run only once in 0.1 s; the first time one period after the start."}, .role = Role::Timed, .variant = static_cast<int>(TimedKind::Tenth)},
    {.info = {.mnemonic = "DFTM1", .title = "every 1 s", .group = "timed block",
              .operands = {OperandInfo{.name = "end", .kind = "label", .doc = "ends the block"}}, .stateful = true,
              .ref = "3.11, l.858", .doc = "The statements up to the label run only once in 1 s; the first time one period after the start."}, .role = Role::Timed, .variant = static_cast<int>(TimedKind::Second)},
    {.info = {.mnemonic = "DFTM10", .title = "every 10 s", .group = "timed block",
              .operands = {OperandInfo{.name = "end", .kind = "label", .doc = "ends the block"}}, .stateful = true,
              .ref = "3.11, l.859", .doc = "The statements up to the label run only once in 10 s; the first time one period after the start."}, .role = Role::Timed, .variant = static_cast<int>(TimedKind::TenSeconds)},
    {.info = {.mnemonic = "DFTM100", .title = "every 100 s", .group = "timed block",
              .operands = {OperandInfo{.name = "end", .kind = "label", .doc = "ends the block"}}, .stateful = true,
              .ref = "3.11, l.860", .doc = "The statements up to the label run only once in 100 s; the first time one period after the start."}, .role = Role::Timed, .variant = static_cast<int>(TimedKind::HundredSeconds)},
    {.info = {.mnemonic = "TM", .title = "timer", .group = "timer",
              .operands = {OperandInfo{.name = "count", .kind = "timer cell", .access = Access::ReadWrite, .doc = "counts the runs"}}, .stateful = true,
              .ref = "3.11, l.884", .doc = "While RLO is 0 the count is 0. While RLO is 1 it counts up to the preset in DR; RLO is 1 when it is there already."}, .effects = kReadsRlo | kSetsRlo | kReadsDr, .lower = lowerTimer},
    {.info = {.mnemonic = "CU", .title = "counter up", .group = "counter",
              .operands = {OperandInfo{.name = "count", .kind = "counter cell", .access = Access::ReadWrite, .doc = "is counted"}}, .stateful = true,
              .ref = "3.11, l.955", .doc = "Counts when RLO goes from 0 to 1. Then RLO tells whether the count equals the preset in DR, and DR becomes the count."}, .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr, .lower = lowerCounter, .variant = kCountUp},
    {.info = {.mnemonic = "CD", .title = "counter down", .group = "counter",
              .operands = {OperandInfo{.name = "count", .kind = "counter cell", .access = Access::ReadWrite, .doc = "is counted"}}, .stateful = true,
              .ref = "3.11, l.956", .doc = "Counts when RLO goes from 0 to 1. Then RLO tells whether the count equals the preset in DR, and DR becomes the count."}, .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr, .lower = lowerCounter, .variant = kCountDown},
    {.info = {.mnemonic = "CUBCD", .title = "counter up in BCD", .group = "counter",
              .operands = {OperandInfo{.name = "count", .kind = "counter cell", .access = Access::ReadWrite, .doc = "is counted"}}, .stateful = true,
              .ref = "3.11, l.957", .doc = "Counts when RLO goes from 0 to 1. Then RLO tells whether the count equals the preset in DR, and DR becomes the count."}, .effects = kReadsRlo | kSetsRlo | kReadsDr | kSetsDr, .lower = lowerCounter, .variant = kCountUpBcd},

    // ---- arithmetic (man. ch. 3.12) -------------------------------------------------------------------------------
    {.info = {.mnemonic = "AD", .title = "add", .group = "arithmetic",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "the second operand"}},
              .ref = "3.12, l.1006", .doc = "The part of DR in the width of the operand becomes the sum; the rest stays. With REAL. or a real constant DR_REAL is added to."}, .effects = kReadsDr | kSetsDr, .lower = lowerArithmetic, .variant = kAdd},
    {.info = {.mnemonic = "SU", .title = "subtract", .group = "arithmetic",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "the second operand"}},
              .ref = "3.12, l.1008", .doc = "The part of DR in the width of the operand becomes the difference; the rest stays. With REAL. or a real constant DR_REAL is subtracted from."}, .effects = kReadsDr | kSetsDr, .lower = lowerArithmetic, .variant = kSubtract},
    {.info = {.mnemonic = "MULB", .title = "multiply", .group = "arithmetic",
              .operands = {OperandInfo{.name = "val", .kind = "narrow value", .doc = "the second operand"}},
              .ref = "3.12, l.1065", .doc = "DR becomes the signed product of its low part and the operand, sign-extended to 64 bits."}, .effects = kReadsDr | kSetsDr, .lower = lowerArithmetic, .variant = kMultiply},
    {.info = {.mnemonic = "DIVB", .title = "divide", .group = "arithmetic",
              .operands = {OperandInfo{.name = "val", .kind = "narrow value", .doc = "the second operand"}},
              .ref = "3.12, l.1067", .doc = "DR becomes the signed quotient, rounded toward zero. BYTE divides 16 bits of DR, WORD 32, DWORD and constants 64. A zero divisor or a quotient beyond 32 bits stops the program."}, .effects = kReadsDr | kSetsDr, .lower = lowerArithmetic, .variant = kDivide},
    {.info = {.mnemonic = "ORB", .title = "bitwise or", .group = "bitwise",
              .operands = {OperandInfo{.name = "val", .kind = "bitwise value", .doc = "the second operand"}},
              .ref = "3.12, l.1171", .doc = "The part of DR in the width of the operand becomes its bitwise OR with the operand; the rest stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerBitwise, .variant = kOr},
    {.info = {.mnemonic = "ANDB", .title = "bitwise and", .group = "bitwise",
              .operands = {OperandInfo{.name = "val", .kind = "bitwise value", .doc = "the second operand"}},
              .ref = "3.12, l.1172", .doc = "The part of DR in the width of the operand becomes its bitwise AND with the operand; the rest stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerBitwise, .variant = kAnd},
    {.info = {.mnemonic = "XORB", .title = "bitwise exclusive or", .group = "bitwise",
              .operands = {OperandInfo{.name = "val", .kind = "bitwise value", .doc = "the second operand"}},
              .ref = "3.12, l.1173", .doc = "The part of DR in the width of the operand becomes its bitwise EXCLUSIVE OR with the operand; the rest stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerBitwise, .variant = kXor},

    // ---- operations on DR (man. ch. 3.13) -------------------------------------------------------------------------
    {.info = {.mnemonic = "INR", .title = "increment", .group = "DR operation",
              .operands = {OperandInfo{.name = "width", .kind = "width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1201", .doc = "DR plus 1 in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest of DR stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerUnary, .variant = kIncrement},
    {.info = {.mnemonic = "DCR", .title = "decrement", .group = "DR operation",
              .operands = {OperandInfo{.name = "width", .kind = "width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1202", .doc = "DR minus 1 in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest of DR stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerUnary, .variant = kDecrement},
    {.info = {.mnemonic = "INV", .title = "negate", .group = "DR operation",
              .operands = {OperandInfo{.name = "width", .kind = "width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1289", .doc = "The two's complement of DR in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest of DR stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerUnary, .variant = kNegate},
    {.info = {.mnemonic = "ABS", .title = "absolute value", .group = "DR operation",
              .operands = {OperandInfo{.name = "width", .kind = "width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1290", .doc = "The absolute value of DR in 16 bits; with DWRD in 32, with QWRD in 64 bits, with REAL on DR_REAL. The rest of DR stays."}, .effects = kReadsDr | kSetsDr, .lower = lowerUnary, .variant = kAbsolute},
    {.info = {.mnemonic = "INRBCD", .title = "increment BCD", .group = "DR operation",
              .ref = "3.13, l.1203", .doc = "DR plus 1 as four decimal digits; behind 9999 comes 0."}, .effects = kReadsDr | kSetsDr, .lower = lowerIncrementBcd},
    {.info = {.mnemonic = "BIN", .title = "BCD to binary", .group = "DR operation",
              .operands = {OperandInfo{.name = "width", .kind = "double width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1233", .doc = "The digits in DR become their number. With DWRD bit 31 marks a negative number."}, .effects = kReadsDr | kSetsDr, .lower = lowerBin},
    {.info = {.mnemonic = "BCD", .title = "binary to BCD", .group = "DR operation",
              .operands = {OperandInfo{.name = "width", .kind = "double width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1234", .doc = "The number in DR becomes its digits, at most 4, with DWRD 8."}, .effects = kReadsDr | kSetsDr, .lower = lowerBcd},
    {.info = {.mnemonic = "RL", .title = "shift left", .group = "DR operation",
              .operands = {OperandInfo{.name = "n", .kind = "shift count", .doc = "by how many bits"}, OperandInfo{.name = "width", .kind = "integer width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1262", .doc = "Logical shift left of 16, 32 or 64 bits of DR; zeros come in."}, .effects = kReadsDr | kSetsDr, .lower = lowerShift, .variant = 0},
    {.info = {.mnemonic = "RR", .title = "shift right", .group = "DR operation",
              .operands = {OperandInfo{.name = "n", .kind = "shift count", .doc = "by how many bits"}, OperandInfo{.name = "width", .kind = "integer width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.13, l.1264", .doc = "Logical shift right of 16, 32 or 64 bits of DR; zeros come in."}, .effects = kReadsDr | kSetsDr, .lower = lowerShift, .variant = 1},

    // ---- comparison (man. ch. 3.14) -------------------------------------------------------------------------------
    {.info = {.mnemonic = "EQ", .title = "equal", .group = "comparison",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "compared with DR"}},
              .ref = "3.14, l.1369", .doc = "RLO tells whether DR equals the operand, signed, in the operand's width; with REAL. or a real constant DR_REAL."}, .effects = kReadsDr | kSetsRlo, .lower = lowerCompare, .variant = kEqual},
    {.info = {.mnemonic = "LT", .title = "less", .group = "comparison",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "compared with DR"}},
              .ref = "3.14, l.1371", .doc = "RLO tells whether DR is less than the operand, signed, in the operand's width; with REAL. or a real constant DR_REAL."}, .effects = kReadsDr | kSetsRlo, .lower = lowerCompare, .variant = kLess},
    {.info = {.mnemonic = "GT", .title = "greater", .group = "comparison",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "compared with DR"}},
              .ref = "3.14, l.1372", .doc = "RLO tells whether DR is greater than the operand, signed, in the operand's width; with REAL. or a real constant DR_REAL."}, .effects = kReadsDr | kSetsRlo, .lower = lowerCompare, .variant = kGreater},
    {.info = {.mnemonic = "LE", .title = "less or equal", .group = "comparison",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "compared with DR"}},
              .ref = "3.14, l.1373", .doc = "RLO tells whether DR is less than or equal to the operand, signed, in the operand's width; with REAL. or a real constant DR_REAL."}, .effects = kReadsDr | kSetsRlo, .lower = lowerCompare, .variant = kLessEqual},
    {.info = {.mnemonic = "GE", .title = "greater or equal", .group = "comparison",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "compared with DR"}},
              .ref = "3.14, l.1374", .doc = "RLO tells whether DR is greater than or equal to the operand, signed, in the operand's width; with REAL. or a real constant DR_REAL."}, .effects = kReadsDr | kSetsRlo, .lower = lowerCompare, .variant = kGreaterEqual},
    {.info = {.mnemonic = "EQ1", .title = "equal if RLO", .group = "comparison",
              .operands = {OperandInfo{.name = "val", .kind = "value", .doc = "compared with DR"}},
              .ref = "3.14, l.1370", .doc = "As EQ while RLO is 1; else RLO stays 0. A chain compares areas."}, .effects = kReadsDr | kReadsRlo | kSetsRlo, .lower = lowerCompare, .variant = kEqualIfRlo},

    // ---- conversions (man. ch. 3.15) ------------------------------------------------------------------------------
    {.info = {.mnemonic = "CONDR", .title = "DR to RLO", .group = "conversion",
              .operands = {OperandInfo{.name = "bits", .kind = "bits of DR", .doc = "16 bits without it", .min = 0, .max = 31, .optional = true}},
              .ref = "3.15, l.1461", .doc = "RLO tells whether DR is not 0 in 16 bits, with DWRD in 32; with a number RLO becomes that bit of DR."}, .effects = kReadsDr | kSetsRlo, .lower = lowerDrToRlo},
    {.info = {.mnemonic = "CONRD", .title = "RLO to DR", .group = "conversion",
              .operands = {OperandInfo{.name = "width", .kind = "double width", .doc = "16 bits without it", .optional = true}}, .terminating = true,
              .ref = "3.15, l.1462", .doc = "DR becomes FFFFh for RLO 1 and 0 for 0; with DWRD FFFFFFFFh."}, .effects = kReadsRlo | kSetsDr, .lower = lowerRloToDr},
    {.info = {.mnemonic = "REAL", .title = "integer to real", .group = "conversion",
              .operands = {OperandInfo{.name = "width", .kind = "integer width", .doc = "16 bits without it", .optional = true}},
              .ref = "3.15, l.1503", .doc = "DR_REAL becomes the signed integer in DR; DR keeps it, sign-extended."}, .effects = kReadsDr | kSetsDr, .lower = lowerToReal},

    // ---- procedures (man. ch. 3.17) -------------------------------------------------------------------------------
    {.info = {.mnemonic = "PROC_BEGIN", .title = "procedure", .group = "procedure",
              .operands = {OperandInfo{.name = "name", .kind = "declaration", .doc = "a new name"}},
              .ref = "3.17, l.1588", .doc = "Begins a procedure; the normal flow passes it by."}, .role = Role::ProcBegin},
    {.info = {.mnemonic = "PROC_END", .title = "end of a procedure", .group = "procedure",
              .operands = {OperandInfo{.name = "name", .kind = "declaration", .doc = "the name of its PROC_BEGIN"}},
              .ref = "3.17, l.1589", .doc = "Ends a procedure."}, .role = Role::ProcEnd},
    {.info = {.mnemonic = "PROC_CALL", .title = "call", .group = "procedure",
              .operands = {OperandInfo{.name = "name", .kind = "procedure", .doc = "is run"}},
              .ref = "3.17, l.1590", .doc = "Runs a procedure and goes on behind the call; RLO and DR go in and come out."}, .effects = kSetsRlo | kSetsDr, .lower = lowerCall},

    // ---- mechanisms (man. ch. 4) ----------------------------------------------------------------------------------
    {.info = {.mnemonic = "MECH_BEGIN", .title = "mechanism", .group = "mechanism",
              .operands = {OperandInfo{.name = "mech", .kind = "declaration", .doc = "a new name"}}, .stateful = true,
              .ref = "4.2, l.2037", .doc = "Begins a mechanism: code that is carried out a little further in each cycle while its bit is 1. Declares the bit and the word NAME_LINE."}, .role = Role::MechBegin},
    {.info = {.mnemonic = "MECH_END", .title = "end of a mechanism", .group = "mechanism",
              .operands = {OperandInfo{.name = "mech", .kind = "declaration", .doc = "the name of its MECH_BEGIN"}},
              .ref = "4.2, l.2038", .doc = "Ends a mechanism: its bit becomes 0, and it starts at its beginning the next time."}, .role = Role::MechEnd},
    {.info = {.mnemonic = "MECH_INIT", .title = "initialise a mechanism", .group = "mechanism",
              .operands = {OperandInfo{.name = "mech", .kind = "mechanism", .doc = "is stopped"}},
              .ref = "4.2, l.2039", .doc = "The mechanism is stopped and starts at its beginning the next time."}, .lower = lowerMechInit},
    {.info = {.mnemonic = "EX", .title = "next cycle", .group = "mechanism state", .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2055", .doc = "Stops the unit for this cycle; it goes on behind EX in the next."}, .effects = kWaits, .lower = lowerEx},
    {.info = {.mnemonic = "EX0", .title = "wait while 0", .group = "mechanism state", .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2056", .doc = "While RLO is 0 the unit is left; in the next cycle it goes on behind the last state that it passed."}, .effects = kWaits | kKeepsDr | kReadsRlo, .lower = lowerExWhile, .variant = 0},
    {.info = {.mnemonic = "EX1", .title = "wait while 1", .group = "mechanism state", .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2057", .doc = "While RLO is 1 the unit is left; in the next cycle it goes on behind the last state that it passed."}, .effects = kWaits | kKeepsDr | kReadsRlo, .lower = lowerExWhile, .variant = 1},
    {.info = {.mnemonic = "BEX", .title = "set the point of return", .group = "mechanism state", .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2058", .doc = "Does not wait; a state further on that waits returns here."}, .effects = kWaits, .lower = lowerBex},
    {.info = {.mnemonic = "TEX0", .title = "wait while 0, with time-out", .group = "mechanism state",
              .operands = {OperandInfo{.name = "count", .kind = "timer cell", .access = Access::ReadWrite, .doc = "counts the cycles"}, OperandInfo{.name = "time", .kind = "time", .doc = "cycles of the PLC"}, OperandInfo{.name = "error", .kind = "label", .doc = "where a time-out leads"}, OperandInfo{.name = "code", .kind = "constant", .doc = "DR at the time-out", .optional = true}}, .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2092", .doc = "As EX0, but at most for the time; then control goes to the label with the code in DR.",
              .example = "LDR  CHAIN_STOPPED\nTEX0 -,250,ERROR,4"}, .effects = kWaits | kKeepsDr | kReadsRlo, .lower = lowerTimedEx, .variant = 0},
    {.info = {.mnemonic = "TEX1", .title = "wait while 1, with time-out", .group = "mechanism state",
              .operands = {OperandInfo{.name = "count", .kind = "timer cell", .access = Access::ReadWrite, .doc = "counts the cycles"}, OperandInfo{.name = "time", .kind = "time", .doc = "cycles of the PLC"}, OperandInfo{.name = "error", .kind = "label", .doc = "where a time-out leads"}, OperandInfo{.name = "code", .kind = "constant", .doc = "DR at the time-out", .optional = true}}, .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2093", .doc = "As EX1, but at most for the time; then control goes to the label with the code in DR."}, .effects = kWaits | kKeepsDr | kReadsRlo, .lower = lowerTimedEx, .variant = 1},
    {.info = {.mnemonic = "TIM", .title = "wait", .group = "mechanism state",
              .operands = {OperandInfo{.name = "count", .kind = "timer cell", .access = Access::ReadWrite, .doc = "counts the cycles"}, OperandInfo{.name = "time", .kind = "time", .doc = "cycles of the PLC"}}, .terminating = true, .stateful = true, .tasks = "mechanisms, MODULE_BLOCK_INIT, MODULE_BLOCK_DONE",
              .ref = "4.2, l.2136", .doc = "Waits for the time."}, .effects = kWaits, .lower = lowerWait},

    // ---- messages (man. ch. 14) and the ends of start and shutdown (man. ch. 5) -----------------------------------
    {.info = {.mnemonic = "ESET", .title = "message", .group = "message",
              .operands = {OperandInfo{.name = "error", .kind = "message value", .doc = "number; in DR without it", .optional = true}, OperandInfo{.name = "subid", .kind = "message value", .doc = "additional number", .optional = true}, OperandInfo{.name = "set", .kind = "message value", .doc = "of a persistent message: 1 shows, 0 removes", .optional = true}, OperandInfo{.name = "par1", .kind = "message value", .doc = "value in the text", .optional = true}, OperandInfo{.name = "par2", .kind = "message value", .doc = "value in the text", .optional = true}, OperandInfo{.name = "par3", .kind = "message value", .doc = "value in the text", .optional = true}},
              .ref = "14.3.1, l.5090", .doc = "Generates a message each time it is carried out.",
              .example = "ESET 12,-,-,BYTE.SPEED"}, .effects = kReadsDr, .lower = lowerMessage, .variant = kAlways},
    {.info = {.mnemonic = "ESET1", .title = "message if 1", .group = "message",
              .operands = {OperandInfo{.name = "error", .kind = "message value", .doc = "number; in DR without it", .optional = true}, OperandInfo{.name = "subid", .kind = "message value", .doc = "additional number", .optional = true}, OperandInfo{.name = "set", .kind = "message value", .doc = "of a persistent message: 1 shows, 0 removes", .optional = true}, OperandInfo{.name = "par1", .kind = "message value", .doc = "value in the text", .optional = true}, OperandInfo{.name = "par2", .kind = "message value", .doc = "value in the text", .optional = true}, OperandInfo{.name = "par3", .kind = "message value", .doc = "value in the text", .optional = true}}, .terminating = true,
              .ref = "14.3.1, l.5091", .doc = "As ESET, but only while RLO is 1."}, .effects = kReadsDr | kReadsRlo, .lower = lowerMessage, .variant = kIfRlo},
    {.info = {.mnemonic = "MODULE_INIT_FINISHED", .title = "start is complete", .group = "module service",
              .ref = "5.3, l.2572", .doc = "The start is complete when each file that has this instruction has carried one out."}, .effects = kEndsInit, .lower = lowerFinished, .variant = static_cast<int>(HostCell::InitOwed)},
    {.info = {.mnemonic = "MODULE_DONE_FINISHED", .title = "shutdown is complete", .group = "module service",
              .ref = "5.3, l.2618", .doc = "The shutdown is complete when each file that has this instruction has carried one out."}, .effects = kEndsDone, .lower = lowerFinished, .variant = static_cast<int>(HostCell::DoneOwed)},

    // ---- declarations (man. ch. 3.4, 3.18) ------------------------------------------------------------------------
    {.info = {.mnemonic = "DFM", .title = "bits of a byte", .group = "declaration",
              .operands = {OperandInfo{.name = "bit", .kind = "declaration", .doc = "name of a bit, from bit 0", .optional = true, .repeated = true}}, .tasks = "DATA, DATA_LOCAL",
              .ref = "3.4, l.95", .doc = "Declares one byte and the names of its bits. A name may be left out, its comma not.",
              .example = "GAMA: DFM  B0,B1,,B3,,,,B7"}, .role = Role::Dfm},
    {.info = {.mnemonic = "DS", .title = "bytes", .group = "declaration",
              .operands = {OperandInfo{.name = "size", .kind = "declaration", .doc = "1 BYTE, 2 WORD, 4 DWORD, 8 for a prefix, n an array"}}, .tasks = "DATA, DATA_LOCAL",
              .ref = "3.4, l.118", .doc = "Declares a variable of 1, 2 or 4 bytes, or an array that is used with a prefix."}, .role = Role::Ds},
    {.info = {.mnemonic = "STR", .title = "text", .group = "declaration",
              .operands = {OperandInfo{.name = "size", .kind = "declaration", .doc = "characters"}, OperandInfo{.name = "text", .kind = "declaration", .doc = "its contents, or the memory it lies on", .optional = true}},
              .ref = "3.18, l.1651", .doc = "Declares a text of at most n characters."}, .role = Role::Str},
    {.info = {.mnemonic = "EQUI", .title = "constant", .group = "declaration",
              .operands = {OperandInfo{.name = "name", .kind = "declaration", .doc = "a new name"}, OperandInfo{.name = "value", .kind = "declaration", .doc = "an integer"}},
              .ref = "3.4, l.137", .doc = "Declares an integer constant.",
              .example = "EQUI MAX_POS, 24"}, .role = Role::Equi},
    {.info = {.mnemonic = "DB", .title = "member of 1 byte", .group = "declaration",
              .operands = {OperandInfo{.name = "value", .kind = "declaration", .doc = "a value, ?, or n DUP(value)"}}, .tasks = "struc",
              .ref = "18.1.1, l.13526", .doc = "Member of a structure; its name becomes the offset in bytes."}, .role = Role::MemberSize, .variant = 1},
    {.info = {.mnemonic = "DW", .title = "member of 2 bytes", .group = "declaration",
              .operands = {OperandInfo{.name = "value", .kind = "declaration", .doc = "a value, ?, or n DUP(value)"}}, .tasks = "struc",
              .ref = "18.1.1, l.13526", .doc = "Member of a structure; its name becomes the offset in bytes."}, .role = Role::MemberSize, .variant = 2},
    {.info = {.mnemonic = "DD", .title = "member of 4 bytes", .group = "declaration",
              .operands = {OperandInfo{.name = "value", .kind = "declaration", .doc = "a value, ?, or n DUP(value)"}}, .tasks = "struc",
              .ref = "18.1.1, l.13526", .doc = "Member of a structure; its name becomes the offset in bytes."}, .role = Role::MemberSize, .variant = 4},
    {.info = {.mnemonic = "DQ", .title = "member of 8 bytes", .group = "declaration",
              .operands = {OperandInfo{.name = "value", .kind = "declaration", .doc = "a value, ?, or n DUP(value)"}}, .tasks = "struc",
              .ref = "18.1.1, l.13526", .doc = "Member of a structure; its name becomes the offset in bytes."}, .role = Role::MemberSize, .variant = 8},
    {.info = {.mnemonic = "STRUC", .title = "structure", .group = "declaration", .tasks = "DATA, DATA_LOCAL",
              .ref = "18.1.1, l.13525", .doc = "NAME struc begins a structure: its members become constants, their offsets in bytes."}, .role = Role::MemberSize, .variant = 0},
    {.info = {.mnemonic = "ENDS", .title = "structure", .group = "declaration", .tasks = "DATA, DATA_LOCAL",
              .ref = "18.1.1, l.13525", .doc = "NAME ends ends a structure."}, .role = Role::MemberSize, .variant = 0},
    {.info = {.mnemonic = "DUP", .title = "structure", .group = "declaration", .tasks = "DATA, DATA_LOCAL",
              .ref = "18.1.1, l.13525", .doc = "n DUP(value): n values of a member."}, .role = Role::MemberSize, .variant = 0},

    // ---- accepted without effect ----------------------------------------------------------------------------------
    {.info = {.mnemonic = "DEBUG", .title = "debugging", .group = "debugging",
              .operands = {OperandInfo{.name = "state", .kind = "declaration", .doc = "ON or OFF", .optional = true}},
              .ref = "7.1, l.2794", .doc = "Marks a region for break-points; no effect on results."}, .role = Role::NoCode},
    {.info = {.mnemonic = "CLI", .title = "no interrupts", .group = "assembler",
              .ref = "3.9, l.564", .doc = "Protects reading two related cells from the fast task, which does not interrupt here anyway."}, .role = Role::NoCode},
    {.info = {.mnemonic = "STI", .title = "interrupts", .group = "assembler",
              .ref = "3.9, l.567", .doc = "Ends what CLI began."}, .role = Role::NoCode},
    {.info = {.mnemonic = "MOV", .title = "index register", .group = "assembler",
              .operands = {OperandInfo{.name = "BX", .kind = "register", .doc = "the index register"}, OperandInfo{.name = "CX", .kind = "register", .doc = "DR"}},
              .ref = "18.1.1, l.13532", .doc = "MOV BX, CX: the index register becomes the low 16 bits of DR."}, .effects = kReadsDr, .lower = lowerMovBx},

    // ---- not built ------------------------------------------------------------------------------------------------
    {.info = {.mnemonic = "LDR_LIC", .title = "a licence becomes RLO", .group = "bit logic",
              .ref = "8.4.7, l.7631", .doc = "A licence becomes RLO."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "MV", .title = "copies or clears memory", .group = "memory",
              .ref = "3.15, l.1484", .doc = "Copies or clears memory."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CLEAR", .title = "copies or clears memory", .group = "memory",
              .ref = "3.15, l.1521", .doc = "Copies or clears memory."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "STRCPY", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1700", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "STRADD", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1701", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "BINSTR", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1808", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "BCDSTR", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1809", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "STRCMP", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1844", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "MEMCPY", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1901", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "MEMCMP", .title = "works on texts", .group = "text",
              .ref = "3.18, l.1934", .doc = "Works on texts."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "EDEF", .title = "ties a bit to a message", .group = "message",
              .ref = "14.3.2, l.5192", .doc = "Ties a bit to a message."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "MAP_IN", .title = "declares a mapped input or output", .group = "inputs and outputs",
              .ref = "10.4, l.5767", .doc = "Declares a mapped input or output."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "MAP_OUT", .title = "declares a mapped input or output", .group = "inputs and outputs",
              .ref = "10.4, l.5768", .doc = "Declares a mapped input or output."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "MAP_AIN", .title = "declares a mapped input or output", .group = "inputs and outputs",
              .ref = "10.4, l.5850", .doc = "Declares a mapped input or output."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "MAP_AOUT", .title = "declares a mapped input or output", .group = "inputs and outputs",
              .ref = "10.4, l.5851", .doc = "Declares a mapped input or output."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "DEF_IN", .title = "declares a logical input or output", .group = "inputs and outputs",
              .ref = "27.6, l.13299", .doc = "Declares a logical input or output."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "DEF_OUT", .title = "declares a logical input or output", .group = "inputs and outputs",
              .ref = "27.6, l.13300", .doc = "Declares a logical input or output."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "UPDATE_IN", .title = "takes over a logical input at once", .group = "inputs and outputs",
              .ref = "27.7, l.13413", .doc = "Takes over a logical input at once."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "SHARE_VAR", .title = "gives a variable a public name", .group = "sharing",
              .ref = "18.2, l.13618", .doc = "Gives a variable a public name."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "SHARE_BIT", .title = "gives a variable a public name", .group = "sharing",
              .ref = "18.2, l.13705", .doc = "Gives a variable a public name."}, .role = Role::NotBuilt, .effects = kInitOnly},
    {.info = {.mnemonic = "CNF_GET_INT", .title = "reads the configuration", .group = "configuration",
              .ref = "16.1, l.16111", .doc = "Reads the configuration."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CNF_GET_REAL", .title = "reads the configuration", .group = "configuration",
              .ref = "16.1, l.16112", .doc = "Reads the configuration."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CNF_GET_STR", .title = "reads the configuration", .group = "configuration",
              .ref = "16.1, l.16113", .doc = "Reads the configuration."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CNF_GET_BIN", .title = "reads the configuration", .group = "configuration",
              .ref = "16.1, l.16114", .doc = "Reads the configuration."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CNF_GET_BIT", .title = "reads the configuration", .group = "configuration",
              .ref = "16.1, l.16115", .doc = "Reads the configuration."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CONST_GET", .title = "reads the configuration", .group = "configuration",
              .ref = "16.1, l.16355", .doc = "Reads the configuration."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "T_INCLUDE", .title = "macros and included files", .group = "macro",
              .ref = "22.1, l.20313", .doc = "Macros and included files."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "DEF_T_MACRO", .title = "macros and included files", .group = "macro",
              .ref = "22.1, l.20349", .doc = "Macros and included files."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "END_T_MACRO", .title = "macros and included files", .group = "macro",
              .ref = "22.1, l.20373", .doc = "Macros and included files."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "T_LOCAL", .title = "macros and included files", .group = "macro",
              .ref = "22.1, l.20441", .doc = "Macros and included files."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "APPEND_T_MACRO", .title = "macros and included files", .group = "macro",
              .ref = "22.1, l.20526", .doc = "Macros and included files."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CONTROL_T_MACRO", .title = "macros and included files", .group = "macro",
              .ref = "22.1, l.20576", .doc = "Macros and included files."}, .role = Role::NotBuilt},
    {.info = {.mnemonic = "CAN_SEND", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.3709", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_RECV", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.3743", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_RECV_REQ", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.3779", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_RECV_DEL", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.3848", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_RECV_END", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.3850", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_SYSIO_READ", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.4276", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_SYSIO_WRITE", .title = "packets of the CAN bus", .group = "CAN-BUS",
              .ref = "9.4, l.4317", .doc = "Packets of the CAN bus."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "CAN_AX_SEND", .title = "a packet to a drive", .group = "CAN-BUS",
              .ref = "13.14, l.9474", .doc = "A packet to a drive."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "ANALOG_PORT", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.7722", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "ANALOG", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.7770", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "SPI_AX", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.7821", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "AX_SPI", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.7975", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "SPI_MAIN", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.7999", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "ANALOG_SPI", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.8028", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "RAMP", .title = "works on a spindle", .group = "spindle",
              .ref = "12.2, l.8274", .doc = "Works on a spindle."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "REGUL_X", .title = "selects a set of servo parameters", .group = "servo",
              .ref = "13.1, l.8452", .doc = "Selects a set of servo parameters."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "REGUL_Y", .title = "selects a set of servo parameters", .group = "servo",
              .ref = "13.1, l.8452", .doc = "Selects a set of servo parameters."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "REGUL_Z", .title = "selects a set of servo parameters", .group = "servo",
              .ref = "13.1, l.8452", .doc = "Selects a set of servo parameters."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "REGUL_4", .title = "selects a set of servo parameters", .group = "servo",
              .ref = "13.1, l.8452", .doc = "Selects a set of servo parameters."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "REGUL_5", .title = "selects a set of servo parameters", .group = "servo",
              .ref = "13.1, l.8452", .doc = "Selects a set of servo parameters."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "REGUL_6", .title = "selects a set of servo parameters", .group = "servo",
              .ref = "13.1, l.8452", .doc = "Selects a set of servo parameters."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "POS_INIT", .title = "works on a positioning unit", .group = "positioning unit",
              .ref = "19.3, l.12136", .doc = "Works on a positioning unit."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "POS_RESET", .title = "works on a positioning unit", .group = "positioning unit",
              .ref = "19.3, l.12191", .doc = "Works on a positioning unit."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "POS_MODE", .title = "works on a positioning unit", .group = "positioning unit",
              .ref = "19.3, l.12205", .doc = "Works on a positioning unit."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "POS_CONTROL", .title = "works on a positioning unit", .group = "positioning unit",
              .ref = "19.3, l.12240", .doc = "Works on a positioning unit."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "SA_READ", .title = "reads or writes a shared area", .group = "shared area", .terminating = true,
              .ref = "18.3.1, l.15500", .doc = "Reads or writes a shared area."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "SA_WRITE", .title = "reads or writes a shared area", .group = "shared area", .terminating = true,
              .ref = "18.3.1, l.15501", .doc = "Reads or writes a shared area."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_GET_INT", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18675", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_GET_REAL", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18676", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_GET_STR", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18677", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_GET_BIN", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18678", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_SET_INT", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18679", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_SET_REAL", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18680", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_SET_STR", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18681", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_SET_BIN", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18682", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_COL_INDEX", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18785", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_COL_ID", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18786", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_COL_TYPE", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18880", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_GET_SELLINE", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18941", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_SET_SELLINE", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18942", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_CHANGED", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.18997", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "PLCT_GET_LINESCOUNT", .title = "reads or writes a PLC table", .group = "PLC table", .terminating = true,
              .ref = "17.4, l.19042", .doc = "Reads or writes a PLC table."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "ECAT_COE_READ", .title = "asks the EtherCAT master", .group = "EtherCAT", .terminating = true,
              .ref = "26.4, l.17996", .doc = "Asks the EtherCAT master."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "ECAT_COE_WRITE", .title = "asks the EtherCAT master", .group = "EtherCAT", .terminating = true,
              .ref = "26.4, l.17997", .doc = "Asks the EtherCAT master."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "ECAT_SOE_READ", .title = "asks the EtherCAT master", .group = "EtherCAT", .terminating = true,
              .ref = "26.4, l.18083", .doc = "Asks the EtherCAT master."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "ECAT_SOE_WRITE", .title = "asks the EtherCAT master", .group = "EtherCAT", .terminating = true,
              .ref = "26.4, l.18084", .doc = "Asks the EtherCAT master."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "ECAT_COMMAND", .title = "asks the EtherCAT master", .group = "EtherCAT", .terminating = true,
              .ref = "26.4, l.18168", .doc = "Asks the EtherCAT master."}, .role = Role::NotBuiltService, .effects = kWaits},
    {.info = {.mnemonic = "COM_SEND", .title = "works on a serial line", .group = "serial COM",
              .ref = "23.3.2, l.21063", .doc = "Works on a serial line."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "COM_SEND_STR", .title = "works on a serial line", .group = "serial COM",
              .ref = "23.3.2, l.21088", .doc = "Works on a serial line."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "COM_RECV", .title = "works on a serial line", .group = "serial COM",
              .ref = "23.3.2, l.21138", .doc = "Works on a serial line."}, .role = Role::NotBuiltService},
    {.info = {.mnemonic = "COM_CONTROL", .title = "works on a serial line", .group = "serial COM",
              .ref = "23.3.2, l.21165", .doc = "Works on a serial line."}, .role = Role::NotBuiltService},
};

constexpr size_t kRowCount = std::size(kRows);

constexpr auto kInfos = [] {
  std::array<const InstructionInfo*, kRowCount> infos{};
  for (size_t i = 0; i < kRowCount; ++i) infos[i] = &kRows[i].info;
  return infos;
}();

constexpr auto kByName = [] {
  std::array<uint16_t, kRowCount> order{};
  for (size_t i = 0; i < kRowCount; ++i) order[i] = static_cast<uint16_t>(i);
  std::sort(order.begin(), order.end(), [](uint16_t a, uint16_t b) { return kRows[a].info.mnemonic < kRows[b].info.mnemonic; });
  return order;
}();

constexpr bool rowsAreComplete() {
  for (size_t i = 0; i < kRowCount; ++i) {
    const Row& row = kRows[i];
    if (row.info.doc.empty() || row.info.ref.empty() || row.info.title.empty()) return false;
    if (row.role == Role::Code && row.lower == nullptr) return false;
    if (i > 0 && kRows[kByName[i]].info.mnemonic == kRows[kByName[i - 1]].info.mnemonic) return false;
  }
  return true;
}
static_assert(rowsAreComplete(), "every row has a title, a reference and a doc; code has its lowering; mnemonics are unique");

constexpr std::string_view kRegisters[] = {"BX", "CX", "AX", "AH", "DX", "SI", "DI", "ECX", "EDX", "RLO", "DR", "DR_REAL"};

// Of the 80386; all but MOV BX,CX, CLI and STI are beyond this compiler.
constexpr std::string_view kAssembler[] = {
    "AAA", "ADC", "ADD", "AND", "BT", "CALL", "CBW", "CLC", "CLD", "CMC", "CMP", "CWD", "DEC", "DIV", "ENTER", "HLT", "IDIV", "IMUL",
    "IN", "INC", "INT", "IRET", "JA", "JAE", "JB", "JBE", "JC", "JE", "JG", "JGE", "JL", "JLE", "JMP", "JNC", "JNE", "JNZ", "JS",
    "JZ", "LDS", "LEA", "LES", "LODSB", "LOOP", "MOVSB", "MOVSW", "MOVSX", "MOVZX", "MUL", "NEG", "NOP", "NOT", "OR", "OUT", "POP",
    "POPA", "POPF", "PUSH", "PUSHA", "PUSHF", "RCL", "RCR", "REP", "RET", "ROL", "ROR", "SAHF", "SAL", "SAR", "SBB", "SETC", "SHL",
    "SHR", "STC", "STD", "STOSB", "STOSW", "SUB", "TEST", "XCHG", "XLAT", "XOR",
};

template <size_t N> bool isOneOf(std::string_view name, const std::string_view (&list)[N]) {
  return std::any_of(std::begin(list), std::end(list), [&](std::string_view item) { return equalsNoCase(name, item); });
}

int compareNoCase(std::string_view name, std::string_view upperCase) {
  const size_t common = std::min(name.size(), upperCase.size());
  for (size_t i = 0; i < common; ++i)
    if (upper(name[i]) != upperCase[i]) return upper(name[i]) < upperCase[i] ? -1 : 1;
  return name.size() == upperCase.size() ? 0 : name.size() < upperCase.size() ? -1 : 1;
}

} // namespace

std::span<const Row> allRows() { return kRows; }
std::span<const InstructionInfo* const> instructionInfos() { return kInfos; }

const Row* findRow(std::string_view mnemonic) {
  if (equalsNoCase(mnemonic, "JLO")) mnemonic = "JL0";
  const auto at = std::lower_bound(kByName.begin(), kByName.end(), mnemonic,
                                   [](uint16_t row, std::string_view name) { return compareNoCase(name, kRows[row].info.mnemonic) > 0; });
  if (at == kByName.end() || compareNoCase(mnemonic, kRows[*at].info.mnemonic) != 0) return nullptr;
  return &kRows[*at];
}

// Reserved are the words of chapters 3-5, 7 and 22; the others name symbols in examples (man. l.12300).
Reserved reservedWord(std::string_view name) {
  if (isOneOf(name, kRegisters)) return Reserved::Yes;
  const Row* row = findRow(name);
  if (row == nullptr) return Reserved::No;
  const std::string_view chapter = row->info.ref.substr(0, row->info.ref.find('.'));
  const bool core = chapter == "3" || chapter == "4" || chapter == "5" || chapter == "7" || chapter == "22";
  return core ? Reserved::Yes : Reserved::Warn;
}

bool isAssembler(std::string_view name) { return isOneOf(name, kAssembler); }

std::string_view moduleName(ModuleKind kind) {
  for (const Row& row : kRows)
    if (row.role == Role::Module && row.variant == static_cast<int>(kind)) return row.info.mnemonic;
  return {};
}

} // namespace rung::frontend::technol

// The rows of the table of operations (see op_info.h).
#include "ir/core/op_info.h"

namespace rung::ir {
namespace {

using C = Constraint;

constexpr OpInfo kOps[] = {
    {.code = OpCode::Const, .name = "const", .types = kAllTypes, .operands = {}, .result = C::Same, .attr = Attr::Literal, .effects = kPure,
     .doc = "A constant. Integers are kept modulo their width; a f64 by its bits."},
    {.code = OpCode::Add, .name = "add", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Sum modulo the width."},
    {.code = OpCode::Sub, .name = "sub", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Difference modulo the width."},
    {.code = OpCode::Mul, .name = "mul", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Product modulo the width."},
    {.code = OpCode::DivS, .name = "div_s", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Signed quotient, rounded toward zero. Divisor 0 gives 0; the smallest number divided by -1 gives itself."},
    {.code = OpCode::DivU, .name = "div_u", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Unsigned quotient. Divisor 0 gives 0."},
    {.code = OpCode::RemS, .name = "rem_s", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Signed remainder with the sign of the dividend. Divisor 0 or -1 gives 0."},
    {.code = OpCode::RemU, .name = "rem_u", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Unsigned remainder. Divisor 0 gives 0."},
    {.code = OpCode::Neg, .name = "neg", .types = kInts, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Two's complement; the smallest number gives itself."},
    {.code = OpCode::And, .name = "and", .types = kBitsAndInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Bitwise and."},
    {.code = OpCode::Or, .name = "or", .types = kBitsAndInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Bitwise or."},
    {.code = OpCode::Xor, .name = "xor", .types = kBitsAndInts, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Bitwise exclusive or."},
    {.code = OpCode::Not, .name = "not", .types = kBitsAndInts, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Bitwise complement."},
    {.code = OpCode::Shl, .name = "shl", .types = kInts, .operands = {C::Same, C::I32}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Shift left by an unsigned count; a count of the width or more gives 0."},
    {.code = OpCode::ShrU, .name = "shr_u", .types = kInts, .operands = {C::Same, C::I32}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Logical shift right by an unsigned count; a count of the width or more gives 0."},
    {.code = OpCode::ShrS, .name = "shr_s", .types = kInts, .operands = {C::Same, C::I32}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Arithmetic shift right by an unsigned count; a count of the width or more gives 0 or -1 by the sign."},
    {.code = OpCode::PopCount, .name = "popcount", .types = kInts, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Number of bits that are 1."},
    {.code = OpCode::BcdEncode, .name = "bcd_encode", .types = kInts, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Unsigned binary to packed BCD of the same width; digits above the width are lost."},
    {.code = OpCode::BcdDecode, .name = "bcd_decode", .types = kInts, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Packed BCD to binary modulo the width; a nibble above 9 counts as its value."},
    {.code = OpCode::Eq, .name = "eq", .types = kBitsAndInts, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Equal."},
    {.code = OpCode::Ne, .name = "ne", .types = kBitsAndInts, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Not equal."},
    {.code = OpCode::LtS, .name = "lt_s", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Signed less."},
    {.code = OpCode::LeS, .name = "le_s", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Signed less or equal."},
    {.code = OpCode::LtU, .name = "lt_u", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Unsigned less."},
    {.code = OpCode::LeU, .name = "le_u", .types = kInts, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Unsigned less or equal."},
    {.code = OpCode::Select, .name = "select", .types = kAllTypes, .operands = {C::Bit, C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "The second operand when the first is 1, else the third."},
    {.code = OpCode::ZExt, .name = "zext", .types = kInts, .operands = {C::Narrower}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Widens with zeros."},
    {.code = OpCode::SExt, .name = "sext", .types = kInts, .operands = {C::Narrower}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Widens with the sign; a bit 1 gives all ones."},
    {.code = OpCode::Trunc, .name = "trunc", .types = kBit | setOf(Type::I8) | setOf(Type::I16) | setOf(Type::I32), .operands = {C::Wider}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "The low bits; to a bit: bit 0."},
    {.code = OpCode::FAdd, .name = "fadd", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "IEEE sum, nearest even; every NaN result is 7FF8000000000000."},
    {.code = OpCode::FSub, .name = "fsub", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "IEEE difference; NaN as for fadd."},
    {.code = OpCode::FMul, .name = "fmul", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "IEEE product; NaN as for fadd."},
    {.code = OpCode::FDiv, .name = "fdiv", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "IEEE quotient: x/0 is an infinity, 0/0 NaN; NaN as for fadd."},
    {.code = OpCode::FNeg, .name = "fneg", .types = kFloat, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "The sign bit inverted, also of NaN."},
    {.code = OpCode::FAbs, .name = "fabs", .types = kFloat, .operands = {C::Same}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "The sign bit cleared, also of NaN."},
    {.code = OpCode::FEq, .name = "feq", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Equal; 0 with a NaN; -0 equals +0."},
    {.code = OpCode::FLt, .name = "flt", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Less; 0 with a NaN."},
    {.code = OpCode::FLe, .name = "fle", .types = kFloat, .operands = {C::Same, C::Same}, .result = C::Bit, .attr = Attr::None, .effects = kPure,
     .doc = "Less or equal; 0 with a NaN."},
    {.code = OpCode::FToInt, .name = "f_to_int", .types = kInts, .operands = {C::F64}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Signed integer toward zero, saturating; NaN gives 0."},
    {.code = OpCode::FToIntNearest, .name = "f_to_int_nearest", .types = setOf(Type::I64), .operands = {C::F64}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Signed integer to nearest, ties to even; NaN and everything out of range give 8000000000000000h."},
    {.code = OpCode::IntToF, .name = "int_to_f", .types = kFloat, .operands = {C::AnyInt}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "Signed integer to f64, nearest even."},
    {.code = OpCode::BitsToF, .name = "bits_to_f", .types = kFloat, .operands = {C::I64}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "The f64 with these bits."},
    {.code = OpCode::FToBits, .name = "f_to_bits", .types = setOf(Type::I64), .operands = {C::F64}, .result = C::Same, .attr = Attr::None, .effects = kPure,
     .doc = "The bits of a f64."},
    {.code = OpCode::Load, .name = "load", .types = kAllTypes, .operands = {}, .result = C::Same, .attr = Attr::Place, .effects = kReads,
     .doc = "Reads a fixed place of a space, little-endian, of any alignment."},
    {.code = OpCode::Store, .name = "store", .types = kAllTypes, .operands = {C::Same}, .result = C::None, .attr = Attr::Place, .effects = kWrites,
     .doc = "Writes a fixed place of a space. A bit leaves the other bits of its byte alone."},
    {.code = OpCode::LoadAt, .name = "load_at", .types = kInts | kFloat, .operands = {C::I32}, .result = C::Same, .attr = Attr::Window, .effects = kReads,
     .doc = "Reads element i (counted in units of the space, unsigned) of a window; i outside the window gives 0."},
    {.code = OpCode::StoreAt, .name = "store_at", .types = kInts | kFloat, .operands = {C::I32, C::Same}, .result = C::None, .attr = Attr::Window, .effects = kWrites,
     .doc = "Writes element i of a window; i outside the window writes nothing."},
    {.code = OpCode::LoadBitAt, .name = "load_bit_at", .types = kBit, .operands = {C::I32, C::I32}, .result = C::Bit, .attr = Attr::Window, .effects = kReads,
     .doc = "Reads a bit: element i of a window, bit number b (unsigned). i outside the window or b outside the unit gives 0."},
    {.code = OpCode::StoreBitAt, .name = "store_bit_at", .types = kBit, .operands = {C::I32, C::I32, C::Bit}, .result = C::None, .attr = Attr::Window, .effects = kWrites,
     .doc = "Writes a bit: element i of a window, bit number b. i outside the window or b outside the unit writes nothing."},
    {.code = OpCode::SlotLoad, .name = "slot_load", .types = kAllTypes, .operands = {}, .result = C::Same, .attr = Attr::Slot, .effects = kReads,
     .doc = "Reads a slot, a piece of state that the compiler made; T is the slot's type."},
    {.code = OpCode::SlotStore, .name = "slot_store", .types = kAllTypes, .operands = {C::Same}, .result = C::None, .attr = Attr::Slot, .effects = kWrites,
     .doc = "Writes a slot."},
    {.code = OpCode::Now, .name = "now", .types = setOf(Type::I64), .operands = {}, .result = C::Same, .attr = Attr::None, .effects = kClock,
     .doc = "The clock in microseconds, fixed while a task runs."},
    {.code = OpCode::If, .name = "if", .types = kNoTypes, .operands = {C::Bit}, .result = C::None, .attr = Attr::None, .effects = kStructure,
     .doc = "Opens a region that runs when the operand is 1."},
    {.code = OpCode::Else, .name = "else", .types = kNoTypes, .operands = {C::Variadic}, .result = C::None, .attr = Attr::None, .effects = kStructure,
     .doc = "Ends the first region of an if, whose yields are the operands, and opens the second."},
    {.code = OpCode::EndIf, .name = "endif", .types = kNoTypes, .operands = {C::Variadic}, .result = C::Variadic, .attr = Attr::None, .effects = kStructure,
     .doc = "Ends an if. Its results are the yields of the region that ran: the else's operands or its own. Without an else there are none."},
    {.code = OpCode::Loop, .name = "loop", .types = kNoTypes, .operands = {C::Variadic}, .result = C::Variadic, .attr = Attr::Count, .effects = kStructure,
     .doc = "Opens a region that runs `count` times (0 is allowed). Results inside: the i32 number of the pass, from 0, then the carried values; operands: their first values."},
    {.code = OpCode::EndLoop, .name = "endloop", .types = kNoTypes, .operands = {C::Variadic}, .result = C::Variadic, .attr = Attr::None, .effects = kStructure,
     .doc = "Ends a loop. Operands: the carried values for the next pass; results: those after the last (the first values when count is 0)."},
    {.code = OpCode::Message, .name = "message", .types = kNoTypes, .operands = {C::I32, C::I32, C::I32, C::Any}, .result = C::None, .attr = Attr::MessageOp, .effects = kHost,
     .doc = "Shows, logs or clears message `number` with channel, index and a value (i64 or f64)."},
    {.code = OpCode::ServiceRequest, .name = "service_request", .types = kNoTypes, .operands = {C::Variadic}, .result = C::I32, .attr = Attr::Service, .effects = kHost,
     .doc = "Asks the host for a service with i64 arguments (at most 16); gives the ticket, 0 when the queue is full."},
    {.code = OpCode::ServicePoll, .name = "service_poll", .types = kNoTypes, .operands = {C::I32}, .result = C::I32, .attr = Attr::None, .effects = kHost,
     .doc = "The state of a ticket (enum rung_service_state); an unknown ticket gives 0."},
    {.code = OpCode::ServiceResult, .name = "service_result", .types = kNoTypes, .operands = {C::I32}, .result = C::I64, .attr = Attr::ResultNo, .effects = kHost,
     .doc = "Result number k of a finished ticket; 0 when there is none."},
    {.code = OpCode::Trap, .name = "trap", .types = kNoTypes, .operands = {C::Bit}, .result = C::None, .attr = Attr::Fault, .effects = kTraps,
     .doc = "Stops the program with a fault when the operand is 1."},
    {.code = OpCode::Note, .name = "note", .types = kNoTypes, .operands = {}, .result = C::None, .attr = Attr::Text, .effects = kStructure,
     .doc = "A remark for the reader of generated text: which instruction the next operations belong to."},
    {.code = OpCode::ProfEnter, .name = "prof_enter", .types = kNoTypes, .operands = {}, .result = C::None, .attr = Attr::None, .effects = kHost,
     .doc = "Starts the measurement of this rung."},
    {.code = OpCode::ProfLeave, .name = "prof_leave", .types = kNoTypes, .operands = {}, .result = C::None, .attr = Attr::None, .effects = kHost,
     .doc = "Ends the measurement of this rung and counts it."},
};

constexpr bool rowsInOrder() {
  if (std::size(kOps) != kOpCount) return false;
  constexpr std::string_view kNames[] = {
#define RUNG_OP(name, text) text,
#include "ir/core/ops.def"
#undef RUNG_OP
  };
  for (int i = 0; i < kOpCount; ++i)
    if (static_cast<int>(kOps[i].code) != i || kOps[i].name != kNames[i] || kOps[i].doc.empty()) return false;
  return true;
}
static_assert(rowsInOrder(), "op_info.cpp: one row for each line of ops.def, in its order, with its name and a doc");

} // namespace

const OpInfo& opInfo(OpCode code) { return kOps[static_cast<int>(code)]; }
std::span<const OpInfo> allOps() { return kOps; }
const OpInfo* findOp(std::string_view name) {
  for (const OpInfo& info : kOps)
    if (info.name == name) return &info;
  return nullptr;
}

bool satisfies(Constraint constraint, Type own, Type actual) {
  switch (constraint) {
    case Constraint::None: return false;
    case Constraint::Same: return actual == own;
    case Constraint::Bit: return actual == Type::Bit;
    case Constraint::I32: return actual == Type::I32;
    case Constraint::I64: return actual == Type::I64;
    case Constraint::F64: return actual == Type::F64;
    case Constraint::Narrower: return actual != Type::F64 && bitWidth(actual) < bitWidth(own);
    case Constraint::Wider: return isInt(actual) && bitWidth(actual) > bitWidth(own);
    case Constraint::AnyInt: return isInt(actual);
    case Constraint::Any:
    case Constraint::Variadic: return true;
  }
  return false;
}

Type resultType(Constraint constraint, Type own) {
  switch (constraint) {
    case Constraint::Bit: return Type::Bit;
    case Constraint::I32: return Type::I32;
    case Constraint::I64: return Type::I64;
    case Constraint::F64: return Type::F64;
    case Constraint::Same: return own;
    case Constraint::None:
    case Constraint::Narrower:
    case Constraint::Wider:
    case Constraint::AnyInt:
    case Constraint::Any:
    case Constraint::Variadic: return Type::None;
  }
  return Type::None;
}

} // namespace rung::ir

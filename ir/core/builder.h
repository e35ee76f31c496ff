// Builds one rung, operation by operation. Results get their types from the table of operations; an operand of a wrong
// type stops the process: it is an error of the compiler, never of the user's program.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/core/module.h"

namespace rung::ir {

// A fixed place in a space: byte offset and, for a bit, its number 0..7 within that byte.
struct Place {
  SpaceId space;
  uint32_t byte = 0;
  uint32_t bit = 0;
};

// Elements of a space that a computed index may reach: element 0 is at `byte`, each has one unit of the space. Indices
// below `count` are legal; each element must be within the space at the width of the access.
struct Window {
  SpaceId space;
  uint32_t byte = 0;
  uint32_t count = 0;
};

class RungBuilder {
public:
  // `rung` and `module` must outlive the builder; the rung must be empty.
  RungBuilder(const Module& module, Rung& rung) : module_(module), rung_(rung) {}

  Rung& rung() { return rung_; }
  const Module& module() const { return module_; }
  Type typeOf(ValueId value) const { return ir::typeOf(rung_, value); }
  // The source line of the operations that follow; 0: that of the rung.
  void setLine(uint32_t line) { line_ = line; }

  ValueId constant(Type type, int64_t value);
  // The value of a bit that never changes, as a use of it (Rung::constantBits).
  ValueId constantBit(const Place& place, bool value) {
    rung_.constantBits.push_back({place.space, place.byte * 8 + place.bit});
    return bit(value);
  }
  ValueId bit(bool value) { return constant(Type::Bit, value ? 1 : 0); }
  ValueId i32(int64_t value) { return constant(Type::I32, value); }
  ValueId real(double value);

  // Operations with value operands and at most one result, by their code. `type` is T of the row.
  ValueId op(OpCode code, Type type, std::initializer_list<ValueId> args);

  // T is taken from the first operand.
  ValueId add(ValueId a, ValueId b);
  ValueId sub(ValueId a, ValueId b);
  ValueId mul(ValueId a, ValueId b);
  ValueId and_(ValueId a, ValueId b);
  ValueId or_(ValueId a, ValueId b);
  ValueId xor_(ValueId a, ValueId b);
  ValueId not_(ValueId a);
  ValueId eq(ValueId a, ValueId b);
  ValueId ne(ValueId a, ValueId b);
  ValueId ltS(ValueId a, ValueId b);
  ValueId leS(ValueId a, ValueId b);
  ValueId ltU(ValueId a, ValueId b);
  ValueId leU(ValueId a, ValueId b);
  ValueId shl(ValueId a, ValueId count);
  ValueId shrU(ValueId a, ValueId count);
  ValueId divS(ValueId a, ValueId b);
  ValueId divU(ValueId a, ValueId b);
  ValueId remS(ValueId a, ValueId b);
  ValueId remU(ValueId a, ValueId b);
  ValueId neg(ValueId a);
  ValueId popCount(ValueId a);
  ValueId bcdEncode(ValueId a);
  ValueId bcdDecode(ValueId a);
  ValueId fAdd(ValueId a, ValueId b);
  ValueId fSub(ValueId a, ValueId b);
  ValueId fMul(ValueId a, ValueId b);
  ValueId fNeg(ValueId a);
  ValueId fAbs(ValueId a);
  ValueId fEq(ValueId a, ValueId b);
  ValueId fLt(ValueId a, ValueId b);
  ValueId fLe(ValueId a, ValueId b);
  ValueId binary(OpCode code, ValueId a, ValueId b) { return op(code, typeOf(a), {a, b}); }
  ValueId select(ValueId cond, ValueId a, ValueId b);
  ValueId trunc(Type type, ValueId a);
  ValueId sext(Type type, ValueId a);
  ValueId bitsToF(ValueId bits);
  ValueId fToBits(ValueId real);
  ValueId intToF(ValueId integer);
  // Converts to `type` by zext, sext or trunc, depending on the widths; returns the value itself if it has the type
  // already.
  ValueId zextOrTrunc(Type type, ValueId a);
  ValueId sextOrTrunc(Type type, ValueId a);

  ValueId load(Type type, Place place);
  void store(Place place, ValueId value);
  ValueId loadAt(Type type, Window window, ValueId index);
  void storeAt(Window window, ValueId index, ValueId value);
  ValueId loadBitAt(Window window, ValueId index, ValueId bitNumber);
  void storeBitAt(Window window, ValueId index, ValueId bitNumber, ValueId value);
  ValueId slotLoad(SlotId slot);
  void slotStore(SlotId slot, ValueId value);
  ValueId now();

  // Regions. `yields` of both branches must agree in number and types; endIf returns the results. `branchWeights`: of
  // the condition.
  void if_(ValueId cond, BranchWeights branchWeights = kEven);
  void else_(std::span<const ValueId> yields = {});
  std::vector<ValueId> endIf(std::span<const ValueId> yields = {});
  // `body` adds the operations of a region without results. With an invalid condition they always run.
  template <class Body>
  void when(ValueId cond, Body body, BranchWeights branchWeights = kEven) {
    if (cond.valid()) if_(cond, branchWeights);
    body();
    if (cond.valid()) endIf();
  }
  // The same, with other operations for a condition of 0.
  template <class Yes, class No>
  void when(ValueId cond, Yes yes, No no) {
    if_(cond);
    yes();
    else_();
    no();
    endIf();
  }
  // Each branch adds its operations and returns its value, or a std::array or a struct of values only; returns those of
  // the branch that runs.
  template <class Yes, class No>
  auto choose(ValueId cond, Yes yes, No no, BranchWeights branchWeights = kEven) {
    using Result = decltype(yes());
    static_assert(sizeof(Result) % sizeof(ValueId) == 0);
    using Values = std::array<ValueId, sizeof(Result) / sizeof(ValueId)>; // NOLINT(bugprone-sizeof-expression): or one
    if_(cond, branchWeights);
    Values values = std::bit_cast<Values>(yes());
    else_(values);
    const Values others = std::bit_cast<Values>(no());
    std::ranges::copy(endIf(others), values.begin());
    return std::bit_cast<Result>(values);
  }
  // Returns the number of the iteration (i32), then the carried values.
  std::vector<ValueId> loop(uint32_t count, std::span<const ValueId> carried = {});
  std::vector<ValueId> endLoop(std::span<const ValueId> next = {});

  // `op` is an enum rung_message_op; number, channel and index are i32, value is i64 or f64.
  void message(uint32_t op, ValueId number, ValueId channel, ValueId index, ValueId value);
  ValueId serviceRequest(ServiceId service, std::span<const ValueId> args);
  ValueId servicePoll(ValueId ticket);
  ValueId serviceResult(ValueId ticket, uint32_t index);
  void trap(ValueId cond, FaultId fault);
  void note(std::string_view text);

  void gotoRung(uint32_t target, ValueId cond = {});
  void call(RoutineId callee, ValueId cond = {});
  void ret(ValueId cond = {});
  void end(ValueId cond = {});
  void switchTo(ValueId value, std::vector<uint32_t> targets);

private:
  Op& append(OpCode code, Type type, std::span<const ValueId> args);
  ValueId newResult(Op& op, Type type);
  ValueId resize(OpCode widen, Type type, ValueId a);
  void checkArgs(const Op& op) const;

  const Module& module_;
  Rung& rung_;
  uint32_t line_ = 0;
  std::vector<std::vector<Type>> yieldTypes_; // of open regions: the if's (after its else) or the loop's carried types
};

} // namespace rung::ir

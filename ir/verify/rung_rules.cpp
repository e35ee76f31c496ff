// The rules on rungs (see verify.h). They run in order; each relies on those before it.
#include <algorithm>
#include <fmt/format.h>

#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/verify/rules.h"

namespace rung::ir {
namespace {

constexpr uint32_t kNoOp = RUNG_NONE;
constexpr uint64_t kMaxPasses = 1ull << 20;

class RungCheck {
public:
  explicit RungCheck(ModuleCheck& check) : check_(check), module_(check.module) {}

  void run(RoutineId routine, uint32_t number) {
    routine_ = routine;
    number_ = number;
    rung_ = &module_.at(routine).rungs[number];
    failed_ = false;
    for (void (RungCheck::*rule)() :
         {&RungCheck::header, &RungCheck::form, &RungCheck::regions, &RungCheck::scope, &RungCheck::types,
          &RungCheck::yields, &RungCheck::places, &RungCheck::windows, &RungCheck::slotUse, &RungCheck::host,
          &RungCheck::loops, &RungCheck::profile, &RungCheck::transfer}) {
      (this->*rule)();
      if (failed_) return;
    }
  }

private:
  void fail(Rule rule, size_t op, std::string message) {
    check_.fail(rule, std::move(message), routine_, number_, static_cast<uint32_t>(op));
    failed_ = true;
  }
  template <class Visit>
  void eachOp(Visit visit) {
    for (size_t i = 0; i < rung_->ops.size(); ++i) visit(rung_->ops[i], i);
  }
  // For operations with this attribute.
  template <class Visit>
  void eachOp(Attr attr, Visit visit) {
    if ((attributes_ & bitOf(attr)) == 0) return;
    eachOp([&](const Op& op, size_t i) {
      if (opInfo(op.code).attr == attr) visit(op, i);
    });
  }
  static uint32_t bitOf(Attr attr) { return 1u << static_cast<unsigned>(attr); }
  Type argType(const Op& op, uint32_t i) const { return typeOf(*rung_, rung_->args[op.firstArg + i]); }
  Type resultTypeAt(const Op& op, uint32_t i) const { return rung_->values[op.result.index + i]; }

  void header();
  void form();
  void formOf(const Op& op, size_t i);
  void regions();
  void scope();
  void types();
  void yields();
  void places();
  void windows();
  void slotUse();
  void host();
  void loops();
  void profile();
  void transfer();
  void checkYield(const Op& op, size_t i, const Op& like, uint32_t skip, bool results);

  ModuleCheck& check_;
  const Module& module_;
  RoutineId routine_;
  uint32_t number_ = 0;
  const Rung* rung_ = nullptr;
  bool failed_ = false;
  // Collected by form() about the rung.
  uint32_t attributes_ = 0; // a set of Attr
  bool hasRegions_ = false;
  bool measures_ = false;
  std::vector<const Op*> open_; // of each open region the if, its else, or the loop
  // For scope(), by value: whether its region has ended; used if there are regions.
  std::vector<uint8_t> hidden_;
};

void RungCheck::header() {
  const Location& begin = rung_->begin;
  if (begin.file.valid() ? begin.file.index >= module_.files.size() : begin.line != 0)
    fail(Rule::Header, kNoOp, "the file does not exist");
  if (rung_->lastLine != 0 && rung_->lastLine < begin.line)
    fail(Rule::Header, kNoOp, "the last line is before the first");
  if (rung_->weight == 0) fail(Rule::Header, kNoOp, "the weight is 0");
  const auto bitsIn = [](const Space& space) { return uint64_t{space.units} * space.unitBytes * 8; };
  for (const auto& [space, bit] : rung_->constantBits)
    if (space.index >= module_.spaces.size() || bit >= bitsIn(module_.at(space)))
      fail(Rule::Header, kNoOp, "a bit that it reads does not exist");
}

// ---- form ----------------------------------------------------------------------------------------------------------

// The number of results of an operation. Endif and endloop have as many as operands, which `yields` compares with the
// other end; a loop has one more.
uint32_t resultsOf(const Op& op) {
  const OpInfo& info = opInfo(op.code);
  if (info.result == Constraint::None) return 0;
  if (info.result != Constraint::Variadic) return 1;
  return op.code == OpCode::Loop ? op.argCount + 1u : op.argCount;
}

bool unusedFieldsAreEmpty(const Op& op) {
  const Attr attr = opInfo(op.code).attr;
  const bool usesImm = attr == Attr::Literal || attr == Attr::Place || attr == Attr::Window || attr == Attr::ResultNo;
  const bool usesCount = attr == Attr::Window || attr == Attr::Count;
  const bool usesRef = attr != Attr::None && attr != Attr::Literal && attr != Attr::Count && attr != Attr::ResultNo;
  return (usesImm || op.imm == 0) && (usesCount || op.count == 0) && (usesRef || op.ref == 0);
}

bool isRegion(OpCode code) {
  return code == OpCode::If || code == OpCode::Else || code == OpCode::EndIf || code == OpCode::Loop ||
         code == OpCode::EndLoop;
}

bool isMeasuring(OpCode code) { return code == OpCode::ProfEnter || code == OpCode::ProfLeave; }

void RungCheck::formOf(const Op& op, size_t i) {
  const OpInfo& info = opInfo(op.code);
  if (!contains(info.types, op.type))
    return fail(Rule::Form, i, fmt::format("{} has no type {}", info.name, typeName(op.type)));
  if (op.argCount != info.fixed && (op.argCount < info.fixed || !isVariadic(info)))
    return fail(Rule::Form, i, fmt::format("{} operands", op.argCount));
  if (op.resultCount != resultsOf(op)) return fail(Rule::Form, i, fmt::format("{} results", op.resultCount));
  if (op.resultCount == 0 && op.result.valid()) return fail(Rule::Form, i, "a number of results without results");
  if (!unusedFieldsAreEmpty(op)) return fail(Rule::Form, i, "a field that the operation does not use is set");
  if (info.attr == Attr::Literal && (static_cast<uint64_t>(op.imm) & ~valueMask(op.type)) != 0)
    fail(Rule::Form, i, "the constant is wider than its type");
}

void RungCheck::form() {
  attributes_ = 0;
  hasRegions_ = false;
  measures_ = false;
  size_t args = 0;
  size_t values = 0;
  size_t notes = 0;
  eachOp([&](const Op& op, size_t i) {
    if (failed_) return;
    formOf(op, i);
    attributes_ |= bitOf(opInfo(op.code).attr);
    hasRegions_ = hasRegions_ || isRegion(op.code);
    measures_ = measures_ || isMeasuring(op.code);
    if (op.firstArg != args || args + op.argCount > rung_->args.size())
      return fail(Rule::Form, i, "operands out of sequence");
    if (op.resultCount != 0 && (op.result.index != values || values + op.resultCount > rung_->values.size()))
      return fail(Rule::Form, i, "results out of sequence");
    if (opInfo(op.code).attr == Attr::Text) {
      if (op.ref != notes || notes >= rung_->notes.size()) return fail(Rule::Form, i, "notes out of sequence");
      ++notes;
    }
    args += op.argCount;
    values += op.resultCount;
  });
  if (failed_) return;
  if (args != rung_->args.size() || values != rung_->values.size() || notes != rung_->notes.size())
    fail(Rule::Form, kNoOp, "operands, values or notes of no operation");
}

// ---- structure -----------------------------------------------------------------------------------------------------

void RungCheck::regions() {
  if (!hasRegions_) return;
  std::vector<const Op*>& open = open_;
  open.clear();
  eachOp([&](const Op& op, size_t i) {
    const OpCode inner = open.empty() ? OpCode::Note : open.back()->code;
    if (op.code == OpCode::If || op.code == OpCode::Loop) {
      open.push_back(&op);
    } else if (op.code == OpCode::Else) {
      if (inner != OpCode::If)
        fail(Rule::Regions, i, "else without if");
      else
        open.back() = &op;
    } else if (op.code == OpCode::EndIf) {
      if (inner != OpCode::If && inner != OpCode::Else)
        fail(Rule::Regions, i, "endif without if");
      else
        open.pop_back();
    } else if (op.code == OpCode::EndLoop) {
      if (inner != OpCode::Loop)
        fail(Rule::Regions, i, "endloop without loop");
      else
        open.pop_back();
    }
  });
  if (!open.empty() && !failed_) fail(Rule::Regions, rung_->ops.size(), "a region is not closed");
}

void RungCheck::scope() {
  hidden_.assign(hasRegions_ ? rung_->values.size() : 0, 0);
  std::vector<uint32_t> firstOfRegion; // values from here on belong to the open region
  uint32_t next = 0;
  const auto need = [&](ValueId id, size_t i) {
    if (id.index >= next || (hasRegions_ && hidden_[id.index] != 0))
      fail(Rule::Scope, i, fmt::format("%{} is not defined here", id.index));
  };
  eachOp([&](const Op& op, size_t i) {
    for (uint32_t k = 0; k < op.argCount; ++k) need(rung_->args[op.firstArg + k], i);
    if (op.code == OpCode::Else || op.code == OpCode::EndIf || op.code == OpCode::EndLoop) {
      std::fill(hidden_.begin() + firstOfRegion.back(), hidden_.begin() + next, uint8_t{1});
      firstOfRegion.pop_back();
    }
    if (op.code == OpCode::If || op.code == OpCode::Else || op.code == OpCode::Loop) firstOfRegion.push_back(next);
    next += op.resultCount;
  });
  for (ValueId id : {rung_->transfer.cond, rung_->transfer.value})
    if (id.valid()) need(id, rung_->ops.size());
}

void RungCheck::types() {
  eachOp([&](const Op& op, size_t i) {
    const OpInfo& info = opInfo(op.code);
    for (uint32_t k = 0; k < info.fixed; ++k)
      if (!satisfies(info.operands[k], op.type, argType(op, k)))
        fail(Rule::Types, i, fmt::format("operand {} is {}", k, typeName(argType(op, k))));
    for (uint32_t k = 0; k < op.resultCount; ++k)
      if (resultTypeAt(op, k) == Type::None) fail(Rule::Types, i, "a result without a type");
    if (info.result == Constraint::None || info.result == Constraint::Variadic) return;
    const Type wanted = resultType(info.result, op.type);
    if (resultTypeAt(op, 0) != wanted)
      fail(Rule::Types, i, fmt::format("the result is {}, not {}", typeName(resultTypeAt(op, 0)), typeName(wanted)));
  });
}

// Checks that the operands of `op` (or its results, except the first `skip`) have the types of the operands of `like`.
void RungCheck::checkYield(const Op& op, size_t i, const Op& like, uint32_t skip, bool results) {
  const uint32_t count = results ? op.resultCount - skip : op.argCount;
  if (count != like.argCount)
    return fail(Rule::Yields, i, fmt::format("{} values where {} are expected", count, like.argCount));
  for (uint32_t k = 0; k < count; ++k) {
    const Type type = results ? resultTypeAt(op, skip + k) : argType(op, k);
    if (type != argType(like, k))
      fail(Rule::Yields, i, fmt::format("value {} is {}, not {}", k, typeName(type), typeName(argType(like, k))));
  }
}

void RungCheck::yields() {
  if (!hasRegions_) return;
  static const Op kNothing{};
  std::vector<const Op*>& open = open_;
  open.clear();
  eachOp([&](const Op& op, size_t i) {
    if (op.code == OpCode::If) {
      open.push_back(&op);
    } else if (op.code == OpCode::Else) {
      open.back() = &op;
    } else if (op.code == OpCode::Loop) {
      checkYield(op, i, op, 1, true);
      if (resultTypeAt(op, 0) != Type::I32) fail(Rule::Yields, i, "the number of the pass is not an i32");
      open.push_back(&op);
    } else if (op.code == OpCode::EndIf || op.code == OpCode::EndLoop) {
      const Op& like = open.back()->code == OpCode::If ? kNothing : *open.back();
      checkYield(op, i, like, 0, false);
      checkYield(op, i, like, 0, true);
      open.pop_back();
    }
  });
}

// ---- memory and host -----------------------------------------------------------------------------------------------

void RungCheck::places() {
  eachOp(Attr::Place, [&](const Op& op, size_t i) {
    if (op.ref >= module_.spaces.size()) return fail(Rule::Places, i, "the space does not exist");
    if (op.type != Type::Bit && op.imm % 8 != 0) return fail(Rule::Places, i, "the access begins within a byte");
    const uint64_t bytes = op.type == Type::Bit ? 1 : byteWidth(op.type);
    if (op.imm < 0 || !check_.inside(SpaceId{op.ref}, static_cast<uint64_t>(op.imm) / 8, bytes))
      fail(Rule::Places, i, "the access lies outside its space");
  });
}

void RungCheck::windows() {
  eachOp(Attr::Window, [&](const Op& op, size_t i) {
    if (op.ref >= module_.spaces.size()) return fail(Rule::Windows, i, "the space does not exist");
    if (op.count == 0) return fail(Rule::Windows, i, "the window is empty");
    if (op.imm < 0 || op.imm % 8 != 0) return fail(Rule::Windows, i, "the window begins within a byte");
    const uint64_t unit = module_.spaces[op.ref].unitBytes;
    const uint64_t bytes = (uint64_t{op.count} - 1) * unit + (op.type == Type::Bit ? unit : byteWidth(op.type));
    if (!check_.inside(SpaceId{op.ref}, static_cast<uint64_t>(op.imm) / 8, bytes))
      fail(Rule::Windows, i, "the window reaches beyond its space");
  });
}

void RungCheck::slotUse() {
  eachOp(Attr::Slot, [&](const Op& op, size_t i) {
    if (op.ref >= module_.slots.size())
      fail(Rule::SlotUse, i, "the slot does not exist");
    else if (module_.slots[op.ref].type != op.type)
      fail(Rule::SlotUse, i, fmt::format("the slot is {}", typeName(module_.slots[op.ref].type)));
  });
}

void RungCheck::host() {
  eachOp(Attr::MessageOp, [&](const Op& op, size_t i) {
    const Type value = argType(op, 3);
    if (op.ref > RUNG_MESSAGE_LOG) fail(Rule::Host, i, "there is no such kind of message");
    if (value != Type::I64 && value != Type::F64)
      fail(Rule::Host, i, fmt::format("the value of the message is {}", typeName(value)));
  });
  eachOp(Attr::Service, [&](const Op& op, size_t i) {
    if (op.ref >= module_.services.size()) fail(Rule::Host, i, "the service does not exist");
    if (op.argCount > RUNG_MAX_SERVICE_ARGS) fail(Rule::Host, i, "too many arguments of a service");
    for (uint32_t k = 0; k < op.argCount; ++k)
      if (argType(op, k) != Type::I64)
        fail(Rule::Host, i, fmt::format("argument {} is {}", k, typeName(argType(op, k))));
  });
  eachOp(Attr::BranchWeights, [&](const Op& op, size_t i) {
    if (op.ref > kSeldom) fail(Rule::Form, i, "there are no such branch weights");
  });
  eachOp(Attr::Fault, [&](const Op& op, size_t i) {
    if (op.ref >= module_.faults.size()) fail(Rule::Host, i, "the fault does not exist");
  });
  eachOp(Attr::ResultNo, [&](const Op& op, size_t i) {
    if (op.imm < 0 || op.imm >= static_cast<int64_t>(RUNG_MAX_SERVICE_ARGS))
      fail(Rule::Host, i, "there is no such result");
  });
}

void RungCheck::loops() {
  if ((attributes_ & bitOf(Attr::Count)) == 0) return;
  std::vector<uint64_t> passes{1}; // product over the open loops
  uint64_t total = 0;
  eachOp([&](const Op& op, size_t i) {
    if (op.code == OpCode::EndLoop) passes.pop_back();
    if (op.code != OpCode::Loop) return;
    passes.push_back(std::min(passes.back() * std::min<uint64_t>(op.count, kMaxPasses + 1), kMaxPasses + 1));
    total = std::min(total + passes.back(), kMaxPasses + 1);
    if (total > kMaxPasses && !failed_)
      fail(Rule::Loops, i, fmt::format("the rung makes more than {} passes", kMaxPasses));
  });
}

void RungCheck::profile() {
  const bool instrumented = module_.instrumented;
  const size_t last = rung_->ops.size() - 1;
  if (check_.mode == Mode::Built && instrumented) fail(Rule::Profile, kNoOp, "the module is instrumented already");
  if (instrumented && (rung_->ops.empty() || rung_->ops.front().code != OpCode::ProfEnter ||
                       rung_->ops[last].code != OpCode::ProfLeave || last == 0))
    return fail(Rule::Profile, kNoOp, "the rung is not measured");
  if (!measures_) return;
  eachOp([&](const Op& op, size_t i) {
    if (!isMeasuring(op.code)) return;
    if (!instrumented || i != (op.code == OpCode::ProfEnter ? 0 : last))
      fail(Rule::Profile, i, "profiling out of place");
  });
}

void RungCheck::transfer() {
  const Transfer& t = rung_->transfer;
  const size_t at = rung_->ops.size();
  const size_t rungs = module_.at(routine_).rungs.size();
  const auto refuse = [&](std::string_view message) { fail(Rule::Transfer, at, std::string(message)); };
  if (t.kind == TransferKind::Goto ? t.target >= rungs : t.target != 0) refuse("the target does not exist");
  if (t.kind == TransferKind::Call ? t.callee.index >= module_.routines.size() : t.callee.valid())
    refuse("the callee does not exist");
  const bool switches = t.kind == TransferKind::Switch;
  if (switches == t.targets.empty()) refuse(switches ? "a switch without targets" : "targets without a switch");
  for (uint32_t target : t.targets)
    if (target >= rungs) refuse(fmt::format("target {} does not exist", target));
  if (switches ? !t.value.valid() || typeOf(*rung_, t.value) != Type::I32 : t.value.valid())
    refuse("the value of a switch is an i32");
  const bool conditional = t.kind != TransferKind::Next && !switches;
  if (t.cond.valid() && (!conditional || typeOf(*rung_, t.cond) != Type::Bit))
    refuse(conditional ? "the condition is not a bit" : "a condition that is not used");
}

} // namespace

void checkRungs(ModuleCheck& check) {
  RungCheck rungs(check);
  for (uint32_t r = 0; r < check.module.routines.size(); ++r)
    for (uint32_t i = 0; i < check.module.routines[r].rungs.size(); ++i) rungs.run(RoutineId{r}, i);
}

} // namespace rung::ir

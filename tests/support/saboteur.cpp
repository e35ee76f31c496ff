// Operations made wrong (see saboteur.h).
#include "tests/support/saboteur.h"

#include "ir/core/ops.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {
namespace {

class Saboteur {
public:
  explicit Saboteur(OpCode code) : code_(code) {}

  void run(Rung& rung) {
    rewriter_.start(rung);
    for (const Op& op : rung.ops) {
      if (op.code == code_)
        spoil(op);
      else
        rewriter_.copy(op);
    }
    rewriter_.finish(rung);
  }

private:
  void spoil(const Op& op) {
    switch (op.code) {
    case OpCode::Note: rewriter_.copy(op); return;
    case OpCode::Const: rewriter_.copy(op).imm ^= 1; return;
    case OpCode::If:
    case OpCode::Trap:
    case OpCode::Message:
    case OpCode::Store:
    case OpCode::SlotStore: return spoilArgs(op, 0, 1);
    case OpCode::StoreAt: return spoilArgs(op, 1, 1);
    case OpCode::StoreBitAt: return spoilArgs(op, 2, 1);
    case OpCode::Else:
    case OpCode::EndIf:
    case OpCode::EndLoop: return spoilArgs(op, 0, op.argCount);
    case OpCode::Loop: // one pass too few; where there is none, one too many
      rewriter_.copy(op).count = op.count > 0 ? op.count - 1 : 1;
      return;
    case OpCode::ProfEnter: // counts as well
      rewriter_.copy(op);
      rewriter_.put(op, OpCode::ProfLeave, Type::None, {});
      return;
    case OpCode::ProfLeave: return; // does not count
    default: break;                 // one result each
    }
    rewriter_.copy(op);
    rewriter_.replace(op.result, flipped(op, rewriter_.mapped(op.result)));
  }

  // The operation uses other values for `count` of its operands.
  void spoilArgs(const Op& op, uint32_t first, uint32_t count) {
    std::vector<ValueId> wrong;
    for (uint32_t i = 0; i < count; ++i) wrong.push_back(flipped(op, rewriter_.mappedArg(op, first + i)));
    const Op& written = rewriter_.copy(op);
    for (uint32_t i = 0; i < count; ++i) rewriter_.setArg(written, first + i, wrong[i]);
  }

  // The value with another lowest bit.
  ValueId flipped(const Op& at, ValueId value) {
    const Type type = rewriter_.type(value);
    if (type != Type::F64)
      return rewriter_.putBefore(at, OpCode::Xor, type, {value, rewriter_.putConstant(at, type, 1)}).result;
    const ValueId bits = rewriter_.putBefore(at, OpCode::FToBits, Type::I64, {value}).result;
    return rewriter_.putBefore(at, OpCode::BitsToF, Type::F64, {flipped(at, bits)}).result;
  }

  const OpCode code_;
  RungRewriter rewriter_;
};

} // namespace

void sabotage(Module& module, OpCode code) {
  Saboteur saboteur(code);
  for (Routine& routine : module.routines)
    for (Rung& rung : routine.rungs) saboteur.run(rung);
}

} // namespace rung::ir

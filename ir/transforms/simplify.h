// The simplification of one operation with known or related operands: to a constant, an operand, or a simpler
// operation.
#pragma once
#include "ir/core/module.h"
#include "ir/core/ops.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {

// The bits of a value that is a constant.
inline bool isConstant(const RungRewriter& writer, ValueId value, uint64_t& bits) {
  const Op& op = writer.definition(value);
  bits = static_cast<uint64_t>(op.imm);
  return op.code == OpCode::Const;
}

// Writes what replaces `op`, or nothing if it has no effect. False if `op` cannot be simplified. `op` must not open,
// divide or close a region; its operands have been written.
bool simplify(const Module& module, RungRewriter& writer, const Op& op);

} // namespace rung::ir

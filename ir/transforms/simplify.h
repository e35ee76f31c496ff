// What one operation is when its operands are known or related: a constant, an operand, or a simpler operation.
#pragma once
#include "ir/core/module.h"
#include "ir/core/ops.h"
#include "ir/transforms/rewriter.h"

namespace rung::ir {

// The bits of a value that a constant gives.
inline bool isConstant(const RungRewriter& writer, ValueId value, uint64_t& bits) {
  const Op& op = writer.definition(value);
  bits = static_cast<uint64_t>(op.imm);
  return op.code == OpCode::Const;
}

// Writes what replaces `op`, or nothing where it does nothing. False when there is nothing better than `op` itself.
// `op` opens, divides and closes no region; its operands are written already.
bool simplify(const Module& module, RungRewriter& writer, const Op& op);

} // namespace rung::ir

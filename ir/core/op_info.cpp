// The rows of ops.def as data (see op_info.h).
#include "ir/core/op_info.h"

#include "ir/core/ops.h"

namespace rung::ir {
namespace {

using enum Constraint;

// Of value operations, by the signature of their row.
constexpr Operands Unary{Same};
constexpr Operands Binary{Same, Same};
constexpr Operands Shift{Same, I32};
constexpr Operands Choice{Bit, Same, Same};
constexpr Operands FromF64{F64};
constexpr Operands FromI64{I64};
constexpr Operands FromNarrower{Narrower};
constexpr Operands FromWider{Wider};
constexpr Operands FromInt{AnyInt};

} // namespace

constexpr OpInfo kOpRows[] = {
#define RUNG_LIST(...) {__VA_ARGS__}
#define RUNG_OP(code, name, types, operands, result, attribute, effects, doc)                                          \
  {OpCode::code, #name, k##types, Operands RUNG_LIST operands, result, Attr::attribute, effects, {}, doc},
#define RUNG_VALUE_OP(code, name, types, signature, result, function, doc)                                             \
  {OpCode::code, #name, k##types, signature, result, Attr::None, kPure, #function, doc},
#include "ir/core/ops.def"
#undef RUNG_LIST
};

std::span<const OpInfo> allOps() { return kOpRows; }

const OpInfo* findOp(std::string_view name) {
  for (const OpInfo& info : kOpRows)
    if (info.name == name) return &info;
  return nullptr;
}

} // namespace rung::ir

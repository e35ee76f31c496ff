// Comparisons of integers (man. §6.12): CMP, which sets flags, and the contacts CLT to CGT.
#include "frontend/dialects/nct/lower/lower.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::ValueId;

// Exactly one of FL_GT, FL_EQ, FL_LT is 1 afterwards.
ValueId lowerCompare(Lowering& box) {
  RungBuilder& b = box.b;
  execute(box, [&] {
    ValueId valid;
    const ValueId x = box.memory.integer(box.operands[0], valid);
    const ValueId y = box.memory.integer(box.operands[1], valid);
    return guarded(box, valid, [&] {
      box.memory.setErrorFlag(false);
      box.memory.setFlag(kFlagGt, b.ltS(y, x));
      box.memory.setFlag(kFlagEq, b.eq(x, y));
      box.memory.setFlag(kFlagLt, b.ltS(x, y));
      return ValueId{};
    });
  });
  return {};
}

ValueId lowerCompareContact(Lowering& box) {
  RungBuilder& b = box.b;
  ValueId valid;
  const ValueId x = box.memory.integer(box.operands[0], valid);
  const ValueId y = box.memory.integer(box.operands[1], valid);
  const ValueId holds = frontend::compare(b, box.variant, x, y);
  if (!valid.valid()) return box.pass(holds);
  box.memory.raiseErrorFlag(box.gate(b.not_(valid)));
  return box.pass(b.and_(holds, valid));
}

} // namespace rung::frontend::nct

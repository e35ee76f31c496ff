// Comparisons (§7.10).
#include "frontend/dialects/gsk/lower/lower.h"

namespace rung::frontend::gsk {

using ir::Type;
using ir::ValueId;

void lowerCompare(Lowering& f) {
  f.b.when(f.act(), [&] {
    ir::RungBuilder& b = f.b;
    const ValueId benchmark = f.operand(1, f.dataType());
    const ValueId data = f.load(f.dataType(), f.param(2).address);
    const ValueId unequal = b.select(b.ltS(data, benchmark), b.constant(Type::I8, 2), b.constant(Type::I8, 4));
    f.store(f.param(3).address, b.select(b.eq(benchmark, data), b.constant(Type::I8, 1), unequal));
  });
}

void lowerCoincidence(Lowering& f) {
  f.latchedOutput(f.act(), {},
                  [&] { return f.b.eq(f.operand(1, f.dataType()), f.load(f.dataType(), f.param(2).address)); });
}

} // namespace rung::frontend::gsk

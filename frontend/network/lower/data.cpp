// Transfers, decoding, bit logic, shift and parity (§7.3, §7.7, §7.8, §7.14, §7.15).
#include "frontend/lower/operations.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::network {

using ir::Type;
using ir::ValueId;

// Bit i is (code == first + i): 1 shifted left by code - first, which gives 0 if the difference is above 7; each
// further byte of the result is eight codes on.
void lowerDecode(Lowering& f) {
  ir::RungBuilder& b = f.b;
  const ValueId code = f.load(f.dataType(), f.param(1).address);
  const ValueId distance = b.zextOrTrunc(Type::I32, b.sub(code, b.constant(f.dataType(), f.param(2).value)));
  for (uint32_t byte = 0; byte < f.function.count; ++byte) {
    const ValueId own = byte == 0 ? distance : b.sub(distance, b.i32(8 * byte));
    const ValueId bits = b.shl(b.constant(Type::I8, 1), own);
    f.store(plus(f.param(3).address, byte), b.select(f.act(), bits, b.constant(Type::I8, 0)));
  }
}

void lowerMoveMasked(Lowering& f) {
  f.b.when(f.act(), [&] {
    const ValueId mask = f.b.constant(Type::I8, f.param(0).value * 16 + f.param(1).value);
    f.store(f.param(3).address, f.b.and_(f.load(Type::I8, f.param(2).address), mask));
  });
}

void lowerMoveOr(Lowering& f) {
  f.b.when(f.act(), [&] {
    const ValueId source = f.load(Type::I8, f.param(0).address);
    f.store(f.param(2).address, f.b.or_(source, f.load(Type::I8, f.param(1).address)));
  });
}

void lowerMove(Lowering& f) {
  f.b.when(f.act(), [&] {
    const Type type = ir::intOfBytes(static_cast<uint32_t>(f.variant()));
    f.store(f.param(1).address, f.load(type, f.param(0).address));
  });
}

// Everything is read before anything is written, so the areas may overlap (P33).
void lowerMoveBlock(Lowering& f) {
  f.b.when(f.act(), [&] {
    struct Piece {
      uint32_t offset;
      ValueId value;
    };
    std::vector<Piece> pieces;
    const auto size = static_cast<uint32_t>(f.param(0).value);
    uint32_t offset = 0;
    for (uint32_t width : {8u, 4u, 2u, 1u})
      for (; size - offset >= width; offset += width)
        pieces.push_back({offset, f.load(ir::intOfBytes(width), plus(f.param(1).address, offset))});
    for (const Piece& piece : pieces) f.store(plus(f.param(2).address, piece.offset), piece.value);
  });
}

void lowerNumber(Lowering& f) {
  f.b.when(f.act(), [&] {
    const ValueId value = f.b.constant(f.dataType(), f.param(1).value);
    for (uint32_t i = 0; i < f.function.count; ++i) f.store(plus(f.param(2).address, i * f.function.length), value);
  });
}

void lowerLogic(Lowering& f) {
  f.b.when(f.act(), [&] {
    const ValueId a = f.load(f.dataType(), f.param(1).address);
    const ValueId b = f.operand(2, f.dataType());
    f.store(f.param(3).address, frontend::combine(f.b, f.variant(), a, b));
  });
}

void lowerNot(Lowering& f) {
  f.b.when(f.act(), [&] { f.store(f.param(2).address, f.b.not_(f.load(f.dataType(), f.param(1).address))); });
}

// Conditions DIR, CONT, RST, ACT.
void lowerShift(Lowering& f) {
  f.resettable([&] {
    ir::RungBuilder& b = f.b;
    const ValueId right = f.condition(0);
    const ValueId old = f.load(Type::I16, f.param(0).address);
    const ValueId one = b.i32(1);
    const ValueId shifted = b.select(right, b.shrU(old, one), b.shl(old, one));
    const ValueId kept = b.select(f.condition(1), b.or_(shifted, old), shifted);
    const ValueId end = b.select(right, old, b.shrU(old, b.i32(15)));
    f.store(f.param(0).address, kept);
    return b.trunc(Type::Bit, end);
  });
}

// Conditions OE, RST, ACT.
void lowerParity(Lowering& f) {
  f.resettable([&] {
    const ValueId ones = f.b.popCount(f.load(Type::I8, f.param(0).address));
    return f.b.xor_(f.b.trunc(Type::Bit, ones), f.condition(0));
  });
}

} // namespace rung::frontend::network

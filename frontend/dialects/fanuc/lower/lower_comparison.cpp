// Comparisons (inventory §6.7) and the display of messages (§6.10).
#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/network/lower/functions.h"

namespace rung::frontend::fanuc {
namespace {

using ir::Type;
using ir::ValueId;

// A constant or an address, of as many bytes as the row says.
ValueId value(Lowering& f, size_t i) {
  const uint32_t bytes = network::kindOf(f.function.row->info.operands[i]).bytes;
  return f.operand(i, ir::intOfBytes(bytes));
}

} // namespace

void lowerCompare(Lowering& f) {
  f.b.when(f.act(), [&] {
    ir::RungBuilder& b = f.b;
    const ValueId input = f.operand(1, f.dataType());
    const ValueId comparison = f.load(f.dataType(), f.param(2).address);
    const Type wide = ir::intOfBytes(2 * f.function.length);
    const ValueId difference = b.sub(b.sextOrTrunc(wide, input), b.sextOrTrunc(wide, comparison));
    const ValueId overflow = b.ne(b.sextOrTrunc(wide, b.trunc(f.dataType(), difference)), difference);
    network::storeFlags(f, b.eq(input, comparison), b.ltS(input, comparison), overflow);
  });
}

void lowerRelation(Lowering& f) {
  f.setOutput(f.b.and_(f.act(), frontend::compare(f.b, f.variant(), value(f, 0), value(f, 1))));
}

void lowerRange(Lowering& f) {
  ir::RungBuilder& b = f.b;
  const ValueId first = value(f, 0), second = value(f, 1), input = value(f, 2);
  const ValueId up = b.and_(b.leS(first, input), b.leS(input, second));
  const ValueId down = b.and_(b.leS(second, input), b.leS(input, first));
  f.setOutput(b.and_(f.act(), b.or_(up, down)));
}

// The byte counts the instructions with ACT=1: messages are shown while there is one.
void lowerDisplay(Lowering& f) {
  ir::RungBuilder& b = f.b;
  const ir::Window display = f.hidden(kDisplaySpace, 1, 1);
  const auto number = [&](ValueId bit) { return b.zextOrTrunc(Type::I8, bit); };
  const ValueId before = frontend::exchange(b, f.slot("shown", Type::Bit), f.act());
  const ValueId showing = b.loadAt(Type::I8, display, b.i32(0));
  b.storeAt(display, b.i32(0), b.add(showing, b.sub(number(f.act()), number(before))));
}

} // namespace rung::frontend::fanuc

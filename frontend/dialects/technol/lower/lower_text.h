// Texts of instructions (man. ch. 3.18): characters up to a terminator, within their variable.
#pragma once
#include <array>

#include "frontend/dialects/technol/lower/areas.h"

namespace rung::frontend::technol {

// A text, or the characters between apostrophes. `room`: capacity in characters from the address on, at most `most`.
struct Text {
  Area area;
  uint32_t most = 0;
  ir::ValueId room;
  bool literal = false;
};

inline Length roomOf(const Text& text) { return {.fixed = text.area.fixed, .most = text.most, .value = text.room}; }
// An index outside of the text stops the program.
Text textOf(Memory& memory, const Operand& operand);
// Number of characters before the terminator; a text without one has as many as fit.
Length lengthOf(ir::RungBuilder& b, const Text& text);
void storeTerminator(ir::RungBuilder& b, const Area& area, ir::ValueId at, ir::ValueId cond);
// Whether one of the operands is a long text, whose instruction gets a separate rung.
bool anyIsLong(std::span<const Operand> operands);

template <class Body>
void inOwnRung(RoutineBuilder& out, bool isLong, Body body) {
  if (isLong) out.cut();
  body();
  if (isLong) out.cut();
}

// Iterates over the numbers below `most`: `pass` takes a number, the value and whether it continues, and returns the
// next two. Blocks after the end are skipped. Returns the last value.
template <class Pass>
ir::ValueId passWhile(ir::RungBuilder& b, uint32_t most, ir::ValueId first, Pass pass) {
  using PassState = std::array<ir::ValueId, 2>;
  const auto run = [&](uint32_t count, ir::ValueId start, const PassState& state) {
    const auto in = b.loop(count, state);
    const auto out = b.endLoop(PassState(pass(b.add(start, in[0]), in[1], in[2])));
    return PassState{out[0], out[1]};
  };
  const PassState begin{first, b.bit(true)};
  if (most <= 2 * kBlock) return run(most, b.i32(0), begin)[0];
  const auto block = b.loop((most + kBlock - 1) / kBlock, begin);
  const PassState state{block[1], block[2]};
  const auto inside = [&] { return run(kBlock, b.mul(block[0], b.i32(kBlock)), state); };
  return b.endLoop(b.choose(state[1], inside, [&] { return state; }))[0];
}

} // namespace rung::frontend::technol

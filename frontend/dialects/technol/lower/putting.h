// Bytes that the control gives in the results of several requests, eight a word, put into the program's memory.
#pragma once

#include "frontend/dialects/technol/lower/areas.h"

namespace rung::frontend::technol {

// What each request brings.
struct PartSize {
  uint32_t bytes = 0;     // at most
  uint32_t firstWord = 0; // among its results
};

// Puts the words of one request, which begin at the byte `first` of the area.
inline void putWords(ir::RungBuilder& b, const Area& to, ir::ValueId count, ir::ValueId ticket, ir::ValueId first,
                     uint32_t words, uint32_t firstWord) {
  for (uint32_t w = 0; w < words; ++w) {
    const ir::ValueId word = b.serviceResult(ticket, firstWord + w);
    const ir::ValueId begin = b.add(first, b.i32(int64_t{w} * 8));
    const auto in = b.loop(8, std::array{word});
    const ir::ValueId number = b.add(begin, in[0]);
    b.when(b.ltU(number, count), [&] { storeByte(b, to, number, b.zextOrTrunc(ir::Type::I8, in[1])); });
    b.endLoop(std::array{b.shrU(in[1], b.i32(8))});
  }
}

// The first `count` bytes (i32), at most `most`; `request` asks for a part by its number (i32) and gives the ticket.
template <class Request>
void putParts(ir::RungBuilder& b, const Area& to, ir::ValueId count, uint32_t most, PartSize size, Request request) {
  if (most == 0) return;
  const uint32_t parts = (most + size.bytes - 1) / size.bytes;
  const uint32_t words = parts > 1 ? size.bytes / 8 : (most + 7) / 8;
  const ir::ValueId part = b.loop(parts)[0];
  const ir::ValueId first = b.mul(part, b.i32(size.bytes));
  b.when(b.ltU(first, count), [&] { putWords(b, to, count, request(part), first, words, size.firstWord); });
  b.endLoop();
}

} // namespace rung::frontend::technol

// The map of kept bytes (see retain_map.h).
#include "rtlib/retain/retain_map.h"

#include <algorithm>

#include "rtlib/core/bits.h"
#include "rtlib/core/memory.h"
#include "rtlib/load/program_info.h"

namespace rung::runtime {

RetainMap::RetainMap(const rung_program& program)
    : pieces_(piecesOf(program)), layout_(retainLayoutOf(program, runsOf(pieces_))) {
  for (const Piece& piece : pieces_) {
    size_ += piece.bytes;
    rawSize_ += piece.bytes * (piece.expanded ? 8 : 1);
  }
}

std::vector<RetainMap::Piece> RetainMap::piecesOf(const rung_program& program) {
  std::vector<Piece> pieces;
  for (const rung_span& span : std::span(program.retains, program.retain_count))
    for (uint32_t done = 0; done < span.size;) {
      const std::optional<LogicalByte> byte = byteAt(program, span.offset + done);
      if (!byte) break; // checkProgram and the compiler refuse it
      const rung_range& range = *core::Memory(program, nullptr).rangeOf(byte->space, byte->byte);
      const bool expanded = range.repr == RUNG_REPR_BYTE_PER_BIT;
      const uint32_t scale = expanded ? 8 : 1;
      const uint32_t bytes = std::min((span.size - done) / scale, range.first_byte + range.byte_count - byte->byte);
      pieces.push_back({byte->space, byte->byte, bytes, expanded});
      done += bytes * scale;
    }
  return pieces;
}

std::vector<RetainRun> RetainMap::runsOf(const std::vector<Piece>& pieces) {
  std::vector<RetainRun> runs;
  for (const Piece& piece : pieces) {
    if (!runs.empty() && runs.back().space == piece.space && runs.back().first + runs.back().count == piece.first)
      runs.back().count += piece.bytes;
    else
      runs.push_back({piece.space, piece.first, piece.bytes});
  }
  return runs;
}

void RetainMap::pack(std::span<const uint8_t> raw, std::span<uint8_t> image) const {
  size_t from = 0;
  size_t to = 0;
  for (const Piece& piece : pieces_)
    for (uint32_t i = 0; i < piece.bytes; ++i) {
      if (!piece.expanded) {
        image[to++] = raw[from++];
        continue;
      }
      image[to++] = core::packBits(&raw[from]);
      from += 8;
    }
}

void RetainMap::unpack(std::span<const uint8_t> image, std::span<uint8_t> raw) const {
  size_t from = 0;
  size_t to = 0;
  for (const Piece& piece : pieces_)
    for (uint32_t i = 0; i < piece.bytes; ++i, ++from) {
      if (!piece.expanded) {
        raw[to++] = image[from];
        continue;
      }
      core::unpackBits(image[from], &raw[to]);
      to += 8;
    }
}

} // namespace rung::runtime

// Makes the description of the retained cells from a program's tables.
#include "rtlib/retain/retained_cells.h"

#include <zlib.h>

#include <algorithm>
#include <initializer_list>
#include <new>
#include <string_view>
#include <vector>

#include "rtlib/core/bits.h"
#include "rtlib/core/memory.h"
#include "rtlib/load/program_info.h"
#include "rung/types.hpp"

namespace rung::runtime {

namespace {

// FNV-1a.
uint64_t hashOf(std::string_view text) {
  uint64_t hash = 0xCBF29CE484222325;
  for (const char c : text) hash = (hash ^ static_cast<uint8_t>(c)) * 0x100000001B3;
  return hash;
}

std::string compressed(const std::string& text) {
  uLongf length = compressBound(text.size());
  std::string out(4 + length, 0);
  for (size_t i = 0; i < 4; ++i) out[i] = static_cast<char>(text.size() >> (8 * i));
  const auto* from = reinterpret_cast<const Bytef*>(text.data());
  if (compress(reinterpret_cast<Bytef*>(&out[4]), &length, from, text.size()) != Z_OK) throw std::bad_alloc();
  out.resize(4 + length);
  return out;
}

class Description {
public:
  Description(const rung_program& program, std::span<const RetainRun> runs)
      : program_(program), runs_(runs), numbers_(program.space_count, RUNG_NONE), text_("dialect\t") {
    text_ += program.dialect;
    text_ += '\n';
    addSpaces();
    for (const RetainRun& run : runs) addLine("kept", nullptr, {numbers_[run.space], run.first, run.count});
    for (uint32_t i = 0; i < program.symbol_count; ++i) addCell(program.symbols[i]);
  }
  const std::string& text() const { return text_; }

private:
  void addLine(const char* kind, const char* name, std::initializer_list<uint32_t> numbers) {
    text_ += kind;
    if (name != nullptr) (text_ += '\t') += name;
    for (const uint32_t number : numbers) (text_ += '\t') += std::to_string(number);
    text_ += '\n';
  }

  void addSpaces() {
    uint32_t count = 0;
    for (const RetainRun& run : runs_) {
      if (numbers_[run.space] != RUNG_NONE) continue;
      numbers_[run.space] = count++;
      uint32_t bytes = 0;
      for (const RetainRun& other : runs_)
        if (other.space == run.space) bytes = std::max(bytes, other.first + other.count);
      const rung_space& space = program_.spaces[run.space];
      addLine("space", space.name, {space.flags & RUNG_SPACE_ALLOCATED, bytes});
    }
  }

  void addCell(const rung_symbol& s) {
    if ((s.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_AREA)) == 0 &&
        isRetained(runs_, s.space, 8 * uint64_t{s.byte} + s.bit, uint64_t{elementBits(s.type)} * s.count))
      addLine("cell", s.name, {numbers_[s.space], s.byte, s.bit, s.type, s.count, s.reach});
  }

  const rung_program& program_;
  std::span<const RetainRun> runs_;
  std::vector<uint32_t> numbers_; // of spaces in the description
  std::string text_;
};

} // namespace

bool isRetained(std::span<const RetainRun> runs, uint32_t space, uint64_t firstBit, uint64_t bits) {
  return std::ranges::any_of(runs, [&](const RetainRun& run) {
    return run.space == space && 8 * uint64_t{run.first} <= firstBit &&
           firstBit + bits <= 8 * (uint64_t{run.first} + run.count);
  });
}

RetainLayout retainLayoutOf(const rung_program& program, std::span<const RetainRun> runs) {
  const Description description(program, runs);
  return {hashOf(description.text()), compressed(description.text())};
}

// The map of retained bytes.

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

// A description of a program's retained cells, which is stored beside their image on disk: which bytes of the program's
// spaces are retained, and the names in them. Another program finds its own cells with it (retained_memory.h).
//
// A description is a compressed text, after its uncompressed length in four bytes, low byte first. The first word of a
// line says what it is; its fields are separated by tabs:
//   dialect NAME · space NAME FLAGS BYTES · kept SPACE FIRST COUNT · cell NAME SPACE BYTE BIT TYPE COUNT REACH
// Spaces are numbered in order; BYTES counts up to the last retained byte. An image consists of the bytes of each
// `kept` line, in order. Only cells that are retained completely are listed, sorted by name.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

// The layout of an image.
struct RetainLayout {
  RetainLayout(uint64_t hashGiven, std::string descriptionGiven = {}) // NOLINT(google-explicit-constructor)
      : hash(hashGiven), description(std::move(descriptionGiven)) {}

  uint64_t hash;           // equal hashes: images are interchangeable, cell by cell
  std::string description; // any bytes; "": only a program of the same hash can use the image
};

// Consecutive retained bytes of a space.
struct RetainRun {
  uint32_t space = RUNG_NONE;
  uint32_t first = 0; // logical
  uint32_t count = 0;
};

// Whether `bits` bits from `firstBit` on, counted from the beginning of the space, are all retained, in one run.
bool isRetained(std::span<const RetainRun> runs, uint32_t space, uint64_t firstBit, uint64_t bits);

// The layout for a program and its retained bytes, in the order of the image.
RetainLayout retainLayoutOf(const rung_program& program, std::span<const RetainRun> runs);

// The retained parts of a program's memory by the addresses of the dialect (K0 to K31 and so on), independent of their
// representation in memory. So an image fits every program of the dialect that retains the same cells at the same
// addresses.

class RetainMap {
public:
  explicit RetainMap(const rung_program& program);

  const RetainLayout& layout() const { return layout_; }
  uint32_t size() const { return size_; } // size of an image

  // Convert between an image and the bytes of Instance::copyRetained and restoreRetained.
  void pack(std::span<const uint8_t> raw, std::span<uint8_t> image) const;
  void unpack(std::span<const uint8_t> image, std::span<uint8_t> raw) const;
  uint32_t rawSize() const { return rawSize_; }

private:
  // Adjacent bytes.
  struct Piece {
    uint32_t space;
    uint32_t first; // logical
    uint32_t bytes; // logical
    bool expanded;  // raw holds a byte for each bit
  };
  static std::vector<Piece> piecesOf(const rung_program& program);
  static std::vector<RetainRun> runsOf(const std::vector<Piece>& pieces);

  std::vector<Piece> pieces_;
  RetainLayout layout_;
  uint32_t size_ = 0;
  uint32_t rawSize_ = 0;
};

} // namespace rung::runtime

// The retained cells of a program, as a description that lies beside their image on disk: which bytes of its spaces are
// kept, and the names in them. Another program finds its own cells there (retained_memory.h).
//
// A description is a text, compressed; its length as a text comes first, in four bytes, low byte first. Of each line
// the first word says what it is, its fields are separated by tabs:
//   dialect NAME · space NAME FLAGS BYTES · kept SPACE FIRST COUNT · cell NAME SPACE BYTE BIT TYPE COUNT REACH
// Spaces are numbered in their order; BYTES is up to the last one that is kept. An image has the bytes of one `kept`
// after those of the one before. Cells are all that are kept as a whole, in the order of their names.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rung/program.h"

namespace rung::runtime {

// How an image is laid out.
struct RetainLayout {
  RetainLayout(uint64_t hashGiven, std::string descriptionGiven = {}) // NOLINT(google-explicit-constructor)
      : hash(hashGiven), description(std::move(descriptionGiven)) {}

  uint64_t hash;           // equal hashes: images are interchangeable, cell by cell
  std::string description; // whatever bytes; "": nobody else can use the image
};

// Bytes of a space that are kept.
struct RetainRun {
  uint32_t space = RUNG_NONE;
  uint32_t first = 0; // logical
  uint32_t count = 0;
};

// All `bits` from a bit of a space on, which is counted from the beginning of the space, are kept, in one run.
bool isKept(std::span<const RetainRun> runs, uint32_t space, uint64_t firstBit, uint64_t bits);

// Of a program, and the bytes of it that are kept, in the order of the image.
RetainLayout retainLayoutOf(const rung_program& program, std::span<const RetainRun> runs);

// Which parts of a program's memory are kept, by the addresses of the dialect: K0 to K31 and so on, whatever
// representation the layout gave them. So the image of one program fits every other program of the dialect that keeps
// the same cells at the same addresses.

class RetainMap {
public:
  explicit RetainMap(const rung_program& program);

  const RetainLayout& layout() const { return layout_; }
  uint32_t size() const { return size_; } // of an image

  // Between an image and the bytes as Instance::copyRetained and restoreRetained take them.
  void pack(std::span<const uint8_t> raw, std::span<uint8_t> image) const;
  void unpack(std::span<const uint8_t> image, std::span<uint8_t> raw) const;
  uint32_t rawSize() const { return rawSize_; }

private:
  // Bytes that lie together.
  struct Piece {
    uint32_t space;
    uint32_t first; // logical
    uint32_t bytes; // logical
    bool expanded;  // raw holds a byte a bit
  };
  static std::vector<Piece> piecesOf(const rung_program& program);
  static std::vector<RetainRun> runsOf(const std::vector<Piece>& pieces);

  std::vector<Piece> pieces_;
  RetainLayout layout_;
  uint32_t size_ = 0;
  uint32_t rawSize_ = 0;
};

} // namespace rung::runtime

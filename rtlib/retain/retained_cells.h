// The retained cells of a program, as a description that lies beside their image on disk: which bytes of its spaces are
// kept, and the names in them. Another program finds its own cells there (retained_take.h).
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

} // namespace rung::runtime

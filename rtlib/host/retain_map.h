// What of a program's memory is kept, by the addresses of the dialect: K0 to K31 and so on, whatever representation the
// layout gave them. So the image of one program fits every other program of the dialect that keeps the same addresses.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rung/program.h"

namespace rung::host {

class RetainMap {
public:
  explicit RetainMap(const rung_program& program);

  // Equal hashes: images are interchangeable.
  uint64_t hash() const { return hash_; }
  uint32_t size() const { return size_; } // of an image

  // Between an image and the bytes as Instance::copyRetained and restoreRetained take them.
  void pack(std::span<const uint8_t> raw, std::span<uint8_t> image) const;
  void unpack(std::span<const uint8_t> image, std::span<uint8_t> raw) const;
  uint32_t rawSize() const { return rawSize_; }

private:
  struct Piece {
    uint32_t bytes; // logical
    bool expanded;  // raw holds a byte a bit
  };
  void addSpan(const rung_program& program, const rung_span& span);

  std::vector<Piece> pieces_;
  uint32_t size_ = 0;
  uint32_t rawSize_ = 0;
  uint64_t hash_;
  // The run of bytes that the hash does not hold yet.
  struct Run {
    uint32_t space = RUNG_NONE;
    uint32_t first = 0;
    uint32_t end = 0;
  };
  void endRun(const rung_program& program, Run& run);
  Run run_;
};

} // namespace rung::host

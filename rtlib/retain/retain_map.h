// Which parts of a program's memory are kept, by the addresses of the dialect: K0 to K31 and so on, whatever
// representation the layout gave them. So the image of one program fits every other program of the dialect that keeps
// the same cells at the same addresses.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rtlib/retain/retained_cells.h"
#include "rung/program.h"

namespace rung::runtime {

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

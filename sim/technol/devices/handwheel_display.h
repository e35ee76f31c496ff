// The display of a handwheel panel (man. 8.4.3, l.7486-7531; l.4613-4663): 64 rows and 128 columns of pixels, on which
// a program writes four characters at a time.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace rung::sim::technol {

class HandwheelDisplay {
public:
  static constexpr uint32_t kRows = 64, kColumns = 128;

  void clear();
  // TOC_DISPLS: row and column of the first character in pixels, four characters (0FFh: what is there stays), size
  // (0: 6 x 8 pixels, 1: 12 x 16; others show nothing), inversion (not 0: the characters are inverted). What does not
  // fit the display is left out.
  void show(std::span<const uint8_t, 8> order);

  static bool isPixel(uint32_t row, uint32_t column) { return row < kRows && column < kColumns; }
  // The characters that follow each other from this place on; "": none begins there.
  std::string text(uint32_t row, uint32_t column) const;
  bool isInverted(uint32_t row, uint32_t column) const { return cells_[row][column].inverted; }

private:
  struct Cell {            // of the upper left pixel of a character
    uint8_t character = 0; // 0: none
    uint8_t size = 0;
    bool inverted = false;
  };
  void put(uint32_t row, uint32_t column, const Cell& cell);

  std::array<std::array<Cell, kColumns>, kRows> cells_{};
  std::array<uint8_t, 8> last_{};
};

} // namespace rung::sim::technol

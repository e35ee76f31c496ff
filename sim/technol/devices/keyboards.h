// The keyboards of the control (man. ch. 11): the actions of keys, defined in files, and the functions that keys
// switch, like Shift on a PC. Keyboards 0 to 3 are panels, 4 and 5 handwheels, 6 the virtual one, whose keys are bits
// of the program (l.12493-12503, l.16723-16733).
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/keyboard_file.h"

namespace rung::sim::technol {

// TLxWS: TL1W to TL4W, TL1K, TL2K, TL1P (man. l.16936-16961).
struct KeyboardState {
  uint8_t function = 0;            // TL_Function: the active one, 0 to 3
  uint8_t requested = 0;           // TL_FunctionReq
  std::array<uint8_t, 3> states{}; // TL_Fun1State to TL_Fun3State: 0, 0FFh

  template <class Archive>
  void state(Archive& archive) {
    archive(requested, states);
    archive.atMost(function, 3);
  }
};

// The actions of pressing or releasing a key. The text is valid as long as the configuration.
struct KeyActions {
  std::optional<int64_t> plcCommand; // _ON_CMD with this code in DR, RLO := pressed (man. l.1614-1626)
  std::string_view rtmCommand;       // a command to the real-time part: manual motion, handwheel, ...
};

class Keyboards {
public:
  static constexpr uint32_t kKeyboards = 8, kKeys = 256, kFunctions = 4;
  static constexpr uint32_t kVirtual = 6;

  // "KbdConfig0": adds a file of keyboard 0. Returns "", or the error; nothing for other keys.
  std::optional<std::string> configure(std::string_view key, const std::string& path);
  void define(uint32_t keyboard, std::vector<host::KeyDefinition> keys);
  // To be called before keys are pressed: looks up the codes of PlcCommand by the identifiers of PLC constants. Returns
  // "", or the errors, one line "FILE:LINE:COLUMN: ..." each.
  std::string resolveCommands(const std::function<std::optional<int64_t>(std::string_view)>& constantOf);

  // At a power-on: all keys are released, every function is 0.
  void power();

  // Presses or releases a key; does nothing if the key is already in that state. A release belongs to the definition
  // that the press used, whatever function is active by then. Functions are switched here, and are not actions.
  KeyActions key(uint32_t keyboard, uint32_t scan, bool pressed);
  bool isPressed(uint32_t keyboard, uint32_t scan) const { return boards_[keyboard].pressed[scan] != 0; }
  const KeyboardState& state(uint32_t keyboard) const { return boards_[keyboard].state; }
  // Whether the keyboard has keys.
  bool exists(uint32_t keyboard) const { return keyboard < kKeyboards && !boards_[keyboard].keys.empty(); }

  template <class Archive>
  void state(Archive& archive) {
    for (Board& board : boards_) {
      archive(board.state, board.pressed, board.held);
      for (const uint16_t number : board.pressed) archive.require(number <= board.keys.size() || number == kNothing);
    }
  }

private:
  struct Board {
    std::vector<host::KeyDefinition> keys;
    std::vector<std::optional<int64_t>> codes; // codes of their PlcCommand
    KeyboardState state;
    std::array<uint16_t, kKeys> pressed{};  // 0: released, otherwise number of the definition + 1, or kNothing
    std::array<uint8_t, kFunctions> held{}; // number of pressed keys that hold a function
  };
  static constexpr uint16_t kNothing = 0xFFFF; // a pressed key without a definition

  static uint16_t find(const Board& board, uint32_t scan);
  bool switchFunction(std::string_view command, bool pressed);
  static void showFunction(Board& board);

  std::array<Board, kKeyboards> boards_;
};

// The display of a handwheel panel (man. 8.4.3, l.7486-7531; l.4613-4663): 64 rows and 128 columns of pixels, to which
// a program writes four characters at a time.

class HandwheelDisplay {
public:
  static constexpr uint32_t kRows = 64, kColumns = 128;

  void clear();
  // TOC_DISPLS: row and column of the first character in pixels, four characters (0FFh: unchanged), size (0: 6 x 8
  // pixels, 1: 12 x 16; others show nothing), inversion (not 0: inverted characters). Parts outside the display are
  // dropped.
  void show(std::span<const uint8_t, 8> order);

  static bool isPixel(uint32_t row, uint32_t column) { return row < kRows && column < kColumns; }
  // The consecutive characters from this pixel on; "": no character begins there.
  std::string text(uint32_t row, uint32_t column) const;
  bool isInverted(uint32_t row, uint32_t column) const { return cells_[row][column].inverted; }

  template <class Archive>
  void state(Archive& archive) {
    archive(cells_, last_);
  }

private:
  struct Cell {            // at the upper left pixel of a character
    uint8_t character = 0; // 0: none
    uint8_t size = 0;
    bool inverted = false;
    template <class Archive>
    void state(Archive& archive) {
      archive(character, size, inverted);
    }
  };
  void put(uint32_t row, uint32_t column, const Cell& cell);

  std::array<std::array<Cell, kColumns>, kRows> cells_{};
  std::array<uint8_t, 8> last_{};
};

} // namespace rung::sim::technol

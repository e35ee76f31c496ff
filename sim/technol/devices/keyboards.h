// The keyboards of the control (man. ch. 11): what a key does by its file, and the functions that keys switch, as Shift
// does on a PC. Keyboards 0 to 3 are panels, 4 and 5 handwheels, 6 the virtual one, whose keys are bits of the program
// (l.12493-12503, l.16723-16733).
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/keyboard_file.h"

namespace rung::sim::technol {

// TLxWS: TL1W to TL4W, TL1K, TL2K, TL1P (man. l.16936-16961).
struct KeyboardState {
  uint8_t function = 0;            // TL_Function: 0 to 3, valid now
  uint8_t requested = 0;           // TL_FunctionReq
  std::array<uint8_t, 3> states{}; // TL_Fun1State to TL_Fun3State: 0, 0FFh
};

// What the press or the release of a key makes the control do. The text stays as long as the configuration.
struct KeyActions {
  std::optional<int64_t> plcCommand; // _ON_CMD with this code in DR, RLO := pressed (man. l.1614-1626)
  std::string_view rtmCommand;       // an order to the real-time part: manual motion, handwheel, ...
};

class Keyboards {
public:
  static constexpr uint32_t kKeyboards = 8, kKeys = 256, kFunctions = 4;
  static constexpr uint32_t kVirtual = 6;

  // "KbdConfig0": a file of keyboard 0, beside others. "" done, a text: what is wrong; nothing: another key.
  std::optional<std::string> configure(std::string_view key, const std::string& path);
  void define(uint32_t keyboard, std::vector<host::KeyDefinition> keys);
  // Before keys are pressed: the codes of PlcCommand by the identifiers of PLC constants. "" or what is wrong, a line
  // "FILE:LINE:COLUMN: ..." each.
  std::string resolveCommands(const std::function<std::optional<int64_t>(std::string_view)>& constantOf);

  // At a power-on: no key is pressed, every function is 0.
  void power();

  // A key is pressed or released; one that is so already does nothing. A release belongs to what the press did,
  // whatever function is valid by then. Functions are switched here, and are not actions.
  KeyActions key(uint32_t keyboard, uint32_t scan, bool pressed);
  bool isPressed(uint32_t keyboard, uint32_t scan) const { return boards_[keyboard].pressed[scan] != 0; }
  const KeyboardState& state(uint32_t keyboard) const { return boards_[keyboard].state; }
  // It has keys.
  bool exists(uint32_t keyboard) const { return keyboard < kKeyboards && !boards_[keyboard].keys.empty(); }

private:
  struct Board {
    std::vector<host::KeyDefinition> keys;
    std::vector<std::optional<int64_t>> codes; // of their PlcCommand
    KeyboardState state;
    std::array<uint16_t, kKeys> pressed{};  // 0: not pressed, else number of the definition + 1, or kNothing
    std::array<uint8_t, kFunctions> held{}; // keys that keep a function while they are pressed
  };
  static constexpr uint16_t kNothing = 0xFFFF; // a pressed key without a definition

  static uint16_t find(const Board& board, uint32_t scan);
  bool switchFunction(std::string_view command, bool pressed);
  static void showFunction(Board& board);

  std::array<Board, kKeyboards> boards_;
};

} // namespace rung::sim::technol

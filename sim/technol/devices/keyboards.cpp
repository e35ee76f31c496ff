// Keyboards.
#include "sim/technol/devices/keyboards.h"

#include <algorithm>

#include "rtlib/nc/control/technol/identifier.h"

namespace rung::sim::technol {

namespace {

constexpr uint8_t kOn = 0xFF;

// Takes a digit below `end` from the beginning of the text.
std::optional<uint32_t> takeDigit(std::string_view& text, uint32_t end) {
  if (text.empty() || text[0] < '0' || text[0] >= static_cast<char>('0' + end)) return std::nullopt;
  const auto digit = static_cast<uint32_t>(text[0] - '0');
  text.remove_prefix(1);
  return digit;
}

} // namespace

std::optional<std::string> Keyboards::configure(std::string_view key, const std::string& path) {
  const std::string name = nc::technol::canonical(key);
  std::string_view rest = name;
  if (!nc::technol::takePrefix(rest, "KBDCONFIG")) return std::nullopt;
  const auto number = takeDigit(rest, kKeyboards);
  if (!number || !rest.empty()) return "'" + std::string(key) + "' is not KbdConfig0 to KbdConfig7";
  return host::readKeyboardFile(path, boards_[*number].keys);
}

void Keyboards::define(uint32_t keyboard, std::vector<host::KeyDefinition> keys) {
  boards_[keyboard].keys = std::move(keys);
}

std::string Keyboards::resolveCommands(const std::function<std::optional<int64_t>(std::string_view)>& constantOf) {
  std::string wrong;
  for (Board& board : boards_) {
    board.codes.assign(board.keys.size(), std::nullopt);
    for (size_t i = 0; i < board.keys.size(); ++i) {
      const host::KeyDefinition& key = board.keys[i];
      if (key.plcCommand.empty()) continue;
      board.codes[i] = constantOf(key.plcCommand);
      if (!board.codes[i])
        wrong += (wrong.empty() ? "" : "\n") + key.place + ": PlcCommand '" + key.plcCommand +
                 "' is not a PLC constant; constants are those of PlcConstants and const.ID";
    }
  }
  return wrong;
}

void Keyboards::power() {
  for (Board& board : boards_) {
    board.state = {};
    board.pressed = {};
    board.held = {};
  }
}

// A key without separate functions does the same in each function (man. l.16863-16872).
uint16_t Keyboards::find(const Board& board, uint32_t scan) {
  for (size_t i = 0; i < board.keys.size(); ++i) {
    const host::KeyDefinition& key = board.keys[i];
    const bool fits = key.function == host::KeyDefinition::kAnyFunction || key.function == board.state.function;
    if (key.scan == scan && fits) return static_cast<uint16_t>(i + 1);
  }
  return kNothing;
}

KeyActions Keyboards::key(uint32_t keyboard, uint32_t scan, bool pressed) {
  if (keyboard >= kKeyboards || scan >= kKeys) return {};
  Board& board = boards_[keyboard];
  uint16_t& place = board.pressed[scan];
  if ((place != 0) == pressed) return {};
  const uint16_t number = pressed ? find(board, scan) : place;
  place = pressed ? number : 0;
  if (number == kNothing) return {};
  const host::KeyDefinition& definition = board.keys[number - 1];
  const bool isFunction = switchFunction(definition.rtmCommand, pressed);
  return {number <= board.codes.size() ? board.codes[number - 1] : std::nullopt,
          isFunction ? std::string_view() : definition.rtmCommand};
}

// RTMID_KEYBx_FUNCTIONy: on while the key is held; _TOGGLE: changes its state, and the highest function that is on
// counts; _SWITCH: only that function (man. l.16872-16935). The manual's names have blanks instead of underscores.
bool Keyboards::switchFunction(std::string_view command, bool pressed) {
  using nc::technol::takePrefix;
  if (!takePrefix(command, "RTMID_KEYB")) return false;
  const auto keyboard = takeDigit(command, kKeyboards);
  if (!keyboard || !takePrefix(command, "_FUNCTION")) return false;
  const auto function = takeDigit(command, kFunctions);
  const bool isKnown = command.empty() || command == "_TOGGLE" || command == "_SWITCH";
  if (!function || !isKnown) return false;
  Board& board = boards_[*keyboard];
  std::array<uint8_t, 3>& states = board.state.states;
  if (command.empty()) {
    uint8_t& held = board.held[*function];
    held = static_cast<uint8_t>(pressed ? held + 1 : held - (held > 0 ? 1 : 0));
  } else if (pressed && command == "_TOGGLE" && *function > 0) {
    states[*function - 1] ^= kOn;
  } else if (pressed) {
    states = {};
    if (*function > 0) states[*function - 1] = kOn;
  }
  showFunction(board);
  return true;
}

void Keyboards::showFunction(Board& board) {
  uint8_t function = 0;
  for (uint8_t i = 1; i < kFunctions; ++i)
    if (board.state.states[i - 1] != 0) function = i;
  for (uint8_t i = 0; i < kFunctions; ++i)
    if (board.held[i] != 0) function = i;
  board.state.function = board.state.requested = function;
}

// The display.

namespace {

constexpr uint32_t kCharacters = 4;
constexpr uint8_t kStays = 0xFF;
constexpr uint32_t kSizes = 2;

constexpr uint32_t widthOf(uint8_t size) { return size == 0 ? 6 : 12; }
constexpr uint32_t heightOf(uint8_t size) { return size == 0 ? 8 : 16; }
constexpr uint32_t kMostWidth = widthOf(1), kMostHeight = heightOf(1);

} // namespace

void HandwheelDisplay::clear() {
  cells_ = {};
  last_ = {};
}

void HandwheelDisplay::show(std::span<const uint8_t, 8> order) {
  if (std::equal(order.begin(), order.end(), last_.begin())) return; // only this code writes there
  std::copy(order.begin(), order.end(), last_.begin());
  const uint8_t size = order[6];
  if (size >= kSizes) return;
  for (uint32_t i = 0; i < kCharacters; ++i)
    if (order[2 + i] != kStays) put(order[0], order[1] + i * widthOf(size), {order[2 + i], size, order[7] != 0});
}

// Deletes characters that it overlaps.
void HandwheelDisplay::put(uint32_t row, uint32_t column, const Cell& cell) {
  const uint32_t bottom = row + heightOf(cell.size), right = column + widthOf(cell.size);
  if (bottom > kRows || right > kColumns) return;
  for (uint32_t r = row < kMostHeight ? 0 : row - kMostHeight; r < bottom; ++r)
    for (uint32_t c = column < kMostWidth ? 0 : column - kMostWidth; c < right; ++c) {
      Cell& old = cells_[r][c];
      if (r + heightOf(old.size) > row && c + widthOf(old.size) > column) old = {};
    }
  cells_[row][column] = cell;
}

std::string HandwheelDisplay::text(uint32_t row, uint32_t column) const {
  std::string shown;
  while (row < kRows && column < kColumns && cells_[row][column].character != 0) {
    const Cell& cell = cells_[row][column];
    shown += static_cast<char>(cell.character);
    column += widthOf(cell.size);
  }
  return shown;
}

} // namespace rung::sim::technol

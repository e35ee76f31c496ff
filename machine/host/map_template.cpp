// See map_template.h.
#include "machine/host/map_template.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "machine/host/component_pins.h"
#include "machine/host/mapping_file.h"
#include "rtlib/nc/signals.h"
#include "rtlib/text/letters.h"
#include "rung/runtime.hpp"
#include "rung/types.hpp"

namespace rung::host {

namespace {

constexpr uint32_t kByteBits = 8;
// Leaves room for a number and the number of a bit.
constexpr size_t kLongestPin = kLongestPinName - std::string_view("-99-7").size();

struct Row {
  std::string pin;
  PinType type = PinType::Bit;
  std::string name;
  std::string comment;
  uint32_t bits = 0; // number of bits with a pin each
};

PinType pinTypeOf(uint32_t type) {
  switch (type) {
  case RUNG_TYPE_BIT: return PinType::Bit;
  case RUNG_TYPE_I8: return PinType::U32;
  case RUNG_TYPE_F64: return PinType::Float;
  default: return PinType::S32;
  }
}

// The word for a mark before a signal's name: the direction of an axis, or that it is inverted (HAL calls such pins
// NAME-not, too); "" for another character.
std::string_view wordOfMark(char c) {
  switch (c) {
  case '+': return "-plus";
  case '-': return "-minus";
  case '*': return "-not";
  default: return "";
  }
}

// "X002.1" is x002-1, "*+L1" l1-plus-not, "D8:4", whose bits have names like d8-4, d8-4bytes. `marks` is where the
// marks of the name begin, after the path in "C2-J1".
std::string pinNameOf(std::string_view name, size_t marks) {
  std::string end;
  for (size_t i = marks; i < name.size() && !wordOfMark(name[i]).empty(); ++i) end.insert(0, wordOfMark(name[i]));
  if (name.find(':') != std::string_view::npos) end += "bytes";
  std::string pin;
  for (const char c : name) {
    if (pin.size() + end.size() >= kLongestPin) break;
    if (text::isLetter(c) || text::isDigit(c))
      pin += text::lower(c);
    else if (!pin.empty() && pin.back() != '-')
      pin += '-';
  }
  while (!pin.empty() && pin.back() == '-') pin.pop_back();
  return (pin.empty() ? "pin" : pin) + end;
}

// Quotes a text for a TOML file.
std::string inToml(std::string_view text) {
  std::string made = "\"";
  for (const char c : text) made += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return made + '"';
}

class Template {
public:
  Template(rung_instance* instance, const rung_program& program)
      : instance_(instance), program_(program), sides_(instance, program) {}

  void add(const UsedName& used) {
    const std::optional<rung_cell_info> written = cellInfo(instance_, used.name, RUNG_WRITE); // written by a pin
    const std::optional<rung_cell_info> found = cellInfo(instance_, used.name, RUNG_READ);
    if (!found || !names_.insert(used.name).second) return;
    const rung_cell_info& info = *found;
    if (info.space == RUNG_NONE || info.type == RUNG_TYPE_TEXT || info.count != 1) return;
    const uint32_t sides = sides_.of(info);
    // Memory that the user cannot name, such as positions, belongs to the NC.
    const bool own = sides == 0 && (program_.spaces[info.space].flags & RUNG_SPACE_HIDDEN) == 0;
    if (own && used.written) return;
    const bool input = sides == RUNG_SPACE_INPUT || (sides != RUNG_SPACE_OUTPUT && !used.written);
    const bool output = sides == RUNG_SPACE_OUTPUT || (!input && !used.read);
    if (input && !written) return;
    Row row{.type = pinTypeOf(info.type), .name = used.name, .comment = commentOf(used.name, info.address)};
    if (input && info.type == RUNG_TYPE_I8) row.type = PinType::Bit, row.bits = kByteBits; // usually eight single bits
    row.pin = uniquePin(row);
    if (own)
      unwritten_.push_back(row);
    else if (input)
      addInput(row, info.type, bitsOf(*written));
    else if (output)
      outputs_.push_back(row);
    else if ((sides & RUNG_SPACE_OUTPUT) != 0)
      others_.push_back(row);
  }

  std::string text() const {
    std::string text =
        "# Pins of " + std::string(program_.name) +
        ": a first list, made of what its rungs use.\n"
        "# Remove what the machine does not connect, and give the pins names of your own. Signals that a\n"
        "# [[send]] table drives are for it alone.\n\n"
        "# What rungctl may change; by default nothing:\n# [rungctl]\n# permissions = [\"set\", \"force\", "
        "\"reload\"]\n\n";
    text += inputs_.empty() && !narrow_.empty() ? "[in]\n" : table("in", inputs_, "");
    if (!narrow_.empty())
      text += "# Numbers of 16 bits; of a greater one the pin's upper bits are lost:\n" + rows(narrow_, "# ") + '\n';
    if (!parts_.empty()) text += "# Pins above bring these, or parts of them:\n" + rows(parts_, "# ") + '\n';
    if (!unwritten_.empty())
      text += "# No rung writes these relays and registers of the program; a pin, [param] or [const] may:\n" +
              rows(unwritten_, "# ") + '\n';
    text += table("out", outputs_, "");
    if (!others_.empty()) text += "# Rungs write these, and read them, too:\n" + rows(others_, "# ") + '\n';
    return text + functions();
  }

private:
  // Each bit may be fed by one pin only.
  void addInput(const Row& row, uint32_t type, const Bits& bits) {
    const bool isTaken = std::ranges::any_of(taken_, [&](const Bits& other) { return other.meets(bits); });
    (isTaken ? parts_ : type == RUNG_TYPE_I16 ? narrow_ : inputs_).push_back(row);
    if (!isTaken) taken_.push_back(bits);
  }

  // The key of a row and its pins: for the byte X7, "x7", and "x7-0" to "x7-7".
  static std::vector<std::string> pinsOf(const std::string& pin, uint32_t bits) {
    std::vector<std::string> pins{pin};
    for (uint32_t bit = 0; bit < bits; ++bit) pins.push_back(pin + "-" + std::to_string(bit));
    return pins;
  }
  std::string uniquePin(const Row& row) {
    const std::string base = pinNameOf(row.name, marksOf(row.name));
    const auto isTaken = [&](const std::string& pin) { return isOwnPin(pin) || pins_.contains(pin); };
    std::string name = base;
    for (int number = 2; std::ranges::any_of(pinsOf(name, row.bits), isTaken); ++number)
      name = base + "-" + std::to_string(number);
    std::ranges::copy(pinsOf(name, row.bits), std::inserter(pins_, pins_.end()));
    return name;
  }

  // Where the marks of a name begin: after the path of a signal of another path, "C2-J1".
  size_t marksOf(std::string_view name) const {
    const size_t path = name.find_first_of("+-*");
    const nc::SignalTable* table = nc::signalsOf(program_.dialect);
    if (path == std::string_view::npos || path < 2 || table == nullptr || text::lower(name[0]) != 'c') return 0;
    const bool isOfPath = std::ranges::all_of(name.substr(1, path - 1), text::isDigit);
    return isOfPath && nc::findSignal(*table, name.substr(path)) != nullptr ? path : 0;
  }

  // The address, by which wiring diagrams go, and the comment of the program, if it is one line.
  std::string commentOf(const std::string& name, const std::string& address) const {
    std::string text = name == address ? "" : address;
    for (const rung_symbol& symbol : std::span(program_.symbols, program_.symbol_count))
      if (name == symbol.name && std::strpbrk(symbol.comment, "\n\r") == nullptr && *symbol.comment != '\0')
        text += (text.empty() ? "" : ", ") + std::string(symbol.comment);
    return text;
  }

  static std::string rows(const std::vector<Row>& list, const std::string& before) {
    std::string text;
    for (const Row& row : list)
      text += before + row.pin + " = { type = \"" + std::string(pinTypeName(row.type)) +
              "\", name = " + inToml(row.name) + (row.bits == 0 ? "" : ", bits = " + std::to_string(row.bits)) + " }" +
              (row.comment.empty() ? "" : " # " + row.comment) + '\n';
    return text;
  }

  static std::string table(const std::string& name, const std::vector<Row>& list, const std::string& before) {
    return list.empty() ? "" : "[" + name + "]\n" + rows(list, before) + '\n';
  }

  bool supports(rung_function_kind kind) const {
    return rung_instance_supports_function(instance_, 0, kind, 0) == RUNG_OK;
  }

  std::string functions() const {
    if (!supports(RUNG_FUNCTION_M)) return {};
    std::string text =
        "# M, S and T functions: an edge of a pin hands one to the program.\n"
        "#\n# [[send]]\n# pin = \"spindle-forward\"\n# edge = \"rise\"\n# function = \"M\"\n# code = 3\n";
    if (supports(RUNG_FUNCTION_T))
      text += "#\n# [[send]]\n# pin = \"tool-prepare\"\n# edge = \"rise\"\n# function = \"T\"\n"
              "# code = \"tool-number\"\n# done = \"tool-prepared\"\n";
    return text + "#\n# [[abort]]\n# pin = \"estop\"\n# edge = \"rise\"\n";
  }

  rung_instance* instance_;
  const rung_program& program_;
  Sides sides_;
  std::set<std::string> names_, pins_;
  std::vector<Bits> taken_; // bits of inputs
  std::vector<Row> inputs_, narrow_, parts_, unwritten_, outputs_, others_;
};

} // namespace

std::string templateMap(rung_instance* instance, const rung_program& program, std::span<const UsedName> used) {
  Template made(instance, program);
  for (const UsedName& name : used) made.add(name);
  return made.text();
}

Bits bitsOf(const rung_cell_info& info) {
  const uint64_t first = uint64_t{8} * info.byte + info.bit;
  return {info.space, first, first + uint64_t{elementBits(info.type)} * info.count};
}

namespace {

uint32_t sideOf(nc::Direction direction) {
  switch (direction) {
  case nc::Direction::In: return RUNG_SPACE_INPUT;
  case nc::Direction::Out: return RUNG_SPACE_OUTPUT;
  case nc::Direction::InOut: break;
  }
  return RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
}

} // namespace

Sides::Sides(rung_instance* instance, const rung_program& program) : program_(program) {
  const nc::SignalTable* table = nc::signalsOf(program.dialect);
  if (table == nullptr) return;
  for (const nc::Signal& signal : *table) {
    if (const std::optional<rung_cell_info> info = cellInfo(instance, signal.symbol, RUNG_READ))
      signals_.push_back({bitsOf(*info), sideOf(signal.direction)});
  }
}

uint32_t Sides::of(const rung_cell_info& info) const {
  const Bits bits = bitsOf(info);
  for (const SignalPlace& place : signals_)
    if (place.bits.space == bits.space && place.bits.first <= bits.first && bits.first < place.bits.end)
      return place.side;
  return program_.spaces[info.space].flags & (RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT);
}

} // namespace rung::host

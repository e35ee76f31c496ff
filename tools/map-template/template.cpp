// See template.h.
#include "tools/map-template/template.h"

#include <cstring>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "ir/support/ascii.h"
#include "rtlib/nc/signals.h"
#include "rtlib/text/letters.h"
#include "rung/runtime.hpp"
#include "rung/types.hpp"
#include "tools/mapping/file.h"

namespace rung::map_template {

using mapping::PinType;

namespace {

constexpr size_t kLongestPin = 38; // HAL's names have 47 characters, with the prefix

struct Row {
  std::string pin;
  PinType type = PinType::Bit;
  std::string name;
  std::string comment;
};

PinType pinTypeOf(uint32_t type) {
  switch (type) {
  case RUNG_TYPE_BIT: return PinType::Bit;
  case RUNG_TYPE_I8: return PinType::U32; // a byte is mostly eight bits
  case RUNG_TYPE_F64: return PinType::Float;
  default: return PinType::S32;
  }
}

// "*ESP" is esp, "X002.1" x002-1.
std::string pinNameOf(std::string_view name) {
  std::string pin;
  for (const char c : name) {
    if (isLetter(c) || isDigit(c))
      pin += text::lower(c);
    else if (!pin.empty() && pin.back() != '-')
      pin += '-';
    if (pin.size() == kLongestPin) break;
  }
  while (!pin.empty() && pin.back() == '-') pin.pop_back();
  return pin.empty() ? "pin" : pin;
}

// A text of a TOML file.
std::string inToml(std::string_view text) {
  std::string made = "\"";
  for (const char c : text) made += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return made + '"';
}

uint64_t firstBit(const rung_cell_info& info) { return uint64_t{8} * info.byte + info.bit; }

class Template {
public:
  Template(rung_instance* instance, const rung_program& program) : instance_(instance), program_(program) {
    if (const nc::SignalTable* signals = nc::signalsOf(program.dialect))
      for (const nc::Signal& signal : *signals) addSignal(signal);
  }

  void add(const UsedName& used) {
    const bool writable = cellInfo(instance_, used.name, RUNG_WRITE).has_value();
    const std::optional<rung_cell_info> found = cellInfo(instance_, used.name, RUNG_READ);
    if (!found) return;
    const rung_cell_info& info = *found;
    if (info.space == RUNG_NONE || info.type == RUNG_TYPE_TEXT || info.count != 1) return;
    const uint32_t flags = sidesOf(info);
    constexpr uint32_t kBoth = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
    const bool input = (flags & kBoth) == RUNG_SPACE_INPUT || ((flags & kBoth) != RUNG_SPACE_OUTPUT && !used.written);
    const bool output = (flags & kBoth) == RUNG_SPACE_OUTPUT || (!input && !used.read);
    if (input && !writable) return;
    Row row{uniquePin(used.name), pinTypeOf(info.type), used.name, commentOf(used.name)};
    if (input)
      inputs_.push_back(std::move(row));
    else if (output)
      outputs_.push_back(std::move(row));
    else if ((flags & RUNG_SPACE_OUTPUT) != 0)
      others_.push_back(std::move(row));
  }

  std::string text() const {
    std::string text =
        "# HAL pins of " + std::string(program_.name) +
        ": a first list, made of what its rungs use.\n"
        "# Remove what the machine does not connect, and give the pins names of your own. Signals that a\n"
        "# [[send]] table drives are for it alone.\n\n";
    text += table("in", inputs_, "");
    text += table("out", outputs_, "");
    if (!others_.empty()) text += "# Rungs write these, and read them, too:\n" + rows(others_, "# ") + '\n';
    return text + functions();
  }

private:
  // Bits of a space that the table of the NC's signals has.
  struct SignalPlace {
    uint32_t space;
    uint64_t first;
    uint64_t end;
    uint32_t side; // enum rung_space_flags
  };

  void addSignal(const nc::Signal& signal) {
    if (signal.direction == nc::Direction::InOut) return;
    const std::optional<rung_cell_info> found = cellInfo(instance_, signal.symbol, RUNG_READ);
    if (!found) return;
    const rung_cell_info& info = *found;
    const uint64_t first = firstBit(info);
    signals_.push_back({info.space, first, first + uint64_t{elementBits(info.type)} * info.count,
                        signal.direction == nc::Direction::In ? RUNG_SPACE_INPUT : RUNG_SPACE_OUTPUT});
  }

  // Whose the cell is: a signal's direction says more than the memory that it lies in.
  uint32_t sidesOf(const rung_cell_info& info) const {
    const uint64_t first = firstBit(info);
    for (const SignalPlace& place : signals_)
      if (place.space == info.space && place.first <= first && first < place.end) return place.side;
    return program_.spaces[info.space].flags;
  }

  std::string uniquePin(const std::string& name) {
    const std::string base = pinNameOf(name);
    std::string pin = base;
    for (int number = 2; !pins_.insert(pin).second; ++number) pin = base + "-" + std::to_string(number);
    return pin;
  }

  std::string commentOf(const std::string& name) const {
    for (const rung_symbol& symbol : std::span(program_.symbols, program_.symbol_count))
      if (name == symbol.name) return std::strpbrk(symbol.comment, "\n\r") == nullptr ? symbol.comment : "";
    return {};
  }

  static std::string rows(const std::vector<Row>& list, const std::string& before) {
    std::string text;
    for (const Row& row : list)
      text += before + row.pin + " = { type = \"" + std::string(mapping::pinTypeName(row.type)) +
              "\", name = " + inToml(row.name) + " }" + (row.comment.empty() ? "" : " # " + row.comment) + '\n';
    return text;
  }

  static std::string table(const std::string& name, const std::vector<Row>& list, const std::string& before) {
    return list.empty() ? "" : "[" + name + "]\n" + rows(list, before) + '\n';
  }

  bool carries(rung_function_kind kind) const {
    return rung_instance_carries_function(instance_, 0, kind, 0) == RUNG_OK;
  }

  std::string functions() const {
    if (!carries(RUNG_FUNCTION_M)) return {};
    std::string text =
        "# M, S and T functions: an edge of a pin hands one to the program.\n"
        "#\n# [[send]]\n# pin = \"spindle-forward\"\n# edge = \"rise\"\n# function = \"M\"\n# code = 3\n";
    if (carries(RUNG_FUNCTION_T))
      text += "#\n# [[send]]\n# pin = \"tool-prepare\"\n# edge = \"rise\"\n# function = \"T\"\n"
              "# code = \"tool-number\"\n# done = \"tool-prepared\"\n";
    return text + "#\n# [[abort]]\n# pin = \"estop\"\n# edge = \"rise\"\n";
  }

  rung_instance* instance_;
  const rung_program& program_;
  std::set<std::string> pins_;
  std::vector<SignalPlace> signals_;
  std::vector<Row> inputs_, outputs_, others_;
};

} // namespace

std::string templateMap(rung_instance* instance, const rung_program& program, std::span<const UsedName> used) {
  Template made(instance, program);
  for (const UsedName& name : used) made.add(name);
  return made.text();
}

} // namespace rung::map_template

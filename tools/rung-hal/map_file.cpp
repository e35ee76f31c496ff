// Parser of the mapping file: a line is a keyword and blank-separated words.
#include "tools/rung-hal/map_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace rung::hal {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::string_view kBlanks = " \t\r";

// '#' opens a comment only at the start of a word: NCT has names such as AN_PLCA,#1.
Words splitLine(std::string_view line) {
  Words words;
  size_t at = line.find_first_not_of(kBlanks);
  while (at != std::string_view::npos && line[at] != '#') {
    const size_t end = line.find_first_of(kBlanks, at);
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::optional<PinType> pinTypeOf(std::string_view word) {
  for (const PinType type : {PinType::Bit, PinType::S32, PinType::U32, PinType::Float})
    if (word == pinTypeName(type)) return type;
  return std::nullopt;
}

bool isPinName(std::string_view word) {
  if (word.empty()) return false;
  for (const char c : word) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!letter && !(c >= '0' && c <= '9') && c != '-' && c != '_' && c != '.') return false;
  }
  return true;
}

std::optional<double> realOf(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<int64_t> integerOf(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative) word.remove_prefix(1);
  const bool hex = word.starts_with("0x") || word.starts_with("0X");
  if (hex) word.remove_prefix(2);
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, hex ? 16 : 10);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return negative ? -static_cast<int64_t>(value) : static_cast<int64_t>(value);
}

std::optional<double> valueOf(PinType type, std::string_view word) {
  if (type == PinType::Float) return realOf(word);
  const std::optional<int64_t> value = integerOf(word);
  if (!value) return std::nullopt;
  switch (type) {
  case PinType::Bit: return *value == 0 || *value == 1 ? std::optional<double>(*value) : std::nullopt;
  case PinType::S32:
    if (*value < std::numeric_limits<int32_t>::min() || *value > std::numeric_limits<int32_t>::max()) break;
    return static_cast<double>(*value);
  case PinType::U32:
    if (*value < 0) break;
    return static_cast<double>(*value);
  case PinType::Float: break;
  }
  return std::nullopt;
}

class Parser {
public:
  Parser(MapFile& map, std::vector<std::string>& errors) : map_(map), errors_(errors) {}

  void line(std::string_view text, uint32_t number) {
    line_ = number;
    const Words words = splitLine(text);
    if (words.empty()) return;
    const std::string_view keyword = words[0];
    if (keyword == "in" || keyword == "out")
      link(words);
    else if (keyword == "const")
      constant(words);
    else if (keyword == "send")
      send(words);
    else if (keyword == "abort")
      abort(words);
    else if (keyword == "timeout")
      timeout(words);
    else if (keyword == "high-speed")
      highSpeed(words);
    else
      error("unknown keyword '" + std::string(keyword) +
            "': in, out, const, send, abort, timeout or high-speed is expected");
  }

private:
  void error(const std::string& what) { errors_.push_back(map_.path + ":" + std::to_string(line_) + ": " + what); }

  bool hasForm(const Words& words, size_t least, size_t most, const char* form) {
    if (words.size() >= least && words.size() <= most) return true;
    error(std::string("the form is: ") + form);
    return false;
  }

  std::optional<PinType> type(std::string_view word) {
    const std::optional<PinType> found = pinTypeOf(word);
    if (!found) error("unknown type '" + std::string(word) + "': bit, s32, u32 or float is expected");
    return found;
  }

  // The pin of that name, made when it is new.
  std::optional<uint32_t> pin(std::string_view name, PinType wanted, bool output) {
    if (!isPinName(name)) {
      error("'" + std::string(name) + "' is not a pin name: letters, digits, '-', '_' and '.' are allowed");
      return std::nullopt;
    }
    for (uint32_t i = 0; i < map_.pins.size(); ++i) {
      const MapPin& old = map_.pins[i];
      if (old.name != name) continue;
      // One input may feed several names, but an output has one source.
      if (output && old.output) {
        error("output pin '" + old.name + "' is already mapped");
        return std::nullopt;
      }
      if (old.type == wanted && old.output == output) return i;
      error("pin '" + old.name + "' is already defined as " + (old.output ? "out " : "in ") +
            std::string(pinTypeName(old.type)));
      return std::nullopt;
    }
    map_.pins.push_back({std::string(name), wanted, output});
    return static_cast<uint32_t>(map_.pins.size() - 1);
  }

  void link(const Words& words) {
    const bool output = words[0] == "out";
    if (!hasForm(words, 4, 5, output ? "out TYPE PIN NAME [SCALE]" : "in TYPE PIN NAME [SCALE]")) return;
    const std::optional<PinType> pinType = type(words[1]);
    if (!pinType) return;
    const std::optional<double> factor = scale(words, *pinType);
    if (!factor) return;
    const std::optional<uint32_t> index = pin(words[2], *pinType, output);
    if (!index) return;
    (output ? map_.outputs : map_.inputs).push_back({*index, std::string(words[3]), *factor, line_});
  }

  std::optional<double> scale(const Words& words, PinType pinType) {
    if (words.size() < 5) return 1;
    const std::optional<double> factor = realOf(words[4]);
    if (pinType == PinType::Float && factor && std::isfinite(*factor) && *factor != 0) return factor;
    error(pinType == PinType::Float
              ? "'" + std::string(words[4]) + "' is not a scale: a number other than 0 is expected"
              : "a scale is possible only for float");
    return std::nullopt;
  }

  void constant(const Words& words) {
    if (!hasForm(words, 4, 4, "const TYPE NAME VALUE")) return;
    const std::optional<PinType> constType = type(words[1]);
    if (!constType) return;
    const std::optional<double> value = valueOf(*constType, words[3]);
    if (!value) return error("'" + std::string(words[3]) + "' is not a value of type " + std::string(words[1]));
    map_.constants.push_back({*constType, std::string(words[2]), *value, line_});
  }

  std::optional<MapEdge> edge(std::string_view name, std::string_view direction) {
    if (direction != "rise" && direction != "fall") {
      error("'" + std::string(direction) + "': rise or fall is expected");
      return std::nullopt;
    }
    const std::optional<uint32_t> index = pin(name, PinType::Bit, false);
    if (!index) return std::nullopt;
    return MapEdge{*index, direction == "rise"};
  }

  void send(const Words& words) {
    if (!hasForm(words, 5, 6, "send PIN rise|fall M|S|T|B CODE|CODEPIN [DONEPIN]")) return;
    const auto kind = std::ranges::find(nc::kFunctionKinds, words[3]);
    if (kind == std::end(nc::kFunctionKinds))
      return error("'" + std::string(words[3]) + "' is not a kind of function: M, S, T or B is expected");
    MapSend sent;
    sent.kind = static_cast<nc::FunctionKind>(kind - std::begin(nc::kFunctionKinds));
    sent.line = line_;
    const std::optional<MapEdge> trigger = edge(words[1], words[2]);
    if (!trigger || !sendCode(words[4], sent)) return;
    sent.edge = *trigger;
    if (words.size() == 6) {
      sent.donePin = pin(words[5], PinType::Bit, true);
      if (!sent.donePin) return;
    }
    map_.sends.push_back(sent);
  }

  void abort(const Words& words) {
    if (!hasForm(words, 3, 3, "abort PIN rise|fall")) return;
    if (const std::optional<MapEdge> cause = edge(words[1], words[2])) map_.aborts.push_back(*cause);
  }

  void timeout(const Words& words) {
    constexpr double kLongest = 1e6;
    if (!hasForm(words, 2, 2, "timeout SECONDS")) return;
    const std::optional<double> seconds = realOf(words[1]);
    if (!seconds || !(*seconds > 0 && *seconds <= kLongest))
      return error("'" + std::string(words[1]) +
                   "' is not a time in seconds: a number above 0, up to 1000000, is expected");
    if (map_.timeoutNs != 0) return error("the time is already set");
    map_.timeoutNs = static_cast<int64_t>(*seconds * 1e9);
  }

  void highSpeed(const Words& words) {
    if (hasForm(words, 1, 1, "high-speed")) map_.highSpeedLine = line_;
  }

  bool sendCode(std::string_view word, MapSend& sent) {
    if (const std::optional<double> number = valueOf(PinType::S32, word)) {
      sent.code = static_cast<int32_t>(*number);
      return true;
    }
    sent.codePin = pin(word, PinType::S32, false);
    return sent.codePin.has_value();
  }

  MapFile& map_;
  std::vector<std::string>& errors_;
  uint32_t line_ = 0;
};

} // namespace

std::string_view pinTypeName(PinType type) {
  switch (type) {
  case PinType::Bit: return "bit";
  case PinType::S32: return "s32";
  case PinType::U32: return "u32";
  case PinType::Float: return "float";
  }
  return "?";
}

MapFile parseMap(std::string_view text, std::string path, std::vector<std::string>& errors) {
  MapFile map;
  map.path = std::move(path);
  Parser parser(map, errors);
  uint32_t number = 0;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    parser.line(text.substr(0, end), ++number);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return map;
}

} // namespace rung::hal

// See recording.h.
#include "tools/bench/machines/recording.h"

#include <charconv>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace rung::bench {
namespace {

constexpr std::string_view kHead = "recording of ";
constexpr int kHex = 16;
constexpr std::string_view kDigits = "0123456789abcdef";

[[noreturn]] void wrong(size_t line, std::string_view what) {
  throw std::runtime_error("line " + std::to_string(line) + " of the recording: " + std::string(what));
}

void appendHex(std::string& text, uint64_t value, int digits) {
  for (int digit = digits - 1; digit >= 0; --digit) text += kDigits[value >> (4 * digit) & 0xF];
}

template <class Number>
bool parse(std::string_view text, Number& number, int base) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc() && end == text.data() + text.size();
}

Writes writesOf(std::string_view word, size_t line) {
  const size_t colon = word.find(':');
  const size_t equals = word.find('=');
  if (colon == std::string_view::npos || equals == std::string_view::npos || colon > equals)
    wrong(line, "found " + std::string(word) + ", expected SPACE:BYTE=HEX");
  Writes writes{.space = std::string(word.substr(0, colon)), .byte = 0, .bytes = {}};
  const std::string_view hex = word.substr(equals + 1);
  if (!parse(word.substr(colon + 1, equals - colon - 1), writes.byte, 10) || hex.size() % 2 != 0)
    wrong(line, "found " + std::string(word) + ", expected SPACE:BYTE=HEX");
  for (size_t i = 0; i < hex.size(); i += 2) {
    uint8_t byte = 0;
    if (!parse(hex.substr(i, 2), byte, kHex))
      wrong(line, "found " + std::string(hex) + ", expected hexadecimal digits");
    writes.bytes.push_back(byte);
  }
  return writes;
}

Part partOf(std::istringstream& words, const std::string& hash, size_t line) {
  Part part;
  if (!parse(std::string_view(hash), part.hash, kHex)) wrong(line, "found " + hash + ", expected a hash");
  for (std::string word; words >> word;) part.writes.push_back(writesOf(word, line));
  return part;
}

} // namespace

std::string textOf(const Recording& recording) {
  std::string text = std::string(kHead) + recording.scenario + "\n";
  for (size_t i = 0; i < recording.parts.size();) {
    const Part& part = recording.parts[i];
    size_t same = i;
    while (i != 0 && same < recording.parts.size() && recording.parts[same].writes.empty() &&
           recording.parts[same].hash == recording.parts[i - 1].hash)
      ++same;
    if (same != i) {
      text += "*" + std::to_string(same - i) + "\n";
      i = same;
      continue;
    }
    appendHex(text, part.hash, 16);
    for (const Writes& writes : part.writes) {
      text += " " + writes.space + ":" + std::to_string(writes.byte) + "=";
      for (const uint8_t byte : writes.bytes) appendHex(text, byte, 2);
    }
    text += "\n";
    ++i;
  }
  return text;
}

Recording recordingOf(const std::string& text) {
  std::istringstream lines(text);
  Recording recording;
  std::string line;
  if (!std::getline(lines, line) || !line.starts_with(kHead)) wrong(1, "expected \"recording of SCENARIO\"");
  recording.scenario = line.substr(kHead.size());
  for (size_t number = 2; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (!first.starts_with('*')) {
      recording.parts.push_back(partOf(words, first, number));
      continue;
    }
    size_t count = 0;
    if (!parse(std::string_view(first).substr(1), count, 10) || recording.parts.empty())
      wrong(number, "found " + first + ", expected a count after a part");
    const Part again{.writes = {}, .hash = recording.parts.back().hash};
    recording.parts.insert(recording.parts.end(), count, again);
  }
  return recording;
}

} // namespace rung::bench

// Texts of a PLC table.
#include "machine/io/tables/plc_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/hex.h"
#include "rtlib/text/number.h"

namespace rung::io {

namespace {

// The memory of a STRING or BINARY element.
struct TextElement {
  uint32_t at = 0, size = 0;
};
static_assert(sizeof(TextElement) == elementSize(ColumnType::Text));

TextElement read(const uint8_t* element) noexcept {
  TextElement read;
  std::memcpy(&read, element, sizeof read);
  return read;
}

void write(uint8_t* element, TextElement value) noexcept { std::memcpy(element, &value, sizeof value); }

template <class Act>
void forTexts(const PlcTable& table, uint32_t line, Act act) {
  for (const PlcTable::Column& column : table.columns)
    if (isText(column.type)) act(size_t{line} * table.lineBytes + column.at);
}

} // namespace

std::span<const uint8_t> PlcTable::textOf(const uint8_t* element) const noexcept {
  const TextElement text = read(element);
  return {texts.data() + text.at, text.size};
}

bool PlcTable::setText(uint8_t* element, std::span<const uint8_t> text) noexcept {
  TextElement now = read(element);
  const auto size = static_cast<uint32_t>(text.size());
  const uint32_t inUse = textsInUse - now.size;
  if (size > texts.size() - inUse) return false;
  textsInUse = inUse + size;
  if (size > now.size) {
    write(element, {});
    if (size > texts.size() - textsEnd) compactTexts();
    now.at = textsEnd;
    textsEnd += size;
  }
  if (size != 0) std::memmove(texts.data() + now.at, text.data(), size);
  write(element, {now.at, size});
  return true;
}

void PlcTable::dropTexts(uint32_t number) noexcept {
  forTexts(*this, number, [&](size_t at) { textsInUse -= read(bytes.data() + at).size; });
}

bool PlcTable::textsFit(const uint8_t* lines, uint32_t lineCount, uint32_t end, uint32_t inUse) const noexcept {
  uint64_t found = 0;
  bool fit = end <= texts.size();
  for (uint32_t i = 0; i < lineCount; ++i)
    forTexts(*this, i, [&](size_t at) {
      const TextElement text = read(lines + at);
      found += text.size;
      fit = fit && text.at <= end && text.size <= end - text.at;
    });
  return fit && found == inUse;
}

// Copies the texts in the order of the lines; the old `texts` become `otherTexts`.
void PlcTable::compactTexts() noexcept {
  textsEnd = 0;
  for (uint32_t i = 0; i < count; ++i)
    forTexts(*this, i, [&](size_t at) {
      const std::span<const uint8_t> text = textOf(bytes.data() + at);
      std::ranges::copy(text, otherTexts.begin() + textsEnd);
      write(bytes.data() + at, {textsEnd, static_cast<uint32_t>(text.size())});
      textsEnd += static_cast<uint32_t>(text.size());
    });
  texts.swap(otherTexts);
}

// Elements of PLC tables.

namespace {

constexpr int64_t kLeastInt = INT32_MIN, kMostInt = UINT32_MAX;
constexpr size_t kShown = 40; // bytes of a text in a message

std::string wrong(std::string_view found, const std::string& expected) {
  return "is " + host::inQuotes(host::inOneLine(found.substr(0, kShown))) + ", expected " + expected;
}

template <class T>
void put(uint8_t* element, T value) {
  std::memcpy(element, &value, sizeof value);
}

template <class T>
T get(const uint8_t* element) {
  T value;
  std::memcpy(&value, element, sizeof value);
  return value;
}

std::span<const uint8_t> asBytes(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

std::string readInt(std::string_view written, uint8_t* element) {
  const auto value = nc::technol::integerOf(written);
  if (!value || *value < kLeastInt || *value > kMostInt)
    return wrong(written, "an integer of " + std::to_string(kLeastInt) + " to " + std::to_string(kMostInt));
  put(element, static_cast<uint32_t>(*value));
  return {};
}

std::string readReal(std::string_view written, uint8_t* element) {
  const auto value = nc::technol::realOf(written);
  if (!value) return wrong(written, "a number");
  put(element, *value);
  return {};
}

std::string putText(PlcTable& table, std::span<const uint8_t> bytes, std::string_view unit, uint8_t* element) {
  const std::string has = "has " + std::to_string(bytes.size()) + " " + std::string(unit);
  if (bytes.size() > kElementBytes) return has + ", expected at most " + std::to_string(kElementBytes);
  return table.setText(element, bytes) ? std::string() : has + ", for which the table has no room";
}

std::string readText(PlcTable& table, std::string_view written, uint8_t* element) {
  std::string bytes;
  if (!toMemory(written, bytes)) return wrong(written, "characters of Windows-1250");
  if (!isWritable(bytes)) return wrong(written, "no control characters but tab and line ends");
  return putText(table, asBytes(bytes), "characters", element);
}

// Parses pairs of hexadecimal digits; nothing if the text is something else.
std::optional<std::vector<uint8_t>> pairsIn(std::string_view written) {
  std::vector<uint8_t> bytes;
  for (std::string_view rest = text::trimmed(written); !rest.empty(); rest = text::trimmed(rest)) {
    const auto byte = text::numberIn<uint8_t>(rest.substr(0, 2), 16);
    if (!byte || rest.size() < 2) return std::nullopt;
    bytes.push_back(*byte);
    rest.remove_prefix(2);
  }
  return bytes;
}

std::string readBinary(PlcTable& table, std::string_view written, uint8_t* element) {
  const auto bytes = pairsIn(written);
  if (!bytes) return wrong(written, "pairs of hexadecimal digits");
  return putText(table, *bytes, "bytes", element);
}

std::string written(double value) {
  std::array<char, 32> text{}; // a double has at most 24 characters
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

} // namespace

bool isWritable(std::string_view text) noexcept {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n' || c == '\r';
  });
}

bool toMemory(std::string_view utf8, std::string& bytes) {
  bytes = nc::memoryText(utf8);
  return nc::shownText(bytes) == utf8;
}

std::string readElement(PlcTable& table, ColumnType type, std::string_view written, uint8_t* element) {
  switch (type) {
  case ColumnType::Int: return readInt(written, element);
  case ColumnType::Real: return readReal(written, element);
  case ColumnType::Text: return readText(table, written, element);
  case ColumnType::Binary: return readBinary(table, written, element);
  }
  return {};
}

std::string readElement(PlcTable& table, ColumnType type, double number, uint8_t* element) {
  if (type == ColumnType::Int && number == std::trunc(number) && number >= double{kLeastInt} &&
      number <= double{kMostInt}) {
    put(element, static_cast<uint32_t>(static_cast<int64_t>(number)));
    return {};
  }
  if (type == ColumnType::Real && std::isfinite(number)) {
    put(element, number);
    return {};
  }
  if (type == ColumnType::Int || type == ColumnType::Real) return readElement(table, type, written(number), element);
  return wrong(written(number), type == ColumnType::Text ? "a text" : "a text of pairs of hexadecimal digits");
}

std::string writtenElement(const PlcTable& table, ColumnType type, const uint8_t* element) {
  const std::span<const uint8_t> bytes = isText(type) ? table.textOf(element) : std::span<const uint8_t>();
  switch (type) {
  case ColumnType::Int: return std::to_string(get<int32_t>(element));
  case ColumnType::Real: return written(get<double>(element));
  case ColumnType::Text: return nc::shownText({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  case ColumnType::Binary: return text::hexOf(bytes);
  }
  return {};
}

} // namespace rung::io

// Texts of a PLC table (see plc_table.h).
#include "machine/io/tables/plc_table.h"

#include <algorithm>
#include <cstring>

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

// In the order of the lines; what was in `texts` stays in `otherTexts` until the next time.
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

} // namespace rung::io

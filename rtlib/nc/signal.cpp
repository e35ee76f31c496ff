// Lookup by name and sizes of areas.
#include "rtlib/nc/signal.h"

#include <algorithm>

namespace rung::nc {

namespace {

char fold(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

int compareNames(std::string_view a, std::string_view b, bool ignoreCase) {
  if (!ignoreCase) return a.compare(b);
  const size_t common = std::min(a.size(), b.size());
  for (size_t i = 0; i < common; ++i) {
    const auto x = static_cast<unsigned char>(fold(a[i])), y = static_cast<unsigned char>(fold(b[i]));
    if (x != y) return x < y ? -1 : 1;
  }
  return a.size() == b.size() ? 0 : a.size() < b.size() ? -1 : 1;
}

} // namespace

const Signal* findSignal(const SignalTable& table, std::string_view symbol, std::string_view area) {
  auto it =
      std::lower_bound(table.byName.begin(), table.byName.end(), symbol, [&](uint16_t row, std::string_view name) {
        return compareNames(table.rows[row].symbol, name, table.ignoreCase) < 0;
      });
  for (; it != table.byName.end(); ++it) {
    const Signal& signal = table.rows[*it];
    if (compareNames(signal.symbol, symbol, table.ignoreCase) != 0) break;
    if (area.empty() || area == signal.area) return &signal;
  }
  return nullptr;
}

uint32_t elementBytes(SignalType type) {
  switch (type) {
  case SignalType::Byte: return 1;
  case SignalType::Word: return 2;
  case SignalType::Dword: return 4;
  case SignalType::Qword:
  case SignalType::Real: return 8;
  case SignalType::Bit:
  case SignalType::Struct:
  case SignalType::String: return 0;
  }
  return 0;
}

uint32_t areaBytes(const SignalTable& table, std::string_view area) {
  uint32_t bytes = 0;
  for (const Signal& s : table) {
    if (area != s.area) continue;
    uint32_t end = s.byteOffset + (s.count - 1) * s.strideBytes;
    switch (s.type) {
    case SignalType::Bit: end += s.strideBytes == 0 ? (s.bit + s.count + 7) / 8 : s.bit / 8 + 1; break;
    case SignalType::Struct: end += areaBytes(table, s.structure); break;
    default: end += elementBytes(s.type);
    }
    bytes = std::max(bytes, end);
  }
  return bytes;
}

} // namespace rung::nc

// Lookup by name and sizes of areas.
#include "rtlib/nc/signal.h"

#include <algorithm>

#include "rtlib/text/letters.h"

namespace rung::nc {

namespace {

int compareNames(std::string_view a, std::string_view b, bool ignoreCase) {
  return ignoreCase ? text::compareIgnoringCase(a, b) : a.compare(b);
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

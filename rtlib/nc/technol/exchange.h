// The requests by which a TECHNOL program reports to its control the variables that it exchanges with other modules and
// shows on screens (man. ch. 10, 18.2, 27): Define and UpdateInput (services.h), which the control answers at once.
#pragma once
#include <cstdint>
#include <string_view>

#include "rung/program.h"

namespace rung::nc {

enum class ExchangeKind : uint8_t { MapIn, MapOut, MapAin, MapAout, DefIn, DefOut, Variable, Bit };
enum class ExchangeType : uint8_t { Bit, Int8, Uns8, Int16, Uns16, Int32, Uns32, Int64, Uns64, Real, Text, Binary };
// The words for these types in programs, separated by blanks: one for each type, then synonyms (man. l.13331-13346,
// l.13701).
inline constexpr std::string_view kExchangeTypeWords =
    "TYPE_BIT TYPE_INT_8 TYPE_UNS_8 TYPE_INT_16 TYPE_UNS_16 TYPE_INT_32 TYPE_UNS_32 TYPE_INT_64 TYPE_UNS_64 TYPE_REAL "
    "TYPE_STR TYPE_BIN TYPE_BYTE TYPE_WORD TYPE_DWORD TYPE_QWORD TYPE_INT8 TYPE_UNS8 TYPE_INT16 TYPE_UNS16 TYPE_INT32 "
    "TYPE_UNS32 TYPE_INT64 TYPE_UNS64";
constexpr bool isMapped(ExchangeKind kind) { return kind <= ExchangeKind::MapAout; }
constexpr bool isText(ExchangeType type) { return type == ExchangeType::Text || type == ExchangeType::Binary; }
// The type by the index of its word.
constexpr ExchangeType exchangeTypeOf(int64_t word) {
  using enum ExchangeType;
  constexpr ExchangeType kTypes[] = {Bit,  Int8,  Uns8,  Int16, Uns16, Int32, Uns32, Int64, Uns64, Real,  Text,  Binary,
                                     Uns8, Uns16, Uns32, Uns64, Int8,  Uns8,  Int16, Uns16, Int32, Uns32, Int64, Uns64};
  return kTypes[word];
}
// How often a connection is updated (man. l.13349-13366), the fastest first. A connection has the slower period of its
// two ends.
enum class ExchangePeriod : uint8_t { Fastest, Fast, Slow, OnDemand };
inline constexpr std::string_view kExchangePeriodWords = "FASTEST FAST SLOW ONDEMAND";

// Bytes of one element; 1 for a bit, which has a byte of its own, and for texts.
constexpr uint32_t bytesOf(ExchangeType type) {
  switch (type) {
  case ExchangeType::Int16:
  case ExchangeType::Uns16: return 2;
  case ExchangeType::Int32:
  case ExchangeType::Uns32: return 4;
  case ExchangeType::Int64:
  case ExchangeType::Uns64:
  case ExchangeType::Real: return 8;
  case ExchangeType::Bit:
  case ExchangeType::Int8:
  case ExchangeType::Uns8:
  case ExchangeType::Text:
  case ExchangeType::Binary: return 1;
  }
  return 1;
}

// Bits of one element; not for texts.
constexpr uint32_t widthOf(ExchangeType type) { return type == ExchangeType::Bit ? 1 : bytesOf(type) * 8; }

// A place in the program's memory as one argument.
constexpr int kPlaceSpaceShift = 40, kPlaceByteShift = 8;
constexpr int64_t placeArgument(uint32_t space, uint32_t byte, uint32_t bit) {
  return int64_t{space} << kPlaceSpaceShift | int64_t{byte} << kPlaceByteShift | bit;
}
struct ExchangePlace {
  uint32_t space, byte, bit;
};
constexpr ExchangePlace placeOfArgument(int64_t argument) {
  return {static_cast<uint32_t>(argument >> kPlaceSpaceShift), static_cast<uint32_t>(argument >> kPlaceByteShift),
          static_cast<uint32_t>(argument & 0xFF)};
}
inline constexpr int64_t kNoPlace = -1;

// The description of an exchanged variable as one argument; `count` elements, or bytes of a text.
constexpr int64_t exchangeArgument(ExchangeKind kind, ExchangeType type, ExchangePeriod period, uint32_t count) {
  return static_cast<int64_t>(kind) | static_cast<int64_t>(type) << 8 | static_cast<int64_t>(period) << 16 |
         int64_t{count} << 24;
}

// Results of Define: 1 if it was done; 1 if the configuration has a default value; its bits, in the variable's type.
inline constexpr uint32_t kDefineHead = 4; // words before the identifier, eight characters each
inline constexpr uint32_t kDefineWords = RUNG_MAX_SERVICE_ARGS - kDefineHead;
inline constexpr uint32_t kDefineBytes = kDefineWords * 8; // longest identifier
// Results of UpdateInput, for one element of an input: 1 if it is connected; the bits of the connected value, converted
// to the input's type.

// The hooks of the schedule, by which the control works between the modules.
inline constexpr uint32_t kHookAfterInput = 1; // runs the block modules (inventory 12.2)
inline constexpr uint32_t kHookAfterMain = 2;
inline constexpr uint32_t kHookBeforeInput = 3;
inline constexpr uint32_t kHookFast = 4;    // before MODULE_FAST and MODULE_CYCLICOPERATION
inline constexpr uint32_t kHookFastest = 5; // before and after MODULE_FASTEST

} // namespace rung::nc

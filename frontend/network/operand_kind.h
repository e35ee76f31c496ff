// Kinds of operands. A dialect has a descriptor for each of its kinds.
#pragma once
#include <optional>

#include "frontend/network/language.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::network {

// How the word of an operand is parsed.
enum class OperandClass : uint8_t { Value, Number, Mask, Named, Format };
// What determines the number of bytes at an address.
enum class Length : uint8_t {
  OfKind,
  OfFormat,
  OfElements, // as many times the format's length as the format counts elements
  OfCount,    // as many bytes as the format counts
  OfNumber,
  OfRow,
  OfDigits,     // 2 bytes, or 1 if the row's condition Row::wide is 0
  OfDigitTable, // as many times that as the number says
};

struct OperandTraits {
  OperandClass parse = OperandClass::Value;
  bool address = true;               // Value: an address is allowed
  bool constant = false;             // Value: a constant is allowed; if both are, the format selects one
  bool either = false;               // Value: it is a constant if it is written as one, otherwise an address
  Length length = Length::OfKind;    // of an address
  uint32_t bytes = 1;                // of an address, with OfKind
  uint32_t least = 0;                // of these, as many must exist where an area ends; 0: all
  std::optional<Area> area = {};     // of an address: the only area allowed
  Diag elsewhere = diag::BadOperand; // reported for another area
  bool rest = false;                 // of an address: it may include all bytes after it in its area
  bool selects = false;              // Format: selects a constant or an address
  bool counts = false;               // Format: the digits before the last one are a number of elements or bytes
  bool chooses = false;              // Format: only 0 a constant or 1 an address
  uint32_t digits = 4;               // Mask: the least number of digits
  std::string_view written = "{}";   // how a value is written; for Named, begins with its letter
};

struct OperandKind : frontend::OperandKindInfo, OperandTraits {};

inline const OperandKind& kindOf(const frontend::OperandInfo& operand) {
  return static_cast<const OperandKind&>(*operand.kind);
}

} // namespace rung::frontend::network

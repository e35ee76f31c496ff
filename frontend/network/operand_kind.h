// Kinds of operands: what a row may ask for. A dialect has a descriptor for each of its own.
#pragma once
#include <optional>

#include "frontend/network/language.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diagnostics.h"

namespace rung::frontend::network {

// How the word of an operand is read.
enum class OperandClass : uint8_t { Value, Number, Mask, Named, Format };
// What says how many bytes there are at an address.
enum class Length : uint8_t { OfKind, OfFormat, OfNumber, OfRow };

struct OperandTraits {
  OperandClass parse = OperandClass::Value;
  bool address = true;               // Value: an address may be written
  bool constant = false;             // Value: a constant may; where both may the format says which
  Length length = Length::OfKind;    // of an address
  uint32_t bytes = 1;                // of an address, with OfKind
  std::optional<Area> area = {};     // of an address: the only one that is allowed
  Diag elsewhere = diag::BadOperand; // it is in another area
  bool rest = false;                 // of an address: all that follows in its area may be meant
  bool selects = false;              // Format: says whether it is a constant or an address
  std::string_view written = "{}";   // how a value is written; Named begins with its letter
};

struct OperandKind : frontend::OperandKindInfo, OperandTraits {};

inline const OperandKind& kindOf(const frontend::OperandInfo& operand) {
  return static_cast<const OperandKind&>(*operand.kind);
}

} // namespace rung::frontend::network

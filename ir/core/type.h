// The types of IR values. Signedness belongs to the operation; texts are ranges of a space, never values.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "ir/support/ids.h"

namespace rung::ir {

enum class Type : uint8_t { None, Bit, I8, I16, I32, I64, F64 };
inline constexpr int kTypeCount = 7;

// Width in bits: 1 for Bit, 0 for None.
constexpr uint32_t bitWidth(Type type) {
  constexpr uint32_t kWidths[kTypeCount] = {0, 1, 8, 16, 32, 64, 64};
  return kWidths[static_cast<int>(type)];
}
// Bytes in memory; 0 for a Bit.
constexpr uint32_t byteWidth(Type type) { return bitWidth(type) / 8; }
constexpr bool isInt(Type type) { return type >= Type::I8 && type <= Type::I64; }
constexpr std::string_view typeName(Type type) {
  constexpr std::string_view kNames[kTypeCount] = {"none", "bit", "i8", "i16", "i32", "i64", "f64"};
  return kNames[static_cast<int>(type)];
}
constexpr std::optional<Type> typeFromName(std::string_view name) {
  for (int i = 0; i < kTypeCount; ++i)
    if (typeName(static_cast<Type>(i)) == name) return static_cast<Type>(i);
  return std::nullopt;
}
// The integer type of a width in bytes (1, 2, 4, 8).
constexpr Type intOfBytes(uint32_t bytes) {
  switch (bytes) {
  case 1: return Type::I8;
  case 2: return Type::I16;
  case 4: return Type::I32;
  case 8: return Type::I64;
  }
  return Type::None;
}

// A set of types, for constraints in the table of operations.
using TypeSet = uint8_t;
constexpr TypeSet setOf(Type type) { return static_cast<TypeSet>(1u << static_cast<int>(type)); }
constexpr bool contains(TypeSet set, Type type) { return (set & setOf(type)) != 0; }
inline constexpr TypeSet kNoTypes = setOf(Type::None);
inline constexpr TypeSet kInts = setOf(Type::I8) | setOf(Type::I16) | setOf(Type::I32) | setOf(Type::I64);
inline constexpr TypeSet kBit = setOf(Type::Bit);
inline constexpr TypeSet kFloat = setOf(Type::F64);
inline constexpr TypeSet kBitsAndInts = kBit | kInts;
inline constexpr TypeSet kAllTypes = kBitsAndInts | kFloat;
inline constexpr TypeSet kIntsAndFloat = kInts | kFloat;
inline constexpr TypeSet kI64 = setOf(Type::I64);
inline constexpr TypeSet kBitToI32 = kBitsAndInts & static_cast<TypeSet>(~kI64);

// Typed indices of the IR. An id is an index in one vector of its owner, never a pointer.

using SpaceId = Id<struct SpaceTag>;     // in Module::spaces
using SlotId = Id<struct SlotTag>;       // in Module::slots
using RoutineId = Id<struct RoutineTag>; // in Module::routines
using TaskId = Id<struct TaskTag>;       // in Module::tasks
using FaultId = Id<struct FaultTag>;     // in Module::faults
using ServiceId = Id<struct ServiceTag>; // in Module::services
using ValueId = Id<struct ValueTag>;     // in Rung::values; never crosses a rung
using FileIndex = Id<struct PathTag>;    // in Module::files

} // namespace rung::ir

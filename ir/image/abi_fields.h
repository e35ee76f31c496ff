// The fields of the C ABI's structs as data, so that the C++ emitter, the LLVM emitter and the tests walk one list
// instead of each repeating the structs. In the order of program.h.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rung/program.h"

namespace rung::ir {

enum class FieldKind : uint8_t {
  U32,
  OwnSize, // uint32_t: size in bytes of the enclosing struct, on the target
  U64,
  I64,
  Text,     // const char *
  Bytes,    // const uint8_t *, with the number at `countOffset`
  U32s,     // const uint32_t *
  Texts,    // const char *const *
  Structs,  // pointer to an array of `element` structs
  ChunkFns, // the table of chunk functions
};

struct StructInfo;

struct FieldInfo {
  std::string_view name;
  FieldKind kind;
  size_t offset;                       // in the struct
  size_t countOffset = 0;              // of the uint32_t in the same struct with the number of elements
  const StructInfo* element = nullptr; // Structs
};

struct StructInfo {
  std::string_view name;
  size_t size;
  std::span<const FieldInfo> fields;
};

// rung_program; all other structs are reached from it.
const StructInfo& programInfo();

// The offsets at which the C compiler of a target places the fields: each at the next multiple of its own size. `size`
// and `offset` above are the same for the pointers of this computer.
struct TargetStruct {
  std::vector<size_t> offsets; // by field
  size_t size;
};
TargetStruct targetStruct(const StructInfo& info, size_t pointerBytes);

} // namespace rung::ir

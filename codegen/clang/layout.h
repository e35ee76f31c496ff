// The layout of a struct of a host's header, as a C or C++ compiler determines it. Plain data, without clang.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::codegen {

enum class MemberKind : uint8_t {
  Bool,
  Integer, // includes enumerations
  Real,    // float or double
  Record,  // a struct or a union
  Other,   // not a type that a PLC has
};

struct HostMember {
  std::string name; // "" for an anonymous struct or union
  std::string type; // as in the header; of an array, the element's
  MemberKind kind = MemberKind::Other;
  bool isSigned = false;
  uint64_t bit = 0;                // offset from the beginning of the enclosing record
  uint32_t bits = 0;               // width of a bit-field; 0: not a bit-field
  uint64_t bytes = 0;              // of an element
  std::vector<uint64_t> lengths;   // of an array, the outermost first
  uint32_t record = 0;             // index in HostLayout::records
  std::vector<uint32_t> constants; // of an enumeration: indices in HostLayout::constants
  std::string why;                 // of Other: the kind of type, such as "a pointer"
};

struct HostRecord {
  bool isUnion = false;
  std::vector<HostMember> members;
};

struct EnumConstant {
  std::string name; // as code outside of all namespaces writes it
  int64_t value = 0;
};

struct HostLayout {
  std::string name;                // as requested
  std::string type;                // as code writes it, such as "struct NcBlock"
  uint64_t bytes = 0;              // sizeof
  std::vector<HostRecord> records; // each once; the first one is the struct itself
  std::vector<EnumConstant> constants;
};

} // namespace rung::codegen

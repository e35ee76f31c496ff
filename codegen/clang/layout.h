// What a compiler makes of a struct of a host's header: where its members lie. Plain data, without clang.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace rung::codegen {

enum class MemberKind : uint8_t {
  Bool,
  Integer, // an enumeration, too
  Real,    // float or double
  Record,  // a struct or a union
  Other,   // nothing that a PLC has
};

struct HostMember {
  std::string name; // "" of an anonymous struct or union
  std::string type; // as the header has it, of an array that of an element
  MemberKind kind = MemberKind::Other;
  bool isSigned = false;
  uint64_t bit = 0;                // from the begin of the record that it is in
  uint32_t bits = 0;               // of a bit-field; 0: it is none
  uint64_t bytes = 0;              // of an element
  std::vector<uint64_t> lengths;   // of an array, the outermost first
  uint32_t record = 0;             // in HostLayout::records
  std::vector<uint32_t> constants; // of an enumeration: in HostLayout::constants
  std::string why;                 // of Other: what it is, "a pointer"
};

struct HostRecord {
  bool isUnion = false;
  std::vector<HostMember> members;
};

struct EnumConstant {
  std::string name; // as code of the header's language writes it outside of all namespaces
  int64_t value = 0;
};

struct HostLayout {
  std::string name;                // as it was asked for
  std::string type;                // as code writes it, "struct NcBlock"
  uint64_t bytes = 0;              // sizeof
  std::vector<HostRecord> records; // the struct itself is the first; each once
  std::vector<EnumConstant> constants;
};

} // namespace rung::codegen

// Writes members in the order of their places (see memory_struct.h). Overlapping ones become a union of structs.
#include "codegen/cpp/memory_struct.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <vector>

#include "ir/shape/memory_members.h"
#include "ir/support/put.h"

namespace rung::codegen {

using namespace ir;

namespace {

uint64_t wholeBytes(uint64_t bits) { return (bits + 7) / 8 * 8; }

std::string_view typeText(const MemoryMember& member) {
  switch (member.type) {
  case Type::None:
  case Type::Bit: return "bool";
  case Type::I8: return member.text ? "char" : "signed char";
  case Type::I16: return "short";
  case Type::I32: return "int";
  case Type::I64: return "long long";
  case Type::F64: return "double";
  }
  return {};
}

std::string declaration(const MemoryMember& member) {
  if (member.isBitField())
    return fmt::format("{} {} : {};\n", member.width == 1 ? "bool" : "int", member.name, member.width);
  if (member.count > 1 || member.text) return fmt::format("{} {}[{}];\n", typeText(member), member.name, member.count);
  return fmt::format("{} {};\n", typeText(member), member.name);
}

class StructWriter {
public:
  explicit StructWriter(std::string& out) : out_(out) {}

  void write(const MemoryLayout& layout) {
    const std::vector<MemoryMember> members = memoryMembers(layout);
    out_ += "// The memory block, for debuggers.\nstruct __attribute__((packed)) rung_memory {\n";
    uint64_t at = 0;
    for (size_t first = 0; first < members.size();) {
      const size_t end = groupEnd(members, first);
      at = writeGroup(std::span(members).subspan(first, end - first), at);
      first = end;
    }
    // clang describes a struct only if its size is used.
    put(out_, "}};\nstatic_assert(sizeof(rung_memory) == {});\n\n", std::max(1u, bytesOf(members)));
  }

private:
  using Lane = std::vector<const MemoryMember*>;

  // Members that share bytes, directly or through others, form a group.
  static size_t groupEnd(const std::vector<MemoryMember>& members, size_t first) {
    uint64_t end = wholeBytes(members[first].endBit());
    size_t next = first + 1;
    for (; next < members.size() && members[next].firstBit < end; ++next)
      end = std::max(end, wholeBytes(members[next].endBit()));
    return next;
  }

  // Lanes of members that do not overlap.
  static std::vector<Lane> lanesOf(std::span<const MemoryMember> group) {
    std::vector<Lane> lanes;
    for (const MemoryMember& member : group) {
      auto free = std::ranges::find_if(lanes, [&](const Lane& l) { return l.back()->endBit() <= member.firstBit; });
      if (free == lanes.end()) free = lanes.emplace(lanes.end());
      free->push_back(&member);
    }
    return lanes;
  }

  // Begins at bit `at`; returns the bit after the group.
  uint64_t writeGroup(std::span<const MemoryMember> group, uint64_t at) {
    const std::vector<Lane> lanes = lanesOf(group);
    if (lanes.size() == 1) return writeLane(lanes.front(), at);
    const uint64_t first = group.front().firstBit / 8 * 8;
    writeGap(at, first);
    uint64_t end = first;
    out_ += "union {\n";
    for (const Lane& lane : lanes) {
      out_ += "struct __attribute__((packed)) {\n";
      end = std::max(end, wholeBytes(writeLane(lane, first)));
      out_ += "};\n";
    }
    out_ += "};\n";
    return end;
  }

  uint64_t writeLane(const Lane& lane, uint64_t at) {
    for (const MemoryMember* member : lane) {
      writeGap(at, member->firstBit);
      out_ += declaration(*member);
      at = member->endBit();
    }
    return at;
  }

  void writeGap(uint64_t from, uint64_t to) {
    constexpr uint64_t kMostUnnamed = 64;
    const auto unnamed = [&](uint64_t bits) {
      if (bits != 0) put(out_, "long long : {};\n", bits);
    };
    if (to - from <= kMostUnnamed) return unnamed(to - from);
    const uint64_t first = wholeBytes(from);
    unnamed(first - from);
    // No name of a program is mapped to a name with '$'.
    put(out_, "char $gap_{}[{}];\n", gaps_++, (to - first) / 8);
    unnamed(to % 8);
  }

  std::string& out_;
  uint32_t gaps_ = 0; // members of unnamed structs share one set of names
};

} // namespace

void writeMemoryStruct(const MemoryLayout& layout, std::string& out) { StructWriter(out).write(layout); }

} // namespace rung::codegen

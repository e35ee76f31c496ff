// The row of an instruction: all data about it. A dialect's table is a constexpr array of rows, each with its lowering
// function; parser, checker, reference pages, `rungc explain` and the table tests use the rows. A new instruction is
// one row, one lowering function (often shared), one scenario.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <source_location>
#include <span>
#include <string_view>

namespace rung::frontend {

// A list of at most N entries that a constexpr row can contain.
template <class T, size_t N>
struct FixedList {
  std::array<T, N> items{};
  size_t count = 0;

  constexpr FixedList() = default;
  template <class... Args>
    requires(sizeof...(Args) > 0 && sizeof...(Args) <= N)
  constexpr FixedList(Args... args) // NOLINT(google-explicit-constructor)
      : items{T(args)...}, count(sizeof...(Args)) {}
  constexpr std::span<const T> all() const { return {items.data(), count}; }
  constexpr size_t size() const { return count; }
  constexpr const T& operator[](size_t i) const { return items[i]; }
};

enum class Access : uint8_t { Read, Write, ReadWrite, None };

constexpr bool isRead(Access access) { return access == Access::Read || access == Access::ReadWrite; }
constexpr bool isWritten(Access access) { return access == Access::Write || access == Access::ReadWrite; }

// The access to an operand, in words.
constexpr std::string_view nameOf(Access access) {
  constexpr std::string_view kNames[] = {"read", "written", "read and written", "named"};
  return kNames[static_cast<size_t>(access)];
}

// A kind of operands. Those of a dialect are constexpr objects of a struct derived from this one, with the properties
// that the dialect's checks use; the rows point to them.
struct OperandKindInfo {
  std::string_view name;
  std::string_view doc;       // what is allowed
  std::string_view good{};    // a valid operand
  std::string_view bad{};     // an invalid one
  std::string_view badCode{}; // the diagnostic that `bad` causes
  // Its definition: the reference lists the kinds that rows use in the order of files and lines.
  std::source_location defined = std::source_location::current();
};

// One operand in the order of the source; min and max bound a constant if min <= max.
struct OperandInfo {
  std::string_view name;
  const OperandKindInfo* kind = nullptr;
  Access access = Access::Read;
  std::string_view doc{};
  int64_t min = 1;
  int64_t max = 0;
  bool optional = false;
  bool repeated = false; // last operand only: one or more
};

// A condition of a box, from top to bottom.
struct PinInfo {
  std::string_view name;
  std::string_view doc{};
  bool edge = false; // works on the rising edge, not the level
};

enum class Output : uint8_t {
  None,     // nothing may follow
  Always,   // something must follow
  Optional, // something may follow
};

enum class Placement : uint8_t {
  AfterContact, // needs a condition before it
  AtRail,       // touches the left rail only
  Anywhere,
};

struct InstructionInfo {
  std::string_view mnemonic;
  FixedList<std::string_view, 3> aliases{}; // equivalent spellings
  std::string_view title;                   // a few words
  std::string_view group;                   // category, for the reference
  int number = -1;                          // GSK's function number
  FixedList<PinInfo, 6> pins{};             // empty: it cannot be drawn in a ladder
  FixedList<OperandInfo, 8> operands{};
  Output output = Output::None;
  Placement placement = Placement::AfterContact;
  bool terminating = false;   // TECHNOL: ends the logic equation
  bool stateful = false;      // has state between its runs
  std::string_view tasks{};   // where it is allowed; empty: everywhere
  std::string_view ref;       // manual: section and line, e.g. "5.7, l.1271"
  std::string_view doc;       // full description
  std::string_view example{}; // source text; CONTRIBUTING.md says which names it may use
};

// A row of a family, whose rows have a common shape and differ in their texts and their variant.
template <class Row>
constexpr Row rowOf(Row shape, std::string_view mnemonic, std::string_view title, std::string_view ref,
                    std::string_view doc, std::string_view example, int variant = 0) {
  shape.info.mnemonic = mnemonic;
  shape.info.title = title;
  shape.info.ref = ref;
  shape.info.doc = doc;
  shape.info.example = example;
  shape.variant = variant;
  return shape;
}

// The pins of a box below its first, which is beside the mnemonic.
constexpr std::span<const PinInfo> furtherPinsOf(const InstructionInfo& info) {
  return info.pins.size() < 2 ? std::span<const PinInfo>() : info.pins.all().subspan(1);
}

// Whether the word is one of a row's aliases; `same` compares as the dialect does.
template <class Same>
constexpr bool isAlias(const InstructionInfo& info, std::string_view word, Same same) {
  for (const std::string_view alias : info.aliases.all())
    if (same(alias, word)) return true;
  return false;
}

} // namespace rung::frontend

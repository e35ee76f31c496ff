// The row of an instruction: everything about it that is data. A dialect's table is a constexpr array of rows, each
// with its lowering function beside it; parser, checker, reference pages, `rungc explain` and the table tests read the
// rows. A new instruction is one row, one lowering function (often shared), one scenario.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <source_location>
#include <span>
#include <string_view>

namespace rung::frontend {

// A list of at most N entries that a constexpr row can hold.
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

// What is done to an operand, in words.
constexpr std::string_view nameOf(Access access) {
  constexpr std::string_view kNames[] = {"read", "written", "read and written", "named"};
  return kNames[static_cast<size_t>(access)];
}

// A kind of operands. Those of a dialect are constexpr objects of a struct derived from this one, which has what the
// dialect's checks ask for; the rows point to them.
struct OperandKindInfo {
  std::string_view name;
  std::string_view doc;       // what may be written
  std::string_view good{};    // an operand that is right
  std::string_view bad{};     // one that is wrong
  std::string_view badCode{}; // the diagnostic that `bad` raises
  // Where it is defined: the reference lists the kinds that rows use in the order of their definitions.
  uint32_t line = std::source_location::current().line();
};

// One operand in the order of the source; min and max bound a constant where min <= max.
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
  FixedList<std::string_view, 3> aliases{}; // spellings that mean the same
  std::string_view title;                   // a few words
  std::string_view group;                   // category, for the reference
  int number = -1;                          // GSK's function number
  FixedList<PinInfo, 6> pins{};             // none: it has no place in a ladder
  FixedList<OperandInfo, 8> operands{};
  Output output = Output::None;
  Placement placement = Placement::AfterContact;
  bool terminating = false;   // TECHNOL: closes the logic equation
  bool stateful = false;      // keeps something between its runs
  std::string_view tasks{};   // where it is allowed, empty: everywhere
  std::string_view ref;       // manual: section and line, e.g. "5.7, l.1271"
  std::string_view doc;       // what it does, in full
  std::string_view example{}; // source text; CONTRIBUTING.md says which names it may use
};

// A row of a family, whose rows share a shape and differ in their texts and their variant.
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

// The pins of a box below its first, which has the mnemonic.
constexpr std::span<const PinInfo> furtherPinsOf(const InstructionInfo& info) {
  return info.pins.size() < 2 ? std::span<const PinInfo>() : info.pins.all().subspan(1);
}

// Whether it is one of a row's aliases; `same` compares as the dialect does.
template <class Same>
constexpr bool isAlias(const InstructionInfo& info, std::string_view word, Same same) {
  for (const std::string_view alias : info.aliases.all())
    if (same(alias, word)) return true;
  return false;
}

} // namespace rung::frontend

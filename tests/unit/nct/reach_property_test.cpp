// Whatever an index or bit register holds, no instruction touches a word that is not its result: random registers, the
// whole memory compared on every engine (man. l.283, l.729).
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include <fmt/format.h>

#include "tests/unit/nct/machines.h"

namespace rung::frontend::nct::test {
namespace {

// Words of the program below.
constexpr uint32_t kSelect = 7000; // which form runs
constexpr uint32_t kPins = 7001;   // power at its pins, from bit 0
constexpr uint32_t kIndex = 7002;  // three index registers and one for the number of a bit
constexpr uint32_t kBit = 7005;
constexpr uint32_t kOutput = 7090;
constexpr uint32_t kBase[] = {7100, 7110, 7120}; // operand i is kBase[i] with index register kIndex + i

enum class Kind : uint8_t { None, Word, Real, Bit };
enum class Result : uint8_t { Nothing, First, User, Array };
struct Form {
  const char* text = ""; // operands as 0, 1, 2 in braces
  Kind operands[3] = {};
  Result result = Result::Nothing;
  bool enabled = true; // does nothing without power
  int pins = 1;
  const char* pinNames[4] = {};
};

constexpr Kind W = Kind::Word, R = Kind::Real, B = Kind::Bit, N = Kind::None;
constexpr Form kForms[] = {
    {"MOV {0} {1}", {W, W, N}, Result::First},
    {"MVN {0} {1}", {W, W, N}, Result::First},
    {"NEG {0} {1}", {W, W, N}, Result::First},
    {"MOVF {0} {1}", {R, R, N}, Result::First},
    {"AND {0} {1} {2}", {W, W, W}, Result::First},
    {"OR {0} {1} {2}", {W, W, W}, Result::First},
    {"XOR {0} {1} {2}", {W, W, W}, Result::First},
    {"ADD {0} {1} {2}", {W, W, W}, Result::First},
    {"SUB {0} {1} {2}", {W, W, W}, Result::First},
    {"MUL {0} {1} {2}", {W, W, W}, Result::First},
    {"DIV {0} {1} {2}", {W, W, W}, Result::First},
    {"+F {0} {1} {2}", {R, R, R}, Result::First},
    {"-F {0} {1} {2}", {R, R, R}, Result::First},
    {"*F {0} {1} {2}", {R, R, R}, Result::First},
    {"/F {0} {1} {2}", {R, R, R}, Result::First},
    {"BIN {0} {1}", {W, W, N}, Result::First},
    {"BCD {0} {1}", {W, W, N}, Result::First},
    {"FLT {0} {1}", {R, W, N}, Result::First},
    {"FIX {0} {1}", {W, R, N}, Result::First},
    {"DEG {0} {1}", {R, R, N}, Result::First},
    {"RAD {0} {1}", {R, R, N}, Result::First},
    {"CMP {0} {1}", {W, W, N}, Result::Nothing},
    {"FCMP {0} {1}", {R, R, N}, Result::Nothing},
    {"CLT {0} {1}", {W, W, N}, Result::Nothing},
    {"FLGE {0} {1}", {R, R, N}, Result::Nothing},
    {"ASHL {0} {1} {2}", {W, W, W}, Result::Array},
    {"ASHR {0} {1} {2}", {W, W, W}, Result::Array},
    {"ARTL {0} {1} {2}", {W, W, W}, Result::Array},
    {"ARTR {0} {1} {2}", {W, W, W}, Result::Array},
    {"TOND {0} {1} #0", {W, W, N}, Result::User, false},
    {"TOFFD {0} #9 {1}", {W, W, N}, Result::User, false},
    {"TPULSE {0} {1} {2}", {W, W, W}, Result::User, false},
    {"CNT {0} {1} {2} #5", {W, W, W}, Result::User, false, 3, {"", "U/D", "R"}},
    {"CNTR {0} #1 {1} {2}", {W, W, W}, Result::User, false, 3, {"", "U/D", "R"}},
    {"SHTR {0}", {W, N, N}, Result::First, false, 3, {"", "L/R", "D"}},
    {"ROT {0} {1} {2} #0 #9", {W, W, W}, Result::First, false, 5, {"BID", "DIR", "INC", "PRE"}},
    {"({0})", {B, N, N}, Result::First, false},
    {"(/{0})", {B, N, N}, Result::First, false},
    {"(S {0})", {B, N, N}, Result::First},
    {"(R {0})", {B, N, N}, Result::First},
    {"DIFU {0}", {B, N, N}, Result::First, false},
    {"DIFD {0}", {B, N, N}, Result::First, false},
    {"[{0}]", {B, N, N}, Result::Nothing},
    {"[/@{0}]", {B, N, N}, Result::Nothing},
    {"[%{0}]", {W, N, N}, Result::Nothing},
};
constexpr uint32_t kFormCount = std::size(kForms);

bool closes(const Form& form) {
  const std::string_view text = form.text;
  return text[0] == '(' || text.starts_with("DIF") || text.starts_with("CMP") || text.starts_with("FCMP");
}

std::string operandText(const Form& form, uint32_t i) {
  if (form.operands[i] == Kind::Bit) return fmt::format("{}:{},{}", kBase[i], kBit, kIndex + i);
  return fmt::format("{},{}", kBase[i], kIndex + i);
}

std::string drawing(const Form& form, uint32_t number) {
  std::string text =
      fmt::format(fmt::runtime(form.text), operandText(form, 0), operandText(form, 1), operandText(form, 2));
  if (text[0] != '(' && text[0] != '[') text = "{" + text + "}";
  std::string out = fmt::format("rung\n|--[{}.00]--{}", kPins, text);
  out += closes(form) ? "\n" : fmt::format("--({}.{:02})\n", kOutput + number / 32, number % 32);
  for (int pin = 1; pin < form.pins; ++pin) {
    const char* name = form.pinNames[form.pins == 5 ? pin - 1 : pin];
    out += fmt::format("|--[{}.{:02}]--{{{:<{}}}}\n", kPins, pin, name, text.size() - 2);
  }
  return out;
}

// Each form between a jump that leaves it out and its label.
std::string program() {
  std::string text;
  for (uint32_t i = 0; i < kFormCount; ++i) {
    text += fmt::format("rung\n|--{{CNE {} #{}}}--{{JMP #{}}}\n\n", kSelect, i, i);
    text += drawing(kForms[i], i) + fmt::format("\nrung\n|--{{JME #{}}}\n\n", i);
  }
  return text;
}

using Words = std::vector<uint32_t>;

Words snapshot(const Machine& machine) {
  Words words(10000);
  for (uint32_t i = 0; i < words.size(); ++i) words[i] = machine.word(i);
  return words;
}

// The word where operand `i` lies; nothing when it is out of reach.
std::optional<uint32_t> place(const Form& form, uint32_t i, const Words& words) {
  const auto index = static_cast<int32_t>(words[kIndex + i]);
  const int64_t word = int64_t{kBase[i]} + index;
  const bool written = i == 0 ? form.result != Result::Nothing : i == 1 && form.result == Result::Array;
  int64_t first = written ? 1 : 0;
  if (i == 0 && form.result == Result::User) first = kNcEnd;
  const int64_t last = form.operands[i] == Kind::Real ? 9998 : 9999;
  if (form.operands[i] == Kind::Real && index % 2 != 0) return std::nullopt;
  if (form.operands[i] == Kind::Bit && words[kBit] > 31) return std::nullopt;
  if (word < first || word > last) return std::nullopt;
  return static_cast<uint32_t>(word);
}

struct Allowed {
  uint32_t first = 0, end = 0; // words that may change
  bool error = false;          // FL_ER must be 1
};

Allowed allowed(const Form& form, const Words& before) {
  Allowed out;
  std::optional<uint32_t> places[3];
  for (uint32_t i = 0; i < 3; ++i) {
    if (form.operands[i] == Kind::None) continue;
    places[i] = place(form, i, before);
    out.error |= !places[i];
  }
  if (form.result == Result::Array && !out.error) out.error = *places[0] > *places[1];
  if (out.error || form.result == Result::Nothing) return out;
  out.first = *places[0];
  out.end = out.first + (form.operands[0] == Kind::Real ? 2 : 1);
  if (form.result == Result::Array) out.end = *places[1] + 1;
  return out;
}

void check(const Machine& machine, const Form& form, const Words& before) {
  const bool power = (before[kPins] & 1) != 0;
  const Allowed may = allowed(form, before);
  for (uint32_t i = 2; i < before.size(); ++i) {
    if (machine.word(i) == before[i] || (i >= kOutput && i < kOutput + 2)) continue;
    const bool own = i >= may.first && i < may.end && (power || !form.enabled);
    ASSERT_TRUE(own) << machine.name() << ": " << form.text << " changed word " << i << "; registers "
                     << static_cast<int32_t>(before[kIndex]) << " " << static_cast<int32_t>(before[kIndex + 1]) << " "
                     << static_cast<int32_t>(before[kIndex + 2]) << " " << static_cast<int32_t>(before[kBit]);
  }
  for (uint32_t i = 0; i < kNcEnd; ++i) // only what the form may write reaches the time-slice memory
    ASSERT_TRUE(i < 2 || machine.slice(i) == before[i] || (i >= may.first && i < may.end))
        << machine.name() << ": " << form.text << " changed the time-slice word " << i;
  ASSERT_EQ(machine.word(1), 0u);
  const bool edge = std::string_view(form.text).starts_with("SHTR") || std::string_view(form.text).starts_with("ROT");
  if (may.error && (power || !form.enabled) && !edge) {
    ASSERT_EQ(machine.word(0) & 1, 1u) << form.text;
  }
  if (!power && form.enabled) {
    ASSERT_EQ(machine.word(0), before[0]) << form.text;
  }
}

uint32_t wildIndex(std::mt19937& random, uint32_t operand) {
  constexpr int32_t kEnds[] = {INT32_MIN, INT32_MAX, -1, 10000, 9999, -10000, 0, 1};
  const auto near = [&](int64_t value) { return static_cast<uint32_t>(value + static_cast<int>(random() % 9) - 4); };
  switch (random() % 8) {
  case 0: return static_cast<uint32_t>(random());
  case 1: return static_cast<uint32_t>(kEnds[random() % std::size(kEnds)]);
  case 2: return near(-int64_t{kBase[operand]});
  case 3: return near(9999 - int64_t{kBase[operand]});
  case 4: return near(int64_t{kNcEnd} - kBase[operand]);
  case 5: return near(INT32_MAX - int64_t{kBase[operand]});
  default: return near(0);
  }
}

TEST(ReachProperty, NoIndexRegisterLeadsOutsideTheResult) {
  Machines machines(program());
  std::mt19937 random(20240607);
  for (int round = 0; round < 25; ++round) {
    for (Machine& machine : machines.all()) {
      std::mt19937 content(static_cast<uint32_t>(round));
      for (uint32_t i = 2; i < 10000; ++i) machine.setWord(i, static_cast<uint32_t>(content()));
    }
    for (uint32_t form = 0; form < kFormCount; ++form) {
      uint32_t registers[] = {form,
                              static_cast<uint32_t>(random()) | (random() % 4 != 0 ? 1u : 0u),
                              wildIndex(random, 0),
                              wildIndex(random, 1),
                              wildIndex(random, 2),
                              static_cast<uint32_t>(random() % 3 == 0 ? random() : random() % 34)};
      if (random() % 4 != 0) // mostly an even offset, so that doubles are met
        for (uint32_t i = 2; i < 5; ++i) registers[i] &= ~1u;
      const auto flags = static_cast<uint32_t>(random() & 0x7E);
      for (Machine& machine : machines.all()) {
        for (uint32_t i = 0; i < std::size(registers); ++i) machine.setWord(kSelect + i, registers[i]);
        machine.setWord(0, flags);
        for (uint32_t i = 2; i < kNcEnd; ++i) machine.setWord(i, machine.slice(i));
        const Words before = snapshot(machine);
        machine.run();
        ASSERT_NO_FATAL_FAILURE(check(machine, kForms[form], before));
      }
      ASSERT_EQ(machines.difference(), "") << kForms[form].text;
    }
  }
}

} // namespace
} // namespace rung::frontend::nct::test

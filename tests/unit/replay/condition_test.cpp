// Conditions: what they mean, and what is said about those that cannot be read.
#include <map>

#include <gtest/gtest.h>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "tests/support/compiled_program.h"
#include "tools/replay/condition.h"

namespace rung::replay {
namespace {

class Conditions : public ::testing::Test {
protected:
  Conditions()
      : program_("t.pmc", "dialect gsk\nsymbol GO X0.0\nFUNC END1\nLD GO\nOUT Y0.0\nFUNC END2\n",
                 compiler::EngineKind::Interp),
        block_(program_.program().memory_size + 64) {}

  Result<runtime::Ref> locate(std::string_view name) {
    if (const auto constant = constants_.find(name); constant != constants_.end()) return constant->second;
    const auto place = nc::resolve(program_.program(), name);
    if (place) return *place;
    return failure("no " + std::string(name));
  }
  Result<Condition> parse(std::string_view text) {
    return Condition::parse(text, [this](std::string_view name) { return locate(name); });
  }
  core::Memory memory() { return {program_.program(), block_.data()}; }
  void set(std::string_view name, uint64_t value) { runtime::writeRaw(memory(), locate(name).value(), value); }
  bool holds(std::string_view text) {
    Result<Condition> condition = parse(text);
    EXPECT_TRUE(condition.ok()) << text << ": " << condition.error();
    return condition.ok() && condition.value().holds(memory());
  }

  testing::CompiledProgram program_;
  std::map<std::string, runtime::Ref, std::less<>> constants_ = {
      {"TITLE", {.width = 8, .kind = runtime::RefKind::Text}}};
  std::vector<uint8_t> block_;
};

TEST_F(Conditions, CompareAndCombine) {
  set("GO", 1);
  set("D100:2", 0xFFFE); // -2
  set("D10", 5);
  for (const char* text : {"GO", "GO = 1", "GO=on", "not GO = 0", "D100:2 = -2", "D100:2 = 65534", "D100:2<0",
                           "D10 > 4.5", "D10>=5 and D10 <= 5", "D100:2 < D10", "D10 != 4",
                           "GO and (D10 = 4 or D10 = 5)", "(GO)", "X0.1 or GO", "D10 = 0x5", "-3 < D100:2"})
    EXPECT_TRUE(holds(text)) << text;
  for (const char* text : {"not GO", "GO = 0", "D100:2 > 0", "D10 < 5", "GO and D10 = 4", "X0.1", "rises GO"})
    EXPECT_FALSE(holds(text)) << text;
}

// Not only the bits that the narrower side has.
TEST_F(Conditions, CompareWholeValues) {
  set("GO", 1);
  set("D10", 5);
  set("D100:2", 261); // 0x105
  set("D20", 0xFF);
  set("D200:2", 0xFFFF);
  for (const char* text : {"D10 != 261", "261 != D10", "D10 != D100:2", "GO != 3", "D100:2 = 261", "D20 = 255",
                           "D20 = -1", "D20 = D200:2", "D10 = 5.0"})
    EXPECT_TRUE(holds(text)) << text;
  for (const char* text :
       {"D10 = 261", "261 = D10", "D10 = D100:2", "D100:2 = D10", "GO = 3", "GO = 257", "D20 = 65535", "D10 = 5.5"})
    EXPECT_FALSE(holds(text)) << text;
}

TEST_F(Conditions, ConstantsOfTheProgramHaveTheirValues) {
  runtime::Ref nine;
  nine.kind = runtime::RefKind::Constant;
  nine.width = 64;
  nine.constant = 9;
  constants_["NINE"] = nine;
  set("D10", 9);
  for (const char* text : {"D10 = NINE", "NINE", "NINE = 9", "NINE > 8.5", "D10 <= NINE"})
    EXPECT_TRUE(holds(text)) << text;
  set("D10", 0);
  for (const char* text : {"D10 = NINE", "NINE = 0", "changes NINE"}) EXPECT_FALSE(holds(text)) << text;
}

// A name that reads like a number that is none.
TEST_F(Conditions, NamesAreNoNumbers) {
  for (const char* text : {"inf", "nan", "0x", "-"}) EXPECT_EQ(parse(text).error(), "no " + std::string(text));
}

TEST_F(Conditions, EdgesCompareWithTheCallBefore) {
  Condition rises = parse("rises GO").value(), falls = parse("falls GO").value(),
            changes = parse("changes D10").value();
  const auto call = [&](uint64_t go, uint64_t count) {
    set("GO", go);
    set("D10", count);
    std::string text;
    text += rises.holds(memory()) ? 'r' : '.';
    text += falls.holds(memory()) ? 'f' : '.';
    text += changes.holds(memory()) ? 'c' : '.';
    return text;
  };
  EXPECT_EQ(call(1, 7), "...");
  EXPECT_EQ(call(0, 7), ".f.");
  EXPECT_EQ(call(1, 8), "r.c");
  EXPECT_EQ(call(1, 8), "...");
  rises.restart();
  EXPECT_EQ(call(1, 9), "..c");
}

TEST_F(Conditions, SaysWhatIsWrong) {
  const std::map<std::string, std::string> cases = {
      {"", "expected a condition, such as X8.4 or D100 > 500"},
      {"NOWHERE", "no NOWHERE"},
      {"GO =", "expected a name or a number at the end"},
      {"(GO", "a bracket is not closed"},
      {"GO GO", "expected and, or, a comparison or the end, found 'GO'"},
      {"\"GO", "the quotation mark is not closed"},
      {"GO and", "expected a name or a number at the end"},
      {"rises", "expected a name or a number at the end"},
      {"TITLE = 3", "TITLE is a text, and conditions compare numbers"},
      {std::string(100'000, '('), "it is nested too deeply"},
  };
  for (const auto& [text, problem] : cases) {
    const Result<Condition> condition = parse(text);
    ASSERT_FALSE(condition.ok()) << text;
    EXPECT_EQ(condition.error(), problem) << text;
  }
}

} // namespace
} // namespace rung::replay

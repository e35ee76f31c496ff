// Every signal of the NC in a program: predeclared, of its kind, of its direction, with every index.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <set>

#include "frontend/dialects/nct/reference.h"
#include "rtlib/nc/nct/signals.h"
#include "tests/unit/nct/support.h"

namespace rung::frontend::nct::test {
namespace {

using ::testing::IsEmpty;

bool isBit(const nc::Signal& signal) { return signal.type == nc::SignalType::Bit; }
bool isDouble(const nc::Signal& signal) { return nc::elementBytes(signal.type) == 8; }
uint32_t step(const nc::Signal& signal) { return isDouble(signal) ? 2 : 1; }

// A rung that reads or writes `operand`, which is of the signal's kind.
std::string reads(const nc::Signal& signal, const std::string& operand) {
  if (isBit(signal)) return fmt::format("rung\n|--[{}]--(S 7000.00)\n\n", operand);
  return fmt::format("rung\n|--[N_ON]--{{{} 7002 {}}}\n\n", isDouble(signal) ? "MOVF" : "MOV", operand);
}
std::string writes(const nc::Signal& signal, const std::string& operand) {
  if (isBit(signal)) return fmt::format("rung\n|--[N_ON]--(S {})\n\n", operand);
  return fmt::format("rung\n|--[N_ON]--{{{} {} {}}}\n\n", isDouble(signal) ? "MOVF" : "MOV", operand,
                     isDouble(signal) ? "*1.0" : "#1");
}
// The name, its last element, a computed one.
std::vector<std::string> forms(const nc::Signal& signal) {
  std::vector<std::string> result = {signal.symbol, fmt::format("{},7001", signal.symbol)};
  if (signal.count > 1) result.push_back(fmt::format("{},#{}", signal.symbol, (signal.count - 1) * step(signal)));
  return result;
}

TEST(NctSignals, AllAreReadInAllForms) {
  std::string program;
  for (const nc::Signal& signal : nc::nctSignals())
    for (const std::string& form : forms(signal)) program += reads(signal, form);
  const Compiled c = compileMain(program);
  for (const std::string& code : c.codes()) EXPECT_TRUE(code.ends_with(" int0-only-signal (w)")) << code;
  EXPECT_LE(c.codes().size(), 6u); // HWMOVE and N_P2MS
  EXPECT_NE(c.module, nullptr);
}

TEST(NctSignals, OutputsAreWrittenInAllForms) {
  std::string program;
  for (const nc::Signal& signal : nc::nctSignals())
    if (signal.direction == nc::Direction::Out)
      for (const std::string& form : forms(signal)) program += writes(signal, form);
  EXPECT_THAT(compileMain(program).codes(), IsEmpty());
}

TEST(NctSignals, InputsAreNot) {
  std::string program;
  size_t count = 0;
  for (const nc::Signal& signal : nc::nctSignals()) {
    if (signal.direction != nc::Direction::In) continue;
    program +=
        writes(signal, forms(signal).back().find('#') == std::string::npos ? signal.symbol : forms(signal).back());
    ++count;
  }
  const Compiled c = compileMain(program);
  size_t told = 0;
  for (const std::string& code : c.codes()) told += code.ends_with(" write-to-input (w)") ? 1 : 0;
  EXPECT_EQ(told, count);
}

TEST(NctSignals, OneElementTooFarIsTold) {
  for (const nc::Signal& signal : nc::nctSignals()) {
    if (signal.count < 2) continue;
    const Compiled c = compileMain(reads(signal, fmt::format("{},#{}", signal.symbol, signal.count * step(signal))));
    ASSERT_FALSE(c.codes().empty()) << signal.symbol;
    EXPECT_TRUE(c.codes()[0].ends_with(" signal-index (w)")) << c.rendered();
  }
}

TEST(NctSignals, KindsAreNotMixed) {
  for (const nc::Signal& signal : nc::nctSignals()) {
    const std::string program = isBit(signal) ? fmt::format("rung\n|--[N_ON]--{{MOV 7002 {}}}\n", signal.symbol)
                                              : fmt::format("rung\n|--[N_ON]--(S {})\n", signal.symbol);
    const Compiled c = compileMain(program);
    ASSERT_EQ(c.codes().size(), 1u) << signal.symbol;
    EXPECT_TRUE(c.codes()[0].ends_with(" symbol-kind-mismatch")) << c.rendered();
  }
}

TEST(NctSignals, NoneCanBeDeclaredAgain) {
  for (const nc::Signal& signal : nc::nctSignals()) {
    const Compiled c = compileMain(fmt::format("symbol {} 7000\n", signal.symbol));
    ASSERT_EQ(c.codes().size(), 1u) << signal.symbol;
    EXPECT_TRUE(c.codes()[0].ends_with(" duplicate-symbol"));
  }
}

// Places of different signals overlap only where the manual says that a word holds bits.
TEST(NctSignals, PlacesAreDistinct) {
  std::map<uint32_t, std::set<const nc::Signal*>> words; // of signals that are no bits
  std::map<uint64_t, const nc::Signal*> bits;
  for (const nc::Signal& signal : nc::nctSignals())
    for (uint32_t i = 0; i < signal.count; ++i) {
      const uint32_t word = (signal.byteOffset + i * signal.strideBytes) / 4;
      EXPECT_GE(word, 2u) << signal.symbol;
      EXPECT_LT(word, 4000u) << signal.symbol;
      if (isBit(signal)) {
        EXPECT_TRUE(bits.emplace(uint64_t{word} * 32 + signal.bit, &signal).second) << signal.symbol;
      } else {
        for (uint32_t half = 0; half < step(signal); ++half) words[word + half].insert(&signal);
      }
    }
  for (const auto& [word, owners] : words)
    EXPECT_EQ(owners.size(), 1u) << "word " << word << ' ' << (*owners.begin())->symbol;
  for (const auto& [place, signal] : bits) {
    const auto owner = words.find(static_cast<uint32_t>(place / 32));
    if (owner == words.end()) continue;
    const nc::Signal& container = **owner->second.begin();
    EXPECT_EQ(container.direction, signal->direction) << signal->symbol;
    EXPECT_EQ(container.count, signal->count) << signal->symbol;
    EXPECT_TRUE(std::string_view(signal->address).starts_with(std::string(container.symbol) + "."))
        << signal->symbol << ' ' << container.symbol;
  }
}

TEST(NctSignals, AllAreExplained) {
  for (const nc::Signal& signal : nc::nctSignals()) {
    const std::string text = explainWord(signal.symbol);
    EXPECT_TRUE(text.starts_with(fmt::format("[nct] {}: ", signal.symbol))) << signal.symbol;
    EXPECT_NE(text.find(signal.meaning), std::string::npos) << text;
    EXPECT_NE(text.find(fmt::format("l.{}.", signal.manualLine)), std::string::npos) << text;
    if (signal.count > 1) {
      EXPECT_NE(text.find(fmt::format("to #{} (", (signal.count - 1) * step(signal))), std::string::npos) << text;
    }
  }
  EXPECT_EQ(explainWord("AP_DISP"), explainWord("AP_DISPD"));
  EXPECT_EQ(explainWord("an_plca,#1"), explainWord("AN_PLCA"));
  EXPECT_NE(explainWord("FL_ER").find("0000.00"), std::string::npos);
  EXPECT_NE(explainWord("mw70").find("window"), std::string::npos);
  EXPECT_NE(explainWord("actposax").find("SCP"), std::string::npos);
  EXPECT_EQ(explainWord("MW 104"), "");
  EXPECT_EQ(explainWord("NOWHERE"), "");
  EXPECT_EQ(explainWord(""), "");
}

} // namespace
} // namespace rung::frontend::nct::test

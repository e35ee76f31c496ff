// Messages where scenarios do not reach: texts, a queue that overflows, a message that nobody can delete any more.
#include "rtlib/nc/nct/messages.h"

#include <bit>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "sim/machine.h"

namespace rung::frontend::nct::test {
namespace {

using nc::nct::fillText;
using nc::nct::readPlaceholder;

std::string filled(std::string_view text, int64_t value, bool real = false, size_t room = 500) {
  std::string out(room, '?');
  const rung_message message = {RUNG_MESSAGE_SHOW, 1, 0, 0, value, real ? 1u : 0u, 0};
  out.resize(fillText(text, message, out));
  return out;
}
std::string filledReal(std::string_view text, double value) {
  return filled(text, std::bit_cast<int64_t>(value), true);
}

TEST(MessageText, Integers) {
  EXPECT_EQ(filled("Mount the tool No. {#0:F0} to spindle.", 17), "Mount the tool No. 17 to spindle.");
  EXPECT_EQ(filled("{#0:F0}", INT64_MIN), "-9223372036854775808");
  EXPECT_EQ(filled("{#0:F0}{#0:F0}", -1), "-1-1");
  EXPECT_EQ(filled("", 5), "");
  EXPECT_EQ(filled("none", 5), "none");
}

TEST(MessageText, DoublesAreRoundedToTheirDecimals) {
  EXPECT_EQ(filledReal("The temperature of the spindle {*0:F1} °C", 36.65), "The temperature of the spindle 36.6 °C");
  EXPECT_EQ(filledReal("{*0:F0}", 2.5), "2");
  EXPECT_EQ(filledReal("{*0:F0}", 3.5), "4");
  EXPECT_EQ(filledReal("{*0:F3}", -0.0), "-0.000");
  EXPECT_EQ(filledReal("{*0:F20}", 0.1), "0.10000000000000000555");
  EXPECT_EQ(filledReal("{*0:F20}", -1.7976931348623157e308).size(), 1u + 309 + 1 + 20);
}

// A number that is known at run time only may meet a text of the other kind.
TEST(MessageText, PrintTheNumberThatThereIs) {
  EXPECT_EQ(filled("{*0:F1}", 5), "5.0");
  EXPECT_EQ(filledReal("{#0:F0}", 2.75), "3");
}

TEST(MessageText, AreCutOff) {
  EXPECT_EQ(filled("abcdef", 1, false, 3), "abc");
  EXPECT_EQ(filled("ab{#0:F0}", 12345, false, 4), "ab12");
  EXPECT_EQ(filled("a {b} {#0:F0}", 1), "a {b} 1") << "what is no placeholder stays";
}

TEST(MessageText, WhatIsNoPlaceholder) {
  for (const char* text : {"{#0:F1}", "{#0:F}", "{#0:F0", "{#1:F0}", "{#0F0}", "{0:F0}", "{*0:F-1}", "{*0:F21}",
                           "{*0:f1}", "{* 0:F1}", "{*0:F1 }", "{*0:F99999999999}", "{", "{}", "{#}", "#0:F0}"})
    EXPECT_FALSE(readPlaceholder(text)) << text;
  EXPECT_EQ(readPlaceholder("{*0:F12} and so on")->length, 8u);
  EXPECT_EQ(readPlaceholder("{*0:F12}")->decimals, 12);
}

// A program beside the control.
class Bench {
public:
  explicit Bench(const std::string& body) {
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer("test.lad", "dialect nct\nmodule MAIN\n" + body);
    auto compiled = compiler::compile(sources, {&file, 1}, {}, diagnostics);
    EXPECT_TRUE(compiled.has_value()) << renderText(diagnostics, sources);
    compiled_ = std::move(*compiled);
    engine_ = std::move(compiler::makeEngine(compiler::EngineKind::Interp, compiled_, {}).value());
    machine_ = std::make_unique<sim::Machine>(engine_->program(), engine_->context(), sim::makeSimulatedNc("nct"));
    machine_->powerOn(nc::PowerOn::Cold);
  }
  void set(std::string_view bit, bool value) {
    EXPECT_EQ(program().write(*machine_->nc().writePlace(program().program(), bit), value ? 1 : 0), std::nullopt);
  }
  uint64_t read(const std::string& name) {
    return program().read(*machine_->nc().readPlace(program().program(), name));
  }
  void scan() { machine_->scan(); }
  // The bits that are 1 among `count` from word `first` on.
  uint32_t ones(uint32_t first, uint32_t count) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; ++i)
      sum += static_cast<uint32_t>(read(fmt::format("{:04}.{:02}", first + i / 32, i % 32)));
    return sum;
  }
  std::vector<nc::ShownMessage> shown() { return machine_->nc().control().messages(program()); }
  std::vector<std::string> log() { return machine_->nc().takeLog(); }
  uint32_t lost() { return program().messages().lost(); }

private:
  runtime::Instance& program() { return machine_->inside(); }

  compiler::Compiled compiled_;
  std::unique_ptr<runtime::Engine> engine_;
  std::unique_ptr<sim::Machine> machine_;
};

// `count` boxes with the numbers from `number` on, driven by one bit; outputs from `word` on.
std::string boxes(const char* mnemonic, const char* bit, uint32_t number, uint32_t count, uint32_t word) {
  std::string text;
  for (uint32_t i = 0; i < count; ++i)
    text += fmt::format("rung\n|--[{}]--{{{} #{} #0 #0}}--({:04}.{:02})\n\n", bit, mnemonic, number + i, word + i / 32,
                        i % 32);
  return text;
}

constexpr uint32_t kRoom = core::kMessageCapacity;

TEST(MessageQueue, WhatFoundNoRoomIsNotShown) {
  Bench b(boxes("MSG", "7000.00", 1, kRoom + 44, 7100));
  b.set("7000.00", true);
  b.scan();
  EXPECT_EQ(b.lost(), 44u);
  EXPECT_EQ(b.shown().size(), kRoom);
  b.scan();
  EXPECT_EQ(b.ones(7100, kRoom + 44), kRoom);
  EXPECT_EQ(b.read("N_ACTMSG"), kRoom * 100) << "the last one that was sent";
  b.scan();
  EXPECT_EQ(b.ones(7100, kRoom + 44), kRoom) << "nothing is sent again before the next rising edge";
  b.set("7000.00", false);
  b.scan();
  b.scan();
  EXPECT_EQ(b.shown().size(), 0u);
  EXPECT_EQ(b.ones(7100, kRoom + 44), 0u);
}

TEST(MessageQueue, WhatFoundNoRoomIsNotLogged) {
  Bench b(boxes("REM", "7000.00", 1, kRoom + 10, 7100));
  b.set("7000.00", true);
  b.scan();
  EXPECT_EQ(b.log().size(), kRoom);
  EXPECT_EQ(b.shown().size(), 0u);
  b.scan();
  EXPECT_EQ(b.ones(7100, kRoom + 10), kRoom);
}

// The program's deletion is lost, but what no box wants any more goes all the same.
TEST(MessageQueue, ALostDeletionIsMadeUpFor) {
  Bench b(boxes("ALR", "7000.01", 401, kRoom, 7200) + boxes("MSG", "7000.00", 1, 20, 7100));
  b.set("7000.00", true);
  b.scan();
  b.scan();
  EXPECT_EQ(b.ones(7100, 20), 20u);
  b.set("7000.00", false);
  b.set("7000.01", true);
  b.scan();
  EXPECT_EQ(b.lost(), 20u);
  b.scan();
  EXPECT_EQ(b.shown().size(), kRoom);
  EXPECT_EQ(b.ones(7200, kRoom), kRoom);
  EXPECT_EQ(b.ones(7100, 20), 0u);
  for (const nc::ShownMessage& message : b.shown()) EXPECT_GE(message.number, 401u);
}

} // namespace
} // namespace rung::frontend::nct::test

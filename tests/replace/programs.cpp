// The ladders (see programs.h).
#include "tests/replace/programs.h"

#include <fmt/format.h>
#include <random>
#include <vector>

#include "ir/support/put.h"

namespace rung::test {
namespace {

constexpr const char* kInputWords[] = {"INP000", "INP001", "INP010", "INP011"};
constexpr const char* kOutputWords[] = {"OUT000", "OUT010"};
constexpr uint32_t kBitsAWord = 32;
constexpr uint32_t kInputs = std::size(kInputWords) * kBitsAWord;
constexpr uint32_t kOutputs = std::size(kOutputWords) * kBitsAWord;
constexpr uint32_t kMessages = 20;
constexpr uint32_t kRequests = 8;
constexpr uint32_t kMoreTimers = 32; // of Variant::Array
constexpr uint32_t kArrayWords = 512;
constexpr uint32_t kFirstCoil = 5400; // a word
constexpr uint32_t kStepsOfALogicRung = 4;

// Where a variant has its cells: words, from PLCNVRAM = 4000 and from PLCRAM = 5024.
struct Map {
  uint32_t keep, latch, latchBit, count, ring, time;
};
constexpr Map kUsual = {4100, 4500, 0, 4300, 4400, 5100};
constexpr Map kMoved = {4600, 4550, 3, 4800, 4410, 5700};
constexpr uint32_t kToggle = 5030, kTick = 5200, kTicks = 5300, kMore = 5800, kArray = 6000, kBlocks = 7000;

std::string bit(uint32_t word, uint32_t number) {
  return fmt::format("{:04}.{:02}", word + number / kBitsAWord, number % kBitsAWord);
}

class Writer {
public:
  explicit Writer(Variant variant) : variant_(variant), map_(variant == Variant::Moved ? kMoved : kUsual) {}

  std::string write() {
    text_ = "dialect nct\n";
    symbols();
    text_ += "module MAIN\n";
    rung(2, "|--[/TOGGLE]--(TOGGLE)");
    rung(2, "|--[N_ON]--{{ADD SCANS SCANS #1}}");
    for (uint32_t i = 0; i < kCounters; ++i) rung(2, "|--[@TOGGLE]--{{ADD COUNT{0} COUNT{0} #1}}", i);
    for (uint32_t i = 0; i < kRings; ++i) ring(i);
    for (uint32_t i = 0; i < kTimers; ++i) timer(i);
    for (uint32_t i = 0; i < kMessages; ++i) rung(3, "|--[{}]--{{MSG #{} #0 #0 #0}}--(SHOWN{})", input(i), i + 1, i);
    for (uint32_t i = 0; i < kRequests; ++i) request(i);
    if (variant_ == Variant::Array) array();
    logic((kSteps - steps_) / kStepsOfALogicRung);
    return text_;
  }

private:
  template <class... T>
  void line(fmt::format_string<T...> format, T&&... arguments) {
    put(text_, format, std::forward<T>(arguments)...);
    text_ += '\n';
  }
  template <class... T>
  void rung(uint32_t steps, fmt::format_string<T...> format, T&&... arguments) {
    text_ += "\nrung\n";
    line(format, std::forward<T>(arguments)...);
    steps_ += steps;
  }

  void words(const char* name, uint32_t count, uint32_t first) {
    for (uint32_t i = 0; i < count; ++i) line("symbol {}{} {:04}", name, i, first + i);
  }
  void bits(const char* name, uint32_t count, uint32_t word, uint32_t first = 0) {
    for (uint32_t i = 0; i < count; ++i) line("symbol {}{} {}", name, i, bit(word, first + i));
  }

  void symbols() {
    line("symbol SCANS 4000");
    line("symbol TOGGLE {}", bit(kToggle, 0));
    words("KEEP", kKept, map_.keep);
    bits("LATCH", kLatches, map_.latch, map_.latchBit);
    words("COUNT", kCounters, map_.count);
    words("RING", kRings, map_.ring);
    words("TIME", kTimers, map_.time);
    bits("TICK", kTimers, kTick);
    words("TICKS", kTimers, kTicks);
    bits("SHOWN", kMessages, kTick + 8);
    bits("ASK", kRequests, kTick + 9);
    for (uint32_t i = 0; i < kMessages; ++i) line("message {} \"Message {}\"", i + 1, i + 1);
    if (variant_ != Variant::Array) return;
    line("symbol CURSOR {:04}", kMore - 1);
    words("MORE", kMoreTimers, kMore);
    bits("OVER", kMoreTimers, kMore + kMoreTimers);
  }

  void ring(uint32_t i) {
    rung(5, "|--[TOGGLE]----{{CNTR RING{} #0 #{} #{}}}--({})", i, ringEnd(i), ringEnd(i), bit(kTick + 4, i));
    const size_t width = fmt::format("CNTR RING{} #0 #{} #{}", i, ringEnd(i), ringEnd(i)).size();
    line("|--[/N_ON]-----{{{:<{}}}}", "U/D", width);
    line("|--[/N_ON]-----{{{:<{}}}}", "R", width);
  }
  void timer(uint32_t i) {
    rung(3, "|--[/TICK{0}]--{{TOND TIME{0} #{1} #0}}--(TICK{0})", i, timerMs(i));
    rung(2, "|--[@TICK{0}]--{{ADD TICKS{0} TICKS{0} #1}}", i);
  }
  // Its answers mean nothing to the program.
  void request(uint32_t i) {
    rung(2, "|--[@TICK{}]--(S ASK{})", i, i);
    rung(3, "|--[ASK{0}]--{{MR {1:04} #10}}--(R ASK{0})", i, kBlocks + 16 * i);
  }
  void array() {
    for (uint32_t i = 0; i < kMoreTimers; ++i)
      rung(3, "|--[{0}]--{{TOND MORE{1} #{2} #0}}--(OVER{1})", input(i), i, 10 + i);
    rung(2, "|--[N_ON]--{{ADD CURSOR CURSOR #1}}");
    rung(2, "|--[N_ON]--{{AND CURSOR CURSOR #${:X}}}", kArrayWords - 1);
    rung(2, "|--[N_ON]--{{MOV {:04},CURSOR SCANS}}", kArray);
  }

  static std::string input(uint32_t i) { return fmt::format("{}.{:02}", kInputWords[i / kBitsAWord], i % kBitsAWord); }
  // The first ones are outputs of the machine.
  static std::string coil(uint32_t i) {
    return i < kOutputs ? fmt::format("{}.{:02}", kOutputWords[i / kBitsAWord], i % kBitsAWord) : bit(kFirstCoil, i);
  }

  void logic(uint32_t rungs) {
    std::mt19937 random(1);
    std::mt19937 other(2);
    for (uint32_t i = 0; i < rungs; ++i) {
      const auto contact = [&] {
        uint32_t drawn = static_cast<uint32_t>(random());
        if (variant_ == Variant::OtherLogic && i % 16 == 0) drawn = static_cast<uint32_t>(other());
        const uint32_t number = drawn / 4 % (kInputs + rungs);
        return fmt::format("[{}{}]", drawn % 4 == 0 ? "/" : "",
                           number < kInputs ? input(number) : coil(number - kInputs));
      };
      const std::string a = contact(), b = contact(), c = contact();
      if (random() % 2 == 0) {
        rung(kStepsOfALogicRung, "|--{}--{}--{}--({})", a, b, c, coil(i));
        continue;
      }
      const size_t width = std::max(a.size(), b.size());
      rung(kStepsOfALogicRung, "|--{:-<{}}--+--{}--({})", a, width, c, coil(i));
      line("|--{:-<{}}--+", b, width);
    }
  }

  Variant variant_;
  Map map_;
  std::string text_;
  uint32_t steps_ = 0;
};

} // namespace

std::string ladderOf(Variant variant) { return Writer(variant).write(); }

} // namespace rung::test

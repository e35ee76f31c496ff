// Boxes against plain C++: integers and conversions with random and boundary values, ROT against walking round the ring
// step by step, arrays against a vector of bits, the ring counter against counting.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <random>

#include <fmt/format.h>

#include "tests/unit/nct/machines.h"

namespace rung::frontend::nct::test {
namespace {

enum Flag : uint32_t { kEr = 1, kUf = 2, kOf = 4, kCy = 8, kGt = 16, kEq = 32, kLt = 64 };
constexpr uint32_t kA = 7001, kB = 7002, kResult = 7100, kFlags = 7200;

struct Answer {
  std::optional<int32_t> result; // nothing: stays as it was
  uint32_t flags = 0;            // those of `mask`
  uint32_t mask = kEr;
};

struct Box {
  const char* text; // {} is the result
  std::function<Answer(int32_t, int32_t)> answer;
};

int32_t wrapped(int64_t value) { return static_cast<int32_t>(static_cast<uint64_t>(value)); }

Answer sum(int64_t a, int64_t b, bool subtract) {
  const int64_t exact = subtract ? a - b : a + b;
  const int32_t result = wrapped(exact);
  const auto ua = static_cast<uint32_t>(a), ub = static_cast<uint32_t>(b);
  uint32_t flags = 0;
  if (exact > INT32_MAX) flags |= kOf;
  if (exact < INT32_MIN) flags |= kUf;
  if (subtract ? ub > ua : uint64_t{ua} + ub > UINT32_MAX) flags |= kCy;
  return {result, flags, kEr | kUf | kOf | kCy};
}

Answer quotient(int64_t a, int64_t b) {
  constexpr uint32_t kMask = kEr | kUf | kOf | kCy;
  if (b == 0) return {0, kEr, kMask};
  return {wrapped(a / b), a / b > INT32_MAX ? kOf : 0u, kMask};
}

Answer fromBcd(uint32_t a) {
  int32_t value = 0;
  for (int shift = 28; shift >= 0; shift -= 4) {
    const uint32_t digit = a >> shift & 15;
    if (digit > 9) return {std::nullopt, kEr, kEr};
    value = value * 10 + static_cast<int32_t>(digit);
  }
  return {value, 0, kEr};
}

Answer toBcd(int32_t a) {
  if (a < 0 || a > 99'999'999) return {std::nullopt, kEr, kEr};
  uint32_t digits = 0;
  for (int shift = 0; a > 0; shift += 4, a /= 10) digits |= static_cast<uint32_t>(a % 10) << shift;
  return {static_cast<int32_t>(digits), 0, kEr};
}

const Box kBoxes[] = {
    {"MOV {} 7001", [](int32_t a, int32_t) { return Answer{a}; }},
    {"MVN {} 7001", [](int32_t a, int32_t) { return Answer{-1 - a}; }},
    {"NEG {} 7002", [](int32_t, int32_t b) { return Answer{-1 - b}; }},
    {"AND {} 7001 7002", [](int32_t a, int32_t b) { return Answer{a & b}; }},
    {"OR {} 7001 7002", [](int32_t a, int32_t b) { return Answer{a | b}; }},
    {"XOR {} 7001 7002", [](int32_t a, int32_t b) { return Answer{a ^ b}; }},
    {"ADD {} 7001 7002", [](int32_t a, int32_t b) { return sum(a, b, false); }},
    {"SUB {} 7001 7002", [](int32_t a, int32_t b) { return sum(a, b, true); }},
    {"MUL {} 7001 7002",
     [](int32_t a, int32_t b) {
       const int64_t exact = int64_t{a} * b;
       const bool over = exact > INT32_MAX || exact < INT32_MIN;
       return Answer{wrapped(exact), over ? kOf : 0u, kEr | kUf | kOf | kCy};
     }},
    {"DIV {} 7001 7002", [](int32_t a, int32_t b) { return quotient(a, b); }},
    {"ADD {} 7001 #-7", [](int32_t a, int32_t) { return sum(a, -7, false); }},
    {"SUB {} 7001 #$80000000", [](int32_t a, int32_t) { return sum(a, INT32_MIN, true); }},
    {"DIV {} 7001 #-1", [](int32_t a, int32_t) { return quotient(a, -1); }},
    {"BIN {} 7001", [](int32_t a, int32_t) { return fromBcd(static_cast<uint32_t>(a)); }},
    {"BCD {} 7001", [](int32_t a, int32_t) { return toBcd(a); }},
};
constexpr uint32_t kBoxCount = std::size(kBoxes);

// Each box, and FLAGS behind it; with FLAGS full before it, which flags it leaves alone is seen as well.
std::string boxProgram() {
  std::string text;
  for (uint32_t i = 0; i < kBoxCount; ++i)
    text += fmt::format("rung\n|--[7000.00]--{{{}}}--({}.{:02})\n\nrung\n|--[7000.00]--{{MOV {} FLAGS}}\n\n",
                        fmt::format(fmt::runtime(kBoxes[i].text), kResult + i), 7300 + i / 32, i % 32, kFlags + i);
  return text;
}

uint32_t operand(std::mt19937& random) {
  constexpr int32_t kEdges[] = {0,          1,
                                -1,         2,
                                -2,         7,
                                9,          10,
                                46340,      46341,
                                65535,      65536,
                                99'999'999, 100'000'000,
                                INT32_MAX,  INT32_MAX - 1,
                                INT32_MIN,  INT32_MIN + 1,
                                0x12345678, 0x0000000A};
  switch (random() % 4) {
  case 0: return static_cast<uint32_t>(kEdges[random() % std::size(kEdges)]);
  case 1: return static_cast<uint32_t>(random() >> random() % 32);
  case 2: { // often a BCD number
    uint32_t digits = 0;
    for (int i = 0; i < 8; ++i) digits = digits << 4 | random() % 10;
    return digits;
  }
  default: return static_cast<uint32_t>(random());
  }
}

TEST(ArithmeticProperty, IntegerBoxesArePlainArithmetic) {
  Machines machines(boxProgram());
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    const uint32_t a = operand(random), b = operand(random), mark = operand(random);
    for (Machine& machine : machines.all()) {
      machine.setWord(7000, 1);
      machine.setWord(kA, a);
      machine.setWord(kB, b);
      for (uint32_t i = 0; i < kBoxCount; ++i) machine.setWord(kResult + i, mark);
      machine.run();
      for (uint32_t i = 0; i < kBoxCount; ++i) {
        const Answer answer = kBoxes[i].answer(static_cast<int32_t>(a), static_cast<int32_t>(b));
        const std::string about = fmt::format("{}: {} with {:#x}, {:#x}", machine.name(), kBoxes[i].text, a, b);
        ASSERT_EQ(machine.word(kResult + i), answer.result ? static_cast<uint32_t>(*answer.result) : mark) << about;
        ASSERT_EQ(machine.word(kFlags + i) & answer.mask, answer.flags) << about;
        ASSERT_EQ(machine.bit(7300 + i / 32, i % 32), (answer.flags & kEr) == 0) << about;
      }
    }
  }
  EXPECT_EQ(machines.difference(), "");
}

TEST(ArithmeticProperty, ComparisonsAgreeWithTheOrderOfIntegers) {
  Machines machines("rung\n|--[7000.00]--{CMP 7001 7002}\n\n"
                    "rung\n|--{CLT 7001 7002}--(7300.00)\n\nrung\n|--{CLE 7001 7002}--(7300.01)\n\n"
                    "rung\n|--{CEQ 7001 7002}--(7300.02)\n\nrung\n|--{CNE 7001 7002}--(7300.03)\n\n"
                    "rung\n|--{CGE 7001 7002}--(7300.04)\n\nrung\n|--{CGT 7001 7002}--(7300.05)\n");
  std::mt19937 random(8);
  for (int round = 0; round < 3000; ++round) {
    const uint32_t a = operand(random), b = random() % 4 == 0 ? a : operand(random);
    const auto x = static_cast<int32_t>(a), y = static_cast<int32_t>(b);
    for (Machine& machine : machines.all()) {
      machine.setWord(7000, 1);
      machine.setWord(kA, a);
      machine.setWord(kB, b);
      machine.run();
      ASSERT_EQ(machine.word(0), x > y ? kGt : x == y ? kEq : kLt) << machine.name() << " " << x << " " << y;
      const uint32_t expected = uint32_t{x < y} | uint32_t{x <= y} << 1 | uint32_t{x == y} << 2 |
                                uint32_t{x != y} << 3 | uint32_t{x >= y} << 4 | uint32_t{x > y} << 5;
      ASSERT_EQ(machine.word(7300), expected) << machine.name() << " " << x << " " << y;
    }
  }
}

// --- ROT
// --------------------------------------------------------------------------------------------------------------
constexpr uint32_t kToGo = 7010;

enum Input : uint32_t { kShorter = 1, kNegative = 2, kSteps = 4, kBefore = 8 };

struct Ring {
  int32_t start, end;
  int32_t next(int32_t place, bool down) const {
    if (down) return place == start ? end : place - 1;
    return place == end ? start : place + 1;
  }
  int32_t steps(int32_t from, int32_t to, bool down) const {
    int32_t count = 0;
    for (; from != to; from = next(from, down)) ++count;
    return count;
  }
};

struct Way {
  int32_t toGo;
  bool negative;
};

// Walks: on each step but the last the place is one "before the goal" more.
Way walk(const Ring& ring, int32_t from, int32_t goal, uint32_t inputs) {
  bool down = (inputs & kNegative) != 0;
  if ((inputs & kShorter) != 0) down = ring.steps(from, goal, true) < ring.steps(from, goal, false);
  int32_t count = 0, last = goal;
  for (int32_t place = from; place != goal; place = ring.next(place, down)) {
    ++count;
    last = place; // the one that was left last
  }
  const bool before = (inputs & kBefore) != 0 && count > 0;
  if ((inputs & kSteps) != 0) return {before ? count - 1 : count, down};
  return {before ? last : goal, down};
}

TEST(ArithmeticProperty, RotFindsTheWayThatWalkingFinds) {
  Machines machines("rung\n|--[7000.00]--{ROT 7010 7011 7012 7013 7014}--(7300.00)\n"
                    "|--[7000.01]--{BID                         }\n|--[7000.02]--{DIR                         }\n"
                    "|--[7000.03]--{INC                         }\n|--[7000.04]--{PRE                         }\n",
                    Machines::interpreterAndJit());
  for (Machine& machine : machines.all())
    for (const Ring ring : {Ring{1, 1}, Ring{0, 1}, Ring{1, 3}, Ring{0, 3}, Ring{5, 9}, Ring{1, 8}, Ring{1, 12}})
      for (int32_t from = ring.start; from <= ring.end; ++from)
        for (int32_t goal = ring.start; goal <= ring.end; ++goal)
          for (uint32_t inputs = 0; inputs < 16; ++inputs) {
            const int32_t values[] = {-1, from, goal, ring.start, ring.end};
            for (uint32_t i = 0; i < std::size(values); ++i)
              machine.setWord(kToGo + i, static_cast<uint32_t>(values[i]));
            for (uint32_t enable : {0u, 1u}) {
              machine.setWord(7000, inputs << 1 | enable);
              machine.run();
            }
            const Way way = walk(ring, from, goal, inputs);
            ASSERT_EQ(static_cast<int32_t>(machine.word(kToGo)), way.toGo)
                << machine.name() << " " << ring.start << ".." << ring.end << " from " << from << " to " << goal
                << " inputs " << inputs;
            ASSERT_EQ(machine.bit(7300, 0), way.negative);
          }
}

TEST(ArithmeticProperty, TheRingCounterGoesRoundTheRing) {
  Machines machines("rung\n|--[7000.00]--{CNTR 7010 7011 7012 7013}--(7300.00)\n"
                    "|--[7000.01]--{U/D                     }\n|--[7000.02]--{R                       }\n",
                    Machines::interpreterAndJit());
  std::mt19937 random(9);
  for (Machine& machine : machines.all())
    for (int32_t size = 1; size <= 6; ++size) {
      const Ring ring{3, 3 + size - 1};
      for (uint32_t i = 0; i < 3; ++i) machine.setWord(7011 + i, static_cast<uint32_t>(i == 0 ? ring.start : ring.end));
      int32_t place = ring.start;
      bool clock = true;
      machine.setWord(7000, 5);
      machine.run();
      for (int step = 0; step < 200; ++step) {
        const bool now = random() % 2 != 0, down = random() % 2 != 0, reset = random() % 16 == 0;
        machine.setWord(7000, uint32_t{now} | uint32_t{down} << 1 | uint32_t{reset} << 2);
        machine.run();
        if (reset)
          place = ring.start;
        else if (now && !clock)
          place = ring.next(place, down);
        clock = now;
        ASSERT_EQ(static_cast<int32_t>(machine.word(7010)), place) << machine.name() << " step " << step;
        ASSERT_EQ(machine.bit(7300, 0), place == ring.end);
      }
    }
}

// --- arrays
// -----------------------------------------------------------------------------------------------------------
constexpr uint32_t kArray = 7100;

std::vector<bool> moved(const std::vector<bool>& bits, size_t count, bool left, bool rotate) {
  std::vector<bool> out(bits.size());
  for (size_t i = 0; i < bits.size(); ++i) {
    if (!rotate && count >= bits.size()) continue;
    const size_t by = count % bits.size();
    const size_t to = left ? i + by : i + bits.size() - by;
    const bool wraps = left ? to >= bits.size() : to < bits.size();
    if (rotate || !wraps) out[to % bits.size()] = bits[i];
  }
  return out;
}

TEST(ArithmeticProperty, ArraysMoveAsOneRowOfBits) {
  constexpr const char* kNames[] = {"ASHL", "ASHR", "ARTL", "ARTR"};
  std::string text;
  for (int i = 0; i < 4; ++i)
    text += fmt::format("rung\n|--[7000.{:02}]--{{{} 7100,7001 7100,7002 7003}}--(7300.{:02})\n\n", i, kNames[i], i);
  Machines machines(text);
  std::mt19937 random(10);
  for (int round = 0; round < 120; ++round) {
    const uint32_t first = random() % 4, last = first + random() % 4, kind = random() % 4;
    const auto count = static_cast<uint32_t>(random() % 5 == 0 ? random() >> 1 : random() % 140);
    std::vector<uint32_t> words(10);
    for (uint32_t& word : words) word = static_cast<uint32_t>(random());
    std::vector<bool> bits;
    for (uint32_t i = first; i <= last; ++i)
      for (int bit = 0; bit < 32; ++bit) bits.push_back((words[i] >> bit & 1) != 0);
    const std::vector<bool> expected = moved(bits, count, kind % 2 == 0, kind >= 2);
    for (Machine& machine : machines.all()) {
      for (uint32_t i = 0; i < words.size(); ++i) machine.setWord(kArray + i, words[i]);
      machine.setWord(7001, first);
      machine.setWord(7002, last);
      machine.setWord(7003, count);
      machine.setWord(7000, 1u << kind);
      machine.run();
      ASSERT_EQ(machine.word(7300), 1u << kind);
      for (uint32_t i = 0; i < words.size(); ++i) {
        uint32_t word = words[i];
        if (i >= first && i <= last)
          for (uint32_t bit = 0; bit < 32; ++bit)
            word = (word & ~(1u << bit)) | uint32_t{expected[(i - first) * 32 + bit]} << bit;
        ASSERT_EQ(machine.word(kArray + i), word)
            << machine.name() << " " << kNames[kind] << " " << first << ".." << last << " by " << count;
      }
    }
  }
}

} // namespace
} // namespace rung::frontend::nct::test

// The generator (see gsk_workload.h). Every element is written twice, as commands and as C++.
#include "tools/bench/gsk_workload.h"

#include <fmt/format.h>
#include <iterator>
#include <random>

namespace rung::bench {
namespace {

constexpr uint32_t kInputBits = 1024; // X9-X72, F64-F127
constexpr uint32_t kFirstX = 9;
constexpr uint32_t kFirstF = 64;
constexpr uint32_t kRelays = 8 * 900;    // R0-R899: coils
constexpr uint32_t kDecoded = 8 * 100;   // R900-R999: results of DECB
constexpr uint32_t kWords = 900;         // D0-D1799, two bytes each
constexpr uint32_t kNumbers = 200;       // of TMRB and of DIFU
constexpr uint32_t kRungsAFunction = 60; // of the hand-written form; one for everything takes a compiler minutes
constexpr uint32_t kSubprogramSteps = 200;

std::string nameOf(uint32_t bit) {
  if (bit < kInputBits / 2) return fmt::format("X{}.{}", kFirstX + bit / 8, bit % 8);
  if (bit < kInputBits) return fmt::format("F{}.{}", kFirstF + (bit - kInputBits / 2) / 8, bit % 8);
  return fmt::format("R{}.{}", (bit - kInputBits) / 8, bit % 8);
}

class Generator {
public:
  Generator(uint32_t steps, uint64_t seed) : random_(seed), limit_(steps) {}

  Workload run() {
    unit("level1", limit_ / 10);
    emit("FUNC END1\n", 1);
    const uint32_t subprograms = limit_ / 5 / kSubprogramSteps;
    const uint32_t level2 = limit_ - steps_ - subprograms * (kSubprogramSteps + 8);
    openUnit("level2");
    for (uint32_t s = 0; s < subprograms; ++s) {
      while (used_ < (s + 1) * level2 / (subprograms + 1)) element();
      const uint32_t act = anyBit();
      emit(fmt::format("LD {}\nFUNC CALL\nPRM P{}\n", nameOf(act), s + 1), 3);
      hand(fmt::format("  if (m[{}]) sub{}(m);\n", act, s + 1));
    }
    while (used_ < level2) element();
    closeUnit();
    emit("FUNC END2\n", 1);
    for (uint32_t s = 0; s < subprograms; ++s) {
      emit(fmt::format("FUNC SP\nPRM P{}\n", s + 1), 2);
      unit(fmt::format("sub{}", s + 1), kSubprogramSteps);
      emit("FUNC SPE\n", 1);
    }
    return finish(subprograms);
  }

private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  uint32_t anyBit() {
    const uint32_t kind = below(16);
    if (kind < 4) return below(kInputBits);
    return kInputBits + (kind == 4 ? kRelays + below(kDecoded) : below(nextCoil_ + 1));
  }
  uint32_t newCoil() { return kInputBits + (nextCoil_++ % kRelays); }
  uint32_t anyWord() { return below(kWords); }
  std::string word(uint32_t w) const { return fmt::format("D{}", 2 * w); }
  // A signed word in the hand-written form.
  std::string value(uint32_t w) const { return fmt::format("w[{}]", w); }

  void emit(const std::string& text, uint32_t steps) {
    text_ += text;
    steps_ += steps;
    used_ += steps;
  }
  void hand(const std::string& text) {
    body_ += text;
    if (++inFunction_ < kRungsAFunction) return;
    cut();
  }
  void cut() {
    if (body_.empty()) return;
    functions_ += fmt::format("static void part{}(unsigned char *m) {{\n  short *w = words(m);\n  (void)w;\n{}}}\n",
                              parts_, body_);
    unitCalls_ += fmt::format("  part{}(m);\n", parts_++);
    body_.clear();
    inFunction_ = 0;
  }
  void openUnit(std::string name) {
    unit_ = std::move(name);
    used_ = 0;
  }
  void closeUnit() {
    cut();
    functions_ += fmt::format("static void {}(unsigned char *m) {{\n{}}}\n", unit_, unitCalls_);
    unitCalls_.clear();
  }
  void unit(std::string name, uint32_t steps) {
    openUnit(std::move(name));
    while (used_ < steps) element();
    closeUnit();
  }

  // The numbers make seven steps of ten bit logic: its rungs have about 6 steps, functions about 6.
  void element() {
    const uint32_t which = below(100);
    if (which < 70) return logic();
    if (which < 77) return arithmetic();
    if (which < 83) return coincidence();
    if (which < 88) return move();
    if (which < 93) return decode();
    if (which < 97) return edge();
    return timer();
  }

  std::string contact(const char* command, uint32_t bit, bool negated) {
    return fmt::format("{}{} {}\n", command, negated ? "I" : "", nameOf(bit));
  }

  void logic() {
    const uint32_t contacts = 2 + below(5);
    std::string text;
    std::string expression;
    for (uint32_t i = 0; i < contacts; ++i) {
      const uint32_t bit = anyBit();
      const bool negated = below(3) == 0;
      const bool parallel = below(3) == 0;
      const std::string term = fmt::format("{}m[{}]", negated ? "!" : "", bit);
      if (i == 0) {
        text += contact("LD", bit, negated);
        expression = term;
      } else {
        text += negated ? contact(parallel ? "OR" : "AN", bit, true) : contact(parallel ? "OR" : "AND", bit, false);
        expression = fmt::format("({} {} {})", expression, parallel ? "|" : "&", term);
      }
    }
    const uint32_t coil = newCoil();
    const uint32_t kind = below(10);
    text += fmt::format("{} {}\n", kind == 0 ? "SET" : kind == 1 ? "RST" : "OUT", nameOf(coil));
    emit(text, contacts + 1);
    if (kind == 0)
      hand(fmt::format("  m[{}] |= {};\n", coil, expression));
    else if (kind == 1)
      hand(fmt::format("  m[{}] &= !({});\n", coil, expression));
    else
      hand(fmt::format("  m[{}] = {};\n", coil, expression));
  }

  void arithmetic() {
    const uint32_t reset = anyBit(), act = anyBit(), a = anyWord(), b = anyWord(), to = anyWord(), coil = newCoil();
    const bool add = below(2) == 0;
    emit(fmt::format("LD {}\nLD {}\nFUNC {}\nPRM 1002\nPRM {}\nPRM {}\nPRM {}\nOUT {}\n", nameOf(reset), nameOf(act),
                     add ? "ADDB" : "SUBB", word(a), word(b), word(to), nameOf(coil)),
         8);
    const uint32_t state = states_++;
    hand(fmt::format(
        "  if (m[{}]) latch[{}] = 0;\n  else if (m[{}]) {{ const int r = {} {} {}; {} = (short)r; "
        "latch[{}] = r != (short)r; flags = (unsigned char)((r == 0) | (r < 0) << 1 | (r != (short)r) << 5); }}\n"
        "  m[{}] = latch[{}];\n",
        reset, state, act, value(a), add ? "+" : "-", value(b), value(to), state, coil, state));
  }

  void coincidence() {
    const uint32_t act = anyBit(), a = anyWord(), b = anyWord(), coil = newCoil(), state = states_++;
    emit(fmt::format("LD {}\nFUNC COIN\nPRM 1002\nPRM {}\nPRM {}\nOUT {}\n", nameOf(act), word(a), word(b),
                     nameOf(coil)),
         6);
    hand(fmt::format("  if (m[{}]) latch[{}] = {} == {};\n  m[{}] = latch[{}];\n", act, state, value(a), value(b), coil,
                     state));
  }

  void move() {
    const uint32_t act = anyBit(), a = anyWord(), b = anyWord();
    emit(fmt::format("LD {}\nFUNC MOVW\nPRM {}\nPRM {}\n", nameOf(act), word(a), word(b)), 4);
    hand(fmt::format("  if (m[{}]) {} = {};\n", act, value(b), value(a)));
  }

  void decode() {
    const uint32_t act = anyBit(), a = anyWord(), byte = nextDecoded_++ % (kDecoded / 8), first = below(40);
    emit(fmt::format("LD {}\nFUNC DECB\nPRM 2\nPRM {}\nPRM {}\nPRM R{}\n", nameOf(act), word(a), first,
                     kRelays / 8 + byte),
         6);
    hand(fmt::format("  for (int i = 0; i < 8; ++i) m[{} + i] = m[{}] & ({} == {} + i);\n",
                     kInputBits + kRelays + 8 * byte, act, value(a), first));
  }

  void edge() {
    if (edges_ == kNumbers) return logic();
    const uint32_t act = anyBit(), coil = newCoil(), state = states_++;
    emit(fmt::format("LD {}\nFUNC DIFU\nPRM {}\nOUT {}\n", nameOf(act), ++edges_, nameOf(coil)), 4);
    hand(fmt::format("  {{ const bool now = m[{}]; m[{}] = now & !latch[{}]; latch[{}] = now; }}\n", act, coil, state,
                     state));
  }

  void timer() {
    if (timers_ == kNumbers) return logic();
    const uint32_t act = anyBit(), coil = newCoil(), ms = 8 * (1 + below(30)), state = timers_;
    emit(fmt::format("LD {}\nFUNC TMRB\nPRM {}\nPRM {}\nOUT {}\n", nameOf(act), ++timers_, ms, nameOf(coil)), 5);
    hand(fmt::format("  if (m[{}]) timer[{}] = timer[{}] < 0 ? 0 : timer[{}] + 8000; else timer[{}] = -1;\n"
                     "  m[{}] = timer[{}] >= {};\n",
                     act, state, state, state, state, coil, state, ms * 1000));
  }

  Workload finish(uint32_t subprograms) {
    Workload work;
    work.file = "bench.pmc";
    work.text = std::move(text_);
    work.units = steps_;
    work.inputs = kInputBits;
    for (uint32_t bit = 0; bit < kInputBits + kRelays + kDecoded; ++bit) work.bits.push_back(nameOf(bit));
    for (uint32_t w = 0; w < kWords; ++w) work.words.push_back(word(w) + ":2");
    std::string& out = work.hand;
    out = fmt::format("static bool latch[{}];\nstatic long timer[{}];\nstatic unsigned char flags;\n"
                      "static inline short *words(unsigned char *m) {{ return (short *)(m + {}); }}\n",
                      states_ + 1, kNumbers, work.bits.size());
    out += "extern \"C\" __attribute__((visibility(\"default\"))) void start() {\n  for (long &t : timer) t = -1;\n}\n";
    for (uint32_t s = 0; s < subprograms; ++s) out += fmt::format("static void sub{}(unsigned char *m);\n", s + 1);
    out += functions_;
    out += "extern \"C\" __attribute__((visibility(\"default\"))) void scan(unsigned char *m) {\n  level1(m);\n  "
           "level2(m);\n}\n";
    return work;
  }

  std::mt19937_64 random_;
  uint32_t limit_;
  uint32_t steps_ = 0;
  uint32_t used_ = 0; // of the unit
  std::string text_;
  std::string unit_;
  std::string body_;
  std::string unitCalls_;
  std::string functions_;
  uint32_t inFunction_ = 0;
  uint32_t parts_ = 0;
  uint32_t nextCoil_ = 0;
  uint32_t nextDecoded_ = 0;
  uint32_t states_ = 0;
  uint32_t edges_ = 0;
  uint32_t timers_ = 0;
};

} // namespace

Workload gskWorkload(uint32_t steps, uint64_t seed) { return Generator(steps, seed).run(); }

} // namespace rung::bench

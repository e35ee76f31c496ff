// One statement per element (see straight.h, also for the meaning of FROZEN).
#include "tools/bench/generated/straight.h"

#include <algorithm>

#include "ir/support/check.h"
#include "ir/support/put.h"

namespace rung::bench {
namespace {

constexpr uint32_t kWordBits = 64;
constexpr size_t kElementsAFunction = 100; // a single function for everything takes compilers minutes

uint32_t alignedTo8(uint32_t bytes) { return (bytes + 7) / 8 * 8; }

class Writer {
public:
  explicit Writer(BitForm form) : packed_(form == BitForm::Packed) {}

  std::string bit(uint32_t number) const {
    if (!packed_) return fmt::format("m->bit[{}]", number);
    return fmt::format("bool(m->bit[{}] >> {} & 1)", number / kWordBits, number % kWordBits);
  }
  std::string contact(const Contact& c) const { return (c.negated ? "!" : "") + bit(c.bit); }
  std::string store(uint32_t number, const std::string& value) const {
    if (!packed_) return fmt::format("m->bit[{}] = {};", number, value);
    return fmt::format("m->bit[{0}] = (m->bit[{0}] & ~(1ull << {1})) | (unsigned long long)({2}) << {1};",
                       number / kWordBits, number % kWordBits, value);
  }
  std::string statement(const Element& e) const;

private:
  std::string calculate(const Element& e, const char* op) const {
    return fmt::format("if ({}) m->word[{}] = m->word[{}] {} m->word[{}];", contact(e.first), e.to, e.a, op, e.b);
  }
  std::string calculateReal(const Element& e, const char* op) const {
    return fmt::format("if ({}) m->real[{}] = m->real[{}] {} m->real[{}];", contact(e.first), e.to, e.a, op, e.b);
  }
  std::string timer(const Element& e) const {
    return fmt::format("{{ const bool in = {0}; const int t = m->timer[{1}]; {2} "
                       "m->timer[{1}] = in ? (t < {3} ? t + ms : t) : 0; }}",
                       contact(e.first), e.number, store(e.coil, fmt::format("in & (t >= {})", e.preset)), e.preset);
  }
  std::string counter(const Element& e) const {
    return fmt::format("{{ const bool in = {0}; int c = m->counter[{1}]; if (in & !m->clock[{1}]) c = c == {2} ? 0 : "
                       "c + 1; if ({3}) c = 0; m->clock[{1}] = in; m->counter[{1}] = c; {4} }}",
                       contact(e.first), e.number, e.preset, contact(e.second),
                       store(e.coil, fmt::format("c == {}", e.preset)));
  }
  std::string mechanism(const Element& e) const {
    return fmt::format("if ({0}) m->active[{1}] = true; if (m->active[{1}]) switch (m->state[{1}]) {{ case 0: {2} "
                       "if (!{3}) break; m->state[{1}] = 1; [[fallthrough]]; default: {4} if ({3}) break; "
                       "m->state[{1}] = 0; m->active[{1}] = false; }}",
                       contact(e.first), e.number, store(e.coil, "true"), contact(e.second), store(e.coil, "false"));
  }

  bool packed_;
};

std::string Writer::statement(const Element& e) const {
  switch (e.op) {
  case Op::Logic:
    return store(e.coil, fmt::format("({} {} {}) & {}", contact(e.first), e.parallel ? "|" : "&", contact(e.second),
                                     contact(e.third)));
  case Op::Timer: return timer(e);
  case Op::Counter: return counter(e);
  case Op::Add: return calculate(e, "+");
  case Op::Subtract: return calculate(e, "-");
  case Op::Multiply: return calculate(e, "*");
  case Op::Less:
    return store(e.coil, fmt::format("{} & (int(m->word[{}]) < int(m->word[{}]))", contact(e.first), e.a, e.b));
  case Op::RealAdd: return calculateReal(e, "+");
  case Op::RealSubtract: return calculateReal(e, "-");
  case Op::RealMultiply: return calculateReal(e, "*");
  case Op::TableRead:
    return fmt::format("if ({}) m->word[{}] = m->table[{}][m->word[{}]];", contact(e.first), e.to, e.b, e.a);
  case Op::TableWrite:
    return fmt::format("if ({}) m->table[{}][m->word[{}]] = m->word[{}];", contact(e.first), e.b, e.a, e.to);
  case Op::Mechanism: return mechanism(e);
  }
  RUNG_CHECK(false, "each operation has a statement");
  return {};
}

} // namespace

StraightLayout::StraightLayout(const Work& work, BitForm f) : form(f) {
  words = alignedTo8(f == BitForm::Packed ? (work.bits() + kWordBits - 1) / kWordBits * 8 : work.bits());
  tables = words + alignedTo8(4 * std::max(1u, work.words()));
  reals = tables + 4 * kTables * kEntries;
  const uint32_t own = reals + 8 * std::max(1u, work.reals());
  size = alignedTo8(own + 4 * std::max(1u, work.timers) + 5 * std::max(1u, work.counters) +
                    2 * std::max(1u, work.mechanisms));
}

std::string straightSource(const Work& work, BitForm form) {
  const StraightLayout layout(work, form);
  std::string out;
  if (form == BitForm::Packed)
    put(out, "struct Memory {{\n  alignas(8) unsigned long long bit[{}];\n", layout.words / 8);
  else
    put(out, "struct Memory {{\n  alignas(8) bool bit[{}];\n", layout.words);
  put(out,
      "  alignas(8) unsigned word[{}];\n  alignas(8) unsigned table[{}][{}];\n  double real[{}];\n  int timer[{}];\n"
      "  int counter[{}];\n  bool clock[{}];\n  bool active[{}];\n  unsigned char state[{}];\n}};\n"
      "static_assert(sizeof(Memory) == {});\n",
      std::max(1u, work.words()), kTables, kEntries, std::max(1u, work.reals()), std::max(1u, work.timers),
      std::max(1u, work.counters), std::max(1u, work.counters), std::max(1u, work.mechanisms),
      std::max(1u, work.mechanisms), layout.size);
  const Writer writer(form);
  size_t functions = 0;
  for (size_t first = 0; first < work.elements.size(); first += kElementsAFunction, ++functions) {
    put(out, "__attribute__((noinline)) static void part{}(Memory* m, [[maybe_unused]] int ms) {{\n", functions);
    for (size_t i = first; i < std::min(work.elements.size(), first + kElementsAFunction); ++i)
      put(out, "  {}\n", writer.statement(work.elements[i]));
    out += "}\n";
  }
  out += "extern \"C\" __attribute__((visibility(\"default\"))) void scan(Memory* m, int ms) {\n";
  for (size_t i = 0; i < functions; ++i) put(out, "  part{}(m, ms);\n", i);
  return out + "  (void)m, (void)ms;\n}\n";
}

} // namespace rung::bench

// One statement per element (see structured_text.h), each as a programmer would write it by hand.
#include "tools/bench/generated/structured_text.h"

#include <string_view>

#include "ir/support/check.h"
#include "ir/support/put.h"

namespace rung::bench {
namespace {

std::string bit(uint32_t number) { return fmt::format("b{}", number); }
std::string contact(const Contact& c) { return (c.negated ? "NOT " : "") + bit(c.bit); }

std::string calculate(const Element& e, char letter, const char* op) {
  return fmt::format("IF {0} THEN {1}{2} := {1}{3} {4} {1}{5}; END_IF;", contact(e.first), letter, e.to, e.a, op, e.b);
}

std::string timer(const Element& e) {
  return fmt::format("t{0}(IN := {1}, PT := T#{2}ms); {3} := t{0}.Q;", e.number, contact(e.first), e.preset,
                     bit(e.coil));
}

// Not a CTU, which would stay at its preset.
std::string counter(const Element& e) {
  return fmt::format("IF {0} AND NOT e{1} THEN IF c{1} = {2} THEN c{1} := 0; ELSE c{1} := c{1} + 1; END_IF; END_IF; "
                     "IF {3} THEN c{1} := 0; END_IF; e{1} := {0}; {4} := c{1} = {2};",
                     contact(e.first), e.number, e.preset, contact(e.second), bit(e.coil));
}

std::string statement(const Element& e) {
  switch (e.op) {
  case Op::Logic:
    return fmt::format("{} := ({} {} {}) AND {};", bit(e.coil), contact(e.first), e.parallel ? "OR" : "AND",
                       contact(e.second), contact(e.third));
  case Op::Timer: return timer(e);
  case Op::Counter: return counter(e);
  case Op::Add: return calculate(e, 'w', "+");
  case Op::Subtract: return calculate(e, 'w', "-");
  case Op::Multiply: return calculate(e, 'w', "*");
  case Op::Less:
    return fmt::format("{} := {} AND (UDINT_TO_DINT(w{}) < UDINT_TO_DINT(w{}));", bit(e.coil), contact(e.first), e.a,
                       e.b);
  case Op::RealAdd: return calculate(e, 'r', "+");
  case Op::RealSubtract: return calculate(e, 'r', "-");
  case Op::RealMultiply: return calculate(e, 'r', "*");
  case Op::TableRead: return fmt::format("IF {} THEN w{} := a{}[w{}]; END_IF;", contact(e.first), e.to, e.b, e.a);
  case Op::TableWrite: return fmt::format("IF {} THEN a{}[w{}] := w{}; END_IF;", contact(e.first), e.b, e.a, e.to);
  case Op::Mechanism: break;
  }
  RUNG_CHECK(false, "each operation has a statement, mechanisms are refused before");
  return {};
}

void declare(std::string& out, char letter, uint32_t count, std::string_view type) {
  for (uint32_t i = 0; i < count; ++i) put(out, "  {}{} : {};\n", letter, i, type);
}

} // namespace

Result<std::string> structuredText(const Work& work) {
  if (work.mechanisms != 0) return failure("Structured Text has no mechanisms");
  std::string out = "PROGRAM MAIN\nVAR\n";
  declare(out, 'b', work.bits(), "BOOL");
  declare(out, 'w', work.words(), "UDINT");
  declare(out, 'r', work.reals(), "LREAL");
  declare(out, 't', work.timers, "TON");
  declare(out, 'c', work.counters, "DINT");
  declare(out, 'e', work.counters, "BOOL");
  if (work.hasTables) declare(out, 'a', kTables, fmt::format("ARRAY [0..{}] OF UDINT", kEntries - 1));
  out += "END_VAR\n";
  for (const Element& element : work.elements) put(out, "{}\n", statement(element));
  return out + R"(END_PROGRAM

CONFIGURATION config
  RESOURCE resource1 ON PLC
    TASK task0(INTERVAL := T#10ms, PRIORITY := 0);
    PROGRAM instance0 WITH task0 : MAIN;
  END_RESOURCE
END_CONFIGURATION
)";
}

} // namespace rung::bench

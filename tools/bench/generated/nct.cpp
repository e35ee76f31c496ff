// The NCT form: ladder text (see form.h). Everything is in the volatile user memory, except NC signals.
#include <algorithm>

#include "ir/support/put.h"
#include "rtlib/nc/nct/signals.h"
#include "tools/bench/generated/form.h"

namespace rung::bench {
namespace {

constexpr uint32_t kBitsAWord = 32;
constexpr uint32_t kBits = 5100; // first word of the program's bits
constexpr uint32_t kWords = 6800;
constexpr uint32_t kCells = 7200; // first word of timers, counters, and reals, which take two words each
constexpr uint32_t kTableWords = 9700;
constexpr int kScanMs = 10;

std::string bitAt(uint32_t word, uint32_t bit) {
  return fmt::format("{:04}.{:02}", word + bit / kBitsAWord, bit % kBitsAWord);
}
std::string wordAt(uint32_t word) { return fmt::format("{:04}", word); }
std::string word(uint32_t number) { return wordAt(kWords + number); }
std::string table(uint32_t number, uint32_t entry) { return wordAt(kTableWords + number * kEntries + entry); }

// The places of a work's cells.
struct Cells {
  explicit Cells(const Work& work)
      : counters(kCells + work.timers), reals((counters + work.counters + 1) / 2 * 2), end(reals + 2 * work.reals()) {}
  std::string timer(uint32_t number) const { return wordAt(kCells + number); }
  std::string counter(uint32_t number) const { return wordAt(counters + number); }
  std::string real(uint32_t number) const { return wordAt(reals + 2 * number); }

  uint32_t counters, reals, end;
};

// Adds the bits of the interface with the given direction.
void addSignals(std::vector<std::string>& bits, nc::Direction direction, size_t most) {
  for (const nc::Signal& row : nc::nctSignals()) {
    if (row.type != nc::SignalType::Bit || row.direction != direction) continue;
    for (uint32_t i = 0; i < row.count && bits.size() < most; ++i)
      bits.push_back(bitAt(row.byteOffset / 4, row.bit + i * std::max(1u, 8 * row.strideBytes)));
  }
}

std::vector<std::string> bitsOf(const Work& work) {
  std::vector<std::string> bits;
  if (work.kind == Kind::Signals) addSignals(bits, nc::Direction::In, work.inputs);
  while (bits.size() < work.inputs) bits.push_back(bitAt(kBits, static_cast<uint32_t>(bits.size())));
  if (work.kind == Kind::Signals) addSignals(bits, nc::Direction::Out, work.bits());
  while (bits.size() < work.bits()) bits.push_back(bitAt(kBits, static_cast<uint32_t>(bits.size())));
  return bits;
}

class Writer {
public:
  Writer(const Program& program, const Cells& cells) : program_(program), cells_(cells) {}

  std::string rung(const Element& e) const {
    const std::string in = contact(e.first);
    switch (e.op) {
    case Op::Logic: return logic(e);
    case Op::Timer: return box(in, fmt::format("TOND {} #{} #0", cells_.timer(e.number), e.preset), e.coil);
    case Op::Counter: return counter(e);
    case Op::Add: return calculate(e, "ADD");
    case Op::Subtract: return calculate(e, "SUB");
    case Op::Multiply: return calculate(e, "MUL");
    case Op::Less: return box(in, fmt::format("CLT {} {}", word(e.a), word(e.b)), e.coil);
    case Op::RealAdd: return calculateReal(e, "+F");
    case Op::RealSubtract: return calculateReal(e, "-F");
    case Op::RealMultiply: return calculateReal(e, "*F");
    case Op::TableRead: return fmt::format("|--{}--{{MOV {} {},{}}}\n", in, word(e.to), table(e.b, 0), word(e.a));
    case Op::TableWrite: return fmt::format("|--{}--{{MOV {},{} {}}}\n", in, table(e.b, 0), word(e.a), word(e.to));
    case Op::Mechanism: break; // refused earlier
    }
    return {};
  }

private:
  std::string contact(const Contact& c) const {
    return fmt::format("[{}{}]", c.negated ? "/" : "", program_.bits[c.bit]);
  }
  std::string box(const std::string& in, const std::string& text, uint32_t coil) const {
    return fmt::format("|--{}--{{{}}}--({})\n", in, text, program_.bits[coil]);
  }
  std::string logic(const Element& e) const {
    const std::string a = contact(e.first), b = contact(e.second), c = contact(e.third);
    const std::string& coil = program_.bits[e.coil];
    if (!e.parallel) return fmt::format("|--{}--{}--{}--({})\n", a, b, c, coil);
    const size_t width = std::max(a.size(), b.size());
    return fmt::format("|--{:-<{}}--+--{}--({})\n|--{:-<{}}--+\n", a, width, c, coil, b, width);
  }
  std::string counter(const Element& e) const {
    const std::string in = contact(e.first);
    const std::string text = fmt::format("CNTR {0} #0 #{1} #{1}", cells_.counter(e.number), e.preset);
    return box(in, text, e.coil) + fmt::format("|--{:-<{}}--{{{:<{}}}}\n|--{}--{{{:<{}}}}\n", "[N_OFF]", in.size(),
                                               "U/D", text.size(), contact(e.second), "R", text.size());
  }
  std::string calculate(const Element& e, const char* op) const {
    return fmt::format("|--{}--{{{} {} {} {}}}\n", contact(e.first), op, word(e.to), word(e.a), word(e.b));
  }
  std::string calculateReal(const Element& e, const char* op) const {
    return fmt::format("|--{}--{{{} {} {} {}}}\n", contact(e.first), op, cells_.real(e.to), cells_.real(e.a),
                       cells_.real(e.b));
  }

  const Program& program_;
  const Cells& cells_;
};

class Nct final : public Form {
public:
  Result<Program> write(const Work& work) const override {
    if (work.mechanisms != 0) return failure("NCT has no mechanisms");
    const Cells cells(work);
    if (kBits + work.bits() / kBitsAWord >= kWords || cells.end > kTableWords)
      return failure("NCT has no room for so many");
    Program program = named();
    program.bits = bitsOf(work);
    for (uint32_t i = 0; i < work.words(); ++i) program.words.push_back(word(i));
    for (uint32_t i = 0; i < work.reals(); ++i) program.reals.push_back(cells.real(i));
    if (work.hasTables)
      for (uint32_t i = 0; i < kTables * kEntries; ++i) program.tables.push_back(table(0, i));
    const Writer writer(program, cells);
    for (const Element& element : work.elements) put(program.text, "\nrung\n{}", writer.rung(element));
    return program;
  }

  std::vector<Instruction> instructions() const override {
    return {{"contact, coil", "|--[{in}]--({out})\n"},
            {"two contacts in series, coil", "|--[{in}]--[{in}]--({out})\n"},
            {"contact, negated coil", "|--[{in}]--(/{out})\n"},
            {"contact, SET", "|--[{in}]--(S {out})\n"},
            {"contact of a rising edge, coil", "|--[@{in}]--({out})\n"},
            {"DIFU", "|--[{in}]--{DIFU {out}}\n"},
            {"TOND", "|--[{in}]--{TOND {state} #960000 #0}--({out})\n"},
            {"TOFFD", "|--[{in}]--{TOFFD {state} #960000 #0}--({out})\n"},
            {"TPULSE", "|--[{in}]--{TPULSE {state} #960000 #0}--({out})\n"},
            {"CNT", "|--[{in}]--{CNT {state} #0 #99 #99}--({out})\n|--[N_OFF]----{U/D                }\n"
                    "|--[N_OFF]----{R                  }\n"},
            {"CNTR", "|--[{in}]--{CNTR {state} #0 #99 #99}--({out})\n|--[N_OFF]----{U/D                 }\n"
                     "|--[N_OFF]----{R                   }\n"},
            {"MOV", "|--[{in}]--{MOV {to} {a}}\n"},
            {"MOV, indexed", "|--[{in}]--{MOV {to} 9700,{a}}\n"},
            {"MOVF", "|--[{in}]--{MOVF {z} {x}}\n"},
            {"AND", "|--[{in}]--{AND {to} {a} {b}}\n"},
            {"ADD", "|--[{in}]--{ADD {to} {a} {b}}\n"},
            {"SUB", "|--[{in}]--{SUB {to} {a} {b}}\n"},
            {"MUL", "|--[{in}]--{MUL {to} {a} {b}}\n"},
            {"DIV", "|--[{in}]--{DIV {to} {a} #7}\n"},
            {"CLT, coil", "|--[{in}]--{CLT {a} {b}}--({out})\n"},
            {"CEQ, coil", "|--[{in}]--{CEQ {a} {b}}--({out})\n"},
            {"ASHL, one word by 3", "|--[{in}]--{ASHL {to} {to} #3}\n"},
            {"BCD", "|--[{in}]--{BCD {to} {a}}\n"},
            {"+F", "|--[{in}]--{+F {z} {x} {y}}\n"},
            {"*F", "|--[{in}]--{*F {z} {x} {y}}\n"},
            {"/F", "|--[{in}]--{/F {z} {x} *7.0}\n"},
            {"SQRT", "|--[{in}]--{SQRT {z} {x}}\n"},
            {"SIN", "|--[{in}]--{SIN {z} {x}}\n"},
            {"FLLT, coil", "|--[{in}]--{FLLT {x} {y}}--({out})\n"},
            {"FLT", "|--[{in}]--{FLT {z} {a}}\n"},
            {"FIX", "|--[{in}]--{FIX {to} {x}}\n"}};
  }

  Program repeat(const std::string& text, uint32_t count) const override {
    Program program = named();
    for (uint32_t i = 0; i < count; ++i) program.bits.push_back(bitAt(kBits, i));
    Work cellsOf;
    cellsOf.timers = count;
    const Cells cells(cellsOf);
    for (uint32_t i = 0; i < count; ++i)
      program.text += "\nrung\n" + filled(text, {{"in", program.bits[conditionOf(i, count)]},
                                                 {"out", bitAt(kBits + kBitsAWord, i)},
                                                 {"a", word(3 * i % 300)},
                                                 {"b", word((3 * i + 1) % 300)},
                                                 {"to", word((3 * i + 2) % 300)},
                                                 {"x", cells.real(3 * i % 300)},
                                                 {"y", cells.real((3 * i + 1) % 300)},
                                                 {"z", cells.real((3 * i + 2) % 300)},
                                                 {"state", cells.timer(i)}});
    return program;
  }

private:
  static Program named() { return {.file = "generated.lad", .text = "dialect nct\nmodule MAIN\n", .msAScan = kScanMs}; }
};

} // namespace

std::unique_ptr<Form> nctForm() { return std::make_unique<Nct>(); }

} // namespace rung::bench

// The TECHNOL form: all of it in MODULE_MAIN (see form.h).
#include <algorithm>

#include "ir/support/put.h"
#include "rtlib/nc/technol/signals.h"
#include "tools/bench/generated/form.h"

namespace rung::bench {
namespace {

constexpr int kScanMs = 20;

std::string bit(uint32_t number) { return fmt::format("B_{}", number); }
std::string word(uint32_t number) { return fmt::format("W_{}", number); }
std::string real(uint32_t number) { return fmt::format("Q_{}", number); }

// The cells of the interface that only the control (or, for outputs, the program) writes.
std::vector<std::string> signals(nc::Direction direction) {
  std::vector<std::string> names;
  for (const nc::Signal& row : nc::technolSignals())
    if (std::string_view(row.area) == "I" && row.type == nc::SignalType::Bit && row.direction == direction &&
        row.count == 1)
      names.emplace_back(row.symbol);
  return names;
}

// By bit, whether a rung names it: a cell of the interface that no rung names is not in the program.
std::vector<bool> named(const Work& work) {
  std::vector<bool> out(work.bits(), false);
  for (const Element& element : work.elements) {
    for (const Contact& contact : {element.first, element.second, element.third}) out[contact.bit] = true;
    out[element.coil] = true;
  }
  return out;
}

std::vector<std::string> bitsOf(const Work& work) {
  const std::vector<bool> isNamed = named(work);
  const std::vector<std::string> ofControl = signals(nc::Direction::In);
  const std::vector<std::string> ofProgram = signals(nc::Direction::Out);
  size_t inputs = 0;
  size_t outputs = 0;
  std::vector<std::string> bits;
  for (uint32_t i = 0; i < work.bits(); ++i) {
    const bool isInput = i < work.inputs;
    const std::vector<std::string>& names = isInput ? ofControl : ofProgram;
    size_t& next = isInput ? inputs : outputs;
    const bool takes = work.kind == Kind::Signals && isNamed[i] && next < names.size();
    bits.push_back(takes ? names[next++] : bit(i));
  }
  return bits;
}

std::string declarationOf(const std::vector<std::string>& bits) {
  std::string text;
  uint32_t count = 0;
  for (const std::string& name : bits) {
    if (!name.starts_with("B_")) continue; // part of the interface
    put(text, "{}{}", count % 8 == 0 ? "\n        DFM  " : ",", name);
    ++count;
  }
  return text + "\n";
}

std::string cells(const char* prefix, uint32_t count, uint32_t bytes) {
  std::string text;
  for (uint32_t i = 0; i < count; ++i) put(text, "{}{}: DS {}\n", prefix, i, bytes);
  return text;
}

std::string programOf(const std::string& declarations, const std::string& main) {
  std::string text = "DATA\n" + declarations + "DATA_END\n";
  for (const char* module : {"INPUT", "BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT"})
    put(text, "MODULE_{0}\nMODULE_{0}_END\n", module);
  return text + "MODULE_MAIN\n" + main + "MODULE_MAIN_END\nSTOP\n";
}

class Writer {
public:
  explicit Writer(const Program& program) : program_(program) {}

  std::string statements(const Element& e) const {
    const std::string& in = program_.bits[e.first.bit];
    switch (e.op) {
    case Op::Logic:
      return fmt::format("        LDR  {}\n        {}   {}\n        LA   {}\n        WR   {}\n", contact(e.first),
                         e.parallel ? "LO" : "LA", contact(e.second), contact(e.third), coil(e));
    case Op::Timer:
      return fmt::format("        LDR  {}\n        LOD  {}\n        TM   T_{}\n        WR   {}\n", in,
                         e.preset / kScanMs, e.number, coil(e));
    case Op::Counter: return counter(e);
    case Op::Add: return calculate(e, "AD", "DWRD.W_");
    case Op::Subtract: return calculate(e, "SU", "DWRD.W_");
    case Op::Multiply: return calculate(e, "MULB", "DWRD.W_");
    case Op::Less:
      return fmt::format("        LOD  {}\n        LT   {}\n        LA   {}\n        WR   {}\n", word(e.a), word(e.b),
                         in, coil(e));
    case Op::RealAdd: return calculate(e, "AD", "REAL.Q_");
    case Op::RealSubtract: return calculate(e, "SU", "REAL.Q_");
    case Op::RealMultiply: return calculate(e, "MULB", "REAL.Q_");
    case Op::TableRead: return indexed(e) + fmt::format("        LOD  {}\n        STO1 {}\n", entry(e), word(e.to));
    case Op::TableWrite: return indexed(e) + fmt::format("        LOD  {}\n        STO1 {}\n", word(e.to), entry(e));
    case Op::Mechanism: return mechanism(e);
    }
    return {};
  }

private:
  std::string contact(const Contact& c) const { return (c.negated ? "-" : "") + program_.bits[c.bit]; }
  const std::string& coil(const Element& e) const { return program_.bits[e.coil]; }
  // CU has neither a limit nor a reset: both are written after it.
  std::string counter(const Element& e) const {
    return fmt::format(
        "        LDR  {0}\n        LOD  {1}\n        CU   C_{2}\n"
        "        LOD  C_{2}\n        GT   CNST.{1}\n        LO   {3}\n        LOD  0\n        STO1 C_{2}\n"
        "        LOD  C_{2}\n        EQ   CNST.{1}\n        WR   {4}\n",
        program_.bits[e.first.bit], e.preset, e.number, program_.bits[e.second.bit], coil(e));
  }
  std::string calculate(const Element& e, const char* op, const char* prefix) const {
    return fmt::format("        LDR  {0}\n        LOD  {2}{3}\n        {1:<4} {2}{4}\n        STO1 {2}{5}\n",
                       program_.bits[e.first.bit], op, prefix, e.a, e.b, e.to);
  }
  std::string indexed(const Element& e) const {
    return fmt::format("        LOD  {}\n        RL   2\n        MOV  BX,CX\n        LDR  {}\n", word(e.a),
                       program_.bits[e.first.bit]);
  }
  std::string entry(const Element& e) const { return fmt::format("DWRD.(TAB[BX]+{})", 4 * kEntries * e.b); }
  std::string mechanism(const Element& e) const {
    return fmt::format("        LDR  {0}\n        FL1  1,M_{1}\n        MECH_BEGIN M_{1}\n        FL   1,{2}\n"
                       "        LDR  {3}\n        EX0\n        FL   0,{2}\n        LDR  {3}\n        EX1\n"
                       "        MECH_END M_{1}\n",
                       program_.bits[e.first.bit], e.number, coil(e), program_.bits[e.second.bit]);
  }

  const Program& program_;
};

class Technol final : public Form {
public:
  Result<Program> write(const Work& work) const override {
    Program program = named();
    program.bits = bitsOf(work);
    for (uint32_t i = 0; i < work.words(); ++i) program.words.push_back(word(i));
    for (uint32_t i = 0; i < work.reals(); ++i) program.reals.push_back(real(i));
    if (work.hasTables)
      for (uint32_t i = 0; i < kTables * kEntries; ++i) program.tables.push_back(fmt::format("DWRD.TAB+{}", 4 * i));
    std::string declarations = declarationOf(program.bits) + cells("W_", work.words(), 4) +
                               cells("Q_", work.reals(), 8) + cells("T_", work.timers, 2) +
                               cells("C_", work.counters, 2);
    if (work.hasTables) put(declarations, "TAB: DS {}\n", 4 * kTables * kEntries);
    std::string main;
    const Writer writer(program);
    for (const Element& element : work.elements) main += writer.statements(element);
    program.text = programOf(declarations, main);
    return program;
  }

  std::vector<Instruction> instructions() const override {
    return {{"LDR, WR", "LDR {in}\nWR {out}\n"},
            {"LDR, LA, WR", "LDR {in}\nLA {in}\nWR {out}\n"},
            {"FL", "FL 1,{out}\n"},
            {"LDR, FL1", "LDR {in}\nFL1 1,{out}\n"},
            {"MOVR", "MOVR {out},{in}\n"},
            {"EDGE_H, WR", "EDGE_H {in}\nWR {out}\n"},
            {"TM, WR", "LDR {in}\nLOD 48000\nTM {state}\nWR {out}\n"},
            {"CU, WR", "LDR {in}\nLOD 99\nCU {state}\nWR {out}\n"},
            {"LOD, STO", "LOD {a}\nSTO {to}\n"},
            {"MOVE", "MOVE {to},{a}\n"},
            {"LDR, MOVE1", "LDR {in}\nMOVE1 {to},{a}\n"},
            {"LOD, STO, indexed", "LOD {a}\nMOV BX,CX\nLOD DWRD.TAB[BX]\nSTO {to}\n"},
            {"LOD, AD, STO", "LOD {a}\nAD {b}\nSTO {to}\n"},
            {"LOD, SU, STO", "LOD {a}\nSU {b}\nSTO {to}\n"},
            {"LOD, MULB, STO", "LOD {a}\nMULB {b}\nSTO {to}\n"},
            {"LOD, DIVB, STO", "LOD {a}\nDIVB CNST.7\nSTO {to}\n"},
            {"LOD, ANDB, STO", "LOD {a}\nANDB {b}\nSTO {to}\n"},
            {"LOD, INR, STO", "LOD {a}\nINR\nSTO {to}\n"},
            {"LOD, RL, STO", "LOD {a}\nRL 3\nSTO {to}\n"},
            {"LOD, BCD, STO", "LOD {a}\nBCD\nSTO {to}\n"},
            {"LOD, EQ, WR", "LOD {a}\nEQ {b}\nWR {out}\n"},
            {"LOD, LT, WR", "LOD {a}\nLT {b}\nWR {out}\n"},
            {"real LOD, STO", "LOD REAL.{x}\nSTO REAL.{z}\n"},
            {"real LOD, AD, STO", "LOD REAL.{x}\nAD REAL.{y}\nSTO REAL.{z}\n"},
            {"real LOD, MULB, STO", "LOD REAL.{x}\nMULB REAL.{y}\nSTO REAL.{z}\n"},
            {"real LOD, LT, WR", "LOD REAL.{x}\nLT REAL.{y}\nWR {out}\n"},
            {"MV, 16 bytes", "MV TAB,TAB+128,16\n"},
            {"mechanism of one EX", "LDR {in}\nFL1 1,M_{n}\nMECH_BEGIN M_{n}\nEX\nMECH_END M_{n}\n"}};
  }

  Program repeat(const std::string& text, uint32_t count) const override {
    Program program = named();
    for (uint32_t i = 0; i < count; ++i) program.bits.push_back(bit(i));
    std::vector<std::string> declared = program.bits;
    std::string main;
    for (uint32_t i = 0; i < count; ++i) {
      declared.push_back(bit(count + i));
      main += filled(text, {{"in", program.bits[conditionOf(i, count)]},
                            {"out", bit(count + i)},
                            {"a", word(3 * i)},
                            {"b", word(3 * i + 1)},
                            {"to", word(3 * i + 2)},
                            {"x", real(3 * i)},
                            {"y", real(3 * i + 1)},
                            {"z", real(3 * i + 2)},
                            {"state", fmt::format("T_{}", i)},
                            {"n", std::to_string(i + 1)}});
    }
    const uint32_t used = std::max(1u, count);
    program.text = programOf(declarationOf(declared) + cells("W_", 3 * used, 4) + cells("Q_", 3 * used, 8) +
                                 cells("T_", used, 2) + "TAB: DS 256\n",
                             main);
    return program;
  }

private:
  static Program named() { return {.file = "generated.plc", .text = {}, .msAScan = kScanMs}; }
};

} // namespace

std::unique_ptr<Form> technolForm() { return std::make_unique<Technol>(); }

} // namespace rung::bench

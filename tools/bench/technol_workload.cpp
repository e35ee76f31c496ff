// The generators (see technol_workload.h). Every element is written twice, as TECHNOL and as C++.
#include "tools/bench/technol_workload.h"

#include <fmt/format.h>
#include <random>

namespace rung::bench {
namespace {

constexpr uint32_t kContacts = 512;
constexpr uint32_t kWords = 500;
constexpr uint32_t kElementsAFunction = 60; // of the hand-written form; one for everything takes a compiler minutes

std::string bitName(uint32_t bit) { return fmt::format("B{}", bit); }

std::string bitDeclarations(const std::string& prefix, uint32_t count) {
  std::string text;
  for (uint32_t i = 0; i < count; ++i)
    text += fmt::format("{}{}{}{}", i % 8 == 0 ? "        DFM  " : "", prefix, i,
                        i % 8 == 7 || i + 1 == count ? "\n" : ",");
  return text;
}

std::string program(const std::string& data, const std::string& main) {
  std::string text = "DATA\n" + data + "DATA_END\n";
  for (const char* module : {"INPUT", "BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT"})
    text += fmt::format("MODULE_{0}\nMODULE_{0}_END\n", module);
  return text + "MODULE_MAIN\n" + main + "MODULE_MAIN_END\nSTOP\n";
}

std::string mechanism(uint32_t number, const std::string& output, const std::string& contact) {
  return fmt::format("        MECH_BEGIN M{0}\n        FL   1,{1}\n        LDR  {2}\n        EX0\n        FL   0,{1}\n"
                     "        LDR  {2}\n        EX1\n        MECH_END M{0}\n",
                     number, output, contact);
}

// `m` has the bits, `a` the activation bits, `s` the states.
std::string mechanismByHand(uint32_t number, uint32_t output, const std::string& contact) {
  return fmt::format(
      "  if (a[{0}])\n    switch (s[{0}]) {{\n    case 0: m[{1}] = 1; if (!{2}) break; s[{0}] = 1; [[fallthrough]];\n"
      "    default: m[{1}] = 0; if ({2}) break; s[{0}] = 0; a[{0}] = 0;\n    }}\n",
      number, output, contact);
}

// Cuts the hand-written form into functions of a size that compilers like.
class HandWritten {
public:
  void add(const std::string& text) {
    body_ += text;
    if (++elements_ == kElementsAFunction) cut();
  }
  std::string finish(uint32_t mechanisms, uint32_t bits, const std::string& start) {
    cut();
    return fmt::format("static unsigned char a[{0}], s[{0}], r[{0}];\n"
                       "static short *words(unsigned char *m) {{ return reinterpret_cast<short *>(m + {1}); }}\n{2}"
                       "extern \"C\" __attribute__((visibility(\"default\"))) void start() {{\n  for (unsigned i = 0; "
                       "i < {0}; ++i) {{ s[i] = r[i] = 0; {3} }}\n}}\n"
                       "extern \"C\" __attribute__((visibility(\"default\"))) void scan(unsigned char *m) {{\n{4}}}\n",
                       std::max(1u, mechanisms), bits, functions_, start, calls_);
  }

private:
  void cut() {
    if (body_.empty()) return;
    functions_ += fmt::format("static void part{}(unsigned char *m) {{\n  short *w = words(m);\n  (void)w;\n{}}}\n",
                              parts_, body_);
    calls_ += fmt::format("  part{}(m);\n", parts_++);
    body_.clear();
    elements_ = 0;
  }

  std::string body_, functions_, calls_;
  uint32_t elements_ = 0, parts_ = 0;
};

class Generator {
public:
  Generator(uint32_t lines, uint64_t seed) : random_(seed), limit_(lines) {}

  Workload run() {
    while (lines_ < limit_) element();
    Workload work;
    work.file = "generated.plc";
    const uint32_t bits = kContacts + coils_;
    std::string data = bitDeclarations("B", bits);
    for (uint32_t i = 0; i < kWords; ++i) data += fmt::format("W{}:     DS 2\n", i);
    work.text = program(data, text_);
    work.units = lines_;
    work.inputs = kContacts;
    for (uint32_t i = 0; i < bits; ++i) work.bits.push_back(bitName(i));
    for (uint32_t i = 0; i < kWords; ++i) work.words.push_back(fmt::format("W{}", i));
    work.hand = hand_.finish(mechanisms_, bits, "a[i] = 0;");
    return work;
  }

private:
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }
  uint32_t anyBit() { return below(kContacts + coils_); }
  uint32_t newCoil() { return kContacts + coils_++; }
  void emit(const std::string& text, uint32_t lines) {
    text_ += text;
    lines_ += lines;
  }

  void element() {
    const uint32_t which = below(100);
    if (which < 60) return equation();
    if (which < 80) return arithmetic();
    if (which < 95) return comparison();
    mechanismAndStart();
  }
  void equation() {
    const uint32_t a = anyBit(), b = anyBit(), c = anyBit(), coil = newCoil();
    emit(fmt::format("        LDR  {}\n        LA   -{}\n        LO   {}\n        WR   {}\n", bitName(a), bitName(b),
                     bitName(c), bitName(coil)),
         4);
    hand_.add(fmt::format("  m[{}] = (m[{}] & !m[{}]) | m[{}];\n", coil, a, b, c));
  }
  void arithmetic() {
    const uint32_t a = below(kWords), b = below(kWords), to = below(kWords);
    emit(fmt::format("        LOD  W{}\n        AD   W{}\n        STO  W{}\n", a, b, to), 3);
    hand_.add(fmt::format("  w[{}] = short(w[{}] + w[{}]);\n", to, a, b));
  }
  void comparison() {
    const uint32_t a = below(kWords), b = below(kWords), coil = newCoil();
    emit(fmt::format("        LOD  W{}\n        LT   W{}\n        WR   {}\n", a, b, bitName(coil)), 3);
    hand_.add(fmt::format("  m[{}] = w[{}] < w[{}];\n", coil, a, b));
  }
  void mechanismAndStart() {
    const uint32_t begins = anyBit(), contact = below(kContacts), output = newCoil(), number = mechanisms_++;
    emit(fmt::format("        LDR  {}\n        FL1  1,M{}\n", bitName(begins), number) +
             mechanism(number, bitName(output), bitName(contact)),
         10);
    hand_.add(fmt::format("  if (m[{}]) a[{}] = 1;\n", begins, number) +
              mechanismByHand(number, output, fmt::format("m[{}]", contact)));
  }

  std::mt19937_64 random_;
  uint32_t limit_, lines_ = 0, coils_ = 1, mechanisms_ = 0;
  std::string text_;
  HandWritten hand_;
};

} // namespace

Workload mechanismsWorkload(uint32_t mechanisms, bool waiting) {
  Workload work;
  work.file = "generated.plc";
  HandWritten hand;
  std::string main = "        LDR  B0\n        WR   B1\n"; // the one input that changes
  hand.add("  m[1] = m[0];\n");
  for (uint32_t i = 0; i < mechanisms; ++i) {
    main += mechanism(i, bitName(i + 2), fmt::format("R{}", i));
    hand.add(mechanismByHand(i, i + 2, fmt::format("r[{}]", i)));
    if (waiting) work.ones.push_back(fmt::format("M{}", i));
  }
  work.text = program(bitDeclarations("B", mechanisms + 2) + bitDeclarations("R", mechanisms), main);
  work.units = mechanisms;
  work.inputs = 1;
  for (uint32_t i = 0; i < mechanisms + 2; ++i) work.bits.push_back(bitName(i));
  work.hand = hand.finish(mechanisms, mechanisms + 2, waiting ? "a[i] = 1;" : "a[i] = 0;");
  return work;
}

Workload technolWorkload(uint32_t lines, uint64_t seed) { return Generator(lines, seed).run(); }

} // namespace rung::bench

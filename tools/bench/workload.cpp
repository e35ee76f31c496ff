// The bit logic (see workload.h).
#include "tools/bench/workload.h"

#include <algorithm>
#include <fmt/format.h>
#include <random>

#include "ir/support/put.h"

namespace rung::bench {
namespace {

constexpr uint32_t kInputs = 1024;
constexpr uint32_t kFirstWord = 5100; // in the volatile user memory
constexpr uint32_t kBitsAWord = 32;
// Functions of the hand-written form; one function for everything takes a compiler minutes.
constexpr size_t kRungsAFunction = 100;

struct Contact {
  uint32_t bit = 0; // inputs, then coils
  bool negated = false;
};

struct WorkRung {
  Contact first;
  Contact second;
  bool parallel = false; // first OR second, else first AND second
  Contact third;         // AND
};

std::string address(uint32_t bit) {
  return fmt::format("{:04}.{:02}", kFirstWord + bit / kBitsAWord, bit % kBitsAWord);
}
std::string contact(const Contact& c) { return fmt::format("[{}{}]", c.negated ? "/" : "", address(c.bit)); }
std::string term(const Contact& c) { return fmt::format("{}m[{}]", c.negated ? "!" : "", c.bit); }

// Rung i drives coil i.
std::vector<WorkRung> drawRungs(uint32_t count, uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto draw = [&] { return Contact{static_cast<uint32_t>(random() % (kInputs + count)), random() % 3 == 0}; };
  std::vector<WorkRung> rungs(count);
  for (WorkRung& rung : rungs) {
    rung.first = draw();
    rung.second = draw();
    rung.parallel = random() % 2 == 0;
    rung.third = draw();
  }
  return rungs;
}

std::string ladderText(const std::vector<WorkRung>& rungs) {
  std::string out = "dialect nct\nmodule MAIN\n";
  for (uint32_t i = 0; i < rungs.size(); ++i) {
    const WorkRung& r = rungs[i];
    const std::string a = contact(r.first);
    const std::string b = contact(r.second);
    out += "\nrung\n";
    if (!r.parallel) {
      put(out, "|--{}--{}--{}--({})\n", a, b, contact(r.third), address(kInputs + i));
      continue;
    }
    const size_t width = std::max(a.size(), b.size());
    put(out, "|--{:-<{}}--+--{}--({})\n|--{:-<{}}--+\n", a, width, contact(r.third), address(kInputs + i), b, width);
  }
  return out;
}

std::string handWritten(const std::vector<WorkRung>& rungs) {
  std::string out;
  size_t functions = 0;
  for (size_t first = 0; first < rungs.size(); first += kRungsAFunction, ++functions) {
    put(out, "static void part{}(unsigned char *m) {{\n", functions);
    for (size_t i = first; i < std::min(rungs.size(), first + kRungsAFunction); ++i)
      put(out, "  m[{}] = ({} {} {}) & {};\n", kInputs + i, term(rungs[i].first), rungs[i].parallel ? "|" : "&",
          term(rungs[i].second), term(rungs[i].third));
    out += "}\n";
  }
  out += "extern \"C\" __attribute__((visibility(\"default\"))) void scan(unsigned char *m) {\n";
  for (size_t i = 0; i < functions; ++i) put(out, "  part{}(m);\n", i);
  return out + "}\n";
}

} // namespace

Workload bitsWorkload(uint32_t rungs, uint64_t seed) {
  const std::vector<WorkRung> drawn = drawRungs(rungs, seed);
  Workload work{.file = "bench.lad",
                .text = ladderText(drawn),
                .units = rungs,
                .inputs = kInputs,
                .bits = {},
                .words = {},
                .hand = handWritten(drawn)};
  for (uint32_t bit = 0; bit < kInputs + rungs; ++bit) work.bits.push_back(address(bit));
  return work;
}

} // namespace rung::bench

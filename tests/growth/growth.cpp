// Work whose instructions growth_test.py counts: growth SIZE. Each case has inputs of SIZE, twice and four times as
// many parts of one kind.
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <utility>

#include "codegen/jit/jit_engine.h"
#include "compiler/compile.h"
#include "ir/analysis/uses.h"
#include "ir/core/builder.h"
#include "ir/support/source.h"
#include "ir/text/text.h"
#include "ir/transforms/pipeline.h"
#include "tests/unit/ladder/ladder_testing.h"

namespace {

using namespace rung;
using namespace rung::ir;

// ---- ladder text ----

void parseRungs(uint32_t n) {
  std::string text = "dialect t\nmodule M\n";
  for (uint32_t i = 0; i < n; ++i) text += "rung \"r\"\n|--[A]--+--[/B]--(X)\n|--[C]--+\n\n";
  const frontend::ladder::Parsed parsed(std::move(text));
}

void parseErrors(uint32_t n) {
  std::string text = "dialect t\nmodule M\n";
  for (uint32_t i = 0; i < n; ++i) text += "rung\n|--[A\n";
  const frontend::ladder::Parsed parsed(std::move(text));
}

void parseLine(uint32_t n) {
  std::string drawing = "|--";
  for (uint32_t i = 0; i < n; ++i) drawing += "[A]--";
  const frontend::ladder::Parsed parsed = frontend::ladder::parseDrawing(drawing + "(X)\n");
}

void parseBoxesBelowEachOther(uint32_t n) {
  std::string line = "|--[A]";
  for (uint32_t i = 0; i < n; ++i) line += "--{XX }";
  const frontend::ladder::Parsed parsed = frontend::ladder::parseDrawing(line + "\n|---[A]" + line.substr(6) + "\n");
}

// ---- modules ----

Module emptyModule(uint32_t rungs, uint32_t slots) {
  Module module;
  module.name = "large";
  module.files = {"a"};
  module.spaces = {{.name = "M", .unitBytes = 4, .units = 10000}};
  for (uint32_t i = 0; i < slots; ++i)
    module.slots.push_back({.type = Type::I32, .transient = true, .key = fmt::format("r{}", i)});
  module.routines.resize(1);
  module.routines[0].rungs.resize(rungs);
  module.tasks.push_back({.name = "T", .entry = RoutineId{0}});
  return module;
}

void optimise(Module& module) { runPasses(module, {.optimise = true, .instrument = true, .verifyEach = false}); }

// Twenty registers that every rung stores and loads, and a jump.
Module manyRungs(uint32_t n) {
  constexpr uint32_t kRegisters = 20;
  Module module = emptyModule(n, kRegisters);
  for (uint32_t i = 0; i < n; ++i) {
    RungBuilder b(module, module.routines[0].rungs[i]);
    const ValueId x = b.load(Type::Bit, {SpaceId{0}, i % 40000, i % 8});
    const ValueId y = b.and_(b.load(Type::Bit, {SpaceId{0}, i % 40000, i % 8}), x);
    const ValueId old = b.slotLoad(SlotId{i % kRegisters});
    for (uint32_t k = 0; k < 3; ++k) b.slotStore(SlotId{(i + k) % kRegisters}, b.add(old, b.i32(k)));
    b.store({SpaceId{0}, (i + 7) % 40000, i % 8}, b.or_(y, b.not_(x)));
    if (i + 50 < n) b.gotoRung(i + 50, x);
  }
  return module;
}

void optimiseRungs(uint32_t n) {
  Module module = manyRungs(n);
  optimise(module);
}

// One rung, with regions in regions around it.
void optimiseLargeRung(uint32_t n) {
  Module module = emptyModule(2, 1);
  RungBuilder b(module, module.routines[0].rungs[0]);
  const ValueId cond = b.load(Type::Bit, {SpaceId{0}, 0, 0});
  const uint32_t depth = n / 40;
  for (uint32_t i = 0; i < depth; ++i) {
    if (i % 2 == 0)
      b.if_(cond);
    else
      b.loop(1);
  }
  for (uint32_t i = 0; i < n; ++i) {
    const Place place{SpaceId{0}, 4 * (i % 5000), 0};
    b.store(place, b.add(b.load(Type::I32, place), b.loadAt(Type::I32, {SpaceId{0}, 0, 100}, b.i32(i % 7))));
  }
  for (uint32_t i = depth; i-- > 0;) {
    if (i % 2 == 0)
      b.endIf();
    else
      b.endLoop();
  }
  optimise(module);
}

// As many registers as rungs, each stored in the first rung and loaded in the last: all live everywhere. Twice as many
// as the size says, as a few cost next to nothing.
void optimiseRegisters(uint32_t n) {
  n *= 2;
  Module module = emptyModule(n, n);
  {
    RungBuilder b(module, module.routines[0].rungs[0]);
    const ValueId zero = b.i32(0);
    for (uint32_t i = 0; i < n; ++i) b.slotStore(SlotId{i}, zero);
  }
  RungBuilder b(module, module.routines[0].rungs[n - 1]);
  for (uint32_t i = 0; i < n; ++i) b.store({SpaceId{0}, 0, 0}, b.slotLoad(SlotId{i}));
  optimise(module);
}

// One rung that uses as many places, several times.
void usesOfARung(uint32_t n) {
  Module module = emptyModule(1, 0);
  RungBuilder b(module, module.routines[0].rungs[0]);
  for (uint32_t i = 0; i < 8 * n; ++i)
    b.store({SpaceId{0}, i % 5000 + 8, 0}, b.load(Type::Bit, {SpaceId{0}, i / 8, i % 8}));
  if (Uses(module).of(0).size() < size_t{8} * n) std::abort();
}

void linesOfPositions(uint32_t n) {
  constexpr uint32_t kLines = 8; // as many times
  const std::string line = "LD X0.0 ; a comment\n";
  std::string text;
  for (uint32_t i = 0; i < kLines * n; ++i) text += line;
  SourceManager sources;
  const FileId file = sources.addBuffer("a.pmc", std::move(text));
  uint64_t sum = 0;
  for (uint32_t i = 0; i < kLines * n; ++i) sum += sources.lineCol(sources.position(file, i * line.size())).line;
  if (sum != uint64_t{kLines} * n * (uint64_t{kLines} * n + 1) / 2) std::abort();
}

void printAndParse(uint32_t n) {
  Module module = manyRungs(n);
  for (uint32_t i = 0; i < n; ++i)
    module.symbols.push_back({.name = "S" + std::to_string(i), .space = SpaceId{0}, .byte = i % 40000});
  if (!parse(print(module)).module) std::abort();
}

// ---- programs: all that is done before the first scan, and machine code -----

void compileProgram(const std::string& file, std::string text) {
  SourceManager sources;
  const std::vector<FileId> files{sources.addBuffer(file, std::move(text))};
  Diagnostics diagnostics;
  const std::optional<compiler::Compiled> compiled = compiler::compile(sources, files, {}, diagnostics);
  if (!compiled || !codegen::compileJit(*compiled->layout, compiled->codeHash, {}).ok()) std::abort();
}

constexpr uint32_t kRungsTakeLong = 4; // as many times as a contact, which the others count

// Bit i of an NCT's registers for the program's own use.
std::string nctBit(uint32_t i) { return fmt::format("{}.{:02}", 7000 + i / 32, i % 32); }
std::string gskBit(uint32_t i) { return fmt::format("R{}.{}", i / 8 % 900, i % 8); }

void nctRungs(uint32_t n) {
  n /= kRungsTakeLong;
  std::string text = "dialect nct\nmodule MAIN\n";
  for (uint32_t i = 0; i < n; ++i)
    text += fmt::format("\nrung\n|--[{}]--+--[/{}]--({})\n|--[{}]--+\n", nctBit(i * 7 % n), nctBit(i * 3 % n),
                        nctBit(i), nctBit(i * 5 % n));
  compileProgram("a.lad", std::move(text));
}

void nctContacts(uint32_t n) {
  std::string text = "dialect nct\nmodule MAIN\n\nrung\n|--";
  for (uint32_t i = 0; i < n; ++i) text += fmt::format("[{}]--", nctBit(i));
  compileProgram("a.lad", text + "(7900.00)\n");
}

void gskRungs(uint32_t n) {
  n /= kRungsTakeLong;
  std::string text = "dialect gsk\nFUNC END1\n";
  for (uint32_t i = 0; i < n; ++i)
    text += fmt::format("LD {}\nOR {}\nANI {}\nOUT {}\n", gskBit(i * 7), gskBit(i * 3), gskBit(i * 5), gskBit(i));
  compileProgram("a.pmc", text + "FUNC END2\n");
}

void gskContacts(uint32_t n) {
  std::string text = "dialect gsk\nFUNC END1\nLD X10.0\n";
  for (uint32_t i = 0; i < n; ++i) text += fmt::format("AND {}\n", gskBit(i));
  compileProgram("a.pmc", text + "OUT Y10.0\nFUNC END2\n");
}

// Bits 0 to 7 of each of `bytes` bytes, and the modules around MAIN.
std::string technolProgram(uint32_t bytes, const std::string& main) {
  std::string text = "DATA\n";
  for (uint32_t i = 0; i < bytes; ++i)
    text += fmt::format("        DFM B{0}_0,B{0}_1,B{0}_2,B{0}_3,B{0}_4,B{0}_5,B{0}_6,B{0}_7\n", i);
  text += "DATA_END\nMODULE_INPUT\nMODULE_INPUT_END\nMODULE_MAIN\n" + main + "MODULE_MAIN_END\n";
  for (const char* name : {"BLOCK_INIT", "BLOCK_DONE", "INIT", "CLEAR", "HALT"})
    text += fmt::format("MODULE_{0}\nMODULE_{0}_END\n", name);
  return text + "STOP\n";
}

void technolRungs(uint32_t n) {
  n = 2 * n / kRungsTakeLong; // fewer fit into one code unit, whose fixed cost would be a step
  constexpr uint32_t kBytes = 400;
  const auto bit = [](uint32_t i) { return fmt::format("B{}_{}", i / 8 % kBytes, i % 8); };
  std::string text;
  for (uint32_t i = 0; i < n; ++i)
    text += fmt::format("        LDR {}\n        LO {}\n        LA -{}\n        WR {}\n", bit(i * 7), bit(i * 3),
                        bit(i * 5), bit(i));
  compileProgram("a.plc", technolProgram(kBytes, text));
}

void technolContacts(uint32_t n) {
  std::string text = "        LDR B0_0\n";
  for (uint32_t i = 1; i < n; ++i) text += fmt::format("        LA B{}_{}\n", i / 8, i % 8);
  compileProgram("a.plc", technolProgram((n + 7) / 8, text + "        WR B0_0\n"));
}

// What the test must notice.
void quadratic(uint32_t n) {
  volatile uint32_t steps = 0;
  for (uint32_t i = 0; i < 100 * n; ++i)
    for (uint32_t k = 0; k < n; ++k) steps = steps + 1;
}

using Work = void (*)(uint32_t);
constexpr std::pair<std::string_view, Work> kCases[] = {
    {"parse-rungs", parseRungs},
    {"parse-errors", parseErrors},
    {"parse-line", parseLine},
    {"parse-boxes", parseBoxesBelowEachOther},
    {"optimise-rungs", optimiseRungs},
    {"optimise-large-rung", optimiseLargeRung},
    {"optimise-registers", optimiseRegisters},
    {"uses-of-a-rung", usesOfARung},
    {"lines-of-positions", linesOfPositions},
    {"print-and-parse", printAndParse},
    {"nct-rungs", nctRungs},
    {"nct-contacts", nctContacts},
    {"gsk-rungs", gskRungs},
    {"gsk-contacts", gskContacts},
    {"technol-rungs", technolRungs},
    {"technol-contacts", technolContacts},
    {"quadratic", quadratic},
};

} // namespace

// Callgrind counts within it and writes a file at each return.
extern "C" [[gnu::noinline]] void measured(Work work, uint32_t n) { work(n); }

// All in one process, as valgrind needs most of its time to read the code of LLVM, which it does once.
int main(int argc, char** argv) {
  const uint32_t size = argc == 2 ? static_cast<uint32_t>(std::atoi(argv[1])) : 0;
  if (size == 0) return 2;
  for (const auto& [name, work] : kCases) {
    work(size); // what is made once is there
    for (const uint32_t n : {size, 2 * size, 4 * size}) {
      std::printf("%s %u\n", std::string(name).c_str(), n);
      measured(work, n);
    }
  }
  return 0;
}

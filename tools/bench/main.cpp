// rung-bench: measures every engine on generated programs and prints docs/performance.md. Each case runs in a separate
// process, so that its resident memory is its own; figures are medians, and ratios are measured within one process.
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "codegen/process/process.h"
#include "ir/support/temporary_folder.h"
#include "machine/command-line/usage.h"
#include "tools/bench/measure.h"

namespace {

using rung::bench::Case;
using rung::bench::Measured;

struct Row {
  std::string title;
  Case which;
};

constexpr const char* kStraightCompiler = "clang++-19";

int measureOne(const Case& which) {
  if (!std::filesystem::exists(which.straight)) {
    const rung::Result<void> built = rung::bench::buildStraight(which, kStraightCompiler, which.straight);
    if (!built.ok()) {
      fmt::print(stderr, "rung-bench: {}\n", built.error());
      return 1;
    }
  }
  const rung::Result<Measured> m = rung::bench::measure(which);
  if (!m.ok()) {
    fmt::print(stderr, "rung-bench: {}\n", m.error());
    return 1;
  }
  const Measured& v = m.value();
  std::cout << nlohmann::json{{"front", v.frontMs},   {"back", v.backMs},    {"code", v.codeKb},
                              {"memory", v.memoryKb}, {"scan", v.nsPerScan}, {"straight", v.straightNsPerScan},
                              {"ratio", v.ratio},     {"rss", v.residentMb}}
            << '\n';
  return 0;
}

// Runs this program for one case; nothing if it failed.
std::optional<nlohmann::json> runCase(const Case& which) {
  const rung::TemporaryFolder folder;
  if (!folder.ok()) return std::nullopt;
  std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                    "--engine",
                                    which.engine,
                                    "--compiler",
                                    which.compiler,
                                    "--dialect",
                                    which.dialect,
                                    "--kind",
                                    which.kind,
                                    "--size",
                                    std::to_string(which.size),
                                    "--straight",
                                    which.straight};
  if (!which.optimise) words.emplace_back("--fast");
  const rung::Result<int> code = rung::codegen::runProgram(words, {.out = (folder / "figures").string(), .error = {}});
  if (!code.ok()) fmt::print(stderr, "rung-bench: {}\n", code.error());
  if (!code.ok() || code.value() != 0) return std::nullopt;
  const std::string text = folder.contentsOf("figures").value_or("");
  return nlohmann::json::parse(text, nullptr, false);
}

std::vector<Row> rowsFor(const Case& program) {
  const auto row = [&](const char* title, const char* engine, const char* compiler, bool optimise) {
    Row made{title, program};
    made.which.engine = engine;
    made.which.compiler = compiler;
    made.which.optimise = optimise;
    return made;
  };
  return {row("interpreter", "interp", "", true),
          row("generated C++, g++ -O2", "cpp", "g++", true),
          row("generated C++, clang++ -O2", "cpp", "clang++-19", true),
          row("LLVM object, linked and loaded", "llvm", "", true),
          row("JIT, fast compilation", "jit", "", false),
          row("JIT", "jit", "", true)};
}

int printTable(Case program, const std::string& title, const rung::TemporaryFolder& folder) {
  program.straight = (folder / fmt::format("{}-{}.so", program.kind, program.size)).string();
  fmt::print(
      "## {}\n\n| engine | ns per scan | ns per rung | ratio to straight-line C++ | times as fast as the interpreter | "
      "source to layout, ms | layout to first scan, ms | resident, MB | code, kB |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      title);
  int status = 0;
  double interpreter = 0;
  double memory = 0;
  for (const Row& row : rowsFor(program)) {
    const auto m = runCase(row.which);
    if (!m || m->is_discarded()) {
      fmt::print("| {} | failed | | | | | | | |\n", row.title);
      status = 1;
      continue;
    }
    const double scan = (*m)["scan"];
    const double code = (*m)["code"];
    if (row.which.engine == "interp") interpreter = scan;
    memory = (*m)["memory"];
    fmt::print("| {} | {:.0f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {} |\n", row.title, scan,
               scan / program.size, (*m)["ratio"].get<double>(), interpreter / scan, (*m)["front"].get<double>(),
               (*m)["back"].get<double>(), (*m)["rss"].get<double>(), code == 0 ? "–" : fmt::format("{:.0f}", code));
    std::fflush(stdout);
  }
  fmt::print("\nThe memory block of an instance takes {:.1f} kB.\n\n", memory);
  return status;
}

struct Table {
  const char* dialect;
  const char* kind;
  uint32_t size;
  const char* title;
};
constexpr Table kTables[] = {{"nct", "bits", 10000, "NCT: 10,000 rungs of bit logic"},
                             {"nct", "full", 1000, "NCT: full, 1,000 rungs"},
                             {"gsk", "full", 1000, "GSK: full, 1,000 rungs"},
                             {"technol", "full", 1000, "TECHNOL: full, 1,000 rungs"},
                             {"technol", "mechanisms-waiting", 200, "TECHNOL: 200 mechanisms, all waiting"}};

int printDocument() {
  const rung::TemporaryFolder folder;
  if (!folder.ok()) return 3;
  fmt::print("{}", R"(# Performance

This page says how fast programs run that Rung has compiled, how long compiling takes, and how that
compares with hand-written C++ and with other systems. It is for those who want to know whether a
program keeps its period, and for developers of Rung.

Written by `./dev bench`; do not edit. All programs are generated from a seed
(tools/bench/generated): one description becomes a program in each dialect, and the same as
straight-line C++. All read the same inputs, and their results are compared before anything is
measured. Ratios in the first tables are to C++ with one byte per bit, compiled by clang++ at -O3:
medians of pairs that run hot and in turn in one process. Absolute times depend on the machine. A
scan is that of the host's runner, without a control, with its copies of the NC area. Resident
memory is the peak of the process, compiler included. Code is the memory that a loaded shared object
takes, or the size of the JIT's object files. "Full" is bit logic with one timer, one counter and
two integer operations for every ten rungs of it; figures per rung count its bit logic alone.

Two engines are far above 1: the interpreter, which defines the results and is not meant to be fast,
and fast compilation, in which LLVM selects instructions quickly, without passes, and keeps every
value of a rung in memory. It is for trying a change at once.

)");
  int status = 0;
  for (const Table& table : kTables)
    status |= printTable({.dialect = table.dialect, .kind = table.kind, .size = table.size}, table.title, folder);
  return status;
}

} // namespace

int main(int argc, char** argv) {
  namespace cli = rung::cli;
  cli::CommandLine app(
      {.name = "rung-bench",
       .description = "Measures the engines and prints docs/performance.md; with --engine one case, as JSON",
       .exitStatus = "0 ok, 1 a case cannot be measured, 2 wrong usage, 3 environment",
       .guide = "docs/performance.md",
       .seeAlso = {}});
  Case which;
  bool fast = false;
  cli::Command options = app.root();
  cli::Option engine = options.option("--engine", which.engine, "interp, cpp, llvm or jit");
  options.option("--compiler", which.compiler, "C++ compiler of engine cpp");
  options.option("--dialect", which.dialect, "nct, gsk or technol");
  options.option("--kind", which.kind, "Kind of program, as rung-bench-generated names it");
  options.option("--size", which.size, "How many rungs");
  engine.needs(options.option("--straight", which.straight,
                              "Shared object with the straight-line form; made there when there is none"));
  options.flag("--fast", fast, "Compile fast");
  const std::optional<int> decided = app.run(argc, argv, [](const cli::WrongWords& words) {
    std::cerr << "rung-bench: " << words.text << '\n';
    return cli::kUsage;
  });
  if (decided) return *decided;
  which.optimise = !fast;
  return which.engine.empty() ? printDocument() : measureOne(which);
}

// rung-bench: measures every engine on generated programs and prints docs/performance.md. Each case runs in a process
// of its own, so that its resident memory is its own; figures are medians, and ratios are taken in one process.
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
#include "tools/bench/measure.h"
#include "tools/command-line/usage.h"

namespace {

using rung::bench::Case;
using rung::bench::Measured;

struct Row {
  std::string title;
  Case which;
};

constexpr const char* kHandCompiler = "clang++-19";

int measureOne(const Case& which) {
  if (!std::filesystem::exists(which.handWritten)) {
    const rung::Result<void> built = rung::bench::buildHandWritten(which, kHandCompiler, which.handWritten);
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
                              {"memory", v.memoryKb}, {"scan", v.nsPerScan}, {"hand", v.handNsPerScan},
                              {"ratio", v.ratio},     {"rss", v.residentMb}}
            << '\n';
  return 0;
}

// Runs this program for one case; nothing when it failed.
std::optional<nlohmann::json> runCase(const Case& which) {
  const rung::TemporaryFolder folder;
  if (!folder.ok()) return std::nullopt;
  std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                    "--engine",
                                    which.engine,
                                    "--compiler",
                                    which.compiler,
                                    "--program",
                                    which.program,
                                    "--units",
                                    std::to_string(which.units),
                                    "--hand",
                                    which.handWritten};
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

std::string_view unitOf(std::string_view program) {
  if (program == "gsk") return "step";
  if (program == "technol") return "line";
  return program == "bits" ? "rung" : "mechanism";
}

int printTable(Case program, const std::string& title, const rung::TemporaryFolder& folder) {
  program.handWritten = (folder / fmt::format("hand-{}{}.so", program.program, program.units)).string();
  fmt::print(
      "## {}\n\n| engine | ns a scan | ns a {} | ratio to hand-written | faster than the interpreter | source to "
      "layout, ms | layout to first scan, ms | resident, MB | code, kB |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      title, unitOf(program.program));
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
               scan / program.units, (*m)["ratio"].get<double>(), interpreter / scan, (*m)["front"].get<double>(),
               (*m)["back"].get<double>(), (*m)["rss"].get<double>(), code == 0 ? "–" : fmt::format("{:.0f}", code));
    std::fflush(stdout);
  }
  fmt::print("\nAn instance's memory block has {:.1f} kB.\n\n", memory);
  return status;
}

int printDocument() {
  const rung::TemporaryFolder folder;
  if (!folder.ok()) return 3;
  fmt::print("{}", R"(# Performance

Made by `./dev bench`; do not edit. Programs are generated from a seed (tools/bench). The first two are bit logic: three contacts and
a coil a rung, the contacts drawn at random among 1,024 inputs and all coils. The third is a GSK program at the limit of the control, 12,000
steps: seven tenths bit logic, the rest timers, edges, arithmetic, comparisons, transfers and decoding, a tenth of it in Level 1, a fifth in
subprograms. Of TECHNOL there are mechanisms of two states, each with its output and its contact, all idle or all waiting in the first state,
and a program of equations, arithmetic, comparisons and some mechanisms. "Hand-written" is the same logic as straight C++ over an array of `bool` and one of words, compiled by clang++ at -O3; both forms are
run side by side from the same inputs and compared before they are measured. Ratios are medians of pairs measured in turn in one process;
absolute times depend on the machine. A scan is one run of the main task through the host's runner, with its copies of the NC area; of GSK Level
1 and Level 2 with the input latch, of TECHNOL MODULE_INPUT and MODULE_MAIN. Resident memory is the most that the process ever had, compiler included. Code is what a shared object
takes when it is loaded, and the object files of the JIT.

Above 1.5 are the interpreter, which is the definition and not meant to be fast, fast compilation (LLVM's quick instruction selection
without passes keeps every value of a rung in memory; it is for trying a change at once), and TECHNOL mechanisms that do nothing else. A
resting mechanism is a test and a store of its line, which is 0 while it rests whoever cleared its bit; a waiting one stores its line and
counts its weight for the watchdog on top of what the hand-written form does. The runner's part of so short a scan shows too: about 50 ns, and
some ns for each of the chunks.

)");
  int status = 0;
  for (uint32_t rungs : {1000u, 10000u})
    status |= printTable(
        {.engine = "", .compiler = "", .program = "bits", .units = rungs, .optimise = true, .handWritten = ""},
        fmt::format("{} rungs of bit logic", rungs), folder);
  status |=
      printTable({.engine = "", .compiler = "", .program = "gsk", .units = 12000, .optimise = true, .handWritten = ""},
                 "A GSK program of 12000 steps", folder);
  const auto technol = [&](const char* program, uint32_t units, const char* title) {
    status |= printTable(
        {.engine = "", .compiler = "", .program = program, .units = units, .optimise = true, .handWritten = ""}, title,
        folder);
  };
  technol("idle", 200, "200 TECHNOL mechanisms, all idle");
  technol("waiting", 200, "200 TECHNOL mechanisms, all waiting");
  technol("technol", 10000, "A TECHNOL program of 10000 lines");
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
  bool source = false;
  cli::Command options = app.root();
  cli::Option engine = options.option("--engine", which.engine, "interp, cpp, llvm or jit");
  options.option("--compiler", which.compiler, "C++ compiler of engine cpp");
  options.option("--program", which.program, "What to run").oneOf({"bits", "gsk", "technol", "idle", "waiting"});
  options.option("--units", which.units, "Rungs of bits, steps of gsk, lines of technol, mechanisms");
  options.flag("--source", source, "Print the generated program");
  engine.needs(options.option("--hand", which.handWritten,
                              "Shared object with the hand-written form; made there when there is none"));
  options.flag("--fast", fast, "Compile fast");
  const std::optional<int> decided = app.run(argc, argv, [](const cli::WrongWords& words) {
    std::cerr << "rung-bench: " << words.text << '\n';
    return cli::kUsage;
  });
  if (decided) return *decided;
  which.optimise = !fast;
  if (source) {
    std::cout << rung::bench::sourceOf(which);
    return 0;
  }
  return which.engine.empty() ? printDocument() : measureOne(which);
}

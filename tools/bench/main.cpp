// rung-bench: measures every engine on generated programs and prints docs/performance.md. Each case runs in a process
// of its own, so that its resident memory is its own; figures are medians, and ratios are taken in one process.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ir/support/temporary_folder.h"
#include "tools/bench/measure.h"

namespace {

using rung::bench::Case;
using rung::bench::Measured;

struct Row {
  std::string title;
  Case which;
};

int measureOne(const Case& which) {
  const rung::Result<Measured> m = rung::bench::measure(which);
  if (!m.ok()) {
    fmt::print(stderr, "rung-bench: {}\n", m.error());
    return 1;
  }
  const Measured& v = m.value();
  std::cout << nlohmann::json{{"first", v.firstScanMs},
                              {"scan", v.nsPerScan},
                              {"hand", v.handNsPerScan},
                              {"ratio", v.ratio},
                              {"rss", v.residentMb}}
            << '\n';
  return 0;
}

// Runs this program for one case; nothing when it failed.
std::optional<nlohmann::json> runCase(const Case& which) {
  const std::string command =
      fmt::format("'{}' --engine {} --compiler '{}' --rungs {} --hand '{}' {}",
                  std::filesystem::read_symlink("/proc/self/exe").string(), which.engine, which.compiler, which.rungs,
                  which.handWritten, which.optimise ? "" : "--fast");
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> buffer;
  while (const size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  if (pclose(pipe) != 0) return std::nullopt;
  return nlohmann::json::parse(text, nullptr, false);
}

std::vector<Row> rowsFor(uint32_t rungs, const std::string& hand) {
  return {
      {"interpreter", {"interp", "", rungs, true, hand}},
      {"generated C++, g++ -O2", {"cpp", "g++", rungs, true, hand}},
      {"generated C++, clang++ -O2", {"cpp", "clang++-19", rungs, true, hand}},
      {"LLVM object, linked and loaded", {"llvm", "", rungs, true, hand}},
      {"JIT, fast compilation", {"jit", "", rungs, false, hand}},
      {"JIT", {"jit", "", rungs, true, hand}},
  };
}

int printTable(uint32_t rungs, const std::string& handCompiler, const rung::TemporaryFolder& folder) {
  const std::string hand = (folder / fmt::format("hand{}.so", rungs)).string();
  const rung::Result<void> built = rung::bench::buildHandWritten(rungs, handCompiler, hand);
  if (!built.ok()) {
    fmt::print(stderr, "rung-bench: {}\n", built.error());
    return 1;
  }
  fmt::print("## {} rungs\n\n| engine | ns a scan | ns a rung | ratio to hand-written | source to first scan, ms | "
             "resident, MB |\n| --- | --- | --- | --- | --- | --- |\n",
             rungs);
  int status = 0;
  for (const Row& row : rowsFor(rungs, hand)) {
    const auto m = runCase(row.which);
    if (!m || m->is_discarded()) {
      fmt::print("| {} | failed | | | | |\n", row.title);
      status = 1;
      continue;
    }
    const double scan = (*m)["scan"];
    fmt::print("| {} | {:.0f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} |\n", row.title, scan, scan / rungs,
               (*m)["ratio"].get<double>(), (*m)["first"].get<double>(), (*m)["rss"].get<double>());
    std::fflush(stdout);
  }
  fmt::print("\n");
  return status;
}

int printDocument() {
  const rung::TemporaryFolder folder;
  if (!folder.ok()) return 3;
  fmt::print("{}", R"(# Performance

Made by `./dev bench`; do not edit. The program is generated: bit logic, three contacts and a coil a rung, the contacts drawn at random
among 1,024 inputs and all coils (tools/bench/workload.h). "Hand-written" is the same logic as straight C++ over an array of `bool`, compiled by
clang++ at -O3. Ratios are medians of pairs measured in turn in one process; absolute times depend on the machine. A scan is one run of the
main task through the host's runner, with its copies of the NC area. Resident memory is the most that the process ever
had, compiler included.

Above 1.5 are the interpreter, which is the definition and not meant to be fast, and fast compilation: LLVM's quick instruction selection
without passes keeps every value of a rung in memory; it is for trying a change at once.

)");
  int status = 0;
  for (uint32_t rungs : {1000u, 10000u}) status |= printTable(rungs, "clang++-19", folder);
  return status;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures the engines and prints docs/performance.md; with --engine one case, as JSON"};
  Case which;
  bool fast = false;
  app.add_option("--engine", which.engine, "interp, cpp, llvm or jit");
  app.add_option("--compiler", which.compiler, "C++ compiler of engine cpp");
  app.add_option("--rungs", which.rungs, "Rungs of the generated program");
  app.add_option("--hand", which.handWritten, "Shared object with the hand-written form");
  app.add_flag("--fast", fast, "Compile fast");
  CLI11_PARSE(app, argc, argv);
  which.optimise = !fast;
  return which.engine.empty() ? printDocument() : measureOne(which);
}

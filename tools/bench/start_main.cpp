// rung-bench-start FILE...: starts a program, or the project of a rung.toml, as `rungc run` does, and prints its costs
// as JSON: milliseconds of CPU time in each stage; of CPU and of real time from there until all code is optimised; the
// peak memory of the process, in MB; rungs, and the bytes of the memory block. CPU time is that of all threads. The
// first stage is the start of the process itself.
#include <chrono>
#include <ctime>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "compiler/engines.h"
#include "compiler/tiered.h"
#include "ir/support/diag_render.h"
#include "rtlib/run/instance.h"
#include "tools/bench/request.h"

namespace {

using namespace rung;

double cpuMs() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
}

double residentMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// CPU time by stage; repeated stages are added up.
class Stages {
public:
  void ended(std::string_view stage) {
    const double now = cpuMs();
    ms_[std::string(stage)] += now - last_;
    last_ = now;
  }
  const std::map<std::string, double>& ms() const { return ms_; }

private:
  double last_ = 0;
  std::map<std::string, double> ms_;
};

size_t rungsOf(const ir::Module& module) {
  size_t rungs = 0;
  for (const ir::Routine& routine : module.routines) rungs += routine.rungs.size();
  return rungs;
}

nlohmann::json start(const std::vector<std::string>& paths) {
  const auto begun = std::chrono::steady_clock::now();
  Stages stages;
  stages.ended("process");
  SourceManager sources;
  std::vector<FileId> files;
  compiler::CompileRequest asked = bench::requestOf(sources, paths, files);
  asked.ended = [&](std::string_view stage) { stages.ended(stage); };
  Diagnostics diagnostics;
  const auto compiled = compiler::compile(sources, files, asked, diagnostics);
  if (!compiled) throw std::runtime_error(renderText(diagnostics, sources));
  const auto engine = bench::good(
      compiler::TieredEngine::make(*compiled, compiler::jitOptionsOf({}), ir::Counting::Ticks, compiler::Pace::Any));
  runtime::Instance instance(*engine);
  instance.scan();
  stages.ended("engine and scan");
  const double first = cpuMs();
  if (const std::string wrong = engine->finish(); !wrong.empty()) throw std::runtime_error(wrong);
  const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - begun;
  return {{"stages", stages.ms()},
          {"first", first},
          {"optimised", cpuMs()},
          {"real", all.count()},
          {"resident", residentMb()},
          {"rungs", rungsOf(*compiled->module)},
          {"block", engine->program().memory_size}};
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::cerr << "usage: rung-bench-start FILE...|rung.toml\n";
    return 2;
  }
  std::cout << start({argv + 1, argv + argc}) << '\n';
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-start: " << problem.what() << '\n';
  return 1;
}

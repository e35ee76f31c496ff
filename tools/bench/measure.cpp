// One measurement (see measure.h).
#include "tools/bench/measure.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <sys/resource.h>
#include <vector>

#include "codegen/cpp/cpp_emitter.h"
#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "rtlib/load/file.h"
#include "tools/bench/generated/side.h"

namespace rung::bench {
namespace {

constexpr int kSamples = 41;
constexpr int kSettleScans = 20;
constexpr double kSampleNs = 2e6; // a sample repeats its scan for about this time

using Clock = std::chrono::steady_clock;

double nsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

template <class Scan>
double sample(int repeats, Scan scan) {
  const auto start = Clock::now();
  for (int i = 0; i < repeats; ++i) scan();
  return nsSince(start) / repeats;
}

template <class Scan>
int repeatsFor(Scan scan) {
  return std::max(1, static_cast<int>(kSampleNs / std::max(1.0, sample(3, scan))));
}

double residentMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Result<Work> workOf(const Case& which) {
  const std::optional<Kind> kind = kindFromName(which.kind);
  if (!kind) return failure(fmt::format("unknown kind of program '{}'", which.kind));
  return drawWork(*kind, which.size);
}

Result<Program> programOf(const Case& which, const Work& work) {
  const std::unique_ptr<Form> form = formOf(which.dialect);
  if (!form) return failure(fmt::format("unknown dialect '{}'", which.dialect));
  return form->write(work);
}

// Runs both sides from the same state through the same scans; they must stay equal, or the comparison would be
// meaningless.
Result<void> settle(Side& ours, Side& straight, const Work& work, const Program& program) {
  Machine machine(work);
  ours.begin(machine);
  straight.begin(machine);
  for (int i = 0; i < kSettleScans; ++i) {
    const Change change = machine.next();
    for (Side* side : {&ours, &straight}) {
      side->apply(change);
      side->scan();
    }
  }
  const std::string wrong = difference(ours.values(), straight.values(), program);
  if (!wrong.empty()) return failure(wrong);
  return {};
}

// Size of the file of a shared object, or of the cache files of the JIT for the same program.
Result<double> codeKb(compiler::EngineKind kind, const compiler::Compiled& compiled, compiler::EngineOptions options,
                      const rung_program& program) {
  if (kind == compiler::EngineKind::Interp) return 0.0;
  uintmax_t bytes = 0;
  if (kind == compiler::EngineKind::Jit) {
    const TemporaryFolder folder;
    options.cacheFolder = (folder / "cache").string();
    const auto engine = compiler::makeEngine(kind, compiled, options);
    if (!engine.ok()) return engine.failure();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(options.cacheFolder))
      if (entry.is_regular_file()) bytes += entry.file_size();
    return static_cast<double>(bytes) / 1024.0;
  }
  // The file is deleted once it is loaded; its mapped size is the same, rounded to pages.
  std::map<std::string, uintmax_t> mapped; // by file
  std::string file;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const size_t path = line.find('/');
    if (path == std::string::npos) continue;
    const uintmax_t begin = std::stoull(line, nullptr, 16);
    const uintmax_t end = std::stoull(line.substr(line.find('-') + 1), nullptr, 16);
    const auto address = reinterpret_cast<uintptr_t>(&program);
    if (begin <= address && address < end) file = line.substr(path);
    mapped[line.substr(path)] += end - begin;
  }
  if (file.empty()) return failure("the program lies in no file");
  return static_cast<double>(mapped[file]) / 1024.0;
}

} // namespace

Result<void> buildStraight(const Case& which, const std::string& compiler, const std::string& path) {
  const Result<Work> work = workOf(which);
  if (!work.ok()) return work.failure();
  codegen::CppBuildOptions options;
  options.compiler = compiler;
  options.optimisation = "-O3";
  options.debugInfo = false;
  const Result<std::string> image = codegen::buildCppSharedObject(straightSource(work.value(), BitForm::Byte), options);
  if (!image.ok()) return image.failure();
  if (std::string wrong = runtime::replaceFile(path, image.value()); !wrong.empty()) return failure(std::move(wrong));
  return {};
}

Result<Measured> measure(const Case& which) {
  const auto kind = compiler::engineFromName(which.engine);
  if (!kind) return failure(fmt::format("unknown engine '{}'", which.engine));
  const Result<Work> work = workOf(which);
  if (!work.ok()) return work.failure();
  const Result<Program> program = programOf(which, work.value());
  if (!program.ok()) return program.failure();

  Measured out;
  auto start = Clock::now();
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer(program.value().file, program.value().text);
  compiler::CompileRequest request;
  request.optimise = which.optimise;
  const auto compiled = compiler::compile(sources, {&file, 1}, request, diagnostics);
  if (!compiled) return failure("the generated program has errors:\n" + renderText(diagnostics, sources));
  out.frontMs = nsSince(start) / 1e6;
  start = Clock::now();
  compiler::EngineOptions engineOptions;
  engineOptions.optimise = which.optimise;
  engineOptions.cppCompiler = which.compiler;
  Result<std::unique_ptr<runtime::Engine>> engine = compiler::makeEngine(*kind, *compiled, engineOptions);
  if (!engine.ok()) return engine.failure();
  runtime::Instance(*engine.value()).scan();
  out.backMs = nsSince(start) / 1e6;
  out.residentMb = residentMb();

  const Result<std::unique_ptr<Ours>> ours = Ours::make(*engine.value(), program.value());
  if (!ours.ok()) return ours.failure();
  const rung_program& image = ours.value()->instance().program();
  out.memoryKb = image.memory_size / 1024.0;
  const Result<std::unique_ptr<Straight>> straight =
      Straight::load(which.straight, work.value(), BitForm::Byte, program.value().msAScan);
  if (!straight.ok()) return straight.failure();
  const Result<void> equal = settle(*ours.value(), *straight.value(), work.value(), program.value());
  if (!equal.ok()) return equal.failure();
  const auto runOurs = [&] { ours.value()->scan(); };
  const auto runStraight = [&] { straight.value()->scan(); };
  const int ourRepeats = repeatsFor(runOurs);
  const int straightRepeats = repeatsFor(runStraight);
  std::vector<double> ourNs;
  std::vector<double> straightNs;
  std::vector<double> ratios;
  for (int i = 0; i < kSamples; ++i) {
    ourNs.push_back(sample(ourRepeats, runOurs));
    straightNs.push_back(sample(straightRepeats, runStraight));
    ratios.push_back(ourNs.back() / straightNs.back());
  }
  out.nsPerScan = median(ourNs);
  out.straightNsPerScan = median(straightNs);
  out.ratio = median(ratios);
  const Result<double> size = codeKb(*kind, *compiled, engineOptions, image);
  if (!size.ok()) return size.failure();
  out.codeKb = size.value();
  return out;
}

} // namespace rung::bench

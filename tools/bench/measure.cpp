// One measurement (see measure.h).
#include "tools/bench/measure.h"

#include <algorithm>
#include <chrono>
#include <dlfcn.h>
#include <fmt/format.h>
#include <random>
#include <sys/resource.h>
#include <vector>

#include "codegen/cpp/cpp_emitter.h"
#include "ir/support/diag_render.h"
#include "rtlib/nc/model/nc_model.h"
#include "tools/bench/workload.h"
#include "tools/driver/engines.h"

namespace rung::bench {
namespace {

constexpr uint64_t kSeed = 20260101;
constexpr int kSamples = 41;
constexpr int kSettleScans = 20;
constexpr double kSampleNs = 2e6; // a sample repeats its scan for about this long

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

// Both forms from the same state through the same number of scans; they must stay equal, or the figures compare
// nothing.
template <class RunEngine, class RunHand>
Result<void> settle(host::Instance& instance, std::vector<uint8_t>& bits, RunEngine runEngine, RunHand runHand) {
  std::mt19937_64 random(kSeed + 1);
  instance.coldStart();
  const auto place = [&](uint32_t bit) { return *instance.resolve(fmt::format("{:04}.{:02}", wordOf(bit), bit % 32)); };
  for (uint32_t bit = 0; bit < kInputs; ++bit) {
    bits[bit] = static_cast<uint8_t>(random() & 1);
    instance.write(place(bit), bits[bit]);
  }
  for (int i = 0; i < kSettleScans; ++i) {
    runEngine();
    runHand();
  }
  for (uint32_t bit = 0; bit < bits.size(); ++bit)
    if (instance.read(place(bit)) != bits[bit])
      return failure(fmt::format("bit {} differs from the hand-written form", bit));
  return {};
}

} // namespace

Result<void> buildHandWritten(uint32_t rungs, const std::string& compiler, const std::string& path) {
  codegen::CppBuildOptions options;
  options.compiler = compiler;
  options.optimisation = "-O3";
  options.debugInfo = false;
  return codegen::buildCppSharedObject(handWritten(drawRungs(rungs, kSeed)), options, path);
}

Result<Measured> measure(const Case& which) {
  const auto kind = driver::engineFromName(which.engine);
  if (!kind) return failure(fmt::format("unknown engine '{}'", which.engine));
  const std::string text = ladderText(drawRungs(which.rungs, kSeed));

  const auto start = Clock::now();
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer("bench.lad", text);
  driver::CompileRequest request;
  request.optimise = which.optimise;
  const auto compiled = driver::compile(sources, {&file, 1}, request, diagnostics);
  if (!compiled) return failure("the generated program has errors:\n" + renderText(diagnostics, sources));
  driver::EngineOptions engineOptions;
  engineOptions.optimise = which.optimise;
  engineOptions.cppCompiler = which.compiler;
  Result<std::unique_ptr<host::Engine>> engine = driver::makeEngine(*kind, *compiled, engineOptions);
  if (!engine.ok()) return engine.failure();
  const std::unique_ptr<host::Instance> instance = driver::makeInstance(*engine.value(), nullptr);
  instance->scan();
  Measured out;
  out.firstScanMs = nsSince(start) / 1e6;
  out.residentMb = residentMb();

  void* library = dlopen(which.handWritten.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return failure(dlerror());
  const auto hand = reinterpret_cast<void (*)(bool*)>(dlsym(library, "scan"));
  if (hand == nullptr) return failure(dlerror());
  std::vector<uint8_t> bits(kInputs + which.rungs);
  const auto runEngine = [&] { instance->runTask(instance->program().main_task); };
  const auto runHand = [&] { hand(reinterpret_cast<bool*>(bits.data())); };
  const Result<void> equal = settle(*instance, bits, runEngine, runHand);
  if (!equal.ok()) return equal.failure();
  const int engineRepeats = repeatsFor(runEngine);
  const int handRepeats = repeatsFor(runHand);
  std::vector<double> engineNs;
  std::vector<double> handNs;
  std::vector<double> ratios;
  for (int i = 0; i < kSamples; ++i) {
    engineNs.push_back(sample(engineRepeats, runEngine));
    handNs.push_back(sample(handRepeats, runHand));
    ratios.push_back(engineNs.back() / handNs.back());
  }
  out.nsPerScan = median(engineNs);
  out.handNsPerScan = median(handNs);
  out.ratio = median(ratios);
  return out;
}

} // namespace rung::bench

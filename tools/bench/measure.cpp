// One measurement (see measure.h).
#include "tools/bench/measure.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <random>
#include <sys/resource.h>
#include <vector>

#include "codegen/cpp/cpp_emitter.h"
#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "ir/support/temporary_folder.h"
#include "rtlib/host/file.h"
#include "rtlib/nc/names/names.h"
#include "tools/bench/gsk_workload.h"
#include "tools/bench/technol_workload.h"
#include "tools/compiler/engines.h"

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

Workload workloadOf(const Case& which) {
  if (which.program == "gsk") return gskWorkload(which.units, kSeed);
  if (which.program == "technol") return technolWorkload(which.units, kSeed);
  if (which.program == "idle" || which.program == "waiting")
    return mechanismsWorkload(which.units, which.program == "waiting");
  return bitsWorkload(which.units, kSeed);
}

// The hand-written form, loaded.
struct Hand {
  void (*scan)(uint8_t*) = nullptr;
  void (*start)() = nullptr; // may be null
};

Result<Hand> loadHand(const std::string& path) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return failure(dlerror());
  Hand hand;
  hand.scan = reinterpret_cast<void (*)(uint8_t*)>(dlsym(library, "scan"));
  if (hand.scan == nullptr) return failure(dlerror());
  hand.start = reinterpret_cast<void (*)()>(dlsym(library, "start"));
  return hand;
}

// Both forms from the same state through the same number of scans; they must stay equal, or the figures compare
// nothing.
template <class RunEngine, class RunHand>
Result<void> settle(host::Instance& instance, const Workload& work, std::vector<uint8_t>& hand, RunEngine runEngine,
                    RunHand runHand) {
  std::mt19937_64 random(kSeed + 1);
  instance.coldStart();
  const auto placeOf = [&](const std::string& name) {
    const std::optional<host::Ref> place = nc::resolve(instance.program(), name);
    RUNG_CHECK(place.has_value(), "a workload names places of its own program");
    return *place;
  };
  for (const std::string& name : work.ones) host::writeRaw(instance.memory(), placeOf(name), 1);
  std::vector<host::Ref> bits;
  std::vector<host::Ref> words;
  for (const std::string& name : work.bits) bits.push_back(placeOf(name));
  for (const std::string& name : work.words) words.push_back(placeOf(name));
  const auto wordAt = [&](size_t i) { return hand.data() + bits.size() + 2 * i; };
  for (uint32_t bit = 0; bit < work.inputs; ++bit) {
    hand[bit] = static_cast<uint8_t>(random() & 1);
    host::writeRaw(instance.memory(), bits[bit], hand[bit]);
  }
  for (size_t i = 0; i < words.size(); ++i) {
    const auto value = static_cast<uint16_t>(random() % 64);
    std::memcpy(wordAt(i), &value, 2);
    host::writeRaw(instance.memory(), words[i], value);
  }
  for (int i = 0; i < kSettleScans; ++i) {
    for (int change = 0; change < 16; ++change) {
      const auto bit = static_cast<uint32_t>(random() % work.inputs);
      hand[bit] ^= 1;
      host::writeRaw(instance.memory(), bits[bit], hand[bit]);
    }
    runEngine();
    runHand();
  }
  for (size_t bit = 0; bit < bits.size(); ++bit)
    if (instance.read(bits[bit]) != hand[bit])
      return failure(fmt::format("{} differs from the hand-written form", work.bits[bit]));
  for (size_t i = 0; i < words.size(); ++i)
    if (instance.read(words[i]) != static_cast<uint64_t>(wordAt(i)[0] | wordAt(i)[1] << 8))
      return failure(fmt::format("{} differs from the hand-written form", work.words[i]));
  return {};
}

// Of a shared object the file, of the JIT what its cache keeps of the same program.
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
  // The file is gone when it is loaded; what is mapped of it is as large, rounded to pages.
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

Result<void> buildHandWritten(const Case& which, const std::string& compiler, const std::string& path) {
  codegen::CppBuildOptions options;
  options.compiler = compiler;
  options.optimisation = "-O3";
  options.debugInfo = false;
  const Result<std::string> image = codegen::buildCppSharedObject(workloadOf(which).hand, options);
  if (!image.ok()) return image.failure();
  if (std::string wrong = host::replaceFile(path, image.value()); !wrong.empty()) return failure(std::move(wrong));
  return {};
}

std::string sourceOf(const Case& which) { return workloadOf(which).text; }

Result<Measured> measure(const Case& which) {
  const auto kind = compiler::engineFromName(which.engine);
  if (!kind) return failure(fmt::format("unknown engine '{}'", which.engine));
  const Workload work = workloadOf(which);

  Measured out;
  auto start = Clock::now();
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer(work.file, work.text);
  compiler::CompileRequest request;
  request.optimise = which.optimise;
  const auto compiled = compiler::compile(sources, {&file, 1}, request, diagnostics);
  if (!compiled) return failure("the generated program has errors:\n" + renderText(diagnostics, sources));
  out.frontMs = nsSince(start) / 1e6;
  start = Clock::now();
  compiler::EngineOptions engineOptions;
  engineOptions.optimise = which.optimise;
  engineOptions.cppCompiler = which.compiler;
  Result<std::unique_ptr<host::Engine>> engine = compiler::makeEngine(*kind, *compiled, engineOptions);
  if (!engine.ok()) return engine.failure();
  const auto instance = std::make_unique<host::Instance>(*engine.value());
  instance->scan();
  out.backMs = nsSince(start) / 1e6;
  out.residentMb = residentMb();
  out.memoryKb = instance->program().memory_size / 1024.0;

  const Result<Hand> loaded = loadHand(which.handWritten);
  if (!loaded.ok()) return loaded.failure();
  const Hand& hand = loaded.value();
  if (hand.start != nullptr) hand.start();
  std::vector<uint8_t> memory(work.bits.size() + 2 * work.words.size());
  // NCT's time slices around a scan are the NC's; a scan of the others is their modules, and no more.
  const auto runEngine = [&] {
    if (which.program == "bits")
      instance->runTask(instance->program().main_task);
    else
      instance->scan();
  };
  const auto runHand = [&] { hand.scan(memory.data()); };
  const Result<void> equal = settle(*instance, work, memory, runEngine, runHand);
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
  const Result<double> size = codeKb(*kind, *compiled, engineOptions, instance->program());
  if (!size.ok()) return size.failure();
  out.codeKb = size.value();
  return out;
}

} // namespace rung::bench

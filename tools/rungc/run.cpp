// rungc run: runs a program, from source or from a shared object, on the virtual or the real clock.
#include <chrono>
#include <csignal>
#include <fmt/format.h>

#include "rtlib/host/realtime.h"
#include "rtlib/host/so_engine.h"
#include "rtlib/nc/model/nc_model.h"
#include "tools/driver/engines.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/scenario.h"

namespace rung::rungc {
namespace {

struct RunOptions {
  SourceOptions source;
  std::string engine = "jit";
  uint64_t scans = 1;
  std::string duration;
  std::vector<std::string> watch;
  bool realtime = false;
  bool debugger = false;
  std::string level = "2";
};

volatile std::sig_atomic_t gStop = 0; // set by SIGINT: the only thing a signal handler may touch

struct Watched {
  std::string name;
  host::Ref place;
  std::string last;
};

std::string valueText(const host::Instance& instance, const host::Ref& place) {
  switch (place.kind) {
  case host::RefKind::Text: return "\"" + instance.readText(place) + "\"";
  case host::RefKind::Real: return fmt::format("{}", instance.readReal(place));
  case host::RefKind::Bit: return fmt::format("{}", instance.read(place));
  case host::RefKind::Int:
  case host::RefKind::Constant: return fmt::format("{}", host::readSigned(instance.memory(), place));
  }
  return {};
}

// Prints what has changed, behind the time.
void printChanges(const host::Instance& instance, std::vector<Watched>& watched) {
  for (Watched& w : watched) {
    std::string now = valueText(instance, w.place);
    if (now == w.last) continue;
    fmt::print("{:>12.3f} ms  {} = {}\n", static_cast<double>(instance.nowUs()) / 1000.0, w.name, now);
    w.last = std::move(now);
  }
}

bool resolveWatched(const nc::NcModel& nc, const host::Instance& instance, const std::vector<std::string>& names,
                    std::vector<Watched>& watched) {
  for (const std::string& name : names) {
    const auto place = nc.readPlace(instance, name);
    if (!place) {
      fmt::print(stderr, "rungc: '{}' is no name of this program\n", name);
      return false;
    }
    watched.push_back({name, *place, ""});
  }
  return true;
}

int runInstance(host::Engine& engine, const RunOptions& options, int64_t forUs) {
  const std::unique_ptr<nc::NcModel> nc = nc::makeNcModel(engine.program().dialect);
  const std::unique_ptr<host::Instance> instance = driver::makeInstance(engine, nc.get());
  nc->powerOn(*instance, nc::PowerOn::Cold);
  std::vector<Watched> watched;
  if (!resolveWatched(*nc, *instance, options.watch, watched)) return kUsage;
  std::signal(SIGINT, [](int) { gStop = 1; });
  uint64_t scans = 0;
  const auto more = [&] {
    return gStop == 0 && !instance->faulted() && (forUs >= 0 ? instance->nowUs() < forUs : scans < options.scans);
  };
  if (options.realtime) {
    const host::RealTimeStats stats = host::runRealTime(*instance, {}, [&] {
      nc->board().take(*instance);
      printChanges(*instance, watched);
      scans += instance->atListStart() ? 1 : 0;
      return more();
    });
    fmt::print("{} slices, {} missed, latest start {:.1f} us, longest slice {:.1f} us\n", stats.slices, stats.missed,
               static_cast<double>(stats.maxLateNs) / 1e3, static_cast<double>(stats.maxRunNs) / 1e3);
  } else {
    for (; more(); ++scans) {
      nc->scan(*instance);
      printChanges(*instance, watched);
    }
  }
  fmt::print("{} scans, {:.3f} ms of the program's time, engine {}\n", scans,
             static_cast<double>(instance->nowUs()) / 1000.0, engine.name());
  if (!instance->faulted()) return kOk;
  fmt::print(stderr, "rungc: the program stopped with a fault: {}\n", instance->faultText());
  return kWrong;
}

int runSharedObject(const RunOptions& options, int64_t forUs) {
  std::string error;
  const std::unique_ptr<host::SoEngine> engine = host::SoEngine::open(options.source.files[0], error);
  return engine == nullptr ? environmentError(error) : runInstance(*engine, options, forUs);
}

int runSource(const RunOptions& options, int64_t forUs) {
  const auto kind = driver::engineFromName(options.engine);
  if (!kind) {
    fmt::print(stderr, "rungc: unknown engine '{}'; there are interp, cpp, llvm and jit\n", options.engine);
    return kUsage;
  }
  int status = kOk;
  SourceManager sources;
  const auto compiled = compileSources(sources, options.source, {}, status);
  if (!compiled) return status;
  driver::EngineOptions engineOptions;
  engineOptions.debugger = options.debugger;
  engineOptions.optimise = options.level != "0";
  Result<std::unique_ptr<host::Engine>> engine = driver::makeEngine(*kind, *compiled, engineOptions);
  return engine.ok() ? runInstance(*engine.value(), options, forUs) : environmentError(engine.error());
}

} // namespace

void addRun(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("run", "Run a program, from source or from a shared object");
  auto options = std::make_shared<RunOptions>();
  addSourceOptions(*command, options->source);
  command->add_option("--engine", options->engine, "interp, cpp, llvm or jit; a shared object brings its own")
      ->capture_default_str();
  CLI::Option* scans = command->add_option("--scans", options->scans, "Number of scans")->capture_default_str();
  command->add_option("--for", options->duration, "Time to run, such as 2s or 500ms")->excludes(scans);
  command->add_option("--watch", options->watch, "Names whose changes are printed");
  command->add_flag("--realtime", options->realtime, "On the machine's clock");
  command->add_flag("--debugger", options->debugger, "Tell gdb about code compiled in the process");
  addLevelOption(*command, options->level);
  command->callback([options, &status] {
    int64_t forUs = -1;
    if (!options->duration.empty()) {
      const auto us = scenario::parseDuration(options->duration);
      if (!us) {
        fmt::print(stderr, "rungc: '{}' is no duration; write 2s, 500ms or 100us\n", options->duration);
        status = kUsage;
        return;
      }
      forUs = *us;
    }
    const bool object = options->source.files.size() == 1 && options->source.files[0].ends_with(".so");
    status = object ? runSharedObject(*options, forUs) : runSource(*options, forUs);
  });
}

} // namespace rung::rungc

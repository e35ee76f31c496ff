// rungc run: runs a program, from source or from a shared object, on the virtual or the real clock.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fmt/format.h>

#include "rtlib/host/realtime.h"
#include "rtlib/host/retained_memory.h"
#include "rtlib/host/so_engine.h"
#include "rtlib/nc/model/nc_model.h"
#include "rtlib/nc/model/refuse.h"
#include "rtlib/nc/model/retained_tables.h"
#include "rtlib/nc/technol/code_page.h"
#include "tools/driver/engines.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/compile_step.h"
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
  std::string retain;
  std::string cache;
};

volatile std::sig_atomic_t gStop = 0; // set by SIGINT and SIGTERM: the only thing a signal handler may touch

struct Watched {
  std::string name;
  host::Ref place;
  std::string last;
};

std::string valueText(const host::Instance& instance, const host::Ref& place) {
  switch (place.kind) {
  case host::RefKind::Text: {
    const std::string text = instance.readText(place);
    const bool oneByte = std::string_view(instance.program().dialect) == "technol";
    return "\"" + (oneByte ? nc::shownText(text) : text) + "\"";
  }
  case host::RefKind::Real: return fmt::format("{}", instance.readReal(place));
  case host::RefKind::Bit: return fmt::format("{}", instance.read(place));
  case host::RefKind::Constant: return fmt::format("{}", place.constant);
  case host::RefKind::Int: {
    // Whether a cell has a sign is the program's affair: both readings, as a scenario shows them.
    const int64_t number = host::readSigned(instance.memory(), place);
    return number < 0 ? fmt::format("{} ({})", instance.read(place), number) : fmt::format("{}", number);
  }
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

// TECHNOL: as in the log.
std::string messageText(const rung_program& program, const nc::ShownMessage& message) {
  if (std::string_view(program.dialect) == "technol")
    return fmt::format("PLC{:05} {} {} {} {}{}", message.number, static_cast<uint32_t>(message.index), message.value,
                       message.par2, message.par3, message.text.empty() ? "" : " " + message.text);
  std::string text = fmt::format("message {}", message.number);
  if (message.channel != 0 || message.index != 0)
    text += fmt::format(" (channel {}, index {})", message.channel, message.index);
  if (!message.text.empty()) text += fmt::format(" \"{}\"", message.text);
  return text;
}

// Prints which messages have come to the screen or gone from it, behind the time.
void printMessages(const host::Instance& instance, std::vector<nc::ShownMessage> now,
                   std::vector<nc::ShownMessage>& shown) {
  if (now == shown) return;
  const double ms = static_cast<double>(instance.nowUs()) / 1000.0;
  const auto stands = [](const std::vector<nc::ShownMessage>& list, const nc::ShownMessage& message) {
    return std::find(list.begin(), list.end(), message) != list.end();
  };
  for (const nc::ShownMessage& message : shown)
    if (!stands(now, message)) fmt::print("{:>12.3f} ms  {} is gone\n", ms, messageText(instance.program(), message));
  for (const nc::ShownMessage& message : now)
    if (!stands(shown, message)) fmt::print("{:>12.3f} ms  {}\n", ms, messageText(instance.program(), message));
  shown = std::move(now);
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

// What --retain keeps: the program's retained memory, and the tables of the NC beside it.
struct Retained {
  Retained(const rung_program& program, nc::NcModel& nc, const std::string& file)
      : memory(program, file, std::chrono::milliseconds(nc.savesOnRequest() ? 5 : 200)), tables(nc, file) {}
  host::RetainedMemory memory;
  nc::RetainedTables tables;
};

// Switches the program on, warm with the files of --retain. Nothing but an error when they cannot be used.
std::optional<std::string> switchOn(nc::NcModel& nc, host::Instance& instance, Retained* retained) {
  if (retained == nullptr) {
    nc.powerOn(instance, nc::PowerOn::Cold);
    return std::nullopt;
  }
  std::string report;
  std::string error;
  const bool found = retained->memory.load(instance, report, error);
  if (!error.empty()) return error;
  if (!report.empty()) fmt::print(stderr, "rungc: {}\n", report);
  if (!found && !report.empty()) nc.reportRetainedLost();
  report.clear();
  retained->tables.load(report, error);
  if (!error.empty()) return error;
  if (!report.empty()) fmt::print(stderr, "rungc: {}\n", report);
  nc.powerOn(instance, found ? nc::PowerOn::Warm : nc::PowerOn::Cold);
  return std::nullopt;
}

// One run of an instance, to the end that the options set.
class Run {
public:
  Run(const RunOptions& options, int64_t forUs, nc::NcModel& nc, host::Instance& instance, Retained* retained,
      std::vector<Watched> watched)
      : options_(options), forUs_(forUs), nc_(nc), instance_(instance), retained_(retained),
        watched_(std::move(watched)) {}

  uint64_t scans() const { return scans_; }

  void realTime() {
    nc_.betweenSlices(instance_);
    const host::RealTimeStats stats = host::runRealTime(instance_, {}, [this] {
      nc_.takeMessages(instance_);
      scans_ += instance_.atListStart() ? 1 : 0;
      nc_.betweenSlices(instance_);
      look();
      return more();
    });
    fmt::print("{} slices, {} missed, latest start {:.1f} us, longest slice {:.1f} us\n", stats.slices, stats.missed,
               static_cast<double>(stats.maxLateNs) / 1e3, static_cast<double>(stats.maxRunNs) / 1e3);
  }

  void virtualTime() {
    for (; more(); ++scans_) {
      nc_.scan(instance_);
      look();
    }
  }

private:
  void look() {
    rt::ServiceRequest request; // here is nobody who could answer later
    while (instance_.services().take(request)) instance_.services().complete(nc::refuse(instance_.program(), request));
    if (retained_ != nullptr) {
      if (nc_.savesOnRequest())
        saveOnRequest();
      else
        retained_->memory.offer(instance_);
      retained_->tables.offer();
    }
    printChanges(instance_, watched_);
    printMessages(instance_, nc_.messages(instance_), shown_);
    nc_.board().takeLog(); // nobody reads it here, and it must not grow
  }
  // On the real clock the scans go on while the image is written; a failure is tried again. On the virtual clock time
  // stands still meanwhile.
  void saveOnRequest() {
    if (saving_ && !retained_->memory.written()) return;
    if (saving_ && retained_->memory.failed() == failures_) nc_.saved(instance_);
    saving_ = false;
    if (!nc_.asksToSave(instance_)) return;
    failures_ = retained_->memory.failed();
    saving_ = retained_->memory.offer(instance_);
    if (options_.realtime) return;
    if (retained_->memory.finish(instance_).empty()) nc_.saved(instance_);
    saving_ = false;
  }
  bool more() const {
    if (gStop != 0 || instance_.faulted()) return false;
    return forUs_ >= 0 ? instance_.nowUs() < forUs_ : scans_ < options_.scans;
  }

  const RunOptions& options_;
  int64_t forUs_;
  nc::NcModel& nc_;
  host::Instance& instance_;
  Retained* retained_;
  std::vector<Watched> watched_;
  std::vector<nc::ShownMessage> shown_;
  uint64_t scans_ = 0;
  bool saving_ = false;   // an image that the program asked for is being written
  uint64_t failures_ = 0; // in front of it
};

// The keys of --config that the compiler does not read are the NC's; `dialect` is null where nothing was compiled.
std::string configure(nc::NcModel& nc, const SourceOptions& options, const frontend::Dialect* dialect) {
  for (const std::string& pair : options.config) {
    const size_t equals = std::min(pair.find('='), pair.size());
    const std::string key = pair.substr(0, equals);
    if (dialect != nullptr && scenario::readsKey(*dialect, key)) continue;
    if (equals == pair.size()) return "--config takes KEY=VALUE, found '" + pair + "'";
    if (std::string wrong = nc.config(key, pair.substr(equals + 1)); !wrong.empty()) return wrong;
  }
  return {};
}

int runInstance(host::Engine& engine, const RunOptions& options, int64_t forUs, const frontend::Dialect* dialect) {
  const std::unique_ptr<nc::NcModel> nc = nc::makeNcModel(engine.program().dialect);
  if (const std::string wrong = configure(*nc, options.source, dialect); !wrong.empty()) {
    fmt::print(stderr, "rungc: {}\n", wrong);
    return kUsage;
  }
  const std::unique_ptr<host::Instance> instance = driver::makeInstance(engine, nc.get());
  std::unique_ptr<Retained> retained;
  if (!options.retain.empty()) retained = std::make_unique<Retained>(engine.program(), *nc, options.retain);
  nc->setStored(retained != nullptr);
  if (const auto error = switchOn(*nc, *instance, retained.get())) return environmentError(*error);
  for (const nc::NcProblem& problem : nc->connectionProblems()) fmt::print(stderr, "rungc: {}\n", problem.text);
  if (!nc->connectionProblems().empty()) return kUsage;
  std::vector<Watched> watched;
  if (!resolveWatched(*nc, *instance, options.watch, watched)) return kUsage;
  std::signal(SIGINT, [](int) { gStop = 1; });
  std::signal(SIGTERM, [](int) { gStop = 1; });
  Run run(options, forUs, *nc, *instance, retained.get(), std::move(watched));
  if (options.realtime)
    run.realTime();
  else
    run.virtualTime();
  fmt::print("{} scans, {:.3f} ms of the program's time, engine {}\n", run.scans(),
             static_cast<double>(instance->nowUs()) / 1000.0, engine.name());
  if (retained) {
    if (!instance->faulted()) nc->powerOff(*instance);
    if (const std::string error = retained->memory.finish(*instance); !error.empty()) return environmentError(error);
    if (const std::string error = retained->tables.finish(); !error.empty()) return environmentError(error);
  }
  if (!instance->faulted()) return kOk;
  fmt::print(stderr, "rungc: the program stopped with a fault: {}\n", instance->faultText());
  return kWrong;
}

int runSharedObject(const RunOptions& options, int64_t forUs) {
  std::string error;
  const std::unique_ptr<host::SoEngine> engine =
      host::SoEngine::open(options.source.files[0], error, host::Loaded::WithProcess);
  return engine == nullptr ? environmentError(error) : runInstance(*engine, options, forUs, nullptr);
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
  engineOptions.cacheFolder = options.cache;
  Result<std::unique_ptr<host::Engine>> engine = driver::makeEngine(*kind, *compiled, engineOptions);
  return engine.ok() ? runInstance(*engine.value(), options, forUs, compiled->dialect)
                     : environmentError(engine.error());
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
  command->add_option(
      "--retain", options->retain,
      "Keep the retained memory in FILE.a and FILE.b: taken at the start, saved during the run and at its end");
  command->add_option("--cache", options->cache,
                      "Folder for compiled code of engine jit, to start the same program faster");
  addLevelOption(*command, options->level);
  command->callback([options, &status] {
    int64_t forUs = -1;
    if (!options->duration.empty()) {
      const auto us = scenario::parseDuration(options->duration);
      if (!us.ok()) {
        fmt::print(stderr, "rungc: --for {}: {}\n", options->duration, us.error());
        status = kUsage;
        return;
      }
      forUs = us.value();
    }
    const bool object = options->source.files.size() == 1 && options->source.files[0].ends_with(".so");
    status = object ? runSharedObject(*options, forUs) : runSource(*options, forUs);
  });
}

} // namespace rung::rungc

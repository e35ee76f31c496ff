// rungc test: runs scenarios on one or several engines.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "tools/replay/record_run.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/coverage.h"
#include "tools/rungc/file_watch.h"
#include "tools/rungc/scenarios.h"
#include "tools/scenario/prompt.h"

namespace rung::rungc {
namespace {

// Runs scenarios on several threads, which share only compiled programs (EngineStore), and returns the results in
// order.

struct PoolCalls {
  // Called on the caller's thread, in the order of the files. False: no further scenario is begun, and no further
  // result passed.
  std::function<bool(TestCase)> finished;
  // Called repeatedly on the caller's thread while it waits: the file whose result it waits for.
  std::function<void(const std::string& file)> waiting;
};

constexpr std::chrono::milliseconds kTick{200};

class Pool {
public:
  Pool(const std::vector<std::string>& files, const scenario::RunOptions& options, const std::string& record)
      : files_(files), options_(options), record_(record), results_(files.size()) {}

  void run(unsigned threads, const PoolCalls& calls) {
    std::vector<std::jthread> workers;
    for (size_t i = 0; i < std::min<size_t>(threads, files_.size()); ++i) workers.emplace_back([this] { work(); });
    for (size_t i = 0; i < files_.size(); ++i)
      if (!calls.finished(take(i, calls))) break;
    const std::lock_guard lock(mutex_);
    next_ = files_.size();
  }

private:
  void work() {
    for (size_t i = begin(); i < files_.size(); i = begin()) {
      scenario::RunOptions options = options_;
      if (!record_.empty()) replay::recordInto(folderOf(files_[i]), options);
      TestCase result = runOne(files_[i], options);
      const std::lock_guard lock(mutex_);
      results_[i] = std::move(result);
      changed_.notify_one();
    }
  }

  // The recording of one scenario is the folder itself; those of several have the paths of the scenarios in it.
  std::string folderOf(const std::string& file) const {
    if (files_.size() == 1) return record_;
    std::filesystem::path folder(record_);
    for (const std::filesystem::path& part : std::filesystem::path(file).relative_path().replace_extension())
      if (part != "." && part != "..") folder /= part;
    return folder.string();
  }

  size_t begin() {
    const std::lock_guard lock(mutex_);
    return next_ < files_.size() ? next_++ : files_.size();
  }

  TestCase take(size_t i, const PoolCalls& calls) {
    std::unique_lock lock(mutex_);
    std::optional<TestCase>& result = results_[i];
    while (!result) {
      if (changed_.wait_for(lock, kTick, [&] { return result.has_value(); })) continue;
      lock.unlock();
      calls.waiting(files_[i]);
      lock.lock();
    }
    TestCase taken = std::move(*result);
    result.reset();
    return taken;
  }

  const std::vector<std::string>& files_;
  const scenario::RunOptions& options_;
  const std::string& record_;
  std::mutex mutex_; // protects the members below
  std::condition_variable changed_;
  std::vector<std::optional<TestCase>> results_;
  size_t next_ = 0;
};

void runAll(const std::vector<std::string>& files, const scenario::RunOptions& options, const std::string& record,
            unsigned threads, const PoolCalls& calls) {
  Pool(files, options, record).run(threads, calls);
}

// The command itself.

struct TestOptions {
  std::vector<std::string> names; // files and folders
  std::vector<std::string> filters;
  std::string engines = "jit";
  bool enginesGiven = false;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  bool failFast = false;
  bool watchFiles = false;
  std::string color = "auto";
  std::string junit;
  std::string record;
  std::string cxx;
  bool strict = false;
  std::string level = "2";
  std::string cache;
  CoverageOptions coverage;
  ScenarioTrace trace;
};

struct Outcome {
  int status = kOk;
  std::vector<TestCase> tests;
};

std::string summary(const std::vector<TestCase>& tests, size_t selected, double seconds) {
  const auto count = [&](auto counts) { return std::ranges::count_if(tests, counts); };
  const auto passed = count([](const TestCase& t) { return t.result.passed; });
  const auto hollow = count([](const TestCase& t) { return t.result.passed && t.result.expectsNothing; });
  std::string text = fmt::format("{} passed, {} failed", passed, tests.size() - static_cast<size_t>(passed));
  if (hollow > 0) text += fmt::format(", {} expecting nothing", hollow);
  if (tests.size() < selected) text += fmt::format(", {} not run", selected - tests.size());
  return fmt::format("{} in {}", text, shownSeconds(seconds));
}

Outcome runOnce(const std::vector<std::string>& files, const TestOptions& options, const scenario::RunOptions& run) {
  Outcome outcome;
  scenario::Progress progress(stdout);
  const bool color = wantsColor(options.color, STDOUT_FILENO);
  const auto finished = [&](TestCase test) {
    progress.clear();
    printResult(test, color);
    std::fflush(stdout);
    if (!test.result.passed)
      outcome.status = std::max(outcome.status, test.result.environment.empty() ? int{kWrong} : int{kEnvironment});
    outcome.tests.push_back(std::move(test));
    return outcome.status == kOk || !options.failFast;
  };
  const auto waiting = [&](const std::string& file) {
    progress.show(fmt::format("{} of {}, {}: {}", outcome.tests.size() + 1, files.size(),
                              shownSeconds(progress.seconds()), file));
  };
  runAll(files, run, options.record, options.threads, {finished, waiting});
  progress.clear();
  fmt::print("{}\n", summary(outcome.tests, files.size(), progress.seconds()));
  std::fflush(stdout);
  return outcome;
}

int writeJunit(const std::string& path, const std::vector<TestCase>& tests) {
  return path.empty() ? int{kOk} : writeFile(junitXml(tests), path);
}

// Folders among the names, watched for new scenarios, too.
std::vector<std::string> foldersOf(const std::vector<std::string>& names) {
  std::vector<std::string> folders;
  std::error_code none;
  std::ranges::copy_if(names, std::back_inserter(folders),
                       [&](const std::string& name) { return std::filesystem::is_directory(name, none); });
  return folders;
}

// All files that the scenarios used, including the scenarios.
std::vector<std::string> filesOf(const std::vector<TestCase>& tests) {
  std::vector<std::string> files;
  for (const TestCase& test : tests) {
    files.push_back(test.path);
    files.insert(files.end(), test.result.files.begin(), test.result.files.end());
  }
  std::ranges::sort(files);
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

// Waits for the next change; false if the user ends the program or files cannot be watched.
bool waitForChange(const TestOptions& options, const std::vector<TestCase>& tests,
                   std::filesystem::file_time_type since, int& status) {
  const std::vector<std::string> files = filesOf(tests);
  Result<FileWatch> watch = FileWatch::open(files, foldersOf(options.names), ".scn", since);
  if (!watch.ok()) {
    status = environmentError(watch.error());
    return false;
  }
  fmt::print("watching {} files; Ctrl-C ends\n", files.size());
  std::fflush(stdout);
  const std::optional<std::string> changed = watch.value().wait();
  if (changed) fmt::print("\n{} has changed\n", *changed);
  return changed.has_value();
}

int runTests(TestOptions& options) {
  Result<std::vector<compiler::EngineKind>> engines = enginesOf(options.engines);
  if (!engines.ok()) return usageError(engines.error());
  if (options.coverage.wanted() && options.enginesGiven && options.engines != "interp")
    return usageError(fmt::format("coverage needs the interpreter; leave out --engine {}", options.engines));
  scenario::EngineStore store;
  scenario::RunOptions run;
  run.store = &store;
  run.engines = engines.value();
  run.strict = options.strict;
  run.engine.cppCompiler = options.cxx;
  run.engine.optimise = options.level != "0";
  run.engine.cacheFolder = options.cache;
  options.trace.attach(run);
  for (int status = kOk;;) {
    const auto since = std::filesystem::file_time_type::clock::now();
    const std::optional<std::vector<std::string>> found = scenarioFiles(options.names, status);
    if (!found) return status;
    const std::vector<std::string> files = filtered(*found, options.filters);
    if (files.empty()) return usageError(fmt::format("--filter matches none of the {} scenarios", found->size()));
    CoverageRun coverage;
    if (options.coverage.wanted()) coverage.observe(run);
    if (const std::string problem = options.trace.problem(files.size()); !problem.empty()) return usageError(problem);
    const Outcome outcome = runOnce(files, options, run);
    if (options.trace.refused()) return kUsage;
    status = std::max(outcome.status, writeJunit(options.junit, outcome.tests));
    if (options.coverage.wanted()) status = std::max(status, coverage.finish(options.coverage));
    if (const std::string error = options.trace.finish(); !error.empty()) status = environmentError(error);
    if (!options.watchFiles || !waitForChange(options, outcome.tests, since, status)) return status;
  }
}

} // namespace

void addTest(CommandLine& app, int& status) {
  Command command = app.add("test", "Run scenarios, and compare several engines after every scan");
  auto options = std::make_shared<TestOptions>();
  command.option(
      "SCENARIO", options->names,
      "Scenario files, or folders: the scenarios of the project in it, or every *.scn below it; default: those "
      "of the project of the working directory");
  command
      .option("--engine", options->engines,
              "interp, cpp, llvm, jit, tiered, a list of them with commas, or all: the first four")
      .showDefault();
  command.option("-j,--jobs", options->threads, "Number of scenarios run in parallel; default: one per processor")
      .between(1u, 256u);
  command
      .option("--filter", options->filters,
              "Run only scenarios whose path contains this text, or matches it if it has * ? or [; may be repeated")
      .oneValue();
  command.flag("--fail-fast", options->failFast, "Stop at the first failure");
  command.flag("--watch-files", options->watchFiles, "Run again when a scenario or a program changes");
  addColorOption(command, options->color, "Colours of ok and FAILED");
  options->trace.addTo(command);
  command.option("--junit", options->junit, "Write the results as JUnit XML");
  command.option("--record", options->record,
                 "Record into this folder, for rungc replay; of several scenarios each into its own folder in it");
  command.option("--cxx", options->cxx, "C++ compiler of the engine cpp");
  command.option("--cache", options->cache,
                 "Folder for compiled code, so that unchanged programs are not compiled again");
  addLevelOption(command, options->level);
  command.flag(
      "--strict", options->strict,
      "Treat warnings that the real control would reject as errors, and scenarios that expect nothing as failed");
  addCoverageOptions(command, options->coverage);
  command.onRun([command, options, &status] {
    options->enginesGiven = command.given("--engine");
    status = runTests(*options);
  });
}

} // namespace rung::rungc

// rungc run: runs a program, from source or from a shared object, on the virtual or the real clock; the user can set
// its inputs, drive it with a scenario, or enter commands.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fmt/format.h>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <unistd.h>

#include "compiler/embedded_ir.h"
#include "compiler/engines.h"
#include "rtlib/load/seal.h"
#include "rtlib/load/so_engine.h"
#include "rtlib/nc/config_key.h"
#include "tools/replay/record_run.h"
#include "tools/replay/session_past.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/retained_files.h"
#include "tools/rungc/scenarios.h"
#include "tools/rungc/stop_signal.h"
#include "tools/rungc/web.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/console.h"
#include "tools/scenario/prompt.h"
#include "tools/scenario/trace.h"
#include "tools/scenario/words.h"
#include "tools/web/session_source.h"

namespace rung::rungc {
namespace {

struct RunOptions {
  SourceOptions source;
  ConfigPairs config;            // of the source options
  std::string engine;            // "": tiered, or jit for a debugger
  std::optional<uint64_t> scans; // default: one, if nothing else drives the program
  std::string duration;
  int64_t forUs = 0;
  std::vector<std::string> watch;
  std::vector<std::string> sets;
  std::string scenarioFile;
  RunScenario scenario;
  std::string trace;
  std::string record;
  bool prompt = false;
  bool web = false;
  std::string listen = kDefaultListen;
  bool realtime = false;
  runtime::RealTimeOptions thread; // for a real-time run
  bool debugger = false;
  bool unsealed = false;
  std::string level = "2";
  std::string retain;
  std::string cache;
};

constexpr uint64_t kMostScans = 1'000'000'000'000;

// "500.000 ms", "12.000 s", "5 min 12.000 s", "83 h 20 min 0.000 s"
std::string longText(int64_t us) {
  constexpr int64_t kMinute = 60'000'000;
  if (us < 1'000'000) return fmt::format("{:.3f} ms", static_cast<double>(us) / 1e3);
  const int64_t minutes = us / kMinute;
  std::string text = minutes < 60 ? "" : fmt::format("{} h ", minutes / 60);
  if (minutes > 0) text += fmt::format("{} min ", minutes % 60);
  return text + fmt::format("{:.3f} s", static_cast<double>(us % kMinute) / 1e6);
}

// The program that is run.
struct Program {
  std::optional<compiler::Compiled> compiled; // nothing for a shared object
  std::unique_ptr<runtime::Engine> engine;    // destroyed before `compiled`
  std::unique_ptr<replay::FlowEngine> flow;   // in place of `engine`, for the page
  const runtime::SoEngine* object = nullptr;  // the same engine, if it is a shared object
  std::optional<compiler::Compiled> carried;  // of a shared object, its embedded IR, loaded on first use

  runtime::Engine& runs() const { return flow ? flow->engine() : *engine; }
  const ir::Uses* uses() const { return compiled ? compiled->uses.get() : nullptr; }
  Result<const compiler::Compiled*> wanted();
};

// The whole file from which it was loaded.
std::string fileOf(const runtime::SoEngine& object) {
  constexpr size_t kPiece = size_t{1} << 20;
  std::string bytes;
  for (size_t got = kPiece; got == kPiece;) {
    const size_t before = bytes.size();
    bytes.resize(before + kPiece);
    got = object.readFile(before, std::span(bytes).subspan(before)).value_or(0);
    bytes.resize(before + got);
  }
  return bytes;
}

Result<const compiler::Compiled*> Program::wanted() {
  if (compiled) return &*compiled;
  if (!carried) {
    const std::string file = fileOf(*object);
    Result<compiler::Compiled> found =
        compiler::irOf(runtime::readSealed(file).image, compiler::hashesOf(object->program()));
    if (!found.ok()) return failure(object->path() + ": " + found.error());
    carried = std::move(found).value();
  }
  return &*carried;
}

bool isSharedObject(const std::vector<std::string>& files) { return files.size() == 1 && files[0].ends_with(".so"); }

// From sources or a shared object. Nothing: a message was printed, and `status` is the exit status.
std::optional<Program> makeProgram(const RunOptions& options, const SourceOptions& source, int& status);

// One run of a program, from its start to the end that the options set.
class Run {
public:
  // The options must outlive the run.
  Run(const RunOptions& options, Program program)
      : options_(options), session_("", options.realtime ? sim::Clock::Machine : sim::Clock::Virtual),
        recording_(startOf(options, program.compiled.has_value())) {
    programs_.push_back(std::move(program));
    session_.addEngine(first().runs());
    if (options.web)
      web::observeForces(session_, *first().flow);
    else
      session_.setCompiled([this] { return first().wanted(); });
    session_.setMakeProgram([this](const scenario::Statement& s) { return next(s); });
  }

  int run() {
    int status = start();
    if (status == kOk) status = drive();
    return status == kOk || status == kWrong ? finish(status) : status;
  }

private:
  static scenario::Start startOf(const RunOptions& options, bool compiled) {
    scenario::Start start;
    start.programs = options.source.files;
    start.project = options.source.project;
    start.periodUs = options.scenario.periodUs;
    for (const scenario::Statement& connect : options.scenario.connects) start.connects.push_back(connect.text);
    start.config = options.config;
    if (std::ranges::find(start.programs, "-") != start.programs.end())
      start.notAScenario = "a scenario names sources, and this program came from standard input";
    if (!compiled) start.notAScenario = "a scenario names sources, and this is a shared object: run its sources";
    if (!options.retain.empty()) start.notAScenario = "a scenario starts cold, and this run began with --retain";
    return start;
  }

  Program& first() { return programs_.front(); }

  // ---- start ----

  // Keys of --config that the compiler does not read are passed to the NC.
  std::string configure() {
    const frontend::Dialect* dialect = frontend::findDialect(session_.instance().program().dialect);
    for (const auto& [key, value] : recording_.start().config) {
      const nc::ConfigKey* row = dialect == nullptr ? nullptr : nc::findConfigKey(dialect->configKeys, key);
      const bool compilers = row != nullptr && row->reader == nc::ConfigReader::Compiler;
      if (compilers && first().compiled) continue;
      if (compilers) return fmt::format("--config {0} is for the compiler: rungc build --config {0}={1}", key, value);
      if (std::string wrong = session_.config(key, value); !wrong.empty()) return wrong;
    }
    if (!first().compiled && options_.scenario.periodUs > 0)
      return "the scenario sets the period, which is fixed in a compiled program: run the sources";
    for (const scenario::Statement& connect : options_.scenario.connects)
      if (std::string wrong = session_.connect(connect.words[0], connect.words[1]); !wrong.empty())
        return textOf(problemAt(connect, std::move(wrong)));
    return {};
  }

  int start() try {
    if (const std::string wrong = configure(); !wrong.empty()) return usageError(wrong);
    nc::PowerOn kind = nc::PowerOn::Cold;
    if (!options_.retain.empty()) {
      retained_ = std::make_unique<RetainedFiles>(session_, options_.retain, warn_);
      if (const std::string error = retained_->load(); !error.empty()) return environmentError(error);
      kind = nc::PowerOn::Warm;
    }
    const std::vector<sim::NcProblem> problems = session_.start(kind);
    for (const sim::NcProblem& problem : problems) warn_(problem.text);
    return problems.empty() ? observe() : int{kUsage};
  } catch (const rung::Error& error) { // from loading the retained memory
    return environmentError(error.what());
  }

  int observe() {
    if (retained_) session_.addObserver(*retained_);
    for (const std::string& name : options_.watch)
      if (const std::string wrong = watch_.add(name, session_); !wrong.empty()) return usageError("--watch: " + wrong);
    session_.addObserver(watch_);
    if (const int status = openTrace(); status != kOk) return status;
    if (const int status = openRecording(); status != kOk) return status;
    const bool asked = options_.prompt || options_.web || !options_.scenarioFile.empty();
    if (!asked) return kOk;
    past_ = std::make_unique<replay::SessionPast>(session_, [this] { return first().wanted(); }, recorder_.get());
    session_.addObserver(*past_);
    return kOk;
  }

  int openTrace() {
    if (options_.trace.empty()) return kOk;
    const std::vector<std::string> names =
        options_.watch.empty() ? scenario::defaultTraceNames(session_.instance().program(), first().uses())
                               : options_.watch;
    auto trace = scenario::Trace::open(options_.trace, names, session_.instance(), session_.nc());
    if (!trace.ok()) return environmentError(trace.error());
    trace_ = std::move(trace).value();
    session_.addObserver(*trace_);
    return kOk;
  }

  int openRecording() try {
    if (options_.record.empty()) return kOk;
    const Result<const compiler::Compiled*> program = first().wanted();
    if (!program.ok()) return environmentError("--record: " + program.error());
    recorder_ = std::make_unique<replay::SessionRecorder>(session_, options_.record, *program.value());
    session_.addObserver(*recorder_);
    return kOk;
  } catch (const std::runtime_error& error) {
    return environmentError(error.what());
  }

  // ---- the run ----

  // Executes inputs, then the scenario, then --scans and --for, then the prompt.
  int drive() {
    (void)catchStop();
    scenario::Console console(
        session_, watch_, recording_, [this](const std::string& name) { return past_->why(name); },
        [this](const scenario::Statement& s) { return past_->whyUnexpected(s, "why " + scenario::asWord(s.name)); },
        print_);
    if (const int status = setInputs(); status != kOk) return status;
    int status = runScenario(console);
    if (status == kOk) status = runScans(console);
    if (options_.web) return status == kOk && stopSignal() == 0 ? showPage() : status;
    if (!options_.prompt || stopSignal() == SIGTERM) return status;
    stopSignal() = 0;
    session_.setInterrupt([this] { return interrupted(); });
    return scenario::runPrompt(console, stopSignal(), [this] { progress_.begin(); }) ? status : int{kWrong};
  }

  int setInputs() {
    for (const std::string& pair : options_.sets) {
      const Result<std::string> done = setInput(pair);
      if (!done.ok()) return usageError(fmt::format("--set {}: {}", pair, done.error()));
      recording_.add(done.value());
    }
    return kOk;
  }

  // The executed statement. A value that is not a number may be a text, which needs no quotes here.
  Result<std::string> setInput(const std::string& pair) {
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) return failure("expected NAME=VALUE");
    const std::string name = pair.substr(0, equals);
    const std::string value = pair.substr(equals + 1), word = scenario::asWord(name);
    Result<std::string> plain = executeLine(fmt::format("set {} {}", word, value));
    if (plain.ok()) return plain;
    const Result<std::string> quoted = executeLine(fmt::format("set {} \"{}\"", word, value));
    return quoted.ok() || !session_.nc().writePlace(session_.instance().program(), name) ? quoted : plain;
  }

  Result<std::string> executeLine(const std::string& line) {
    const Result<scenario::Statement> statement = scenario::parseStatement(line);
    if (!statement.ok()) return statement.failure();
    if (const auto problem = session_.execute(statement.value())) return failure(problem->message);
    return statement.value().text;
  }

  int runScenario(scenario::Console& console) {
    session_.setInterrupt([this] { return interrupted(); });
    for (const scenario::Statement& s : options_.scenario.statements) {
      const scenario::Outcome outcome = console.execute(s);
      if (outcome == scenario::Outcome::Interrupted) print_(fmt::format("interrupted at {}:{}", s.file, s.line));
      if (outcome != scenario::Outcome::Done) return kWrong;
    }
    return kOk;
  }

  int runScans(scenario::Console& console) {
    if (!options_.prompt) session_.setUnattended();
    session_.setInterrupt([this] { return interrupted() || session_.instance().faulted(); });
    const bool driven = options_.prompt || options_.web || !options_.scenarioFile.empty();
    scenario::Statement advance;
    advance.kind = options_.duration.empty() ? scenario::Kind::Scan : scenario::Kind::Run;
    advance.count = options_.scans.value_or(driven ? 0 : 1);
    advance.microseconds = options_.forUs;
    advance.text = options_.duration.empty() ? fmt::format("scan {}", advance.count) : "run " + options_.duration;
    if (options_.realtime) return runRealTime(advance);
    if (advance.count > 0 || advance.kind == scenario::Kind::Run) {
      return console.execute(advance) == scenario::Outcome::Failed ? kWrong : kOk;
    }
    return kOk;
  }

  // Until the user stops it.
  int showPage() {
    if (&session_.instance().program() != &first().runs().program())
      return environmentError("the scenario has replaced the program, whose rungs the page would show");
    session_.setUnattended();
    session_.setInterrupt({});
    const std::string title = options_.source.project ? options_.source.project->name : "";
    return serveSession(title, options_.listen, *first().compiled, session_, *past_, *first().flow,
                        [] { return stopSignal() != 0; });
  }

  int runRealTime(const scenario::Statement& end) {
    const runtime::RealTimeThread thread(options_.thread);
    if (!thread.problem().empty()) return environmentError(thread.problem());
    const bool timed = end.kind == scenario::Kind::Run;
    session_.setInterrupt([this, end, timed] {
      return stopSignal() != 0 || (timed ? session_.nowUs() >= end.microseconds : session_.scans() >= end.count);
    });
    const runtime::RealTimeStats stats = session_.runRealTime();
    fmt::print(out_, "{} slices, {} scans skipped, latest start {:.1f} us, longest slice {:.1f} us\n", stats.slices,
               stats.missed, static_cast<double>(stats.maxLateNs) / 1e3, static_cast<double>(stats.maxRunNs) / 1e3);
    return kOk;
  }

  // Compiles the program of a replace or shadow statement, with the configuration of the running one.
  Result<scenario::NextProgram> next(const scenario::Statement& s) {
    SourceOptions source = options_.source;
    source.files = scenario::programPaths(s);
    if (std::ranges::find(source.files, "-") != source.files.end()) return failure("another program comes from files");
    if (const std::string wrong = dialectProblem(source.files); !wrong.empty()) return failure(wrong);
    source.dialect = session_.instance().program().dialect;
    int status = kOk;
    std::optional<Program> program = makeProgram(options_, source, status);
    if (!program) return failure("the running program has not changed");
    programs_.push_back(std::move(*program));
    Program& next = programs_.back();
    return scenario::NextProgram{{&next.runs()}, [&next] { return next.wanted(); }};
  }

  // Checks the dialect that the sources declare.
  std::string dialectProblem(const std::vector<std::string>& files) const {
    if (isSharedObject(files)) return {}; // the session checks its tables
    SourceManager sources;
    const Result<std::vector<FileId>> added = compiler::addFiles(sources, files, {});
    if (!added.ok()) return added.error();
    return scenario::dialectProblem(sources, added.value().front(), session_.instance().program().dialect);
  }

  // Called after every scan.
  bool interrupted() {
    constexpr uint64_t kScansBetween = 1024; // reading the clock costs as much as a small scan
    if (!options_.source.quiet && session_.scans() % kScansBetween == 0)
      progress_.show(fmt::format("{}, running for {}", scenario::scanText(session_.scans(), session_.nowUs()),
                                 shownSeconds(progress_.seconds())));
    return stopSignal() != 0;
  }

  // ---- end ----

  int finish(int status) {
    progress_.clear();
    if (!options_.source.quiet)
      fmt::print(out_, "{} scan{}, {} on the program's clock, engine {}\n", session_.scans(),
                 session_.scans() == 1 ? "" : "s", longText(session_.nowUs()), first().runs().name());
    if (!session_.unexpectedFault().empty()) {
      warn_(scenario::faultLine(session_.instance()));
      status = kWrong;
    }
    for (const Program& program : programs_)
      if (const std::string trouble = compiler::codeTrouble(program.runs()); !trouble.empty()) warn_(trouble);
    // Takes precedence over other failures: the run may have been right.
    if (retained_) status = finishRetained(status);
    if (trace_)
      if (const std::string error = trace_->finish(); !error.empty()) status = environmentError(error);
    return status;
  }

  int finishRetained(int status) {
    if (const std::string error = retained_->finish(); !error.empty()) return environmentError(error);
    if (!options_.source.quiet) fmt::print(out_, "wrote {0}.a, {0}.b\n", options_.retain);
    return status;
  }

  const RunOptions& options_;
  std::list<Program> programs_; // programs that ran: the session may still refer to any of them
  scenario::Session session_;
  scenario::Recording recording_;
  std::FILE* out_ = options_.source.json ? stderr : stdout; // with --json only JSON is printed to standard output
  scenario::Progress progress_{stderr};
  scenario::Print print_ = [this](const std::string& line) {
    progress_.clear();
    fmt::print(out_, "{}\n", line);
    std::fflush(out_);
  };
  RetainedFiles::Report warn_ = [this](const std::string& line) {
    progress_.clear();
    fmt::print(stderr, "rungc: {}\n", line);
  };
  scenario::Watch watch_{print_};
  std::unique_ptr<RetainedFiles> retained_;
  std::unique_ptr<replay::SessionRecorder> recorder_; // null: nothing is recorded
  std::unique_ptr<replay::SessionPast> past_;         // null: no prompt and no page
  std::unique_ptr<scenario::Trace> trace_;
};

std::optional<Program> openSharedObject(const RunOptions& options, const std::string& file, int& status) {
  std::string error;
  std::unique_ptr<runtime::SoEngine> object =
      runtime::SoEngine::open(file, error, {.loaded = runtime::Loaded::WithProcess, .mayLackSeal = options.unsealed});
  if (object == nullptr) {
    status = environmentError(error);
    return std::nullopt;
  }
  Program program;
  program.object = object.get();
  program.engine = std::move(object);
  return program;
}

std::optional<Program> compileProgram(const RunOptions& options, const SourceOptions& source, int& status) {
  const std::string name = !options.engine.empty() ? options.engine : options.debugger ? "jit" : "tiered";
  const auto kind = compiler::engineFromName(name);
  if (!kind) {
    status = usageError(fmt::format("unknown engine '{}'; the engines are interp, cpp, llvm, jit and tiered", name));
    return std::nullopt;
  }
  SourceManager sources;
  compiler::CompileRequest request;
  const bool asked = options.prompt || options.web || !options.scenarioFile.empty();
  request.marks = request.keepBuilt = asked || !options.record.empty(); // for forces, and to play it again
  if (options.scenario.periodUs > 0) request.options.config["period_us"] = std::to_string(options.scenario.periodUs);
  Program program;
  program.compiled = compileChecked(sources, source, request, status);
  if (!program.compiled) return std::nullopt;
  compiler::EngineOptions engineOptions;
  engineOptions.debugger = options.debugger;
  engineOptions.optimise = options.level != "0";
  engineOptions.cacheFolder = options.cache;
  engineOptions.virtualClock = !options.realtime;
  if (options.web) {
    program.flow = std::make_unique<replay::FlowEngine>(*program.compiled);
    return program;
  }
  Result<std::unique_ptr<runtime::Engine>> engine = [&] {
    const scenario::Working working("compiling to machine code");
    return compiler::makeEngine(*kind, *program.compiled, engineOptions);
  }();
  if (!engine.ok()) {
    status = environmentError(engine.error());
    return std::nullopt;
  }
  program.engine = std::move(engine).value();
  return program;
}

std::optional<Program> makeProgram(const RunOptions& options, const SourceOptions& source, int& status) {
  return isSharedObject(source.files) ? openSharedObject(options, source.files[0], status)
                                      : compileProgram(options, source, status);
}

// "" or why there can be no page.
std::string webProblem(const RunOptions& options) {
  if (isSharedObject(options.source.files))
    return "--web shows the rungs of sources, and this is a shared object: run its sources";
  if (!options.engine.empty() && options.engine != "interp")
    return fmt::format("--web runs on the interpreter, not on '{}'", options.engine);
  return listenProblem(options.listen);
}

int runProgram(RunOptions& options) {
  const bool piped = std::ranges::find(options.source.files, "-") != options.source.files.end();
  if (piped && options.prompt && isatty(STDIN_FILENO) == 0)
    return usageError("the program and the lines of the prompt cannot both come from standard input");
  if (!options.duration.empty()) {
    const auto us = scenario::parseDuration(options.duration);
    if (!us.ok()) return usageError(fmt::format("--for {}: {}", options.duration, us.error()));
    options.forUs = us.value();
  }
  if (!options.trace.empty())
    if (const std::string wrong = scenario::traceFileProblem(options.trace); !wrong.empty())
      return usageError("--trace: " + wrong);
  if (options.web)
    if (const std::string wrong = webProblem(options); !wrong.empty()) return usageError(wrong);
  int status = kOk;
  auto config = configPairs(options.source.config, status);
  if (!config) return status;
  options.config = std::move(*config);
  std::optional<Program> program = makeProgram(options, options.source, status);
  return program ? Run(options, std::move(*program)).run() : status;
}

} // namespace

void addRun(CommandLine& app, int& status) {
  Command command = app.add("run", "Run a program, from source or from a shared object");
  auto options = std::make_shared<RunOptions>();
  addSourceOptions(command, options->source);
  command.option("--engine", options->engine,
                 "interp, cpp, llvm, jit, or tiered (interp until jit has compiled). Default: tiered, with --debugger "
                 "jit; a shared object needs none");
  Option scans =
      command.option("--scans", options->scans, "Number of scans; default: 1, or 0 with --scenario, --prompt or --web")
          .between(uint64_t{0}, kMostScans);
  command.option("--for", options->duration, "Time to run, such as 2s or 500ms").excludes(scans);
  command
      .option("--set", options->sets,
              "NAME=VALUE: set an input, a variable or a signal of the NC before the first scan; may be repeated")
      .oneValue();
  Option scenario =
      command.option("--scenario", options->scenarioFile,
                     "First execute the statements of this scenario; without FILE, run the scenario's own program");
  Option prompt = command.flag("-i,--prompt", options->prompt,
                               "Then read statements from standard input: set, scan, run 2s, toggle, watch, help …");
  command.option("--watch", options->watch, "Names whose changes are printed");
  command.option("--trace", options->trace,
                 "Write the values of the watched names, or of all names that the rungs use, to FILE.vcd or FILE.csv");
  command.option("--record", options->record, "Record into this folder, for rungc replay");
  Option web =
      command
          .flag("--web", options->web,
                "Then show the program in a browser: prints a link; runs at the pace of the program's clock on "
                "the interpreter")
          .excludes(prompt);
  command.option("--listen", options->listen, "Address for --web, such as 8080 or 192.168.0.5:8080")
      .needs(web)
      .showDefault();
  Option realtime = command.flag("--realtime", options->realtime, "Run on the computer's clock")
                        .excludes(scenario)
                        .excludes(prompt)
                        .excludes(web);
  command
      .option("--priority", options->thread.priority,
              "Real-time priority of the run, 1 to 99 (SCHED_FIFO); default: ordinary scheduling")
      .between(1, 99)
      .needs(realtime);
  command.flag("--lock-memory", options->thread.lockMemory, "Keep all memory of the run in RAM").needs(realtime);
  command.flag("--debugger", options->debugger, "Let gdb see code compiled in the process");
  command.flag("--unsealed", options->unsealed, "Load a shared object that has no seal; a damaged one may then crash");
  command.option(
      "--retain", options->retain,
      "Keep the retained memory in FILE.a and FILE.b: loaded at the start, saved during the run and at its end");
  command.option("--cache", options->cache, "Folder for compiled code, so that an unchanged program starts faster");
  addLevelOption(command, options->level);
  // The scenario may name the program, so it is read before the program is looked up.
  command.onParsed([options] {
    int wrong = kOk;
    if (!options->scenarioFile.empty())
      wrong = readRunScenario(options->scenarioFile, options->source, options->scenario);
    return wrong == kOk ? takeProject(options->source) : wrong;
  });
  command.onRun([options, &status] { status = runProgram(*options); });
}

} // namespace rung::rungc

// Shared by the commands that run scenarios.
#include "tools/rungc/scenarios.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>
#include <pugixml.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <utility>

#include "frontend/dialects/dialect.h"
#include "ir/support/utf8.h"
#include "rtlib/nc/config_key.h"
#include "tools/replay/session_past.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/session.h"

namespace rung::rungc {

Result<std::vector<compiler::EngineKind>> enginesOf(const std::string& names) {
  std::vector<compiler::EngineKind> engines;
  std::istringstream in(names);
  for (std::string name; std::getline(in, name, ',');) {
    if (name == "all") {
      engines.assign(compiler::allEngines().begin(), compiler::allEngines().end());
      continue;
    }
    const auto kind = compiler::engineFromName(name);
    if (!kind)
      return failure(fmt::format("unknown engine '{}'; the engines are interp, cpp, llvm, jit, tiered and all", name));
    engines.push_back(*kind);
  }
  return engines;
}

TestCase runOne(const std::string& path, const scenario::RunOptions& options) {
  TestCase test{path, 0, {}};
  const auto start = std::chrono::steady_clock::now();
  Result<scenario::Scenario> parsed = scenario::readScenario(path);
  if (!parsed.ok())
    test.result.environment = parsed.error();
  else
    test.result = replay::runAndExplain(parsed.value(), options);
  test.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return test;
}

std::string shownSeconds(double seconds) {
  return seconds < 1 ? fmt::format("{:.0f} ms", seconds * 1000) : fmt::format("{:.2f} s", seconds);
}

void printResult(const TestCase& test, bool color) {
  const scenario::RunResult& result = test.result;
  const auto painted = [&](const char* word, const char* paint) {
    return color ? fmt::format("\033[{}m{}\033[0m", paint, word) : std::string(word);
  };
  if (result.passed)
    fmt::print("{}      {} ({} scans, {})\n", painted("ok", "32"), test.path, result.scans, shownSeconds(test.seconds));
  else
    fmt::print("{}  {}\n", painted("FAILED", "1;31"), test.path);
  for (const std::string& line : result.printed) fmt::print("  {}\n", line);
  for (const scenario::Problem& problem : result.problems) fmt::print("  {}\n", textOf(problem));
  if (!result.environment.empty()) fmt::print("  {}\n", result.environment);
  if (result.passed && result.expectsNothing)
    fmt::print("  {}: {}: it expects nothing, so it passes whatever the program does; add an expect statement\n",
               test.path, painted("warning", "1;35"));
}

// Selects the scenarios of a command.

namespace {

namespace fs = std::filesystem;

using Files = std::vector<std::string>;

std::optional<Files> scenariosBelow(const std::string& folder, int& status) {
  Files found;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code none;
    if (at->path().extension() == ".scn" && !at->is_directory(none))
      found.push_back(at->path().lexically_normal().string());
  }
  if (error || found.empty()) {
    status = usageError(error ? fmt::format("cannot read the folder '{}': {}", folder, error.message())
                              : fmt::format("there is no scenario (*.scn) in or below '{}'", folder));
    return std::nullopt;
  }
  std::ranges::sort(found);
  return found;
}

std::optional<Files> ofProject(const std::string& named, int& status) {
  const auto project = openProject(named, {}, status);
  if (!project) return std::nullopt;
  if (!project->scenarios.empty()) return project->scenarios;
  status = usageError(fmt::format("{} has no scenario: no file matches its key scenarios", project->file));
  return std::nullopt;
}

std::optional<Files> oneFile(const std::string& name, int& status) {
  const std::string problem = scenario::notAScenario(name);
  if (problem.empty()) return Files{name};
  status = usageError(problem);
  return std::nullopt;
}

bool matches(const std::string& path, const std::string& filter) {
  if (filter.find_first_of("*?[") == std::string::npos) return path.find(filter) != std::string::npos;
  const std::string name = fs::path(path).filename().string();
  return fnmatch(filter.c_str(), path.c_str(), 0) == 0 || fnmatch(filter.c_str(), name.c_str(), 0) == 0;
}

} // namespace

std::optional<std::vector<std::string>> scenarioFiles(const std::vector<std::string>& names, int& status) {
  if (names.empty()) return ofProject("", status);
  std::vector<std::string> files;
  for (const std::string& name : names) {
    std::error_code none;
    std::optional<std::vector<std::string>> found;
    const bool isFolder = fs::is_directory(name, none);
    if (isFolder ? fs::is_regular_file(fs::path(name) / compiler::kFileName, none) : namesProject(name))
      found = ofProject(name, status);
    else
      found = isFolder ? scenariosBelow(name, status) : oneFile(name, status);
    if (!found) return std::nullopt;
    std::ranges::move(*found, std::back_inserter(files));
  }
  return files;
}

std::vector<std::string> filtered(const std::vector<std::string>& files, const std::vector<std::string>& filters) {
  std::vector<std::string> out;
  std::ranges::copy_if(files, std::back_inserter(out), [&](const std::string& file) {
    return filters.empty() || std::ranges::any_of(filters, [&](const std::string& f) { return matches(file, f); });
  });
  return out;
}

// JUnit XML, written with pugixml.

namespace {

// XML 1.0 allows neither control characters nor U+FFFE and U+FFFF; texts of scenarios and programs may contain
// anything.
std::string inXml(std::string_view text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const CodePoint character = decodeUtf8(text, at);
    const uint32_t c = character.value;
    if (!character.valid || c == 0xFFFE || c == 0xFFFF)
      out += "\uFFFD";
    else if (c < ' ' && c != '\n' && c != '\t')
      out += '?';
    else
      out += text.substr(at, character.length);
    at += character.length;
  }
  return out;
}

void addText(pugi::xml_node parent, const char* name, std::string_view text) {
  parent.append_child(name).text().set(inXml(text).c_str());
}

void addFailure(pugi::xml_node parent, const scenario::RunResult& result) {
  std::string text = result.environment;
  for (const scenario::Problem& problem : result.problems) text += (text.empty() ? "" : "\n") + textOf(problem);
  const char* name = result.environment.empty() ? "failure" : "error";
  addText(parent, name, text);
  parent.last_child().append_attribute("message") = inXml(text.substr(0, text.find('\n'))).c_str();
}

void addCase(pugi::xml_node suite, const TestCase& test) {
  pugi::xml_node element = suite.append_child("testcase");
  element.append_attribute("classname") = "rungc";
  element.append_attribute("name") = inXml(test.path).c_str();
  element.append_attribute("time") = fmt::format("{:.6f}", test.seconds).c_str();
  if (!test.result.passed) addFailure(element, test.result);
  if (!test.result.printed.empty())
    addText(element, "system-out", fmt::format("{}", fmt::join(test.result.printed, "\n")));
}

} // namespace

std::string junitXml(const std::vector<TestCase>& tests) {
  const auto failed = [](const TestCase& t) { return !t.result.passed && t.result.environment.empty(); };
  const auto notRun = [](const TestCase& t) { return !t.result.passed && !t.result.environment.empty(); };
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node suite = document.append_child("testsuite");
  suite.append_attribute("name") = "rungc";
  suite.append_attribute("tests") = tests.size();
  suite.append_attribute("failures") = std::ranges::count_if(tests, failed);
  suite.append_attribute("errors") = std::ranges::count_if(tests, notRun);
  for (const TestCase& test : tests) addCase(suite, test);
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return std::move(out).str();
}

// Reads the scenario of a run.

namespace {

namespace fs = std::filesystem;
using scenario::Kind;
using scenario::Statement;

std::string inFolderOf(const std::string& file, const std::string& name) {
  return (fs::path(file).parent_path() / name).lexically_normal().string();
}

// Files that the control reads are relative to the scenario.
std::string configOf(const Statement& s) {
  for (const frontend::Dialect* dialect : frontend::allDialects()) {
    const nc::ConfigKey* row = nc::findConfigKey(dialect->configKeys, s.name);
    if (row != nullptr && row->form == nc::ConfigForm::File && row->reader == nc::ConfigReader::Control)
      return s.name + "=" + inFolderOf(s.file, s.value.text);
  }
  return s.name + "=" + s.value.text;
}

// A scenario without a program runs that of the project that contains it.
int findProgram(const std::string& path, const std::vector<std::string>& programs, SourceOptions& options) {
  if (!options.files.empty() || !options.projectFile.empty()) return kOk;
  if (!programs.empty()) {
    options.files = programs;
    options.noProject = true;
    return kOk;
  }
  const auto project = compiler::findUpwards(fs::path(path).parent_path().lexically_normal().string());
  if (!project) return usageError(fmt::format("{} names no program and is not in a project: name the program", path));
  options.projectFile = *project;
  return kOk;
}

} // namespace

int readRunScenario(const std::string& path, SourceOptions& options, RunScenario& scenario) {
  Result<scenario::Scenario> read = scenario::readStatements(path);
  if (!read.ok()) return environmentError(read.error());
  for (const scenario::Problem& problem : read.value().problems) fmt::print(stderr, "{}\n", textOf(problem));
  if (!read.value().problems.empty()) return kWrong;
  std::vector<std::string> programs;
  std::vector<std::string> config;
  std::string dialect;
  for (Statement& s : read.value().statements) {
    switch (s.kind) {
    case Kind::Program:
      for (const std::string& file : s.words) programs.push_back(inFolderOf(s.file, file));
      break;
    case Kind::Dialect: dialect = s.name; break;
    case Kind::Config: config.push_back(configOf(s)); break;
    case Kind::Connect: scenario.connects.push_back(std::move(s)); break;
    case Kind::Period: scenario.periodUs = s.microseconds; break;
    case Kind::ExpectError:
      return usageError(
          fmt::format("{}:{}: the program of this scenario does not compile, so it cannot be run", s.file, s.line));
    case Kind::ExpectWarning:
    case Kind::AllowErrors: break; // diagnostics are printed anyway
    default: scenario.statements.push_back(std::move(s));
    }
  }
  options.config.insert(options.config.begin(), config.begin(), config.end());
  const bool ownProgram = options.files.empty() && options.projectFile.empty();
  if (ownProgram && options.dialect.empty()) options.dialect = dialect;
  return findProgram(path, programs, options);
}

// The trace of a scenario.

void ScenarioTrace::addTo(Command command) {
  Option trace =
      command.option("--trace", path_,
                     "Write the values of names after every scan to FILE.vcd (changes) or FILE.csv (one row per scan)");
  command.option("--watch", names_, "Names to trace; default: every name and address that the rungs use")
      .needs(trace)
      .manyValues();
}

std::string ScenarioTrace::problem(size_t scenarios) const {
  if (!wanted()) return {};
  if (scenarios != 1) return fmt::format("--trace takes one scenario, not {}", scenarios);
  const std::string file = scenario::traceFileProblem(path_);
  return file.empty() ? file : "--trace: " + file;
}

void ScenarioTrace::attach(scenario::RunOptions& run) {
  if (!wanted()) return;
  refused_ = false;
  run.started = [this](scenario::Session& session, const compiler::Compiled& program) {
    return begin(session, program);
  };
}

std::string ScenarioTrace::begin(scenario::Session& session, const compiler::Compiled& program) {
  const rung_program& tables = session.instance().program();
  const std::vector<std::string> names =
      names_.empty() ? scenario::defaultTraceNames(tables, program.uses.get()) : names_;
  std::string unknown = scenario::Trace::nameProblem(names, session.instance(), session.nc());
  refused_ = !unknown.empty();
  if (refused_) return "--watch: " + unknown;
  Result<std::unique_ptr<scenario::Trace>> trace =
      scenario::Trace::open(path_, names, session.instance(), session.nc());
  if (!trace.ok()) return trace.error();
  trace_ = std::move(trace).value();
  session.addObserver(*trace_);
  return {};
}

std::string ScenarioTrace::finish() {
  if (trace_ == nullptr) return {};
  const std::string error = trace_->finish();
  trace_.reset();
  return error;
}

} // namespace rung::rungc

// Reads scenario files (see scenario.h): lines to statements, included files in place, the order of statements.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <optional>
#include <sstream>

#include "compiler/project.h"
#include "ir/support/utf8.h"
#include "rtlib/text/end_of_file.h"
#include "rtlib/text/regular_file.h"
#include "tools/scenario/in_project.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/statements.h"

namespace rung::scenario {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostIncludes = 1000; // limits files that include each other

// The text of a file that should be a scenario.
Result<std::string> readText(const std::string& path) {
  if (std::string problem = notAScenario(path); !problem.empty()) return failure(std::move(problem));
  std::string contents;
  const std::string problem = text::readRegular(path, text::kMostSource, contents);
  if (!problem.empty()) return failure(fmt::format("cannot read '{}': {}", path, problem));
  return contents;
}

class Reader {
public:
  explicit Reader(Scenario& scenario) : scenario_(scenario) {}

  void readFile(const std::string& path, std::string_view text) {
    std::error_code none;
    open_.push_back({path, fs::weakly_canonical(path, none)});
    text = text::upToEndOfFile(text);
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    uint32_t number = 0;
    while (!text.empty()) {
      const size_t end = std::min(text.find('\n'), text.size());
      readLine(++number, text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    open_.pop_back();
  }

private:
  struct Open {
    std::string path; // for display
    fs::path canonical;
  };

  void readLine(uint32_t number, std::string_view line) {
    if (includes_ > kMostIncludes) return; // reported once
    ParsedLine parsed = parseLine(line);
    if (parsed.statement) {
      parsed.statement->file = open_.back().path;
      parsed.statement->line = number;
      parsed.problem = take(std::move(*parsed.statement));
    }
    if (parsed.problem.empty()) return;
    scenario_.problems.push_back({open_.back().path, number, std::move(parsed.problem)});
    scenario_.startUnknown = scenario_.startUnknown || parsed.shapesStart;
  }

  // Returns "" or what is wrong.
  std::string take(Statement statement) {
    if (statement.kind == Kind::Include) return include(statement.name);
    const StatementInfo& info = StatementInfo::of(statement);
    advanced_ = advanced_ || info.advances != Advance::Nothing;
    if (advanced_ && info.stage == Stage::Start) return "config, connect and period must come before the first scan";
    scenario_.statements.push_back(std::move(statement));
    return {};
  }

  std::string include(const std::string& name) {
    const fs::path path = (fs::path(open_.back().path).parent_path() / name).lexically_normal();
    std::error_code none;
    const fs::path canonical = fs::weakly_canonical(path, none);
    for (size_t i = 0; i < open_.size(); ++i)
      if (open_[i].canonical == canonical) return cycle(i, name);
    scenario_.files.push_back(path.string());
    if (++includes_ > kMostIncludes) return fmt::format("more than {} files are included", kMostIncludes);
    const Result<std::string> text = readText(path.string());
    if (!text.ok()) return text.error();
    readFile(path.string(), text.value());
    return {};
  }

  std::string cycle(size_t first, const std::string& name) const {
    std::string chain;
    for (size_t i = first; i < open_.size(); ++i) chain += open_[i].path + " includes ";
    return fmt::format("a file cannot include itself: {}{}", chain, name);
  }

  Scenario& scenario_;
  std::vector<Open> open_; // files being read, the innermost last
  size_t includes_ = 0;
  bool advanced_ = false;
};

} // namespace

namespace {

Scenario parseLines(std::string path, std::string_view text) {
  Scenario scenario;
  scenario.path = std::move(path);
  scenario.files.push_back(scenario.path);
  Reader(scenario).readFile(scenario.path, text);
  return scenario;
}

} // namespace

Scenario parse(std::string path, std::string_view text) {
  Scenario scenario = parseLines(std::move(path), text);
  if (!scenario.statements.empty() && scenario.statements[0].kind == Kind::Program) return scenario;
  if (!scenario.startUnknown && takeProject(scenario)) return scenario;
  if (!scenario.startUnknown) // otherwise the line that cannot be parsed may be the missing one
    scenario.problems.insert(
        scenario.problems.begin(),
        {scenario.path, 1, "a scenario begins with: program FILE; only in a project it may be left out"});
  scenario.startUnknown = true;
  return scenario;
}

std::string notAScenario(const std::string& path) {
  const std::string other = compiler::otherKind(path, compiler::FileKind::Scenario);
  if (other.empty() || compiler::kindOfFile(path) != compiler::FileKind::Program) return other;
  return fmt::format("{}; a scenario is a file of its own that begins with: program {}", other,
                     fs::path(path).filename().string());
}

Result<Scenario> readScenario(const std::string& path) {
  const Result<std::string> text = readText(path);
  if (!text.ok()) return text.failure();
  return parse(path, text.value());
}

Result<Scenario> readStatements(const std::string& path) {
  const Result<std::string> text = readText(path);
  if (!text.ok()) return text.failure();
  return parseLines(path, text.value());
}

std::string textOf(const Problem& problem) {
  return fmt::format("{}:{}: {}", problem.file, problem.line, problem.message);
}

bool wantsReal(const Statement& statement) {
  return statement.near || statement.value.kind == ValueKind::Real || statement.high.kind == ValueKind::Real;
}

bool expectsNothing(const Scenario& scenario) {
  return std::ranges::none_of(scenario.statements, [](const Statement& s) { return StatementInfo::of(s).expects; });
}

} // namespace rung::scenario

// rungc opt: runs passes of the optimiser by name, on a program's IR or a module as text.
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <memory>
#include <ranges>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/pipeline.h"
#include "ir/verify/verify.h"
#include "rtlib/text/regular_file.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

constexpr std::string_view kEnding = ".rir";
constexpr std::string_view kAll = "all";

struct OptOptions {
  SourceOptions source;
  std::string passes; // joined by commas; empty: the passes of `build`
  std::vector<std::string> printAfter;
  bool statistics = false;
  bool verifyEach = false;
  std::string out;
};

std::string knownPasses() {
  std::vector<std::string_view> names;
  for (const ir::Pass& pass : ir::allPasses()) names.push_back(pass.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// On failure nothing, and `status` says why: a name is not that of a pass.
std::vector<const ir::Pass*> passesOf(const OptOptions& options, int& status) {
  std::vector<const ir::Pass*> passes;
  const auto add = [&](std::string_view name) {
    const ir::Pass* pass = ir::findPass(name);
    if (pass == nullptr)
      status = usageError(fmt::format("'{}' is not a pass; the passes are {}", name, knownPasses()));
    else
      passes.push_back(pass);
  };
  if (options.passes.empty())
    for (const std::string_view name : ir::optimisingPasses()) add(name);
  else
    for (const auto name : std::views::split(options.passes, ',')) add(std::string_view(name.begin(), name.end()));
  for (const std::string& name : options.printAfter)
    if (name != kAll && ir::findPass(name) == nullptr)
      status = usageError(
          fmt::format("--print-after takes {} or the name of a pass ({}), found '{}'", kAll, knownPasses(), name));
  for (size_t i = 1; i < passes.size(); ++i)
    if (passes[i - 1]->last)
      status = usageError(fmt::format("no pass can follow '{}', found '{}'", passes[i - 1]->name, passes[i]->name));
  return passes;
}

std::unique_ptr<ir::Module> moduleInFile(const std::string& file, int& status) {
  std::string text;
  if (const std::string problem = text::readRegular(file, text::kMostSource, text); !problem.empty()) {
    status = environmentError(fmt::format("cannot read {}: {}", file, problem));
    return nullptr;
  }
  ir::ParseOutcome parsed = ir::parse(text);
  if (!parsed.module) {
    fmt::print(stderr, "{}:{}:{}: {}\n", file, parsed.error.line, parsed.error.column, parsed.error.message);
    status = kWrong;
    return nullptr;
  }
  if (parsed.module->instrumented) {
    fmt::print(stderr, "{}: the module is instrumented: no pass can follow; run the passes on the module before\n",
               file);
    status = kWrong;
    return nullptr;
  }
  const std::vector<ir::VerifyError> errors = ir::verify(*parsed.module, ir::Mode::Built);
  if (!errors.empty()) {
    fmt::print(stderr, "{}: the module is not valid\n{}", file, ir::render(*parsed.module, errors));
    status = kWrong;
    return nullptr;
  }
  return std::make_unique<ir::Module>(std::move(*parsed.module));
}

// The module as the front end made it, before the pipeline.
std::unique_ptr<ir::Module> moduleOfSources(const SourceOptions& options, int& status) {
  SourceManager sources;
  compiler::CompileRequest request;
  request.optimise = false;
  request.keepBuilt = true;
  auto compiled = compileSources(sources, options, std::move(request), status);
  return compiled ? std::move(compiled->built) : nullptr;
}

bool isModuleText(const std::string& file) { return file.ends_with(kEnding); }

// From a single module text, or from sources. On failure `status` says why.
std::unique_ptr<ir::Module> moduleOf(const SourceOptions& options, int& status) {
  if (std::ranges::none_of(options.files, isModuleText)) return moduleOfSources(options, status);
  if (options.files.size() == 1) return moduleInFile(options.files[0], status);
  status =
      usageError(fmt::format("a module as text ({}) is the only file, found {} files", kEnding, options.files.size()));
  return nullptr;
}

// Statistics of one run of a pass.
struct PassCount {
  std::string_view name;
  size_t operations = 0; // number after the pass
  size_t rungs = 0;      // number of changed or added rungs
};

size_t operationsOf(const ir::Module& module) {
  size_t sum = 0;
  for (const ir::Routine& routine : module.routines)
    for (const ir::Rung& rung : routine.rungs) sum += rung.ops.size();
  return sum;
}

bool hasSameCode(const ir::Rung& a, const ir::Rung& b) {
  return a.ops == b.ops && a.args == b.args && a.values == b.values && a.transfer == b.transfer;
}

// Compares by position; added or removed rungs count at theirs.
size_t changedRungs(const ir::Module& before, const ir::Module& after) {
  size_t changed = 0;
  const size_t routines = std::max(before.routines.size(), after.routines.size());
  for (size_t r = 0; r < routines; ++r) {
    const std::span<const ir::Rung> was =
        r < before.routines.size() ? std::span<const ir::Rung>(before.routines[r].rungs) : std::span<const ir::Rung>();
    const std::span<const ir::Rung> is =
        r < after.routines.size() ? std::span<const ir::Rung>(after.routines[r].rungs) : std::span<const ir::Rung>();
    const size_t common = std::min(was.size(), is.size());
    changed += std::max(was.size(), is.size()) - common;
    for (size_t i = 0; i < common; ++i) changed += hasSameCode(was[i], is[i]) ? 0 : 1;
  }
  return changed;
}

// All text of the module except the routines, line by line.
std::set<std::string> declarationsOf(const ir::Module& module) {
  std::set<std::string> lines;
  bool declares = true;
  std::istringstream text(ir::print(module));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("routine ")) declares = false;
    if (declares && !line.empty()) lines.insert(line);
    if (line == "}") declares = true;
  }
  return lines;
}

std::string codeOf(const ir::Module& module) {
  std::string text;
  for (uint32_t r = 0; r < module.routines.size(); ++r) {
    text += fmt::format("routine {} {{\n", module.routines[r].name);
    for (uint32_t i = 0; i < module.routines[r].rungs.size(); ++i) text += ir::printRung(module, ir::RoutineId{r}, i);
    text += "}\n";
  }
  return text;
}

class Optimiser {
public:
  Optimiser(ir::Module& module, const OptOptions& options)
      : module_(module), options_(options), before_(module), first_(operationsOf(module)),
        declared_(options.printAfter.empty() ? std::set<std::string>() : declarationsOf(module)),
        runner_(module, [this](const ir::Pass& pass, const ir::Module&) { ran(pass); }) {}

  // Returns the exit status.
  int run(std::span<const ir::Pass* const> passes) {
    for (const ir::Pass* pass : passes) {
      runner_.run(*pass);
      if (!error_.empty()) {
        fmt::print(stderr, "rungc: the module is not valid after '{}', pass {}\n{}", pass->name, counts_.size(),
                   error_);
        return kWrong;
      }
    }
    return kOk;
  }

  void printStatistics() const {
    fmt::print("{:<12} {:>10} {:>10} {:>8}\n{:<12} {:>10}\n", "pass", "operations", "fewer", "rungs", "", first_);
    size_t before = first_;
    for (const PassCount& count : counts_) {
      const auto fewer = static_cast<int64_t>(before) - static_cast<int64_t>(count.operations);
      fmt::print("{:<12} {:>10} {:>10} {:>8}\n", count.name, count.operations, fewer, count.rungs);
      before = count.operations;
    }
  }

private:
  void ran(const ir::Pass& pass) {
    counts_.push_back({pass.name, operationsOf(module_), options_.statistics ? changedRungs(before_, module_) : 0});
    if (options_.statistics) before_ = module_;
    if (!options_.printAfter.empty()) print(pass);
    if (!options_.verifyEach) return;
    const auto errors = ir::verify(module_, module_.instrumented ? ir::Mode::Final : ir::Mode::Built);
    if (!errors.empty()) error_ = ir::render(module_, errors);
  }

  // Prints the rungs, and the declarations that the pass has changed.
  void print(const ir::Pass& pass) {
    std::set<std::string> before = std::exchange(declared_, declarationsOf(module_));
    if (!prints(pass)) return;
    fmt::print("; after {}, pass {}\n", pass.name, counts_.size());
    for (const std::string& line : declared_)
      if (!before.contains(line)) fmt::print("{}\n", line);
    fmt::print("{}\n", codeOf(module_));
  }
  bool prints(const ir::Pass& pass) const {
    return std::ranges::any_of(options_.printAfter,
                               [&](const std::string& name) { return name == kAll || name == pass.name; });
  }

  ir::Module& module_;
  const OptOptions& options_;
  ir::Module before_; // before the last pass, for statistics
  size_t first_;
  std::set<std::string> declared_; // after the last pass, if passes are printed
  ir::PassRunner runner_;
  std::vector<PassCount> counts_;
  std::string error_;
};

int runOpt(const OptOptions& options) {
  int status = kOk;
  const std::vector<const ir::Pass*> passes = passesOf(options, status);
  if (status != kOk) return status;
  const std::unique_ptr<ir::Module> module = moduleOf(options.source, status);
  if (module == nullptr) return status;
  Optimiser optimiser(*module, options);
  status = optimiser.run(passes);
  if (options.statistics) optimiser.printStatistics();
  const bool printsOther = options.statistics || !options.printAfter.empty();
  if (status != kOk || (options.out.empty() && printsOther)) return status;
  return writeOutput(ir::print(*module), options.out);
}

} // namespace

void addOpt(CommandLine& app, int& status) {
  Command command =
      app.add("opt", "Run passes of the optimiser by name on sources or on a module as text (.rir), and print the IR");
  auto options = std::make_shared<OptOptions>();
  addSourceOptions(command, options->source);
  command.option("--passes", options->passes, "The passes in order, joined by commas; default: those that build runs");
  command
      .option("--print-after", options->printAfter,
              "Print the rungs and the changed declarations after each run of this pass, or after every one (all), and "
              "not the module; may be repeated")
      .oneValue();
  command.flag("--statistics", options->statistics,
               "Print the operations left and the rungs changed by each pass, and not the module");
  command.flag("--verify-each", options->verifyEach, "Verify the IR after each pass");
  command.option("-o,--output", options->out, "The file to write; default, or with -: standard output");
  command.onRun([options, &status] { status = runOpt(*options); });
}

} // namespace rung::rungc

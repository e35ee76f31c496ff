// rungc opt: passes of the optimiser by name, over a program's IR or a module as text.
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/transforms/pipeline.h"
#include "ir/verify/verify.h"
#include "tools/mapping/file.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

constexpr std::string_view kEnding = ".rir";
constexpr std::string_view kAll = "all";

struct OptOptions {
  SourceOptions source;
  std::string passes; // joined by commas; empty: those that `build` runs
  std::vector<std::string> printAfter;
  bool statistics = false;
  bool verifyEach = false;
  std::string out;
};

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  for (size_t at = 0; at <= text.size();) {
    const size_t comma = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

std::string knownPasses() {
  std::vector<std::string_view> names;
  for (const ir::Pass& pass : ir::allPasses()) names.push_back(pass.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// Nothing, and `status` says why, where a name is not one of a pass.
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
    for (const std::string& name : splitAtCommas(options.passes)) add(name);
  for (const std::string& name : options.printAfter)
    if (name != kAll && ir::findPass(name) == nullptr)
      status = usageError(
          fmt::format("--print-after takes {} or the name of a pass ({}), found '{}'", kAll, knownPasses(), name));
  return passes;
}

std::unique_ptr<ir::Module> moduleInFile(const std::string& file, int& status) {
  std::string text;
  try {
    text = mapping::readFromDisk(file);
  } catch (const std::exception& error) {
    status = environmentError(error.what());
    return nullptr;
  }
  ir::ParseOutcome parsed = ir::parse(text);
  if (!parsed.module) {
    fmt::print(stderr, "{}:{}:{}: {}\n", file, parsed.error.line, parsed.error.column, parsed.error.message);
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

// As the front end has made it, before the pipeline.
std::unique_ptr<ir::Module> moduleOfSources(const SourceOptions& options, int& status) {
  SourceManager sources;
  compiler::CompileRequest request;
  request.optimise = false;
  request.keepBuilt = true;
  auto compiled = compileSources(sources, options, std::move(request), status);
  return compiled ? std::move(compiled->built) : nullptr;
}

bool isModuleText(const std::vector<std::string>& files) { return files.size() == 1 && files[0].ends_with(kEnding); }

// What one run of a pass has done.
struct PassCount {
  std::string_view name;
  size_t operations = 0; // afterwards
  size_t rungs = 0;      // that it has changed or added
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

// By position; rungs that a pass adds or removes count where they are.
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

// The routines alone: no pass changes what the module declares.
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
        runner_(module, [this](const ir::Pass& pass, const ir::Module&) { ran(pass); }) {}

  // Gives the exit status.
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
    if (prints(pass)) fmt::print("; after {}, pass {}\n{}\n", pass.name, counts_.size(), codeOf(module_));
    if (!options_.verifyEach) return;
    const auto errors = ir::verify(module_, module_.instrumented ? ir::Mode::Final : ir::Mode::Built);
    if (!errors.empty()) error_ = ir::render(module_, errors);
  }

  bool prints(const ir::Pass& pass) const {
    return std::ranges::any_of(options_.printAfter,
                               [&](const std::string& name) { return name == kAll || name == pass.name; });
  }

  ir::Module& module_;
  const OptOptions& options_;
  ir::Module before_; // the last pass, for the statistics
  size_t first_;
  ir::PassRunner runner_;
  std::vector<PassCount> counts_;
  std::string error_;
};

int runOpt(const OptOptions& options) {
  int status = kOk;
  const std::vector<const ir::Pass*> passes = passesOf(options, status);
  if (status != kOk) return status;
  const std::unique_ptr<ir::Module> module = isModuleText(options.source.files)
                                                 ? moduleInFile(options.source.files[0], status)
                                                 : moduleOfSources(options.source, status);
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
  Command command = app.add("opt", "Run passes of the optimiser by name and print the IR");
  auto options = std::make_shared<OptOptions>();
  addSourceOptions(command, options->source);
  command.option("--passes", options->passes, "The passes in order, joined by commas; default: those that build runs");
  command
      .option(
          "--print-after", options->printAfter,
          "Print the rungs after each run of this pass, or after every one (all), and not the module; may be repeated")
      .oneValue();
  command.flag("--statistics", options->statistics,
               "Print the operations left and the rungs changed by each pass, and not the module");
  command.flag("--verify-each", options->verifyEach, "Verify the IR after each pass");
  command.option("-o,--output", options->out, "The file to write; default, or with -: standard output");
  command.onRun([options, &status] { status = runOpt(*options); });
}

} // namespace rung::rungc

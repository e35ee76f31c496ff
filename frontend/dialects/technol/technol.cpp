// Entry of the dialect: compiles source files into a module.
#include "frontend/dialects/technol/technol.h"

#include <set>

#include "frontend/dialects/technol/check/analysis.h"
#include "frontend/dialects/technol/check/check_program.h"
#include "frontend/dialects/technol/draw/charts.h"
#include "frontend/dialects/technol/format.h"
#include "frontend/dialects/technol/lower/assemble.h"
#include "frontend/dialects/technol/read/reader.h"
#include "frontend/dialects/technol/reference.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"
#include "ir/support/diag/technol.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {
namespace {

constexpr std::string_view kExtensions[] = {".plc"};
constexpr std::string_view kShownSpaces[] = {"IO"}; // variables of MAP_* and DEF_*

uint32_t periodOf(const CompileOptions& options, Diagnostics& diagnostics) {
  const auto found = options.config.find("period_us");
  if (found == options.config.end()) return kDefaultPeriodUs;
  const nc::ConfigKey& row = *nc::findConfigKey(nc::technolConfigKeys(), "period_us");
  if (nc::wrongValue(row, row.key, found->second).empty()) return static_cast<uint32_t>(nc::wholeNumber(found->second));
  diagnostics.report(diag::OperandRange, options.placeOf("period_us"))
      << "period_us " + found->second << nc::takesOf(row);
  return kDefaultPeriodUs;
}

// "XYZA" as "X Y Z A".
std::string axisNamesOf(const CompileOptions& options) {
  std::string names;
  const auto letters = options.config.find("axes");
  if (letters == options.config.end()) return names;
  for (const char letter : letters->second) names.append(names.empty() ? "" : " ").append(1, letter);
  return names;
}

class TechnolProgram : public CheckedProgram {
public:
  TechnolProgram(SourceManager& sources, std::span<const FileId> files, const CompileOptions& options,
                 Diagnostics& diagnostics)
      : files_(files.begin(), files.end()), options_(options), source_(sources), symbols_(diagnostics) {
    ReadOptions reading{.includePaths = options.includePaths};
    if (const auto folder = options.config.find("system_folder"); folder != options.config.end())
      reading.systemFolder = folder->second;
    readProgram({sources, reading, diagnostics, source_, declarations_, symbols_}, files);
    period_ = periodOf(options, diagnostics);
    typed_.emplace(checkProgram(source_, declarations_, symbols_, axisNamesOf(options), diagnostics));
    analysis_ = analysisOf(*typed_);
  }

  const Analysis& analysis() const override { return analysis_; }

  std::unique_ptr<ir::Module> build() override {
    auto module = std::make_unique<ir::Module>();
    module->name = source_.sources.name(files_[0]);
    module->dialect = "technol";
    for (const FileId file : files_) module->files.emplace_back(source_.sources.name(file));
    addSpaces(declarations_, *module);
    Walk walk(*typed_, *module, period_, options_.marks, options_.given);
    const LoweredProgram lowered = walk.run();
    addTasks(declarations_, lowered, walk.emitter(), period_);
    addSymbols(*typed_, *module, options_.given != nullptr);
    numberRungs(source_, *module);
    trace_ = walk.takeTrace();
    return module;
  }

  std::optional<chart::Program> charts(const ir::Module& built) const override {
    return chartsOf(*typed_, analysis_, trace_, built);
  }

private:
  const std::vector<FileId> files_;
  const CompileOptions options_;
  SourceProgram source_;
  Declarations declarations_;
  Symbols symbols_;
  uint32_t period_ = kDefaultPeriodUs;
  std::optional<TypedProgram> typed_;
  Analysis analysis_;
  Trace trace_;
};

std::unique_ptr<CheckedProgram> check(SourceManager& sources, std::span<const FileId> files,
                                      const CompileOptions& options, Diagnostics& diagnostics) {
  return std::make_unique<TechnolProgram>(sources, files, options, diagnostics);
}

// Included files, each once, in the order in which they are read.
std::vector<std::string> included(SourceManager& sources, std::span<const FileId> files,
                                  const CompileOptions& options) {
  std::set<std::string_view> seen;
  for (const FileId file : files) seen.insert(sources.name(file));
  Diagnostics discarded;
  SourceProgram program(sources);
  Declarations declarations;
  Symbols symbols(discarded);
  const auto before = static_cast<uint32_t>(sources.fileCount());
  // Adds the included files to `sources`.
  readProgram({sources, {.includePaths = options.includePaths}, discarded, program, declarations, symbols}, files);
  std::vector<std::string> names;
  for (uint32_t i = before; i < sources.fileCount(); ++i)
    if (const std::string_view name = sources.name(FileId{i}); seen.insert(name).second) names.emplace_back(name);
  return names;
}

} // namespace

static bool isBuilt(const InstructionInfo&) { return true; }

const Dialect kTechnol = {
    .name = "technol",
    .title = "TECHNOL, PLC836 of the MEFI CNC8x9",
    .extensions = kExtensions,
    .configKeys = nc::technolConfigKeys(),
    .instructions = instructionInfos(),
    .signals = nc::technolSignals,
    .shownSpaces = kShownSpaces,
    .isBuilt = isBuilt,
    .check = check,
    .format = format,
    .included = included,
    .reference = addReference,
    .explain = explainWord,
    .listing = listing,
};

} // namespace rung::frontend::technol

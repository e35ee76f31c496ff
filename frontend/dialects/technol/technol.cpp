// The dialect's entry: source files to a module.
#include "frontend/dialects/technol/technol.h"

#include "frontend/dialects/technol/check/check_program.h"
#include "frontend/dialects/technol/listing.h"
#include "frontend/dialects/technol/lower/assemble.h"
#include "frontend/dialects/technol/read/encoding.h"
#include "frontend/dialects/technol/read/reader.h"
#include "frontend/dialects/technol/reference.h"
#include "frontend/dialects/technol/rows/operand_kinds.h"

namespace rung::frontend {
namespace {

constexpr std::string_view kExtensions[] = {".plc"};

uint32_t periodOf(const CompileOptions& options, Diagnostics& diagnostics) {
  const auto found = options.config.find("period_us");
  if (found == options.config.end()) return technol::kDefaultPeriodUs;
  const nc::ConfigKey& row = *nc::findConfigKey(nc::technolConfigKeys(), "period_us");
  if (nc::wrongValue(row, row.key, found->second).empty()) return static_cast<uint32_t>(nc::wholeNumber(found->second));
  diagnostics.report(Diag::OperandRange, options.placeOf("period_us"))
      << "period_us " + found->second << nc::takesOf(row);
  return technol::kDefaultPeriodUs;
}

technol::Encoding encodingOf(const CompileOptions& options, Diagnostics& diagnostics) {
  const auto found = options.config.find("encoding");
  if (found == options.config.end()) return technol::Encoding::Detect;
  const technol::Encoding encoding = technol::encodingNamed(found->second);
  if (encoding == technol::Encoding::Detect)
    diagnostics.report(Diag::OperandRange, options.placeOf("encoding"))
        << "encoding " + found->second << nc::takesOf(*nc::findConfigKey(nc::technolConfigKeys(), "encoding"));
  return encoding;
}

std::unique_ptr<ir::Module> compile(SourceManager& sources, std::span<const FileId> files,
                                    const CompileOptions& options, Diagnostics& diagnostics) {
  technol::Program program(sources, diagnostics);
  if (const auto folder = options.config.find("system_folder"); folder != options.config.end())
    program.systemFolder = folder->second;
  program.includePaths = options.includePaths;
  program.encoding = encodingOf(options, diagnostics);
  technol::readProgram(program, files);
  const uint32_t period = periodOf(options, diagnostics);
  const technol::TypedProgram typed = technol::checkProgram(program);
  if (diagnostics.hasErrors()) return nullptr;
  auto module = std::make_unique<ir::Module>();
  module->name = sources.name(files[0]);
  module->dialect = "technol";
  for (const FileId file : files) module->files.emplace_back(sources.name(file));
  technol::addSpaces(program, *module);
  technol::Walk walk(program, typed, *module, period, options.marks);
  const technol::LoweredProgram lowered = walk.run();
  technol::addTasks(program, lowered, walk.emitter(), period);
  technol::addSymbols(program, *module);
  technol::numberRungs(*module);
  return module;
}

} // namespace

static bool isBuilt(const InstructionInfo& info) {
  for (const technol::Row& row : technol::allRows())
    if (&row.info == &info) return row.role != technol::Role::NotBuilt && row.role != technol::Role::NotBuiltService;
  return false;
}

const Dialect kTechnol = {
    .name = "technol",
    .title = "TECHNOL, PLC836 of the MEFI CNC8x9",
    .extensions = kExtensions,
    .configKeys = nc::technolConfigKeys(),
    .instructions = technol::instructionInfos(),
    .operandKinds = technol::operandKindInfos(),
    .isBuilt = isBuilt,
    .compile = compile,
    .reference = technol::reference,
    .explain = technol::explainWord,
    .listing = technol::listing,
};

} // namespace rung::frontend

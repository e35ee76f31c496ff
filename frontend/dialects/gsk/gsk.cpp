// The dialect's entry: reads all files, checks the program, lowers it.
#include "frontend/dialects/gsk/gsk.h"

#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/format.h"
#include "frontend/dialects/gsk/lower.h"
#include "frontend/dialects/gsk/messages.h"
#include "frontend/dialects/gsk/reading.h"
#include "frontend/dialects/gsk/reference.h"

namespace rung::gsk {
namespace {

std::vector<ir::MessageText> configuredMessages(SourceManager& sources, FileId program,
                                                const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto at = options.config.find("messages");
  if (at == options.config.end()) return {};
  return readMessages(sources, program, at->second, diagnostics);
}

std::unique_ptr<ir::Module> compile(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  if (options.strict) diagnostics.raiseToError({Diag::DuplicateCounter, Diag::DoubleCoil, Diag::MixedOutput}); // P29
  Context context{sources, diagnostics, {}, 0};
  Program program;
  checkConfig(options, diagnostics);
  context.machine = configuredMachine(options, diagnostics);
  if (files.empty()) return nullptr;
  Reading reading(context, program);
  for (FileId file : files) reading.add(file);
  const bool understood = reading.read();
  analyse(context, program, !understood);
  std::vector<ir::MessageText> texts = configuredMessages(sources, files[0], options, diagnostics);
  if (diagnostics.hasErrors()) return nullptr;
  std::unique_ptr<ir::Module> module = lowerProgram(program, context, files, options);
  if (diagnostics.hasErrors()) return nullptr; // a slot is too short
  module->messages = std::move(texts);
  return module;
}

constexpr std::string_view kExtensions[] = {".pmc"};

} // namespace

// Basic commands have no lowering function of their own: the network is theirs.
static bool isBuilt(const frontend::InstructionInfo& info) {
  const Row* row = info.number < 0 ? nullptr : findFunction(static_cast<uint64_t>(info.number));
  return row == nullptr || row->lower != nullptr || row->control == Control::End1 || row->control == Control::End2;
}

const frontend::Dialect kGsk = {
    .name = "gsk",
    .title = "GSK25iMc / GSK25iTc PLC",
    .extensions = kExtensions,
    .configKeys = nc::gskConfigKeys(),
    .instructions = instructionInfos(),
    .operandKinds = operandKindInfos(),
    .isBuilt = isBuilt,
    .compile = &compile,
    .format = &format,
    .reference = &referenceSections,
    .explain = &explainSignal,
};

} // namespace rung::gsk

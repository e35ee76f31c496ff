// The dialect's entry: reads all files, checks the program, lowers it.
#include "frontend/dialects/gsk/gsk.h"

#include <algorithm>

#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/ladder_reader.h"
#include "frontend/dialects/gsk/list_reader.h"
#include "frontend/dialects/gsk/lower.h"
#include "frontend/dialects/gsk/messages.h"
#include "frontend/dialects/gsk/reference.h"

namespace rung::gsk {
namespace {

// By the name; where it does not tell, ladder text is what has modules or rungs.
bool isLadder(const SourceManager& sources, FileId file) {
  const std::string_view name = sources.name(file);
  if (name.ends_with(".lad")) return true;
  if (name.ends_with(".pmc")) return false;
  LineReader lines(sources, file);
  LineWords words;
  for (SourceLine line; lines.next(line);) {
    splitWords(line, {}, words);
    if (!words.words.empty() && (words.words[0].text == "module" || words.words[0].text == "rung")) return true;
  }
  return false;
}

// All files of one program, command lists in front of ladder text.
class Reading {
public:
  Reading(Context& context, Program& program) : context_(context), units_(context, program) {}

  void add(FileId file) {
    if (isLadder(context_.sources, file))
      ladders_.push_back(parseLadderFile(context_, file)); // checks the encoding itself
    else if (checkEncoding(context_.sources, file, context_.diagnostics))
      lists_.push_back(file);
    else
      units_.setGarbled();
    last_ = file;
  }

  // True when all function commands were understood as such.
  bool read() {
    for (FileId file : lists_) readListSymbols(context_, file);
    for (const auto& file : ladders_) readLadderDeclarations(context_, file);
    for (FileId file : lists_) readList(context_, file, units_);
    if (!lists_.empty()) units_.endOfList(lastLineOf(context_.sources, lists_.back()));
    for (const auto& file : ladders_) readLadder(context_, file, units_);
    units_.finish(lastLineOf(context_.sources, last_));
    return !units_.garbled();
  }

private:
  Context& context_;
  UnitAssembler units_;
  std::vector<FileId> lists_;
  std::vector<ladder::LadderFile> ladders_;
  FileId last_;
};

Machine configuredMachine(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto at = options.config.find("machine");
  if (at == options.config.end()) return Machine::Any;
  if (at->second == "mill") return Machine::Mill;
  if (at->second == "turn") return Machine::Turn;
  diagnostics.report(Diag::ConstantOutOfRange) << "machine " + at->second << "mill, turn";
  return Machine::Any;
}

std::vector<ir::MessageText> configuredMessages(SourceManager& sources, FileId program,
                                                const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto at = options.config.find("messages");
  if (at == options.config.end()) return {};
  return readMessages(sources, program, at->second, diagnostics);
}

std::unique_ptr<ir::Module> compile(SourceManager& sources, std::span<const FileId> files,
                                    const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  if (options.strict) diagnostics.raiseToError({Diag::DuplicateCounter}); // P29
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
constexpr std::string_view kConfigKeys[] = {"tmr.*", "ctr.*", "slot_steps", "machine", "messages"};

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
    .configKeys = kConfigKeys,
    .instructions = instructionInfos(),
    .operandKinds = operandKindInfos(),
    .isBuilt = isBuilt,
    .compile = &compile,
    .reference = &referenceSections,
    .explain = &explainSignal,
};

} // namespace rung::gsk

// Entry of the dialect: reads the files, checks the program, lowers it.
#include "frontend/dialects/gsk/gsk.h"

#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/dialects/gsk/read/messages.h"
#include "frontend/dialects/gsk/reference.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/network/check/analyse.h"
#include "frontend/network/format.h"
#include "frontend/network/read/reading.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/nc/gsk/signals.h"

namespace rung::frontend::gsk {
namespace {

std::vector<ir::MessageText> configuredMessages(SourceManager& sources, FileId program,
                                                const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto at = options.config.find("messages");
  if (at == options.config.end()) return {};
  return readMessages(sources, program, at->second, diagnostics);
}

class GskProgram : public frontend::CheckedProgram {
public:
  GskProgram(SourceManager& sources, std::span<const FileId> files, const frontend::CompileOptions& options,
             Diagnostics& diagnostics)
      : files_(files.begin(), files.end()), options_(options),
        context_{.language = kLanguage, .sources = sources, .diagnostics = diagnostics} {}

  void check() {
    if (files_.empty()) return;
    network::checkConfig(options_, kPages, nc::gskConfigKeys(), context_.diagnostics);
    watchSignals(context_, configuredMachine(options_, context_.diagnostics));
    network::Reading reading(context_, program_);
    for (FileId file : files_) reading.add(file);
    const bool understood = reading.read();
    network::analyse(context_, program_, !understood);
    texts_ = configuredMessages(context_.sources, files_[0], options_, context_.diagnostics);
    const bool hasTexts = options_.config.contains("messages"); // without a file the texts may be elsewhere
    if (hasTexts && !context_.diagnostics.hasErrors()) checkTexts(program_, texts_, context_.diagnostics);
    context_.analysis.settle();
  }

  const frontend::Analysis& analysis() const override { return context_.analysis; }
  std::optional<frontend::NetworkSource> networks() const override { return {{kLanguage, files_}}; }

  std::unique_ptr<ir::Module> build() override {
    const size_t before = context_.diagnostics.errorCount();
    std::unique_ptr<ir::Module> module = lowerProgram(program_, context_, files_, options_);
    if (context_.diagnostics.errorCount() != before) return nullptr; // the steps of a slot do not suffice
    module->messages = std::move(texts_);
    return module;
  }

private:
  const std::vector<FileId> files_;
  const frontend::CompileOptions options_;
  network::Context context_;
  network::Program program_{kLanguage};
  std::vector<ir::MessageText> texts_;
};

std::unique_ptr<frontend::CheckedProgram> check(SourceManager& sources, std::span<const FileId> files,
                                                const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  if (options.strict) diagnostics.raiseToError({diag::DuplicateCounter, diag::DoubleCoil, diag::MixedOutput}); // P29
  auto program = std::make_unique<GskProgram>(sources, files, options, diagnostics);
  program->check();
  return program;
}

std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  return network::format(kLanguage, sources, file, diagnostics);
}

bool isBuilt(const frontend::InstructionInfo& info) { return kLanguage.isBuilt(info); }

constexpr std::string_view kShownSpaces[] = {"A"}; // message requests

} // namespace

const frontend::Dialect kGsk = {
    .name = "gsk",
    .title = "GSK25iMc / GSK25iTc PLC",
    .extensions = kExtensions,
    .configKeys = nc::gskConfigKeys(),
    .instructions = instructionInfos(),
    .signals = nc::gskSignals,
    .shownSpaces = kShownSpaces,
    .isBuilt = isBuilt,
    .findBox = findBox,
    .check = &check,
    .format = &format,
    .reference = &addReference,
    .explain = &explainWord,
};

} // namespace rung::frontend::gsk

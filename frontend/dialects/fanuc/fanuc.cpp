// The dialect's entry: reads all files, checks the program, lowers it.
#include "frontend/dialects/fanuc/fanuc.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/config.h"
#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/dialects/fanuc/read/messages.h"
#include "frontend/dialects/fanuc/read/parameters.h"
#include "frontend/dialects/fanuc/read/signals.h"
#include "frontend/dialects/fanuc/reference.h"
#include "frontend/dialects/fanuc/rows/instructions.h"
#include "frontend/network/check/analyse.h"
#include "frontend/network/format.h"
#include "frontend/network/read/list_reader.h"
#include "frontend/network/read/reading.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/source.h"
#include "ir/support/foreign_file.h"
#include "ir/support/utf8.h"
#include "rtlib/nc/fanuc/signals.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

// Texts and comments of older files are in Latin-1 (F1).
FileId readable(SourceManager& sources, FileId file) {
  const std::string_view text = sources.text(file);
  const bool isText = text.find('\0') == std::string_view::npos && !sources.hasEncoding(file);
  if (!isText || findInvalidUtf8(text) == std::string_view::npos) return file;
  std::string converted;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
      converted += c;
    else
      converted.append({static_cast<char>(0xC0 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3F))});
  }
  return sources.addBuffer(std::string(sources.name(file)), std::move(converted));
}

std::vector<FileId> readable(SourceManager& sources, std::span<const FileId> files) {
  std::vector<FileId> result;
  for (const FileId file : files) result.push_back(readable(sources, file));
  return result;
}

MnemonicFiles opened(const SourceManager& sources, std::span<const FileId> files) {
  MnemonicFiles result;
  for (const FileId file : files) result.push_back(std::make_shared<MnemonicFile>(sources, file));
  return result;
}

bool isSimulated(const frontend::CompileOptions& options) {
  const auto nc = options.config.find("nc");
  return nc != options.config.end() && nc->second == "simulated";
}

// A byte that no text has, in a mnemonic file: it was damaged.
bool checkBytes(const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const size_t at = firstBinary(sources.text(file));
  if (at == std::string_view::npos) return true;
  diagnostics.report(diag::BadCharacter, sources.range(file, at, at + 1))
          .note("a text has no such byte: the file was damaged, or it is not a text")
      << fmt::format("0x{:02X}", static_cast<unsigned char>(sources.text(file)[at]));
  return false;
}

// Reports a file that is something else: LADDER-III's own form, a memory card, parameters of the control. The parser of
// ladder text reports its own.
bool checkKind(const network::Language& language, const SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  if (network::isLadder(language, sources, file)) return true;
  if (isMnemonicFile(text) && !checkBytes(sources, file, diagnostics)) return false;
  const std::optional<std::string> foreign = foreignFile(text);
  const SourceRange shown = isBinary(text) ? SourceRange{} : sources.range(file, 0, 0);
  if (foreign) diagnostics.report(diag::ForeignFile, shown) << sources.name(file) << *foreign;
  return !foreign;
}

class FanucProgram : public frontend::CheckedProgram {
public:
  FanucProgram(SourceManager& sources, std::span<const FileId> files, const frontend::CompileOptions& options,
               Diagnostics& diagnostics)
      : files_(readable(sources, files)), mnemonics_(opened(sources, files_)), options_(options),
        context_{.language = languageOf(configuredPmc(options_, sources, mnemonics_, diagnostics)),
                 .sources = sources,
                 .diagnostics = diagnostics,
                 .isSimulated = isSimulated(options_)},
        program_(context_.language) {}

  void check() {
    if (files_.empty()) return;
    network::checkConfig(options_, pagesOf(pmcOf(context_.language)), nc::fanucConfigKeys(), context_.diagnostics);
    if (!checkFiles()) return;
    checkEnd();
    network::Reading reading(context_, program_);
    for (const auto& mnemonic : mnemonics_) reading.add(mnemonic->file(), mnemonic);
    const bool understood = reading.read();
    network::analyse(context_, program_, !understood);
    checkCounters();
    messages_ = readMessages(context_.language, context_.sources, mnemonics_, context_.diagnostics);
    context_.analysis.settle();
  }

  const frontend::Analysis& analysis() const override { return context_.analysis; }
  std::optional<frontend::NetworkSource> networks() const override { return {{context_.language, files_}}; }

  std::unique_ptr<ir::Module> build() override {
    const size_t before = context_.diagnostics.errorCount();
    std::unique_ptr<ir::Module> module = lowerProgram(program_, context_, files_, options_);
    if (context_.diagnostics.errorCount() != before) return nullptr; // a slot is too short
    for (const Message& message : messages_)
      module->messages.push_back({message.bit + 1, fmt::format("{} {}", message.number, message.text)});
    return module;
  }

private:
  bool checkFiles();
  void checkEnd();
  void checkCounters();

  const std::vector<FileId> files_;
  const MnemonicFiles mnemonics_; // all files; one that is a ladder text is not read as such
  const frontend::CompileOptions options_;
  network::Context context_;
  network::Program program_;
  std::vector<Message> messages_;
};

bool FanucProgram::checkFiles() {
  bool good = true;
  for (const FileId file : files_)
    if (!checkKind(context_.language, context_.sources, file, context_.diagnostics)) good = false;
  return good;
}

// One file may begin and another one end what the control's tools read one after the other (§1.2).
void FanucProgram::checkEnd() {
  const auto first = std::ranges::find_if(mnemonics_, [](const auto& file) { return file->begins(); });
  const bool isClosed = std::ranges::all_of(
      mnemonics_, [](const auto& file) { return std::ranges::all_of(file->sections(), &Section::isClosed); });
  if (first == mnemonics_.end() || !isClosed ||
      std::ranges::any_of(mnemonics_, [](const auto& file) { return file->ends(); }))
    return;
  const SourceRange last = network::lastLineOf(context_.sources, files_.back());
  context_.diagnostics.report(diag::IncompleteFile, last) << "%@A is not followed by %@E";
}

// F17.
void FanucProgram::checkCounters() {
  for (const auto& file : mnemonics_) {
    const std::optional<Word> data = systemParameter(context_.sources, *file, kCounterData);
    if (!data || !text::equalsIgnoringCase(data->text, "BCD")) continue;
    for (const network::Unit& unit : program_.units)
      for (const network::Network& network : unit.networks)
        if (const network::Row* row = network.function.row; row != nullptr && loweredRow(*row).lower == &lowerCounter)
          context_.diagnostics.report(diag::NotSupported, network.function.range)
                  .note(data->range, "the counters hold BCD")
              << row->info.mnemonic;
  }
}

std::unique_ptr<frontend::CheckedProgram> check(SourceManager& sources, std::span<const FileId> files,
                                                const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  auto program = std::make_unique<FanucProgram>(sources, files, options, diagnostics);
  program->check();
  return program;
}

std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  if (!checkKind(languageOf(Pmc::MemB), sources, file, diagnostics)) return std::nullopt;
  return network::format(languageOf(Pmc::MemB), sources, file, diagnostics);
}

bool isBuilt(const frontend::InstructionInfo& info) { return languageOf(Pmc::MemB).isBuilt(info); }

constexpr std::string_view kShownSpaces[] = {"A"}; // requests of messages

} // namespace

const frontend::Dialect kFanuc = {
    .name = "fanuc",
    .title = "FANUC PMC",
    .extensions = kExtensions,
    .configKeys = nc::fanucConfigKeys(),
    .instructions = instructionInfos(),
    .signals = nc::fanucSignals,
    .shownSpaces = kShownSpaces,
    .isBuilt = isBuilt,
    .findBox = findBox,
    .functionWord = "SUB",
    .check = &check,
    .format = &format,
    .reference = &addReference,
    .explain = &explainWord,
};

} // namespace rung::frontend::fanuc

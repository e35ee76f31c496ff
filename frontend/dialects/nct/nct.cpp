// Entry of the dialect: reads the files, checks the program, builds the module (see nct.h).
#include "frontend/dialects/nct/nct.h"

#include <array>
#include <charconv>
#include <unordered_map>

#include <fmt/format.h>

#include "frontend/dialects/nct/check/checker.h"
#include "frontend/dialects/nct/check/message_texts.h"
#include "frontend/dialects/nct/check/structure.h"
#include "frontend/dialects/nct/lower/build_module.h"
#include "frontend/dialects/nct/reference.h"
#include "frontend/ladder/text/format.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/structure.h"
#include "ir/support/meant.h"
#include "rtlib/nc/nct/messages.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::nct {
namespace {

using frontend::CompileOptions;

class NctProgram : public frontend::CheckedProgram {
public:
  NctProgram(SourceManager& sources, std::span<const FileId> files, const CompileOptions& options,
             Diagnostics& diagnostics)
      : sources_(sources), ids_(files.begin(), files.end()), options_(options), diagnostics_(diagnostics),
        config_(readConfig(options, diagnostics)), symbols_(config_, sources, diagnostics), reservations_(diagnostics) {
  }

  void check() {
    read();
    declare();
    checkRungs();
    symbols_.reportUndeclared();
    checkModules();
    symbols_.addTo(analysis_);
    analysis_.settle();
  }

  const frontend::Analysis& analysis() const override { return analysis_; }

  std::unique_ptr<ir::Module> build() override {
    return buildModule(program_, symbols_, texts_, sources_, ids_, options_);
  }

private:
  void read() {
    files_.reserve(ids_.size());
    for (FileId file : ids_) {
      ladder::LadderFile& parsed = files_.emplace_back(ladder::parseLadder(sources_, file, diagnostics_, findBoxInfo));
      if (!parsed.dialect.empty() && parsed.dialect != "nct") reportDialect(parsed);
      if (parsed.dialect.empty()) nameless_ = true; // the file could not be read
    }
  }

  void reportDialect(const ladder::LadderFile& file) {
    DiagBuilder report = diagnostics_.report(diag::DialectConflict, file.dialectRange);
    report << file.dialect << kNct.name;
    if (text::startsWithIgnoringCase(file.dialect, kNct.name)) report.meant(file.dialectRange, kNct.name);
  }

  void declare() {
    for (const ladder::LadderFile& file : files_)
      for (const ladder::Declaration& declaration : file.declarations) switch (declaration.kind) {
        case ladder::DeclarationKind::Symbol:
        case ladder::DeclarationKind::Const: symbols_.declare(declaration); break;
        case ladder::DeclarationKind::Message: addMessage(declaration); break;
        case ladder::DeclarationKind::Button: addText(declaration, 32, kButtonTexts); break;
        case ladder::DeclarationKind::Data:
          diagnostics_.report(diag::UnsupportedElement, declaration.range)
              << "a statement `data`" << "all that a program has is written in ladder text";
          break;
        }
    for (const ladder::LadderFile& file : files_)
      for (const Word& name : file.badNames) symbols_.declareBad(name.text);
    symbols_.resolveAll();
  }

  void checkRungs() {
    for (const ladder::LadderFile& file : files_) checkFile(file);
  }

  void checkModules() {
    for (TypedModule* module : {&program_.main, &program_.int0}) {
      if (!module->exists) continue;
      arrangeParts(*module);
      checkStructure(*module, sources_, diagnostics_);
      checkMessages(*module, textKinds_, diagnostics_);
    }
    if (!diagnostics_.hasErrors()) // an error may hide a box
      checkMessageNumbers({&program_.main, &program_.int0}, textKinds_, diagnostics_);
    if (!program_.main.exists && !program_.main.range.valid() && !nameless_) {
      const SourceRange range = files_.empty() ? SourceRange{} : files_[0].dialectRange;
      diagnostics_.report(diag::MissingMain, range);
    }
  }

  void addMessage(const ladder::Declaration& declaration) {
    if (const auto number = addText(declaration, nc::nct::kMessages, 0))
      textKinds_[*number] = {.kind = checkText(declaration.value, diagnostics_), .range = declaration.value.range};
  }

  // Adds `message 20 "text"` or `button 23 "title"`. Returns the number if it is valid.
  std::optional<uint32_t> addText(const ladder::Declaration& declaration, uint32_t most, uint32_t offset) {
    const std::string_view digits = declaration.name.text;
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) {
      DiagBuilder report = diagnostics_.report(diag::BadOperand, declaration.name.range);
      report << digits << fmt::format("a number of 1 to {}", most);
      if (digits.starts_with('#')) report.meant(declaration.name.range, digits.substr(1));
    } else if (error != std::errc() || number < 1 || number > most) {
      diagnostics_.report(diag::ConstantOutOfRange, declaration.name.range) << digits << "1 to " + std::to_string(most);
    } else if (const auto [first, isNew] = numbers_.emplace(number + offset, declaration.range); !isNew) {
      diagnostics_.report(diag::DuplicateSymbol, declaration.name.range).note(first->second, "the first one is here")
          << fmt::format("{} {}", declaration.kind == ladder::DeclarationKind::Button ? "button" : "message", digits);
    } else {
      texts_.messages.push_back({number + offset, std::string(declaration.value.text)});
      return number;
    }
    return std::nullopt;
  }

  // The module that a statement opens; the same name in another file continues it. The rungs of an unknown module, and
  // of a second module with the same name in one file, are checked one by one, but not as a module.
  TypedModule& open(const ladder::LadderFile& file, const ladder::Module& statement) {
    const std::string_view name = statement.name[0].text;
    TypedModule* module = name == "MAIN" ? &program_.main : name == "INT0" ? &program_.int0 : nullptr;
    if (module == nullptr || statement.name.size() > 1) {
      const SourceRange range = join(statement.name.front().range, statement.name.back().range);
      DiagBuilder report = diagnostics_.report(diag::UnknownModule, range);
      report << sources_.text(range) << "MAIN or INT0";
      suggest(report, range, text::likeliest(sources_.text(range), std::array{"MAIN", "INT0"}));
      nameless_ = true;
      return reported_;
    }
    if (module->exists && module->lastFile == &file) {
      diagnostics_.report(diag::DuplicateModule, statement.range).note(module->range, "here") << name;
      module->partial = true;
      return reported_;
    }
    module->exists = true;
    module->parts.push_back(static_cast<uint32_t>(module->rungs.size()));
    module->range = statement.range;
    module->lastFile = &file;
    return *module;
  }

  void checkFile(const ladder::LadderFile& file) {
    TypedModule* module = nullptr;
    std::optional<RungChecker> checker;
    for (const ladder::Statement& statement : file.statements) {
      switch (statement.kind) {
      case ladder::StatementKind::Module:
        module = &open(file, file.modules[statement.index]);
        checker.emplace(symbols_, reservations_, analysis_, diagnostics_, file.modules[statement.index].name[0].text);
        break;
      case ladder::StatementKind::Rung:
        if (file.rungs[statement.index].module == UINT32_MAX) nameless_ = true;
        ++drawn_;
        if (module == nullptr) break;
        module->rungs.push_back(checker->check(file, file.rungs[statement.index]));
        module->rungs.back().number = drawn_;
        break;
      case ladder::StatementKind::Dialect:
      case ladder::StatementKind::Declaration:
      case ladder::StatementKind::Section:
      case ladder::StatementKind::Comment:
      case ladder::StatementKind::Blank: break;
      }
    }
  }

  SourceManager& sources_;
  const std::vector<FileId> ids_;
  const CompileOptions options_;
  Diagnostics& diagnostics_;
  const Config config_;
  frontend::Analysis analysis_;
  Symbols symbols_;
  OutputReservations reservations_;
  std::vector<ladder::LadderFile> files_;
  Program program_;
  TypedModule reported_; // rungs of rejected modules
  Texts texts_;
  TextKinds textKinds_;
  std::unordered_map<uint32_t, SourceRange> numbers_; // declaration per number of a text
  uint32_t drawn_ = 0;                                // number of rungs so far, in all files
  bool nameless_ = false; // some rungs belong to no known module or were not read: MAIN may be among them
};

std::unique_ptr<frontend::CheckedProgram> check(SourceManager& sources, std::span<const FileId> files,
                                                const CompileOptions& options, Diagnostics& diagnostics) {
  if (options.strict) diagnostics.raiseToError({diag::SymbolInNcArea});
  auto program = std::make_unique<NctProgram>(sources, files, options, diagnostics);
  program->check();
  return program;
}

std::optional<std::string> format(SourceManager& sources, FileId file, Diagnostics& diagnostics) {
  return ladder::format(sources, file, findBoxInfo, diagnostics);
}

constexpr std::string_view kExtensions[] = {".nct"};

constexpr std::string_view kMessageStatement = "a statement of the program, `message 20 \"text\"`";
constexpr frontend::ForeignWord kForeignKeys[] = {{"messages", kMessageStatement}, {"PlcErrors", kMessageStatement}};

} // namespace

static bool isBuilt(const frontend::InstructionInfo& info) {
  for (const Row& row : allRows())
    if (&row.info == &info) return row.isBuilt();
  return false;
}

static std::string textName(uint32_t number) {
  return number > kButtonTexts ? fmt::format("button {}", number - kButtonTexts) : "";
}

const frontend::Dialect kNct = {
    .name = "nct",
    .title = "NCT2xx / NCT3xx PLC",
    .extensions = kExtensions,
    .foreignKeys = kForeignKeys,
    .configKeys = nc::nctConfigKeys(),
    .instructions = instructionInfos(),
    .signals = nc::nctSignals,
    .isBuilt = isBuilt,
    .findBox = findBoxInfo,
    .check = check,
    .format = format,
    .reference = addReference,
    .explain = explainWord,
    .textName = textName,
};

} // namespace rung::frontend::nct

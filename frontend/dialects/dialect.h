// What a dialect provides: its name, its table, and a function from source files to a module. No later stage knows its
// mnemonics. registry.cpp lists the dialects.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/chart/chart.h"
#include "frontend/sema/analysis.h"
#include "frontend/sema/foreign_word.h"
#include "frontend/table/instruction.h"
#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/signal.h"

namespace rung::frontend {

struct CompileOptions {
  // The dialect's configuration (scenario `config KEY VALUE`), and the key "period_us" if a period was requested. The
  // compiler ignores keys that it does not use: they may be the control's.
  std::map<std::string, std::string> config;
  std::map<std::string, SourceRange> configPlaces; // positions of values from a project file
  std::vector<std::string> includePaths; // folders in which included files are looked for, after those of the program
  bool strict = false;                   // warnings that the inventory calls errors in strict mode become errors
  // If not null: receives the contacts and coils of the module's rungs. Must outlive the compilation.
  ir::Marks* marks = nullptr;
  // If not null, the module is to be compared with that of another version: receives the numbers that its rungs are
  // given. Then no rung is simplified because of other rungs, and names that several files have are distinguished.
  ir::GivenNumbers* given = nullptr;

  // The position of a key's value; an invalid range if that is not in a file.
  SourceRange placeOf(const std::string& key) const {
    const auto found = configPlaces.find(key);
    return found == configPlaces.end() ? SourceRange{} : found->second;
  }
};

namespace network {
struct Language;
}

// The source of a program of networks (frontend/network), for conversions and drawings.
struct NetworkSource {
  const network::Language& language;
  std::span<const FileId> files; // decoded
};

// A program after its check. Its sources must outlive it.
class CheckedProgram {
public:
  virtual ~CheckedProgram() = default;
  // Also for a program with errors.
  virtual const Analysis& analysis() const = 0;
  // Nothing for a program that does not consist of networks.
  virtual std::optional<NetworkSource> networks() const { return std::nullopt; }
  // The program as drawings, for a dialect without ladder text; `built` is what build() gave.
  virtual std::optional<chart::Program> charts(const ir::Module& /*built*/) const { return std::nullopt; }
  // May be called once, for a program without errors: a module that passes the verifier. Null if building it finds an
  // error, which is reported.
  virtual std::unique_ptr<ir::Module> build() = 0;
};

class ReferencePage;

struct Dialect {
  std::string_view name;                         // such as "gsk"
  std::string_view title;                        // such as "GSK25iMc / GSK25iTc PLC"
  std::span<const std::string_view> extensions;  // of source files that need not name the dialect, such as ".pmc"
  std::span<const ForeignWord> foreignKeys = {}; // keys of other dialects, and their equivalents here
  std::span<const nc::ConfigKey> configKeys;     // of compile (CompileOptions::config) and of the simulated control
  // The rows, in the order of the reference.
  std::span<const InstructionInfo* const> instructions;
  const nc::SignalTable& (*signals)();                // signals of the control's interface
  std::span<const std::string_view> shownSpaces = {}; // spaces whose cells the control displays or passes on
  // Whether a row of `instructions` can be compiled; all others give the diagnostic not-built-yet.
  bool (*isBuilt)(const InstructionInfo& row);
  // For a dialect with ladders: the row of a box, see ladder::FindBox.
  const InstructionInfo* (*findBox)(std::string_view mnemonic) = nullptr;
  std::string_view functionWord = {}; // before the number of a function in a list: "SUB"; empty if lists have none
  // Reads and checks a program, and reports all errors of all files. Never null. `diagnostics` must outlive the result.
  std::unique_ptr<CheckedProgram> (*check)(SourceManager& sources, std::span<const FileId> files,
                                           const CompileOptions& options, Diagnostics& diagnostics);
  // Formats a file in the style of its form: only blanks, blank lines and the case of a list's mnemonics change. It
  // needs no other file and does not resolve names. Nothing after syntax errors, which have been reported.
  std::optional<std::string> (*format)(SourceManager& sources, FileId file, Diagnostics& diagnostics);
  // The names of the files that a program's files include, as far as they are found. Null if the dialect has no
  // includes.
  std::vector<std::string> (*included)(SourceManager& sources, std::span<const FileId> files,
                                       const CompileOptions& options) = nullptr;
  // Adds the sections after the instructions to the reference page.
  void (*reference)(ReferencePage& page);
  // The meaning of a word that is neither a mnemonic nor a diagnostic, such as a signal's name; "" if it has none. May
  // be null.
  std::string (*explain)(std::string_view word) = nullptr;
  // How the author refers to a text that is not a message: "button 3"; otherwise "". May be null.
  std::string (*textName)(uint32_t number) = nullptr;
  // The program's lines as its mechanisms number them, with the numbers of its rungs; `module` is compiled from
  // `files`. May be null.
  std::string (*listing)(const SourceManager& sources, std::span<const FileId> files,
                         const ir::Module& module) = nullptr;

  // Checks a program and builds it; null after errors.
  std::unique_ptr<ir::Module> compile(SourceManager& sources, std::span<const FileId> files,
                                      const CompileOptions& options, Diagnostics& diagnostics) const {
    const size_t before = diagnostics.errorCount();
    const std::unique_ptr<CheckedProgram> program = check(sources, files, options, diagnostics);
    return diagnostics.errorCount() == before ? program->build() : nullptr;
  }
};

// All dialects, and one by its name; null if there is none.
std::span<const Dialect* const> allDialects();
const Dialect* findDialect(std::string_view name);
// Determined by `dialect NAME` in a ladder text, otherwise by the extension; null if neither determines it.
const Dialect* dialectOf(const SourceManager& sources, FileId file);
// Extensions of program files: that of ladder text, and those of the dialects.
std::vector<std::string_view> programExtensions();

} // namespace rung::frontend

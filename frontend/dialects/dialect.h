// What a dialect gives to the rest: its name, its table, and a function from source files to a module. Nothing after
// it knows a mnemonic. registry.cpp lists the dialects.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
  // The dialect's configuration (scenario `config KEY VALUE`), and the key "period_us" when a period was asked for.
  // Keys that the compiler does not use are none of its business: they may be the control's.
  std::map<std::string, std::string> config;
  std::map<std::string, SourceRange> configPlaces; // of the values that a project file gives
  std::vector<std::string> includePaths; // folders where included files are looked for after those of the program
  bool strict = false;                   // warnings that the inventory calls errors in strict mode are errors
  // Where not null: filled with the contacts and coils of the module's rungs. It outlives the compilation.
  ir::Marks* marks = nullptr;
  // Where not null, the module is to be compared with that of another version: filled with the numbers that its rungs
  // are given. No rung is simplified because of what others do, and names that several files have are distinguished.
  ir::GivenNumbers* given = nullptr;

  // Where the value of a key is written; an invalid range when that is not in a file.
  SourceRange placeOf(const std::string& key) const {
    const auto found = configPlaces.find(key);
    return found == configPlaces.end() ? SourceRange{} : found->second;
  }
};

// A program after its check. The sources that it was made of must outlive it.
class CheckedProgram {
public:
  virtual ~CheckedProgram() = default;
  // Also of a program with errors.
  virtual const Analysis& analysis() const = 0;
  // Of a program without errors, once: a module that passes the verifier. Null where building it finds an error, which
  // is reported.
  virtual std::unique_ptr<ir::Module> build() = 0;
};

class ReferencePage;

struct Dialect {
  std::string_view name;                         // "gsk"
  std::string_view title;                        // "GSK25iMc / GSK25iTc PLC"
  std::span<const std::string_view> extensions;  // of source files that need not name the dialect, e.g. ".pmc"
  std::span<const ForeignWord> foreignKeys = {}; // keys of other dialects, and what is said here instead
  std::span<const nc::ConfigKey> configKeys;     // of compile (CompileOptions::config) and of the simulated control
  // The rows, in the order of the reference.
  std::span<const InstructionInfo* const> instructions;
  const nc::SignalTable& (*signals)();                // of the control's interface
  std::span<const std::string_view> shownSpaces = {}; // whose cells the control shows or passes on
  // Whether a row of `instructions` can be compiled; the others give the diagnostic not-built-yet or service-not-built.
  bool (*isBuilt)(const InstructionInfo& row);
  // Of a dialect with ladders: the row of a box, see ladder::FindBox.
  const InstructionInfo* (*findBox)(std::string_view mnemonic) = nullptr;
  // Reads and checks a program, and reports every error of all files. Never null. `diagnostics` must outlive the
  // result.
  std::unique_ptr<CheckedProgram> (*check)(SourceManager& sources, std::span<const FileId> files,
                                           const CompileOptions& options, Diagnostics& diagnostics);
  // A file in the one style of its form: only blanks, blank lines and the case of mnemonics of a list differ. It needs
  // no other file and knows no names. Nothing where there are mistakes in how it is written; they have been reported.
  std::optional<std::string> (*format)(SourceManager& sources, FileId file, Diagnostics& diagnostics);
  // The names of the files that a program's files include, as far as they are found. Null when the dialect has no such
  // thing.
  std::vector<std::string> (*included)(SourceManager& sources, std::span<const FileId> files,
                                       const CompileOptions& options) = nullptr;
  // Adds to the reference page what goes after the instructions.
  void (*reference)(ReferencePage& page);
  // What a word means that is neither a mnemonic nor a diagnostic, such as a signal's name; "" when nothing. May be
  // null.
  std::string (*explain)(std::string_view word) = nullptr;
  // What a text of the program is to its author, where it is not a message: "button 3", else "". May be null.
  std::string (*textName)(uint32_t number) = nullptr;
  // The program's lines as its mechanisms number them, with the numbers of its rungs, of files that were compiled to
  // `module`. May be null.
  std::string (*listing)(const SourceManager& sources, std::span<const FileId> files,
                         const ir::Module& module) = nullptr;

  // Checks a program and builds it; null when there were errors.
  std::unique_ptr<ir::Module> compile(SourceManager& sources, std::span<const FileId> files,
                                      const CompileOptions& options, Diagnostics& diagnostics) const {
    const size_t before = diagnostics.errorCount();
    const std::unique_ptr<CheckedProgram> program = check(sources, files, options, diagnostics);
    return diagnostics.errorCount() == before ? program->build() : nullptr;
  }
};

// All dialects, and one by its name; null when there is none.
std::span<const Dialect* const> allDialects();
const Dialect* findDialect(std::string_view name);
// By the text of a file: `dialect NAME` in a ladder text, else by its extension; null when neither says so.
const Dialect* dialectOf(const SourceManager& sources, FileId file);
// Of program files: that of ladder text, and those of the dialects.
std::vector<std::string_view> programExtensions();

} // namespace rung::frontend

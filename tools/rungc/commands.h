// The subcommands of rungc. Each adds itself to the application and returns nothing; when the user names it, it stores
// its exit status in `status`: 0 ok, 1 the program or scenario is wrong, 2 usage, 3 environment.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "compiler/project.h"
#include "machine/command-line/command_line.h"
#include "machine/command-line/usage.h"

namespace rung::rungc {

using cli::Command;
using cli::CommandLine;
using cli::kEnvironment;
using cli::kOk;
using cli::kUsage;
using cli::kWrong;
using cli::Option;

// Options of every command that compiles. When the command runs, they already contain the files, dialect and
// configuration of the project (see takeProject).
struct SourceOptions {
  std::vector<std::string> files;
  std::string dialect;
  std::vector<std::string> config; // KEY=VALUE; those of the project come first
  std::string projectFile;         // --project
  bool noProject = false;
  std::optional<compiler::Project> project; // the project that the files belong to
  bool strict = false;
  bool json = false;
  bool quiet = false;
  bool isCheck = false; // warnings are what the command is for; others show a few, and the number of more
  std::string color = "auto";
};

// `json`: help text of --json for this command.
void addSourceOptions(Command command, SourceOptions& options,
                      const std::string& json = "Diagnostics as JSON on standard output");
// Whether the word names a whole project: its folder or its file.
bool namesProject(const std::string& name);
// Finds the project: that of --project, of the only folder or rung.toml among the files, the one that all named files
// belong to, or without files the nearest one from the working directory upwards. Its settings go into the options;
// those of the command line take precedence. Returns the exit status.
int takeProject(SourceOptions& options);
// The project that a folder or a rung.toml names, or with "" the nearest one upwards; mistakes in it are printed. On
// failure nothing, and `status` says why.
std::optional<compiler::Project> openProject(const std::string& named, const SourceOptions& options, int& status);
void addColorOption(Command command, std::string& color, const std::string& what);
// Decided by the option; with "auto", by whether the file is a terminal.
bool wantsColor(const std::string& color, int file);
// -O0 compiles fast, -O2 runs fast.
void addLevelOption(Command command, std::string& level);
// Compiles and prints the diagnostics to standard error (JSON: to standard output). On failure `status` says why.
std::optional<compiler::Compiled> compileSources(SourceManager& sources, const SourceOptions& options,
                                                 compiler::CompileRequest request, int& status);
// The same for commands that check, build or run the program: they also warn of names that look like mistakes.
std::optional<compiler::Compiled> compileChecked(SourceManager& sources, const SourceOptions& options,
                                                 compiler::CompileRequest request, int& status);
using ConfigPairs = std::vector<std::pair<std::string, std::string>>;
// On failure nothing, and `status` says why: an entry is not KEY=VALUE.
std::optional<ConfigPairs> configPairs(const std::vector<std::string>& config, int& status);
// The files and the configuration of these options; on failure nothing, and `status` says why.
std::optional<std::vector<FileId>> addSources(SourceManager& sources, const SourceOptions& options,
                                              frontend::CompileOptions& compile, int& status);
// Prints to standard error, or as JSON to standard output.
void printDiagnostics(const Diagnostics& diagnostics, const SourceManager& sources, const SourceOptions& options);
// Prints "rungc: MESSAGE" and returns kUsage.
int usageError(const std::string& message);
// Prints "rungc: MESSAGE" and returns kEnvironment.
int environmentError(const std::string& message);
// Prints "mill.pmc, 540 rungs, no warnings" and what was written to standard output; nothing with --quiet or --json.
void printSummary(const compiler::Compiled& compiled, const SourceOptions& options, const std::string& written);
// Prints "wrote mill.html" if the status is 0; nothing with --quiet or --json. Returns the status.
int sayWrote(int status, const std::string& out, const SourceOptions& options);
// Writes the whole text; on failure prints a message, leaves the file as it was (see runtime::replaceFile) and returns
// the exit status.
int writeFile(const std::string& text, const std::string& out);
// Writes to a file, or with "" or "-" to standard output.
int writeOutput(const std::string& text, const std::string& out = {});

// Writes a sealed program file to the disk, writable only by its owner. Returns the exit status.
int writeProgram(const std::string& out, const std::string& file);

void addCheck(CommandLine& app, int& status);
void addBuild(CommandLine& app, int& status);
void addConvert(CommandLine& app, int& status);
void addImport(CommandLine& app, int& status);
void addFormat(CommandLine& app, int& status);
void addEmit(CommandLine& app, int& status);
void addOpt(CommandLine& app, int& status);
void addRun(CommandLine& app, int& status);
void addTest(CommandLine& app, int& status);
void addReplay(CommandLine& app, int& status);
void addWeb(CommandLine& app, int& status);
void addProfile(CommandLine& app, int& status);
void addExplain(CommandLine& app, int& status);
void addDoc(CommandLine& app, int& status);
void addView(CommandLine& app, int& status);
void addXref(CommandLine& app, int& status);
void addDiff(CommandLine& app, int& status);
void addNew(CommandLine& app, int& status);
void addSeal(CommandLine& app, int& status);
void addKey(CommandLine& app, int& status);
void addMap(CommandLine& app, int& status);
void addBind(CommandLine& app, int& status);
void addWcet(CommandLine& app, int& status);
void addLsp(CommandLine& app, int& status);

} // namespace rung::rungc

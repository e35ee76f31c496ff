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

// What every command that compiles takes. When the command runs, files, dialect and configuration of the project are in
// it already (see takeProject).
struct SourceOptions {
  std::vector<std::string> files;
  std::string dialect;
  std::vector<std::string> config; // KEY=VALUE, those of the project first
  std::string projectFile;         // --project
  bool noProject = false;
  std::optional<compiler::Project> project; // that the files belong to
  bool strict = false;
  bool json = false;
  bool quiet = false;
  std::string color = "auto";
};

// `json`: what --json means to the command.
void addSourceOptions(Command command, SourceOptions& options,
                      const std::string& json = "Diagnostics as JSON on standard output");
// Whether the words name a whole project: its folder or its file.
bool namesProject(const std::string& name);
// Finds the project: that of --project, of the only folder or rung.toml among the files, that all the named files
// belong to, or without files the nearest one from the working directory upwards. What it says goes into the options;
// those of the command line go before it. Gives the exit status.
int takeProject(SourceOptions& options);
// The project that a folder or a rung.toml names, or with "" the nearest one upwards; its mistakes are printed.
// Nothing, and `status` says why, when there is none.
std::optional<compiler::Project> openProject(const std::string& named, const SourceOptions& options, int& status);
void addColorOption(Command command, std::string& color, const std::string& what);
// By the option and, with auto, whether the file is a terminal.
bool wantsColor(const std::string& color, int file);
// -O0 compiles fast, -O2 runs fast.
void addLevelOption(Command command, std::string& level);
// Compiles and prints the diagnostics to standard error (JSON: to standard output). On failure `status` says why.
std::optional<compiler::Compiled> compileSources(SourceManager& sources, const SourceOptions& options,
                                                 compiler::CompileRequest request, int& status);
// The same for those who check, build or run the program: names that look like mistakes are warned of, too.
std::optional<compiler::Compiled> compileChecked(SourceManager& sources, const SourceOptions& options,
                                                 compiler::CompileRequest request, int& status);
using ConfigPairs = std::vector<std::pair<std::string, std::string>>;
// Nothing, and `status` says why, where one is not KEY=VALUE.
std::optional<ConfigPairs> configPairs(const std::vector<std::string>& config, int& status);
// The files and the configuration of these options; nothing, and `status` says why, when they cannot be had.
std::optional<std::vector<FileId>> addSources(SourceManager& sources, const SourceOptions& options,
                                              frontend::CompileOptions& compile, int& status);
// To standard error, as JSON to standard output.
void printDiagnostics(const Diagnostics& diagnostics, const SourceManager& sources, const SourceOptions& options);
// Prints "rungc: MESSAGE" and gives kUsage.
int usageError(const std::string& message);
// Prints "rungc: MESSAGE" and gives kEnvironment.
int environmentError(const std::string& message);
// "mill.pmc, 540 rungs, no warnings" on standard output, with what was written; nothing with --quiet or --json.
void printSummary(const compiler::Compiled& compiled, const SourceOptions& options, const std::string& written);
// "wrote mill.html" when the status is good; nothing with --quiet or --json. Gives the status.
int sayWrote(int status, const std::string& out, const SourceOptions& options);
// The whole text or, as the exit status and a message say, nothing (see runtime::replaceFile).
int writeFile(const std::string& text, const std::string& out);
// To a file, or with "" or "-" to standard output.
int writeOutput(const std::string& text, const std::string& out = {});

// A sealed program file: on the disk, writable only by its owner. Gives the exit status.
int writeProgram(const std::string& out, const std::string& file);

void addCheck(CommandLine& app, int& status);
void addBuild(CommandLine& app, int& status);
void addConvert(CommandLine& app, int& status);
void addFormat(CommandLine& app, int& status);
void addEmit(CommandLine& app, int& status);
void addOpt(CommandLine& app, int& status);
void addRun(CommandLine& app, int& status);
void addTest(CommandLine& app, int& status);
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

} // namespace rung::rungc

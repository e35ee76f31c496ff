// rungc build, emit and check: a shared object, an intermediate text, or the diagnostics only.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "codegen/cpp/cpp_emitter.h"
#include "codegen/llvm/llvm_emitter.h"
#include "compiler/embedded_ir.h"
#include "compiler/engines.h"
#include "ir/text/text.h"
#include "machine/host/mapping_file.h"
#include "rtlib/load/seal.h"
#include "tools/bind/member.h"
#include "tools/report/profile_branches.h"
#include "tools/rungc/commands.h"
#include "tools/scenario/prompt.h"

namespace rung::rungc {
namespace {

struct BuildOptions {
  SourceOptions source;
  std::string out;
  std::string via = "llvm";
  std::string target;
  std::string cxx;
  std::string what; // emit only
  std::string listing;
  std::string level = "2";
  bool debugInfo = false;
  bool profile = false;
  std::string profileUse;            // a file of `rungc profile -o`
  bool noIr = false;                 // build only
  std::vector<std::string> bindings; // files of rungc bind; build only
};

void addCodeOptions(Command command, BuildOptions& options) {
  addSourceOptions(command, options.source);
  addLevelOption(command, options.level);
  command.flag("-g", options.debugInfo, "Add debug information for the PLC source");
  command.flag("--profile", options.profile, "Count and time every rung");
  command.option("--profile-use", options.profileUse,
                 "Use the counts of rungc profile -o to move rarely executed code aside");
  command.option("--target", options.target,
                 "Triple: x86_64-linux-gnu, aarch64-linux-gnu, armv7-linux-gnueabihf, riscv64-linux-gnu");
}

compiler::CompileRequest requestOf(const BuildOptions& options) {
  compiler::CompileRequest request;
  request.instrument = options.profile;
  request.optimise = options.level != "0";
  return request;
}

// Compiles with the profile of the options; rungs without counts in it are reported.
std::optional<compiler::Compiled> compileWithProfile(SourceManager& sources, const BuildOptions& options,
                                                     compiler::CompileRequest request, int& status) {
  ir::BranchCounts branches;
  if (!options.profileUse.empty()) {
    Result<ir::BranchCounts> read = report::branchesIn(options.profileUse);
    if (!read.ok()) {
      status = environmentError(read.error());
      return std::nullopt;
    }
    branches = std::move(read).value();
    request.branches = &branches;
  }
  std::optional<compiler::Compiled> compiled = compileChecked(sources, options.source, request, status);
  if (compiled && compiled->branchWeights.unknown != 0)
    fmt::print(stderr, "rungc: {}: has no counts for {} of {} rungs with branches (new or changed)\n",
               options.profileUse, compiled->branchWeights.unknown,
               compiled->branchWeights.known + compiled->branchWeights.unknown);
  return compiled;
}

// Takes the layouts for which the program is compiled from the files of rungc bind.
bool takeBindings(const BuildOptions& options, compiler::CompileRequest& request, int& status) {
  for (const std::string& path : options.bindings) {
    std::string file;
    try {
      file = host::readFromDisk(path);
    } catch (const std::exception& error) {
      status = environmentError(error.what());
      return false;
    }
    const Result<bind::Claim> claim = bind::claimIn(file);
    if (!claim.ok()) {
      fmt::print(stderr, "rungc: {}: {}\n", path, claim.error());
      status = kWrong;
      return false;
    }
    request.layouts.push_back({RUNG_LAYOUT_SYMBOL + claim.value().name, claim.value().text,
                               static_cast<int64_t>(bind::hashOf(claim.value().text))});
  }
  return true;
}

codegen::LlvmOptions llvmOptionsOf(const BuildOptions& options) {
  codegen::LlvmOptions llvm;
  llvm.level = options.level == "0" ? codegen::LlvmLevel::Fast : codegen::LlvmLevel::Opt;
  llvm.debugInfo = options.debugInfo;
  llvm.target = options.target;
  return llvm;
}

Result<std::string> objectOf(const compiler::Compiled& compiled, const BuildOptions& options) {
  const scenario::Working working("compiling to machine code");
  if (options.via == "llvm")
    return codegen::buildLlvmSharedObject(*compiled.layout, compiled.codeHash, llvmOptionsOf(options));
  codegen::CppBuildOptions cpp;
  cpp.compiler = !options.cxx.empty()     ? options.cxx
                 : options.target.empty() ? compiler::defaultCppCompiler()
                                          : options.target + "-g++";
  cpp.optimisation = options.level == "0" ? "-O0" : "-O2";
  cpp.debugInfo = options.debugInfo;
  const std::string text = codegen::emitCpp(*compiled.layout, compiled.codeHash, {.debugInfo = options.debugInfo});
  return codegen::buildCppSharedObject(text, cpp);
}

int buildObject(const compiler::Compiled& compiled, const BuildOptions& options) {
  Result<std::string> object = objectOf(compiled, options);
  if (object.ok() && !options.noIr) object = compiler::withIr(object.value(), compiled);
  return object.ok() ? writeProgram(options.out, runtime::sealed(object.value())) : environmentError(object.error());
}

int writeListing(const SourceManager& sources, const compiler::Compiled& compiled, const std::string& name) {
  if (compiled.dialect->listing == nullptr) {
    return usageError(fmt::format("only technol programs have a listing; this program is {}", compiled.dialect->name));
  }
  return writeFile(compiled.dialect->listing(sources, compiled.files, *compiled.module), name);
}

// With the size of the code for the machine.
std::string writtenBy(const BuildOptions& options) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(options.out, error);
  std::string text = options.out;
  if (!error) text += fmt::format(" ({} kB)", (bytes + 1023) / 1024);
  return options.listing.empty() ? text : text + " and " + options.listing;
}

Result<std::string> textOf(const compiler::Compiled& compiled, const BuildOptions& options) {
  const scenario::Working working("writing the " + options.what);
  Result<std::string> text = failure("");
  if (options.what == "cpp")
    text = codegen::emitCpp(*compiled.layout, compiled.codeHash, {.debugInfo = options.debugInfo});
  else if (options.what == "ir")
    text = ir::print(*compiled.module);
  else if (options.what == "layout")
    text = compiled.layout->memory().text();
  else if (options.what == "llvm")
    text = codegen::emitLlvmIr(*compiled.layout, compiled.codeHash, llvmOptionsOf(options));
  else
    text = codegen::emitAssembly(*compiled.layout, compiled.codeHash, llvmOptionsOf(options));
  return text;
}

int emitText(const compiler::Compiled& compiled, const BuildOptions& options) {
  const Result<std::string> text = textOf(compiled, options);
  if (!text.ok()) return environmentError(text.error());
  if (!options.out.empty() && options.out != "-")
    return sayWrote(writeFile(text.value(), options.out), options.out, options.source);
  std::cout << text.value();
  return kOk;
}

} // namespace

void addBuild(CommandLine& app, int& status) {
  Command command = app.add("build", "Compile a program to a shared object");
  auto options = std::make_shared<BuildOptions>();
  addCodeOptions(command, *options);
  command.option("-o,--output", options->out,
                 "The shared object to write; default in a project: NAME.so beside rung.toml");
  command.option("--via", options->via, "Back end: llvm needs no compiler, cpp runs one").oneOf({"llvm", "cpp"});
  command.option("--cxx", options->cxx, "C++ compiler for --via cpp");
  command.flag("--no-ir", options->noIr,
               "Leave out the program's IR; variables that its rungs write can then not be forced");
  command
      .option("--binding", options->bindings,
              "File written by rungc bind: the program runs only in hosts with that layout; may be repeated")
      .oneValue();
  command.option("--listing", options->listing,
                 "Write the program's numbered lines, to which name_LINE refers (technol)");
  command.onRun([options, &status] {
    if (options->out.empty() && !options->source.project) {
      status = usageError("build needs -o FILE; only a project has a default name");
      return;
    }
    if (options->out.empty()) options->out = compiler::productOf(*options->source.project, ".so");
    SourceManager sources;
    compiler::CompileRequest request = requestOf(*options);
    request.keepBuilt = request.marks = !options->noIr;
    if (options->source.project)
      options->bindings.insert(options->bindings.begin(), options->source.project->bindings.begin(),
                               options->source.project->bindings.end());
    if (!takeBindings(*options, request, status)) return;
    const auto compiled = compileWithProfile(sources, *options, request, status);
    if (!compiled) return;
    if (!options->listing.empty()) status = writeListing(sources, *compiled, options->listing);
    if (status == kOk) status = buildObject(*compiled, *options);
    if (status == kOk) printSummary(*compiled, options->source, writtenBy(*options));
  });
}

void addEmit(CommandLine& app, int& status) {
  Command command = app.add("emit", "Print an intermediate form of the program: C++, IR, layout, LLVM IR or assembly");
  auto options = std::make_shared<BuildOptions>();
  command.option("WHAT", options->what, "cpp, ir, layout, llvm or asm")
      .required()
      .oneOf({"cpp", "ir", "layout", "llvm", "asm"});
  command.option("-o,--output", options->out, "The file to write; default, or with -: standard output");
  addCodeOptions(command, *options);
  command.onRun([options, &status] {
    SourceManager sources;
    if (const auto compiled = compileWithProfile(sources, *options, requestOf(*options), status))
      status = emitText(*compiled, *options);
  });
}

// rungc check: reports every mistake and likely mistake of a program.

void addCheck(CommandLine& app, int& status) {
  Command command = app.add("check", "Report all mistakes in a program");
  auto options = std::make_shared<SourceOptions>();
  options->isCheck = true;
  addSourceOptions(command, *options);
  command.onRun([options, &status] {
    SourceManager sources;
    const auto compiled = compileChecked(sources, *options, {}, status);
    if (compiled) printSummary(*compiled, *options, "");
  });
}

} // namespace rung::rungc

// rungc bind: from a struct of a host's header and a program to C code that binds the two.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <tuple>

#include "codegen/clang/layout_json.h"
#include "codegen/process/process.h"
#include "ir/support/temporary_folder.h"
#include "machine/host/mapping_file.h"
#include "tools/bind/binding.h"
#include "tools/bind/generate.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/opened_program.h"

namespace rung::rungc {
namespace {

constexpr size_t kLongestName = 100; // the limit of the library

struct BindOptions {
  SourceOptions source;
  std::string header;
  std::string name;
  std::string members; // path of a binding file
  std::string include;
  std::string build; // path of a folder
  std::string out;
  bool makeTemplate = false;
  std::vector<std::string> flags;
};

// The program that reads headers: beside this one, or where it is installed.
std::optional<std::string> findReader() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const char* place : {"rung-layout", "../libexec/rung/rung-layout"})
    if (const auto found = codegen::findProgram((self.parent_path() / place).string())) return found;
  return std::nullopt;
}

// Mistakes in the header are printed to standard error.
std::optional<codegen::HostLayout> readLayout(const BindOptions& options, int& status) {
  const std::optional<std::string> reader = findReader();
  if (!reader) {
    status = environmentError(
        "bind needs the program rung-layout to read headers, which is not installed; install the package rung-bind");
    return std::nullopt;
  }
  const TemporaryFolder folder;
  std::vector<std::string> words = {*reader, options.header, options.name, options.build};
  words.insert(words.end(), options.flags.begin(), options.flags.end());
  const Result<int> code = codegen::runProgram(words, {.out = (folder / "layout").string(), .error = std::nullopt});
  if (!code.ok()) {
    status = environmentError(fmt::format("cannot read {}: {}", options.header, code.error()));
    return std::nullopt;
  }
  status = code.value();
  if (status != kOk) return std::nullopt;
  const Result<codegen::HostLayout> layout = codegen::layoutOf(folder.contentsOf("layout").value_or(""));
  if (layout.ok()) return layout.value();
  status = environmentError(fmt::format("{} has another version: {}", *reader, layout.error()));
  return std::nullopt;
}

int write(const std::string& text, const BindOptions& options) {
  if (!options.out.empty()) return sayWrote(writeFile(text, options.out), options.out, options.source);
  fmt::print("{}", text);
  return kOk;
}

std::string commandOf(const BindOptions& options) {
  std::string text = "rungc bind " + options.header;
  if (options.source.project)
    text += " --project " + options.source.project->file;
  else
    for (const std::string& file : options.source.files) text += " " + file;
  text += fmt::format(" --struct {} --members {}", options.name, options.members);
  if (!options.build.empty()) text += " -p " + options.build;
  if (!options.flags.empty()) text += " --";
  for (const std::string& flag : options.flags) text += " " + flag;
  return text;
}

bind::Names namesOf(const BindOptions& options) {
  return {.header =
              options.include.empty() ? std::filesystem::path(options.header).filename().string() : options.include,
          .command = commandOf(options)};
}

int bindStruct(const BindOptions& options, const std::string& file, const codegen::HostLayout& layout,
               const OpenedProgram& program) {
  const Instance instance(*program.image);
  std::vector<bind::Error> errors;
  const bind::File entries = bind::parse(file, errors);
  const bind::Binding binding = bind::bind(entries, layout, instance.handle(), program.image->program(), errors);
  std::ranges::sort(errors, {},
                    [](const bind::Error& error) { return std::tuple(error.at.line, error.at.column, error.text); });
  for (const bind::Error& error : errors)
    fmt::print(stderr, "{}:{}:{}: {}\n", options.members, error.at.line, error.at.column, error.text);
  return errors.empty() ? write(bind::generate(binding, layout, namesOf(options)), options) : int{kWrong};
}

int run(const BindOptions& options) {
  if (options.name.size() > kLongestName)
    return usageError(fmt::format("bind: --struct takes a name of at most {} characters", kLongestName));
  std::string file;
  try {
    if (!options.makeTemplate) file = host::readFromDisk(options.members);
  } catch (const std::exception& error) {
    return environmentError(error.what());
  }
  int status = kOk;
  const std::optional<codegen::HostLayout> layout = readLayout(options, status);
  if (!layout) return status;
  if (options.makeTemplate) return write(bind::templateOf(*layout), options);
  const std::optional<OpenedProgram> program = openProgram(options.source, status);
  return program ? bindStruct(options, file, *layout, *program) : status;
}

// A template needs no program.
int parsed(BindOptions& options) {
  if (options.makeTemplate) return kOk;
  if (options.members.empty()) return usageError("bind: expected --template or --members FILE");
  return takeProject(options.source);
}

} // namespace

void addBind(CommandLine& app, int& status) {
  Command command = app.add("bind", "Connect a struct of a host's C or C++ header to a program, as code for the host; "
                                    "the header's compile flags follow --");
  auto options = std::make_shared<BindOptions>();
  command.option("HEADER", options->header, "The header that defines the struct").required();
  addSourceOptions(command, options->source);
  command.option("--struct", options->name, "The struct: its tag or typedef, with its namespaces").required();
  Option members =
      command.option("--members", options->members, "The binding file, which connects members to names of the program");
  command.flag("--template", options->makeTemplate, "Draft a binding file with all members").excludes(members);
  command.option("-o,--output", options->out, "Write to this file instead of standard output");
  command.option("--include", options->include,
                 "Path by which the host's code includes the header; default: its file name");
  command.option("-p,--build", options->build, "Folder of the compile_commands.json with the header's compile flags");
  app.takeRest(command, options->flags);
  command.onParsed([options] { return parsed(*options); });
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc

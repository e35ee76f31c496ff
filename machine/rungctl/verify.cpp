// See verify.h.
#include "machine/rungctl/verify.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "machine/compile/compilation.h"
#include "machine/compile/source_paths.h"
#include "machine/rung-compile/collect.h"
#include "machine/rungctl/program_tables.h"
#include "machine/rungctl/reload.h"
#include "rtlib/text/hex.h"

namespace rung::rungctl {

using nlohmann::json;

namespace {

// The program cannot be compared; the text says why.
class Unknown : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// The program compiled from the sources, as the machine's program was.
ProgramTables compiled(const Words& words, const ProgramTables& machine) {
  rung_compile::Collected collected = rung_compile::collect(words.files, isatty(STDERR_FILENO) != 0);
  if (!collected.sources) throw Unknown(collected.report);
  collected.sources->profile = machine.instrumented;
  if (!collected.sources->name.empty()) collected.sources->name = machine.name; // often that of the folder
  const compile::SourcePaths paths(machine.files, collected.sources->files);
  compile::rename(*collected.sources, paths);
  compile::Compilation compilation(compile::packed(*collected.sources));
  if (compilation.wait() != compile::Compilation::State::Compiled) throw Unknown(compilation.report());
  const Image image = Image::ofMemory(compilation.image(), "the program that was compiled");
  ProgramTables tables = tablesOf(image.program());
  for (ProgramTables::Rung& rung : tables.rungs) rung.file = paths.here(rung.file);
  return tables;
}

ProgramTables given(const Words& words, const ProgramTables& machine) {
  const bool isProgram =
      std::ranges::any_of(words.files, [](const std::string& file) { return file.ends_with(".so"); });
  if (isProgram && words.files.size() > 1)
    throw Unknown("found a compiled program together with other files, expected one compiled program, or sources");
  return isProgram ? tablesOf(Image(words.files.front()).program()) : compiled(words, machine);
}

std::string hexOf(uint64_t code) { return text::hexOfNumber(code, sizeof code); }

// Why two programs are not the same although all that can be compared is equal.
std::string elseText(const ProgramTables& machine, const ProgramTables& other) {
  if (machine.compiler != other.compiler)
    return fmt::format("compiled by different versions: {} runs, this is {}", machine.compiler, other.compiler);
  if (machine.files != other.files)
    return fmt::format("compiled from files with other paths: {} runs, this is {}", fmt::join(machine.files, ", "),
                       fmt::join(other.files, ", "));
  return "values of constants that rungs use, options of the compilation, remarks or lines differ";
}

int compare(const Words& words) {
  Client client(words.common.host);
  ProgramTables machine = tablesOf(client);
  const ProgramTables other = given(words, machine);
  json answer = {{"ok", true},
                 {"equal", machine.code == other.code},
                 {"program", machine.name},
                 {"code", hexOf(machine.code)},
                 {"given", {{"program", other.name}, {"code", hexOf(other.code)}}}};
  if (machine.code == other.code) {
    print(words, answer, fmt::format("the machine runs this program: {}, code {}", machine.name, hexOf(machine.code)));
    return kSameProgram;
  }
  std::string text = fmt::format("the machine runs {}, code {}; this is {}, code {}\n", machine.name,
                                 hexOf(machine.code), other.name, hexOf(other.code));
  if (machine.dialect != other.dialect) {
    answer["dialects"] = {machine.dialect, other.dialect};
    print(words, answer, text + fmt::format("the dialects differ: {} and {}", machine.dialect, other.dialect));
    return kOtherProgram;
  }
  addRungs(client, machine);
  const ProgramDifference found = difference(machine, other);
  answer["rungs"] = found.rungs;
  answer["parts"] = json::array();
  for (const runtime::ProgramPart* part : found.parts) answer["parts"].push_back(part->name);
  for (const json& rung : found.rungs) text += rungLine(rung) + "\n";
  for (const runtime::ProgramPart* part : found.parts) text += std::string(part->difference) + "\n";
  if (found.none()) text += "no rung has another text; " + elseText(machine, other) + "\n";
  print(words, answer, text);
  // A compiled program keeps the paths that it has; nothing else is known to differ.
  return found.none() && machine.compiler == other.compiler && machine.files != other.files ? kUnknownProgram
                                                                                            : kOtherProgram;
}

} // namespace

int verify(const Words& words) try { return compare(words); } catch (const std::exception& problem) {
  if (words.common.asJson)
    std::cout << json{{"ok", false}, {"error", problem.what()}}.dump(-1, ' ', false, json::error_handler_t::replace)
              << '\n';
  return fail(std::string("unknown whether the machine runs this program: ") + problem.what(), kUnknownProgram);
}

} // namespace rung::rungctl

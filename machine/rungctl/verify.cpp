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

// What is before the parts of two paths that are equal at their ends: for /plc/mill/a.pmc and mill/a.pmc "/plc/" and
// "".
std::pair<std::string, std::string> prefixesOf(const std::string& a, const std::string& b) {
  size_t common = 0;
  for (size_t n = 1; n <= std::min(a.size(), b.size()) && a[a.size() - n] == b[b.size() - n]; ++n) {
    const auto begins = [n](const std::string& path) { return n == path.size() || path[path.size() - n - 1] == '/'; };
    if (begins(a) && begins(b)) common = n;
  }
  return {a.substr(0, a.size() - common), b.substr(0, b.size() - common)};
}

// Gives the sources the paths that the machine's program has, because they are part of a program: the same files in
// another folder are the same program.
void takePathsOf(const std::vector<std::string>& machine, compile::Sources& sources) {
  if (machine.empty() || sources.files.empty()) return;
  const auto [to, from] = prefixesOf(machine.front(), sources.files.front());
  if (to == from || to.size() == machine.front().size()) return; // other files
  const auto rename = [&](const std::string& path) {
    const bool isOf = from.empty() ? !path.starts_with('/') : path.starts_with(from);
    return isOf ? to + path.substr(from.size()) : path;
  };
  for (std::string& file : sources.files) file = rename(file);
  for (std::string& folder : sources.includePaths) folder = rename(folder);
  std::map<std::string, std::string> texts;
  for (auto& [path, text] : sources.texts) texts[rename(path)] = std::move(text);
  sources.texts = std::move(texts);
}

Image compiled(const Words& words, const ProgramTables& machine) {
  rung_compile::Collected collected = rung_compile::collect(words.files, isatty(STDERR_FILENO) != 0);
  if (!collected.sources) throw Unknown(collected.report);
  collected.sources->profile = machine.instrumented;
  takePathsOf(machine.files, *collected.sources);
  compile::Compilation compilation(compile::packed(*collected.sources));
  if (compilation.wait() != compile::Compilation::State::Compiled) throw Unknown(compilation.report());
  return Image::ofMemory(compilation.image(), "the program that was compiled");
}

Image given(const Words& words, const ProgramTables& machine) {
  const bool isProgram =
      std::ranges::any_of(words.files, [](const std::string& file) { return file.ends_with(".so"); });
  if (isProgram && words.files.size() > 1)
    throw Unknown("found a compiled program together with other files, expected one compiled program, or sources");
  return isProgram ? Image(words.files.front()) : compiled(words, machine);
}

std::string hexOf(uint64_t code) { return text::hexOfNumber(code, sizeof code); }

// What differs besides rungs, in words.
std::string partText(const std::string& part) {
  if (part == "memory") return "the layout of the memory differs";
  if (part == "names") return "names or constants differ: new ones, other addresses or values";
  if (part == "contents") return "initial contents of the memory differ";
  if (part == "messages") return "texts of messages differ";
  return "the schedule of tasks differs";
}

// Why two programs are not the same although all that can be compared is equal.
std::string elseText(const ProgramTables& machine, const ProgramTables& other) {
  if (machine.compiler != other.compiler)
    return fmt::format("compiled by different versions: {} runs, this is {}", machine.compiler, other.compiler);
  if (machine.files != other.files)
    return fmt::format("compiled from files with other paths: {} runs, this is {}", fmt::join(machine.files, ", "),
                       fmt::join(other.files, ", "));
  return "options of the compilation, remarks or lines differ";
}

int compare(const Words& words) {
  Client client(words.common.host);
  ProgramTables machine = tablesOf(client);
  const ProgramTables other = tablesOf(given(words, machine).program());
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
  answer["parts"] = found.parts;
  for (const json& rung : found.rungs) text += rungLine(rung) + "\n";
  for (const std::string& part : found.parts) text += partText(part) + "\n";
  if (found.none()) text += "no rung differs; " + elseText(machine, other) + "\n";
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

// See write.h.
#include "frontend/dialects/fanuc/write.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/format.h"
#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/dialects/fanuc/read/symbols.h"

namespace rung::frontend::fanuc {
namespace {

using network::Command;
using network::Item;

// A field of a table of symbols. In quotes, which a field with a comma needs, a quote cannot be written.
std::string fieldOf(std::string_view text) {
  const bool needsQuotes = text.find(',') != std::string_view::npos || text.find_first_of("\";%") == 0;
  if (!needsQuotes) return std::string(text);
  std::string field(text);
  std::ranges::replace(field, '"', '\'');
  return fmt::format("\"{}\"", field);
}

// Sections with their lines, in the order in which they were begun.
class Sections {
public:
  // An empty line only begins the section.
  void add(std::string_view code, std::string_view line) {
    auto at = std::ranges::find(sections_, code, &std::pair<std::string, std::string>::first);
    if (at == sections_.end()) at = sections_.insert(sections_.end(), {std::string(code), {}});
    if (!line.empty()) at->second.append(line).push_back('\n');
  }
  // A section with its code and its end; "" if it was not begun. It is then taken.
  std::string take(std::string_view code) {
    const auto at = std::ranges::find(sections_, code, &std::pair<std::string, std::string>::first);
    if (at == sections_.end()) return {};
    const std::string text = fmt::format("{}\n{}%\n", at->first, at->second);
    sections_.erase(at);
    return text;
  }
  std::string takeAll() {
    std::string text;
    while (!sections_.empty()) text += take(sections_.front().first);
    return text;
  }

private:
  std::vector<std::pair<std::string, std::string>> sections_;
};

constexpr std::string_view kLadder = "%@3";
constexpr std::string_view kMessages = "%@4";

// The code of the table of symbols with as many comments as a symbol has.
std::string symbolsCode(size_t comments) {
  std::string code = "%@2-E (SYM=1 ADR=2";
  for (size_t number = 1; number <= comments; ++number) code += fmt::format(" CM{}={}", number, number + 2);
  return code + ")";
}

size_t mostComments(std::span<const Item> declarations) {
  size_t most = 1;
  for (const Item& item : declarations)
    if (item.kind == Item::Kind::Symbol) most = std::max(most, commentsIn(item.comment).size());
  return most;
}

std::string symbolLine(const Item& symbol) {
  std::string line = fmt::format("{},{}", fieldOf(symbol.text), fieldOf(symbol.value));
  for (const std::string_view comment : commentsIn(symbol.comment)) line += fmt::format(",{}", fieldOf(comment));
  return line;
}

} // namespace

std::string mnemonicCommand(const network::Language& language, const network::Written& command, bool begins) {
  const auto line = [](std::string_view name, std::string_view operand) {
    return fmt::format("{:<{}}{}", name, kOperandColumn, operand);
  };
  if (command.command == Command::Parameter || command.command == Command::Table) return std::string(command.operand);
  if (command.command == Command::Function)
    return line(language.nameOf(Command::Function),
                fmt::format("{}", language.findFunction(command.operand)->info.number));
  if (command.operand.empty()) return std::string(language.nameOf(command.command));
  if (!begins && command.command == Command::Load) return line("RD.STK", command.operand);
  if (!begins && command.command == Command::LoadNot) return line("RD.NOT.STK", command.operand);
  return line(language.nameOf(command.command), command.operand);
}

std::string mnemonicFile(std::span<const Item> head, std::span<const Item> declarations, std::string_view ladder) {
  Sections sections;
  const std::string symbols = symbolsCode(mostComments(declarations));
  for (const Item& item : declarations) {
    if (item.kind == Item::Kind::Symbol)
      sections.add(symbols, symbolLine(item));
    else if (item.kind == Item::Kind::Message)
      sections.add(kMessages, fmt::format("{} {}", item.text, item.value));
    else
      sections.add(item.text, item.value);
  }
  std::string text;
  for (const Item& item : head)
    if (!item.text.empty())
      text += item.kind == Item::Kind::Section ? fmt::format("; section \"{}\"\n", item.text)
                                               : fmt::format("; {}\n", item.text);
  text += "%@A\n";
  for (const std::string_view code : {kParametersCode, kTitleCode, std::string_view(symbols)})
    text += sections.take(code);
  text += fmt::format("{}\n{}%\n{}", kLadder, ladder, sections.take(kMessages));
  return text + sections.takeAll() + "%@E\n";
}

} // namespace rung::frontend::fanuc

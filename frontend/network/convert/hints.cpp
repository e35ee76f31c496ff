// Tags and hints to text and back.
#include "frontend/network/convert/hints.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "rtlib/text/blanks.h"

namespace rung::network::convert {
namespace {

constexpr std::string_view kBefore = "->";

// A parameter by the name of its operand, a table row by its number.
std::string parameterText(const Language& language, const SourceNetwork& network, Command command, size_t index) {
  const std::string_view mnemonic = network.row->info.mnemonic;
  if (command == Command::Table) return fmt::format("{{{} {} {}}}", mnemonic, language.nameOf(command), index);
  return fmt::format("{{{} {}}}", mnemonic, network.row->info.operands[index].name);
}

} // namespace

std::string elementText(Command command, std::string_view operand) {
  constexpr std::string_view kCoils[] = {"", "/", "S ", "R "};
  if (isContact(command)) return fmt::format("[{}{}]", isClosed(command) ? "/" : "", operand);
  if (isCoil(command)) return fmt::format("({}{})", kCoils[static_cast<size_t>(coilOf(command))], operand);
  return fmt::format("{{{}}}", operand);
}

std::vector<std::string> tagsOf(const Language& language, const SourceNetwork& network) {
  std::vector<std::string> tags;
  std::unordered_map<std::string, uint32_t> seen;
  size_t parameters = 0;
  size_t rows = 0;
  for (const SourceCommand& command : network.commands) {
    const bool isParameter = command.command == Command::Parameter || command.command == Command::Table;
    size_t& count = command.command == Command::Table ? rows : parameters;
    std::string tag = isParameter                ? parameterText(language, network, command.command, count++)
                      : isBlock(command.command) ? fmt::format("[{}]", language.nameOf(command.command))
                                                 : elementText(command.command, command.operand);
    const uint32_t number = ++seen[tag];
    if (number > 1) tag += fmt::format("#{}", number);
    tags.push_back(std::move(tag));
  }
  return tags;
}

std::optional<Tagged> parseTag(std::string_view comment) {
  Tagged result;
  std::string_view rest = comment;
  if (rest.starts_with(kBefore)) {
    result.before = true;
    rest = text::trimmed(rest.substr(kBefore.size()));
  }
  constexpr std::string_view kOpen = "[({";
  const size_t kind = rest.empty() ? std::string_view::npos : kOpen.find(rest[0]);
  if (kind == std::string_view::npos) return std::nullopt;
  size_t end = rest.find("])}"[kind]);
  if (end == std::string_view::npos) return std::nullopt;
  ++end;
  if (end < rest.size() && rest[end] == '#') end = std::min(rest.find_first_not_of("0123456789", end + 1), rest.size());
  if (end < rest.size() && rest[end] != ' ') return std::nullopt;
  result.tag = rest.substr(0, end);
  result.text = text::trimmed(rest.substr(end));
  return result;
}

std::string tagged(bool before, std::string_view tag, std::string_view text) {
  return fmt::format("{}{}{}{}", before ? "-> " : "", tag, text.empty() ? "" : " ", text);
}

} // namespace rung::network::convert

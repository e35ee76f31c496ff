// Statements of a command list by themselves; see the header.
#include "frontend/network/read/list_syntax.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/address.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "rtlib/text/letters.h"

namespace rung::network {
namespace {

std::string_view wantedOperand(Command command) {
  if (isContact(command) || isCoil(command)) return "a bit";
  if (command == Command::Function) return "the number or name of a function";
  if (command == Command::Parameter) return "a parameter";
  if (command == Command::Table) return "a constant";
  if (command == Command::Dialect) return "the name of the dialect";
  if (command == Command::Symbol) return "`symbol NAME ADDRESS`";
  return "`const NAME VALUE`";
}

size_t operandCount(Command command) { return isBlock(command) ? 0 : isDeclaration(command) ? 2 : 1; }

// Only these may appear outside comments.
bool isPlain(char c) { return c >= 0x21 && c <= 0x7E; }

} // namespace

std::optional<Command> findCommand(const Language& language, std::string_view text) {
  const auto at = std::ranges::find_if(language.commands,
                                       [&](std::string_view name) { return text::equalsIgnoringCase(name, text); });
  if (at == language.commands.end()) return std::nullopt;
  return static_cast<Command>(at - language.commands.begin());
}

// The words after the step number (the S/N column).
std::span<const Word> statementOf(const LineWords& line) {
  std::span<const Word> words(line.words);
  if (!words.empty() && parseDigits(words[0].text)) words = words.subspan(1);
  return words;
}

bool isReadable(std::span<const Word> words) {
  return std::all_of(words.begin(), words.end(),
                     [](const Word& word) { return std::all_of(word.text.begin(), word.text.end(), isPlain); });
}

// Outside comments only printable ASCII may appear: the manual's scan has look-alikes of other alphabets.
bool checkCharacters(Diagnostics& diagnostics, std::span<const Word> words) {
  for (const Word& word : words) {
    const auto bad = std::find_if_not(word.text.begin(), word.text.end(), isPlain);
    if (bad == word.text.end()) continue;
    const auto offset = static_cast<uint32_t>(bad - word.text.begin());
    size_t length = 1;
    while (offset + length < word.text.size() &&
           (static_cast<unsigned char>(word.text[offset + length]) & 0xC0) == 0x80)
      ++length;
    const SourcePos begin{word.range.begin.value + offset};
    const SourceRange range{begin, {begin.value + static_cast<uint32_t>(length)}};
    if (static_cast<unsigned char>(*bad) < 0x80)
      diagnostics.report(diag::BadCharacter, range) << fmt::format("0x{:02X}", static_cast<unsigned char>(*bad));
    else
      diagnostics.report(diag::BadCharacter, range) << fmt::format("'{}'", word.text.substr(offset, length));
    return false;
  }
  return true;
}

bool checkOperands(Diagnostics& diagnostics, Command command, std::span<const Word> words) {
  const size_t wanted = operandCount(command);
  if (words.size() - 1 == wanted) return true;
  if (isDeclaration(command))
    diagnostics.report(diag::BadOperand, words[0].range)
        << words[0].text << fmt::format("complete statement: {}", wantedOperand(command));
  else if (words.size() - 1 < wanted)
    diagnostics.report(diag::BadOperand, words[0].range)
        << words[0].text << fmt::format("complete statement: {} is missing", wantedOperand(command));
  else
    diagnostics.report(diag::BadOperand, words[wanted + 1].range)
        << words[wanted + 1].text
        << fmt::format("part of this statement: {} takes {}", words[0].text,
                       wanted == 0 ? "nothing" : wantedOperand(command));
  return false;
}

} // namespace rung::network

// Statements of a command list by themselves; see the header.
#include "frontend/network/read/list_syntax.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/address.h"
#include "frontend/syntax/bad_character.h"
#include "ir/support/diag/operand.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
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

// Only these may appear outside comments.
bool isPlain(char c) { return c >= 0x21 && c <= 0x7E; }

// What other languages write in brackets, as comparisons, or as bits of timers: `AND ( X0.1`, `LD D0 = 1`, `OUT T1
// K50`.
void noteForeign(const Language& language, std::span<const Word> words, DiagBuilder& report) {
  const bool compares = words[2].text.find_first_not_of("<>=!") == std::string_view::npos;
  const std::string word = compares ? "CMP" : words[1].text == "(" ? fmt::format("{}(", words[0].text) : "";
  if (const frontend::ForeignWord* foreign = frontend::findForeign(language.foreign, word))
    report.note(fmt::format("{} {}", compares ? "a comparison is" : "in this language:", foreign->here));
  else if (const auto address = splitAddress(language, words[1].text);
           address && !language.at(address->area).instead.empty())
    report.note(language.at(address->area).instead);
}

// A word too many; what other languages have there.
void reportSurplus(const Language& language, Command command, std::span<const Word> words, Diagnostics& diagnostics) {
  const Word& word = words[operandCount(command) + 1];
  DiagBuilder report = diagnostics.report(diag::BadOperand, word.range);
  report << word.text
         << fmt::format("a part of this statement: {} takes {}", language.nameOf(command),
                        isBlock(command) ? "nothing" : wantedOperand(command));
  if (looksLikeComment(word.text))
    report.note("a comment begins with ';'");
  else if (findCommand(language, word.text))
    report.note("each command has a line of its own");
  else if (command == Command::Function)
    report.note(fmt::format("its parameters follow on lines of their own: {} {}", language.nameOf(Command::Parameter),
                            word.text));
  else if (isContact(command) || isCoil(command))
    noteForeign(language, words, report);
}

} // namespace

size_t operandCount(Command command) { return isBlock(command) ? 0 : isDeclaration(command) ? 2 : 1; }

// Of a language whose comments begin otherwise.
bool looksLikeComment(std::string_view word) {
  constexpr std::string_view kBegins[] = {"//", "/*", "(*", "#"};
  return std::ranges::any_of(kBegins, [&](std::string_view begin) { return word.starts_with(begin); });
}

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
    reportBadCharacter(word.text, static_cast<size_t>(bad - word.text.begin()), word.range.begin, diagnostics);
    return false;
  }
  return true;
}

bool checkOperands(const Language& language, Diagnostics& diagnostics, Command command, std::span<const Word> words) {
  const size_t wanted = operandCount(command);
  if (words.size() - 1 == wanted) return true;
  if (isDeclaration(command))
    diagnostics.report(diag::BadOperand, words[0].range)
        << words[0].text << fmt::format("a complete statement: {}", wantedOperand(command));
  else if (words.size() - 1 < wanted)
    diagnostics.report(diag::BadOperand, words[0].range)
        << words[0].text << fmt::format("a complete statement: {} is missing", wantedOperand(command));
  else
    reportSurplus(language, command, words, diagnostics);
  return false;
}

} // namespace rung::frontend::network

// Formats command lists with one statement per line: commands in capitals, operands in a column, and step numbers in a
// column before them.
#include "frontend/network/format.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/ladder/text/format.h"
#include "frontend/network/convert/writers.h"
#include "frontend/network/read/ladder_reader.h"
#include "frontend/network/read/list_reader.h"
#include "frontend/network/read/reading.h"
#include "frontend/syntax/page.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

constexpr Table kNames; // symbol, const

// The operand as text; mnemonics of functions are written in capitals like commands.
std::string operandText(const Language& language, Command command, const Word& word) {
  const bool isMnemonic = command == Command::Function && language.findFunction(word.text) != nullptr;
  return isMnemonic ? text::upper(word.text) : std::string(word.text);
}

class ListFormatter {
public:
  ListFormatter(const Language& language, SourceManager& sources, FileId file, Diagnostics& diagnostics)
      : context_{.language = language, .sources = sources, .diagnostics = diagnostics}, file_(file),
        page_(sources.text(file), kCommentColumn) {}

  std::string run() {
    findNumbers();
    LineReader lines(context_.sources, file_);
    for (SourceLine source; lines.next(source);) line(source);
    return page_.take();
  }

private:
  void findNumbers();
  void line(const SourceLine& source);
  void statement(std::span<const Word> words, std::string_view comment);
  std::string number() const;

  Context context_;
  FileId file_;
  Page page_;
  LineWords words_;
  size_t numberWidth_ = 0; // width of the step numbers and the blank after them; 0 without step numbers
};

void ListFormatter::findNumbers() {
  LineReader lines(context_.sources, file_);
  for (SourceLine source; lines.next(source);) {
    splitWords(source, kListRules, words_);
    if (statementOf(words_).size() < words_.words.size())
      numberWidth_ = std::max(numberWidth_, words_.words[0].text.size() + 1);
  }
}

// The step number of the line, padded to its column.
std::string ListFormatter::number() const {
  const bool has = statementOf(words_).size() < words_.words.size();
  return fmt::format("{:<{}}", has ? words_.words[0].text : "", numberWidth_);
}

void ListFormatter::line(const SourceLine& source) {
  splitWords(source, kListRules, words_);
  const std::string_view comment =
      words_.hasComment ? source.text.substr(words_.commentRange.begin.value - source.begin.value) : "";
  const std::span<const Word> words = statementOf(words_);
  if (!words.empty()) return statement(words, comment);
  if (!words_.words.empty()) return page_.line(std::string(words_.words[0].text), comment);
  if (words_.hasComment) return page_.comment(std::string(comment));
  page_.blank();
}

void ListFormatter::statement(std::span<const Word> words, std::string_view comment) {
  if (!checkCharacters(context_.diagnostics, words)) return;
  const auto command = findCommand(context_.language, words[0].text);
  if (!command || isForeign(context_.language, words)) return reportUnknownCommand(context_, words);
  if (!checkOperands(context_.language, context_.diagnostics, *command, words)) return;
  if (isDeclaration(*command))
    return page_.row(kNames,
                     {number() + text::lower(words[0].text), std::string(words[1].text), std::string(words[2].text)},
                     comment);
  if (*command == Command::Dialect)
    return page_.line(fmt::format("{}{} {}", number(), text::lower(words[0].text), words[1].text), comment);
  const std::string operand = words.size() > 1 ? operandText(context_.language, *command, words[1]) : "";
  page_.line(number() + commandText(context_.language, *command, operand), comment);
}

} // namespace

std::string listCommand(const Language& language, const Written& command, bool /*begins*/) {
  return commandText(language, command.command, command.operand);
}

std::optional<std::string> formatList(const Language& language, SourceManager& sources, FileId file,
                                      Diagnostics& diagnostics) {
  const size_t before = diagnostics.errorCount();
  if (!checkEncoding(sources, file, diagnostics)) return std::nullopt;
  std::string text = ListFormatter(language, sources, file, diagnostics).run();
  return diagnostics.errorCount() == before ? std::optional(std::move(text)) : std::nullopt;
}

std::optional<std::string> format(const Language& language, SourceManager& sources, FileId file,
                                  Diagnostics& diagnostics) {
  if (isLadder(language, sources, file)) return ladder::format(sources, file, language.findBox, diagnostics);
  return language.list.format(language, sources, file, diagnostics);
}

} // namespace rung::frontend::network

// Lines of a command list to calls of the network builder.
#include "frontend/dialects/gsk/read/list_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/gsk/read/network_builder.h"
#include "frontend/dialects/gsk/read/title.h"
#include "rtlib/text/letters.h"

namespace rung::gsk {
namespace {

std::string_view wantedOperand(Command command) {
  switch (command) {
  case Command::Func: return "the number or name of a function";
  case Command::Prm: return "a parameter";
  case Command::Table: return "a constant";
  case Command::Dialect: return "the name of the dialect";
  case Command::Symbol: return "a name and an address";
  case Command::Const: return "a name and a constant";
  case Command::Orb:
  case Command::Anb: return "";
  case Command::Ld:
  case Command::Ldi:
  case Command::And:
  case Command::Ani:
  case Command::Or:
  case Command::Ori:
  case Command::Out:
  case Command::Outi:
  case Command::Set:
  case Command::Rst: return "a bit";
  }
  return "";
}

bool isDeclaration(Command command) { return command == Command::Symbol || command == Command::Const; }

size_t operandCount(Command command) {
  return command == Command::Orb || command == Command::Anb ? 0 : isDeclaration(command) ? 2 : 1;
}

// Only these may stand outside comments.
bool isPlain(char c) { return c >= 0x21 && c <= 0x7E; }

class ListReader {
public:
  ListReader(Context& context, FileId file, UnitAssembler& units)
      : context_(context), file_(file),
        builder_(context, file, [&units](Network&& network) { units.add(std::move(network)); }) {}

  void read() {
    LineReader lines(context_.sources, file_);
    while (lines.next(line_)) {
      splitWords(line_, kListRules, words_);
      const auto statement = statementOf(words_);
      if (statement.empty())
        comment();
      else
        readStatement(statement);
    }
    builder_.finish();
  }

private:
  void comment();
  void readStatement(std::span<const Word> words);
  bool checkCharacters(std::span<const Word> words);
  bool checkOperands(Command command, std::span<const Word> words);
  void lostOperand(Command command, const Word& name, Place at);
  void dispatch(Command command, std::span<const Word> words, Place at);
  const Row* functionOf(const Word& word);
  void function(const Word& name, Place at);
  void checkDialect(const Word& word);

  Context& context_;
  FileId file_;
  NetworkBuilder builder_;
  SourceLine line_;
  LineWords words_;
  TitleRule title_;
};

void ListReader::comment() {
  if (words_.hasComment)
    title_.comment(words_.comment);
  else
    title_.blank();
  builder_.title(title_.title());
}

// Outside comments only printable ASCII may stand: the manual's scan has look-alikes of other alphabets.
bool ListReader::checkCharacters(std::span<const Word> words) {
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
      context_.diagnostics.report(Diag::BadCharacter, range)
          << fmt::format("0x{:02X}", static_cast<unsigned char>(*bad));
    else
      context_.diagnostics.report(Diag::BadCharacter, range) << fmt::format("'{}'", word.text.substr(offset, length));
    return false;
  }
  return true;
}

bool ListReader::checkOperands(Command command, std::span<const Word> words) {
  const size_t wanted = operandCount(command);
  if (words.size() - 1 == wanted) return true;
  if (words.size() - 1 < wanted)
    context_.diagnostics.report(Diag::BadOperand, words[0].range)
        << words[0].text << fmt::format("complete statement: {} is missing", wantedOperand(command));
  else
    context_.diagnostics.report(Diag::BadOperand, words[wanted + 1].range)
        << words[wanted + 1].text
        << fmt::format("part of this statement: {} takes {}", words[0].text,
                       wanted == 0 ? "nothing" : wantedOperand(command));
  return false;
}

void ListReader::readStatement(std::span<const Word> words) {
  title_.statement();
  const Place at{join(words.front().range, words.back().range), line_.number};
  const bool readable = checkCharacters(words);
  const auto command = findCommand(words[0].text);
  if (!command) {
    if (readable) reportUnknownCommand(context_, words[0], kCommandNames);
    return builder_.garbage(at);
  }
  if (*command >= Command::Dialect) builder_.title({});
  if (isDeclaration(*command)) return; // readListSymbols
  if (!readable || !checkOperands(*command, words)) return lostOperand(*command, words[0], at);
  if (*command == Command::Dialect) return checkDialect(words[1]);
  dispatch(*command, words, at);
}

// The command counts with an operand that nothing is said about any more; of FUNC nothing is left.
void ListReader::lostOperand(Command command, const Word& name, Place at) {
  if (command == Command::Func) return builder_.garbage(at);
  const Word words[] = {name, Word{}};
  dispatch(command, words, at);
}

void ListReader::checkDialect(const Word& word) {
  if (!text::equalsIgnoringCase(word.text, "gsk"))
    context_.diagnostics.report(Diag::DialectConflict, word.range) << word.text << "gsk";
}

const Row* ListReader::functionOf(const Word& word) {
  const auto number = parseDigits(word.text);
  const Row* row = number ? findFunction(*number) : findFunction(word.text);
  if (row == nullptr) reportUnknownFunction(context_, word.text, word.range);
  return row;
}

// The ends of units are not drawn in ladder form: they have no title.
void ListReader::function(const Word& name, Place at) {
  const Row* row = functionOf(name);
  if (row != nullptr && isEnd(row->control)) builder_.title({});
  builder_.function(row, at);
}

void ListReader::dispatch(Command command, std::span<const Word> words, Place at) {
  switch (command) {
  case Command::Ld: return builder_.contact(Logic::Load, false, words[1], at);
  case Command::Ldi: return builder_.contact(Logic::Load, true, words[1], at);
  case Command::And: return builder_.contact(Logic::And, false, words[1], at);
  case Command::Ani: return builder_.contact(Logic::And, true, words[1], at);
  case Command::Or: return builder_.contact(Logic::Or, false, words[1], at);
  case Command::Ori: return builder_.contact(Logic::Or, true, words[1], at);
  case Command::Orb: return builder_.block(Logic::OrBlock, at);
  case Command::Anb: return builder_.block(Logic::AndBlock, at);
  case Command::Out: return builder_.coil(Coil::Out, words[1], at);
  case Command::Outi: return builder_.coil(Coil::OutInverted, words[1], at);
  case Command::Set: return builder_.coil(Coil::Set, words[1], at);
  case Command::Rst: return builder_.coil(Coil::Reset, words[1], at);
  case Command::Func: return function(words[1], at);
  case Command::Prm: return builder_.parameter(words[1], at);
  case Command::Table: return builder_.tableRow(words[1], at);
  case Command::Dialect:
  case Command::Symbol:
  case Command::Const: return;
  }
}

} // namespace

std::optional<Command> findCommand(std::string_view text) {
  const auto at = std::find_if(kCommandNames.begin(), kCommandNames.end(),
                               [&](std::string_view name) { return text::equalsIgnoringCase(name, text); });
  if (at == kCommandNames.end()) return std::nullopt;
  return static_cast<Command>(at - kCommandNames.begin());
}

// The words behind the step number (the S/N column).
std::span<const Word> statementOf(const LineWords& line) {
  std::span<const Word> words(line.words);
  if (!words.empty() && parseDigits(words[0].text)) words = words.subspan(1);
  return words;
}

void readListSymbols(Context& context, FileId file) {
  LineReader lines(context.sources, file);
  SourceLine line;
  LineWords words;
  while (lines.next(line)) {
    splitWords(line, kListRules, words);
    const auto statement = statementOf(words);
    const auto command = statement.empty() ? std::nullopt : findCommand(statement[0].text);
    if (!command || !isDeclaration(*command)) continue;
    const bool readable = std::all_of(statement.begin(), statement.end(), [](const Word& word) {
      return std::all_of(word.text.begin(), word.text.end(), isPlain);
    });
    if (!readable) continue; // the reader of the list tells
    if (statement.size() != 3)
      context.diagnostics.report(Diag::BadOperand, statement[0].range)
          << statement[0].text
          << (*command == Command::Symbol ? "complete statement: `symbol NAME ADDRESS`"
                                          : "complete statement: `const NAME VALUE`");
    else if (*command == Command::Symbol)
      context.names.addSymbol(context, statement[1], statement[2], words.comment);
    else
      context.names.addConstant(context, statement[1], statement[2]);
  }
}

void readList(Context& context, FileId file, UnitAssembler& units) { ListReader(context, file, units).read(); }

SourceRange lastLineOf(const SourceManager& sources, FileId file) {
  const std::string_view text = sources.text(file);
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos) return sources.range(file, 0, 0);
  const size_t begin = text.rfind('\n', last);
  return sources.range(file, begin == std::string_view::npos ? 0 : begin + 1, last + 1);
}

} // namespace rung::gsk

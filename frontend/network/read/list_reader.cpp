// Translates lines of a command list into calls of the network builder.
#include "frontend/network/read/list_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "frontend/network/address.h"
#include "frontend/network/read/drawn_comments.h"
#include "frontend/network/read/network_builder.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/source.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

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
  void declaration(Command command, std::span<const Word> words);
  void unknownCommand(std::span<const Word> words);
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
  bool sawDrawing_ = false;
};

void ListReader::comment() {
  if (words_.hasComment && context_.sources.isEncodingComment(words_.commentRange)) return;
  if (words_.hasComment) {
    title_.comment(words_.comment);
    context_.gaps.comment(words_.comment);
  } else {
    title_.blank();
    context_.gaps.blank();
  }
  builder_.title(title_.title());
}

void ListReader::readStatement(std::span<const Word> words) {
  title_.statement();
  const Place at{join(words.front().range, words.back().range), line_.number};
  const bool readable = checkCharacters(context_.diagnostics, words);
  const auto command = findCommand(context_.language, words[0].text);
  if (!command || isForeign(context_.language, words)) {
    if (readable) unknownCommand(words);
    return builder_.garbage(at);
  }
  if (*command >= Command::Dialect) builder_.title({});
  if (isDeclaration(*command)) return declaration(*command, words);
  if (!readable || !checkOperands(context_.language, context_.diagnostics, *command, words))
    return lostOperand(*command, words[0], at);
  if (*command == Command::Dialect) return checkDialect(words[1]);
  dispatch(*command, words, at);
  builder_.comment(words_.comment);
}

// Records a declaration as an item of the gap. Its content was read before all networks (readDeclarations).
void ListReader::declaration(Command command, std::span<const Word> words) {
  const auto kind = command == Command::Symbol ? Item::Kind::Symbol : Item::Kind::Const;
  if (words.size() == 1 + operandCount(command)) context_.gaps.declaration(kind, words[1], words[2], words_.comment);
}

// Reports an unknown command; a drawing is reported only at its first line.
void ListReader::unknownCommand(std::span<const Word> words) {
  const bool drawing = words[0].text.starts_with('|') || words[0].text.starts_with('+');
  if (!drawing || !sawDrawing_) reportUnknownCommand(context_, words);
  sawDrawing_ = sawDrawing_ || drawing;
}

// Keeps a command whose operand was rejected, with an empty operand that causes no further errors. FUNC without its
// operand is dropped.
void ListReader::lostOperand(Command command, const Word& name, Place at) {
  if (command == Command::Function) return builder_.garbage(at);
  const Word words[] = {name, Word{}};
  dispatch(command, words, at);
}

void ListReader::checkDialect(const Word& word) {
  context_.gaps.dialect(words_.comment);
  const std::string_view own = context_.language.name;
  if (!text::equalsIgnoringCase(word.text, own))
    context_.diagnostics.report(diag::DialectConflict, word.range) << word.text << own;
}

const Row* ListReader::functionOf(const Word& word) {
  const auto number = parseDigits(word.text);
  const Row* row = number ? context_.language.findFunction(*number) : context_.language.findFunction(word.text);
  if (row == nullptr)
    reportUnknownFunction(context_, word.text, word.range);
  else
    context_.analysis.use(frontend::InstructionUse{word.range, &row->info});
  return row;
}

// Functions that end a unit do not appear in ladder form, so they have no title.
void ListReader::function(const Word& name, Place at) {
  const Row* row = functionOf(name);
  if (row != nullptr && isEnd(row->control)) builder_.title({});
  builder_.function(row, at);
}

void ListReader::dispatch(Command command, std::span<const Word> words, Place at) {
  if (isContact(command))
    return builder_.contact(logicOf(command), isClosed(command) ? Contact::Closed : Contact::Open, words[1], at);
  if (isBlock(command)) return builder_.block(logicOf(command), at);
  if (isCoil(command)) return builder_.coil(coilOf(command), words[1], at);
  if (command == Command::Function) return function(words[1], at);
  if (command == Command::Parameter) return builder_.parameter(words[1], at);
  if (command == Command::Table) builder_.tableRow(words[1], at);
}

class CommandList final : public ListFile {
public:
  using ListFile::ListFile;
  void readDeclarations(Context& context) const override;
  void read(Context& context, UnitAssembler& units) const override { ListReader(context, file(), units).read(); }
};

// `symbol` and `const` statements.
void CommandList::readDeclarations(Context& context) const {
  LineReader lines(context.sources, file());
  SourceLine line;
  LineWords words;
  while (lines.next(line)) {
    splitWords(line, kListRules, words);
    const auto statement = statementOf(words);
    const auto command = statement.empty() ? std::nullopt : findCommand(context.language, statement[0].text);
    if (!command || !isDeclaration(*command)) continue;
    if (!isReadable(statement)) continue; // reported when the list is read
    if (!checkOperands(context.language, context.diagnostics, *command, statement)) continue;
    if (*command == Command::Symbol)
      context.names.addSymbol(context, statement[1], statement[2], words.comment);
    else
      context.names.addConstant(context, statement[1], statement[2]);
  }
}

} // namespace

std::shared_ptr<const ListFile> openList(const SourceManager&, FileId file) {
  return std::make_shared<CommandList>(file);
}

SourceRange lastLineOf(const SourceManager& sources, FileId file) {
  const std::string_view text = sources.text(file);
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos) return sources.range(file, 0, 0);
  const size_t begin = text.rfind('\n', last);
  return sources.range(file, begin == std::string_view::npos ? 0 : begin + 1, last + 1);
}

// Checks of single statements of a command list (see list_reader.h).

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

// Characters that are allowed outside comments.
bool isPlain(char c) { return c >= 0x21 && c <= 0x7E; }

// Explains brackets, comparisons and bits of timers of other languages: `AND ( X0.1`, `LD D0 = 1`, `OUT T1 K50`.
void noteForeign(const Language& language, std::span<const Word> words, DiagBuilder& report) {
  const bool compares = words[2].text.find_first_not_of("<>=!") == std::string_view::npos;
  const std::string word = compares ? "CMP" : words[1].text == "(" ? fmt::format("{}(", words[0].text) : "";
  if (const frontend::ForeignWord* foreign = frontend::findForeign(language.foreign, word))
    report.note(fmt::format("{} {}", compares ? "a comparison is" : "in this language:", foreign->here));
  else if (const auto address = splitAddress(language, words[1].text);
           address && !language.at(address->area).instead.empty())
    report.note(language.at(address->area).instead);
}

// Reports a surplus word, and explains what other languages write there.
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

// Whether the word begins a comment of another language.
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

// Outside comments only printable ASCII is allowed: the manual's scan contains look-alikes of other alphabets.
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

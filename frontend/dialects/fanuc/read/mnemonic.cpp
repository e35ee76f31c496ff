// See mnemonic.h: lines of a ladder to calls of the network builder.
#include "frontend/dialects/fanuc/read/mnemonic.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/read/messages.h"
#include "frontend/dialects/fanuc/read/sections.h"
#include "frontend/dialects/fanuc/read/symbols.h"
#include "frontend/network/address.h"
#include "frontend/network/read/drawn_comments.h"
#include "frontend/network/read/list_reader.h"
#include "frontend/network/read/network_builder.h"
#include "frontend/network/read/units.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/source.h"
#include "ir/support/diag/structure.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

using network::Coil;
using network::Contact;
using network::Context;
using network::Control;
using network::Logic;
using network::NetworkBuilder;
using network::Place;
using network::Row;

// How a command uses the stack, with its operand.
enum class Verb : uint8_t { First, Further, And, Or, AndBlock, OrBlock, Coil, Unbuilt };

struct CommandInfo {
  std::string_view name;
  Verb verb;
  Contact contact = Contact::Open;
  Coil coil = Coil::Out;
};
constexpr CommandInfo kCommands[] = {
    {"RD", Verb::First},
    {"RD.NOT", Verb::First, Contact::Closed},
    {"RD.STK", Verb::Further},
    {"RD.NOT.STK", Verb::Further, Contact::Closed},
    {"RD.STK.NOT", Verb::Further, Contact::Closed}, // as LADDER-III writes it
    {"AND", Verb::And},
    {"AND.NOT", Verb::And, Contact::Closed},
    {"OR", Verb::Or},
    {"OR.NOT", Verb::Or, Contact::Closed},
    {"AND.STK", Verb::AndBlock},
    {"OR.STK", Verb::OrBlock},
    {"WRT", Verb::Coil, Contact::Open, Coil::Out},
    {"WRT.NOT", Verb::Coil, Contact::Open, Coil::OutInverted},
    {"SET", Verb::Coil, Contact::Open, Coil::Set},
    {"RST", Verb::Coil, Contact::Open, Coil::Reset},
    {"RDPT", Verb::Unbuilt},
    {"RDNT", Verb::First, Contact::Falling},
    {"ANDPT", Verb::Unbuilt},
    {"ANDNT", Verb::Unbuilt},
    {"ORPT", Verb::Unbuilt},
    {"ORNT", Verb::Unbuilt},
    {"RDPT.STK", Verb::Unbuilt},
    {"RDNT.STK", Verb::Unbuilt},
    {"PUSH", Verb::Unbuilt},
    {"POP", Verb::Unbuilt},
};

bool takesBit(Verb verb) { return verb != Verb::AndBlock && verb != Verb::OrBlock; }

const CommandInfo* findCommand(std::string_view word) {
  const auto* const found = std::ranges::find_if(
      kCommands, [&](const CommandInfo& command) { return text::equalsIgnoringCase(command.name, word); });
  return found == std::end(kCommands) ? nullptr : found;
}

class LadderReader {
public:
  LadderReader(Context& context, FileId file, network::UnitAssembler& units)
      : context_(context), builder_(context, file, [&units](network::Network&& n) { units.add(std::move(n)); }) {}

  void line(const SourceLine& line);
  void finish();

private:
  bool takeComment(SourceLine& line);
  void plain(const SourceLine& line);
  void remark();
  void statement(std::span<const Word> words);
  void command(const CommandInfo& command, std::span<const Word> words, Place at);
  const Row* functionNamed(std::string_view word) const;
  void function(const Row* row, std::span<const Word> parameters, Place at);
  void begin(const Row* row);
  void numbered(std::span<const Word> words, Place at);
  bool wantsParameter() const;
  bool isOperand(const Word& word) const;
  void parameter(const Word& word);
  void unknown(std::span<const Word> words, Place at);
  void subtraction(std::span<const Word> words, Place at);
  std::span<const Word> withoutParameterWord(std::span<const Word> words);
  Place placeOf(std::span<const Word> words) const {
    return {join(words.front().range, words.back().range), line_.number};
  }

  Context& context_;
  NetworkBuilder builder_;
  SourceLine line_;
  LineWords words_;
  network::TitleRule title_;
  bool inComment_ = false; // (* over lines *)
  Place commentBegin_;
  // The function whose parameters follow. `row_` is null for an unknown one, which takes everything but commands.
  bool inFunction_ = false;
  const Row* row_ = nullptr;
  bool saidForeign_ = false; // of a word before its parameters
  size_t parameters_ = 0;
  int64_t capacity_ = 0; // of its table
};

// The part of a line from `at` on.
SourceLine from(const SourceLine& line, size_t at) { return {line.number, line.text.substr(at), line.at(at)}; }

// A line without the number of its network, which no blank need separate from the statement.
SourceLine withoutNumber(const SourceLine& line) {
  const size_t begin = std::min(line.text.find_first_not_of(" \t"), line.text.size());
  const size_t colon = line.text.find(':', begin);
  if (colon == std::string_view::npos || !isNetworkNumber(line.text.substr(begin, colon + 1 - begin))) return line;
  return from(line, colon + 1);
}

// Comments of networks, `(* … *)`, over lines, between statements.
void LadderReader::line(const SourceLine& whole) {
  SourceLine rest = inComment_ ? whole : withoutNumber(whole);
  const bool hasNumber = rest.begin != whole.begin;
  bool sawComment = false;
  while (true) {
    if (inComment_) {
      sawComment = true;
      if (!takeComment(rest)) return;
    }
    const size_t open = std::min(rest.text.find("(*"), rest.text.size());
    const bool isRemark = rest.text.find(';') < open;
    const SourceLine before{rest.number, isRemark ? rest.text : rest.text.substr(0, open), rest.begin};
    const bool isEmpty = text::trimmed(before.text).empty();
    if (!isEmpty || (open == rest.text.size() && !sawComment && !hasNumber)) plain(before);
    if (isRemark || open == rest.text.size()) return;
    commentBegin_ = {rest.range(open, open + 2), rest.number};
    rest = from(rest, open + 2);
    inComment_ = true;
    title_.blank(); // a remark above it is not the network's title
  }
}

void LadderReader::finish() {
  if (inComment_) {
    context_.diagnostics.report(diag::UnclosedComment, commentBegin_.range);
    builder_.garbage(commentBegin_);
  }
  builder_.finish();
}

// The text of a comment up to its end, after which `line` begins then; false if it does not end on the line.
bool LadderReader::takeComment(SourceLine& line) {
  const size_t end = line.text.find("*)");
  const std::string_view comment = text::trimmed(line.text.substr(0, end));
  if (!comment.empty()) {
    title_.comment(comment);
    context_.gaps.comment(comment);
    builder_.title(title_.title());
  }
  if (end == std::string_view::npos) return false;
  inComment_ = false;
  line = from(line, end + 2);
  return true;
}

void LadderReader::plain(const SourceLine& line) {
  line_ = line;
  splitWords(line_, kMnemonicRules, words_);
  if (words_.words.empty()) return remark();
  title_.statement();
  statement(words_.words);
  builder_.comment(words_.comment);
}

void LadderReader::remark() {
  if (words_.hasComment) {
    title_.comment(words_.comment);
    context_.gaps.comment(words_.comment);
  } else {
    title_.blank();
    context_.gaps.blank();
  }
  builder_.title(title_.title());
}

// AND, OR and NOT without an operand are functions (§1.6). Their rows have names of their own.
const Row* LadderReader::functionNamed(std::string_view word) const {
  const bool isAnd = text::equalsIgnoringCase(word, "AND"), isOr = text::equalsIgnoringCase(word, "OR");
  return context_.language.findFunction(isAnd ? "ANDF" : isOr ? "ORF" : word);
}

void LadderReader::statement(std::span<const Word> words) {
  const Place at = placeOf(words);
  if (!network::checkCharacters(context_.diagnostics, words)) return builder_.garbage(at);
  const CommandInfo* known = findCommand(words[0].text);
  if (known != nullptr && (words.size() > 1 || !takesBit(known->verb))) return command(*known, words, at);
  if (text::equalsIgnoringCase(words[0].text, "SUB"))
    return words.size() > 1 ? numbered(words, at) : subtraction(words, at);
  if (words.size() == 2 && text::equalsIgnoringCase(words[1].text, "SP"))
    return function(&context_.language.rowOf(Control::Sp), words.first(1), at);
  if (const Row* row = functionNamed(words[0].text)) return function(row, words.subspan(1), at);
  if (known != nullptr) return command(*known, words, at);
  if (text::equalsIgnoringCase(words[0].text, "FUNC") && !context_.names.has(words[0].text)) return unknown(words, at);
  if (inFunction_) words = withoutParameterWord(words);
  if (!wantsParameter() && !(inFunction_ && isOperand(words[0]))) return unknown(words, at);
  for (const Word& word : words) parameter(word);
}

void LadderReader::command(const CommandInfo& command, std::span<const Word> words, Place at) {
  inFunction_ = false;
  if (command.verb == Verb::Unbuilt) {
    context_.diagnostics.report(diag::NotBuiltYet, at.range) << command.name;
    return builder_.garbage(at);
  }
  const size_t wanted = takesBit(command.verb) ? 2 : 1;
  if (words.size() > wanted)
    context_.diagnostics.report(diag::BadOperand, words[wanted].range)
        << words[wanted].text
        << fmt::format("a part of this statement: {} takes {}", command.name, wanted == 1 ? "nothing" : "one bit");
  else if (words.size() < wanted)
    context_.diagnostics.report(diag::BadOperand, words[0].range)
        << words[0].text << "a complete statement: a bit is missing";
  const Word operand = words.size() == wanted && wanted == 2 ? words[1] : Word{};
  switch (command.verb) {
  case Verb::First: return builder_.first(command.contact, operand, at);
  case Verb::Further: return builder_.further(command.contact, operand, at);
  case Verb::And: return builder_.contact(Logic::And, command.contact, operand, at);
  case Verb::Or: return builder_.contact(Logic::Or, command.contact, operand, at);
  case Verb::AndBlock: return builder_.block(Logic::AndBlock, at);
  case Verb::OrBlock: return builder_.block(Logic::OrBlock, at);
  case Verb::Coil: return builder_.coil(command.coil, operand, at);
  case Verb::Unbuilt: return;
  }
}

// `SUB 43`, possibly with parameters.
void LadderReader::numbered(std::span<const Word> words, Place at) {
  const auto number = network::parseDigits(words[1].text);
  const Row* row = number ? context_.language.findFunction(*number) : functionNamed(words[1].text);
  if (row == nullptr) network::reportUnknownFunction(context_, words[1].text, words[1].range);
  function(row, words.subspan(2), at);
}

// `SUB` alone is the function SUB 20, if as many conditions as that one has are on the stack. Otherwise the number of
// another function is missing.
void LadderReader::subtraction(std::span<const Word> words, Place at) {
  const Row* row = context_.language.findFunction("SUB");
  if (builder_.values() == row->info.pins.size()) return function(row, words.subspan(1), at);
  context_.diagnostics.report(diag::BadOperand, at.range)
          .note(fmt::format("`SUB` alone is the function SUB {}, which has {} conditions", row->info.number,
                            row->info.pins.size()))
      << words[0].text << "a complete statement: the number of a function is missing";
  builder_.garbage(at);
  begin(nullptr);
}

// Parameters as GSK's lists have them, `PRM D10`, are reported once for a function and read without the word.
std::span<const Word> LadderReader::withoutParameterWord(std::span<const Word> words) {
  const bool isWord =
      text::equalsIgnoringCase(words[0].text, "PRM") || text::equalsIgnoringCase(words[0].text, "TABLE");
  if (!isWord || words.size() != 2 || context_.names.has(words[0].text)) return words;
  if (!std::exchange(saidForeign_, true) && row_ != nullptr) network::reportUnknownCommand(context_, words);
  return words.subspan(1);
}

void LadderReader::function(const Row* row, std::span<const Word> parameters, Place at) {
  if (row != nullptr) context_.analysis.use(frontend::InstructionUse{at.range, &row->info});
  if (row != nullptr && network::isEnd(row->control)) builder_.title({});
  builder_.function(row, at);
  begin(row);
  for (const Word& word : parameters) parameter(word);
}

void LadderReader::begin(const Row* row) {
  inFunction_ = true;
  saidForeign_ = false;
  row_ = row;
  parameters_ = 0;
  capacity_ = 0;
}

// All parameters of the row and, after them, the rows of its table; of an unknown function whatever comes.
bool LadderReader::wantsParameter() const {
  if (!inFunction_) return false;
  if (row_ == nullptr || !row_->built) return true;
  return parameters_ < row_->info.operands.size() + static_cast<size_t>(row_->hasTable ? capacity_ : 0);
}

// A number or an address, which is a parameter, possibly one too many.
bool LadderReader::isOperand(const Word& word) const {
  return network::parseConstant(context_.language, word.text) ||
         network::splitAddress(context_.language, word.text).has_value();
}

void LadderReader::parameter(const Word& word) {
  const Place at{word.range, line_.number};
  const bool isRow = row_ != nullptr && row_->hasTable && parameters_ >= row_->info.operands.size();
  if (row_ != nullptr && row_->hasTable && parameters_ == row_->capacityAt) {
    const uint64_t rows = std::min<uint64_t>(network::parseDigits(word.text).value_or(1), 256);
    capacity_ = rows == 0 ? 100 : static_cast<int64_t>(rows);
  }
  ++parameters_;
  if (isRow) return builder_.tableRow(word, at);
  builder_.parameter(word, at);
}

void LadderReader::unknown(std::span<const Word> words, Place at) {
  inFunction_ = false;
  if (words.size() == 2 && text::equalsIgnoringCase(words[1].text, "LBL"))
    context_.diagnostics.report(diag::UnknownCommand, words[0].range)
            .note(fmt::format("a label is `{}`, with its number on the next line",
                              context_.language.callOf(context_.language.rowOf(Control::Lbl))))
        << words[0].text;
  else if (words.size() == 1 && isOperand(words[0]))
    context_.diagnostics.report(diag::StrayParameter, at.range) << "a parameter";
  else
    network::reportUnknownCommand(context_, words);
  builder_.garbage(at);
}

} // namespace

bool isCommand(std::string_view word) { return findCommand(word) != nullptr; }

bool isNetworkNumber(std::string_view word) {
  return word.size() > 2 && text::upper(word.front()) == 'N' && word.back() == ':' &&
         network::parseDigits(word.substr(1, word.size() - 2)).has_value();
}

namespace {

// For conversions: the lines of a section that is not ladder, as declarations between the networks.
class SectionKeeper {
public:
  SectionKeeper(Context& context, FileId file) : context_(context), file_(file) {}

  // The text before the first section.
  void head(const Section& first) const {
    for (uint32_t number = 1; number + 1 < first.first; ++number)
      if (const std::string_view text = text::trimmed(lineOf(context_.sources, file_, number).text);
          !text.empty() && !text.starts_with("%@"))
        context_.gaps.comment(text.substr(text.starts_with(';') ? 1 : 0));
  }
  void section(const Section& section) {
    if (section.kind == Section::Kind::Outside) return outside(section);
    isEmpty_ = true;
    hasSymbols(section) ? symbols(section) : lines(section);
    // A section without lines is an empty line of it.
    if (isEmpty_) context_.gaps.declaration(Kind::Data, nameOf(section), {"", section.range, true}, {});
  }

private:
  using Kind = network::Item::Kind;

  static Word nameOf(const Section& section) { return {section.name(), section.range, false}; }
  void lines(const Section& section) {
    const bool hasMessages = section.kind == Section::Kind::Messages;
    eachLine(context_.sources, file_, section, [&](const SourceLine& line) {
      const auto message = hasMessages ? messageIn(line) : std::nullopt;
      const std::string_view text = text::trimmed(line.text);
      if (text.empty()) return;
      isEmpty_ = false;
      if (message) return context_.gaps.declaration(Kind::Message, message->place, message->text, {});
      const auto at = static_cast<size_t>(text.data() - line.text.data());
      context_.gaps.declaration(Kind::Data, nameOf(section), {text, line.range(at, at + text.size()), false}, {});
    });
  }
  void outside(const Section& section) const {
    eachLine(context_.sources, file_, section,
             [&](const SourceLine& line) { context_.gaps.comment(text::trimmed(line.text)); });
  }
  void symbols(const Section& section) {
    Diagnostics discarded; // reported when the symbols were declared
    const SymbolSink sink{[&](const Word& name, const Word& place, const Comments& comments) {
                            isEmpty_ = false;
                            context_.gaps.declaration(Kind::Symbol, name, place, joined(comments));
                          },
                          [&](std::string_view text) { context_.gaps.comment(text); }};
    readSymbols(context_.sources, discarded, file_, section, sink);
  }

  Context& context_;
  FileId file_;
  bool isEmpty_ = true; // the section so far
};

} // namespace

void MnemonicFile::readDeclarations(Context& context) const {
  const SymbolSink sink{
      [&](const Word& name, const Word& place, const Comments& comments) { addSymbol(context, name, place, comments); },
      [](std::string_view) {}};
  for (const Section& section : sections())
    if (hasSymbols(section)) readSymbols(context.sources, context.diagnostics, file(), section, sink);
}

void MnemonicFile::read(Context& context, network::UnitAssembler& units) const {
  SectionKeeper keeper(context, file());
  if (context.gaps.areKept() && !sections().empty()) keeper.head(sections().front());
  for (const Section& section : sections()) {
    if (!section.isClosed)
      context.diagnostics.report(diag::IncompleteFile, section.range)
          << fmt::format("the section {} does not end with a line that is %", section.name());
    if (section.kind == Section::Kind::Unknown)
      context.diagnostics.report(diag::UnknownSection, section.range) << section.code;
    if (section.kind == Section::Kind::Outside) context.diagnostics.report(diag::TextOutsideSection, section.range);
    if (section.kind != Section::Kind::Ladder) {
      if (context.gaps.areKept()) keeper.section(section);
      continue;
    }
    LadderReader reader(context, file(), units);
    eachLine(context.sources, file(), section, [&](const SourceLine& line) { reader.line(line); });
    reader.finish();
  }
}

std::shared_ptr<const network::ListFile> openMnemonic(const SourceManager& sources, FileId file) {
  return std::make_shared<MnemonicFile>(sources, file);
}

} // namespace rung::frontend::fanuc

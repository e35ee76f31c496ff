// Writes programs as text (see writers.h).
#include "frontend/network/convert/writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <ranges>

#include "frontend/network/convert/drawing.h"
#include "frontend/network/read/canonical.h"
#include "frontend/network/read/condition.h"
#include "frontend/network/read/drawn_comments.h"
#include "frontend/network/read/gaps.h"
#include "frontend/network/read/reading.h"
#include "ir/support/check.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {

// Reading with comments and gaps, and the preamble of a program.

namespace {

using Kind = Item::Kind;

// The gap with the dialect statement. A program without one is a command list, whose units are in source order: there
// it is the first gap.
Gap& firstGap(SourceProgram& source) {
  std::vector<Gap*> gaps;
  for (Unit& unit : source.program.units) {
    if (!unit.lead.empty()) gaps.push_back(&unit.lead);
    for (size_t i = 0; i < withoutEnd(unit).size(); ++i) gaps.push_back(&unit.networks[i].gap);
  }
  gaps.push_back(&source.tail);
  const auto at = std::ranges::find_if(
      gaps, [](const Gap* gap) { return std::ranges::find(*gap, Kind::Dialect, &Item::kind) != gap->end(); });
  return at == gaps.end() ? *gaps[0] : **at;
}

// Splits the preamble off the first gap; it begins with exactly one dialect statement.
void splitPreamble(SourceProgram& source) {
  Gap& gap = firstGap(source);
  auto dialect = std::ranges::find(gap, Kind::Dialect, &Item::kind);
  if (dialect == gap.end()) dialect = gap.insert(gap.begin(), {Kind::Dialect});
  const auto isStatement = [](const Item& item) { return item.kind != Kind::Comment && item.kind != Kind::Blank; };
  std::rotate(std::ranges::find_if(gap, isStatement), dialect, dialect + 1);
  const auto isOfPreamble = [&](const Item& item) { return isStatement(item) && item.kind != Kind::Section; };
  const auto end = std::ranges::find_if(gap | std::views::reverse, isOfPreamble).base();
  source.preamble.assign(std::make_move_iterator(gap.begin()), std::make_move_iterator(end));
  gap.erase(gap.begin(), end);
}

} // namespace

SourceProgram readSource(const Language& language, SourceManager& sources, std::span<const FileId> files) {
  Diagnostics heard; // stays without errors: the program has been checked before
  Context context{.language = language, .sources = sources, .diagnostics = heard};
  context.gaps.keep();
  SourceProgram source{.sources = sources, .program = Program(language), .preamble = {}, .tail = {}};
  Reading reading(context, source.program);
  for (FileId file : files) reading.add(file);
  reading.read();
  RUNG_CHECK(!heard.hasErrors(), "the program has no errors");
  source.tail = context.gaps.take();
  splitPreamble(source);
  return source;
}

// Comments, declarations and sections between networks.

namespace {

using Kind = Item::Kind;
constexpr Table kNames; // symbol, const
constexpr Table kMessages;
constexpr Table kData;

// Whether ladder text can declare it. A name from a section can have other characters; a program does not use it then.
bool canBeDeclared(std::string_view name) {
  return std::ranges::all_of(name, [](char c) { return c > ' ' && c < 0x7F && c != '"' && c != ';'; });
}

std::string commentText(const Item& item) {
  return item.kind == Kind::Section ? fmt::format("section \"{}\"", item.text) : item.text;
}

} // namespace

std::string commandText(const Language& language, Command command, std::string_view operand) {
  const std::string_view name = language.nameOf(command);
  return operand.empty() ? std::string(name) : fmt::format("{:<4} {}", name, operand);
}

namespace {

// Ladder text has no tabs.
std::string withoutTabs(std::string text) {
  std::ranges::replace(text, '\t', ' ');
  return text;
}

} // namespace

void GapPage::declaration(const Item& item) {
  const bool isText = item.kind == Kind::Message || item.kind == Kind::Data;
  if (!canBeDeclared(item.text) || (!isText && !canBeDeclared(item.value)))
    return comment(withoutTabs(fmt::format("symbol {} {}", item.text, item.value)));
  const Table& table = item.kind == Kind::Message ? kMessages : item.kind == Kind::Data ? kData : kNames;
  const std::string_view keyword = item.kind == Kind::Message ? "message"
                                   : item.kind == Kind::Data  ? "data"
                                   : item.kind == Kind::Const ? "const"
                                                              : "symbol";
  const std::string_view quote = isText ? "\"" : "";
  lines_.row(table, {std::string(keyword), item.text, withoutTabs(fmt::format("{0}{1}{0}", quote, item.value))},
             remark(item.comment));
}

// Whether it is a line of a comment (* *) in a list. A line that begins with % would end the section there.
bool GapPage::isInBlock(const Item& item) const {
  if (form_ != Form::List || !language_.list.blockComments) return false;
  if (item.kind != Kind::Comment && item.kind != Kind::Section) return false;
  return !item.text.empty() && !item.text.starts_with('%') && item.text.find("*)") == std::string::npos;
}

void GapPage::item(const Item& item) {
  switch (item.kind) {
  case Kind::Comment: comment(item.text); break;
  case Kind::Blank: blank(); break;
  case Kind::Dialect: line(fmt::format("dialect {}", language_.name), item.comment); break;
  case Kind::Section: form_ == Form::List ? comment(commentText(item)) : line(commentText(item)); break;
  case Kind::Symbol:
  case Kind::Const:
  case Kind::Message:
  case Kind::Data: declaration(item); break;
  }
}

void GapPage::gap(const Gap& gap) {
  bool isOpen = false;
  for (const Item& item : gap) {
    const bool inBlock = isInBlock(item);
    if (inBlock != isOpen) line(inBlock ? "(*" : "*)");
    isOpen = inBlock;
    inBlock ? line(commentText(item)) : this->item(item);
  }
  if (isOpen) line("*)");
}

Gap tidy(const Gap& gap) {
  Gap result;
  bool wanted = false;
  for (const Item& item : gap) {
    const bool section = item.kind == Kind::Section;
    if (item.kind == Kind::Blank) {
      wanted = true;
      continue;
    }
    if ((wanted || section) && !result.empty()) result.push_back({Kind::Blank});
    result.push_back(item);
    wanted = section;
  }
  if (!result.empty() && result.back().kind == Kind::Section) result.push_back({Kind::Blank});
  return result;
}

std::optional<size_t> titleIn(const Gap& gap) {
  TitleRule rule;
  std::optional<size_t> found;
  for (size_t i = 0; i < gap.size(); ++i) {
    const std::string_view before = rule.title();
    if (gap[i].kind == Kind::Comment)
      rule.comment(gap[i].text);
    else if (gap[i].kind == Kind::Blank)
      rule.blank();
    else
      rule.statement();
    if (rule.title().empty())
      found.reset();
    else if (rule.title().data() != before.data())
      found = i;
  }
  return found;
}

Gap protect(Gap gap, std::string_view title) {
  const auto found = titleIn(gap);
  if (found ? gap[*found].text == title : title.empty()) return gap;
  size_t keep = gap.size();
  for (size_t i = 0; i < gap.size(); ++i)
    if (gap[i].kind == Kind::Comment && gap[i].text == title) keep = i;
  for (size_t i = 0; i < gap.size(); ++i)
    if (i != keep && gap[i].kind == Kind::Comment && isTitle(gap[i].text)) gap[i].text.insert(0, "; ");
  if (keep == gap.size() && !title.empty()) gap.push_back({Kind::Comment, std::string(title)});
  return gap;
}

// Writes a program as ladder text.

namespace {

using Kind = Item::Kind;

class LadderWriter {
public:
  LadderWriter(const Language& language, const SourceProgram& source) : language_(language), source_(source) {}
  std::string run();

private:
  void begin(const Unit& unit);
  void network(const Network& network);
  void rung(Gap gap, std::string_view title);
  void drawing(const Network& network);

  const Language& language_;
  const SourceProgram& source_;
  GapPage page_{language_, Form::Ladder};
};

void LadderWriter::begin(const Unit& unit) {
  page_.blank();
  page_.gap(tidy(unit.lead));
  page_.line(unit.kind == UnitKind::Subprogram
                 ? fmt::format("module {} {}", language_.subprogram, source_.sources.text(unit.nameRange))
                 : fmt::format("module {}", language_.levels[unit.number].name),
             unit.comment);
  for (const Written& command : unit.condition)
    page_.comment(fmt::format("{} {}{}{}", kConditionComment, language_.nameOf(command.command),
                              command.operand.empty() ? "" : " ", command.operand));
}

// The title goes after the word `rung` if it begins the last block of comments: the reader then finds it in the same
// place.
void LadderWriter::rung(Gap gap, std::string_view title) {
  const auto at = titleIn(gap);
  const auto isComment = [](const Item& item) { return item.kind == Kind::Comment; };
  const bool begins = at && (*at == 0 || gap[*at - 1].kind != Kind::Comment) &&
                      std::all_of(gap.begin() + static_cast<ptrdiff_t>(*at), gap.end(), isComment) &&
                      title.find('"') == std::string_view::npos;
  const bool alone = begins && *at + 1 == gap.size();
  if (begins) gap.erase(gap.begin() + static_cast<ptrdiff_t>(*at));
  page_.gap(gap);
  if (alone || (!gap.empty() && gap.back().kind != Kind::Comment)) page_.blank();
  page_.line(begins ? fmt::format("rung \"{}\"", title) : "rung");
}

void LadderWriter::drawing(const Network& network) {
  const Drawing drawing = draw(language_, network);
  std::vector<std::string> tags;
  const auto addTagged = [&](bool before, uint32_t command, std::string_view text) {
    if (tags.empty()) tags = tagsOf(language_, network);
    page_.comment(fmt::format("{}{}{}{}", before ? "-> " : "", tags[command], text.empty() ? "" : " ", text));
  };
  const std::string hint = blocksHint(language_, logicOf(network.written));
  if (!hint.empty()) page_.comment(hint);
  std::vector<const std::string*> remarks(drawing.lines.size(), nullptr);
  std::vector<const std::vector<std::string>*> above(drawing.lines.size(), nullptr);
  for (uint32_t i = 0; i < network.written.size(); ++i) {
    const Written& command = network.written[i];
    const uint32_t line = drawing.lineOf[i];
    if (!command.before.empty() && line != kNone && line > 0 && drawing.ends[line].first == i &&
        std::ranges::none_of(command.before, looksTagged))
      above[line] = &command.before;
    else
      for (const std::string& text : command.before) addTagged(true, i, text);
    if (command.comment.empty()) continue;
    if (line != kNone && drawing.ends[line].last == i)
      remarks[line] = &command.comment;
    else
      addTagged(false, i, command.comment);
  }
  for (size_t line = 0; line < drawing.lines.size(); ++line) {
    if (above[line] != nullptr)
      for (const std::string& text : *above[line]) page_.comment(text);
    page_.line(drawing.lines[line], remarks[line] == nullptr ? std::string_view() : *remarks[line]);
  }
}

// The blank line after `module SUB Pn` ends the condition, or shows that the comments after it are not a condition.
void LadderWriter::network(const Network& network) {
  page_.blank();
  const std::string title = clean(network.title);
  rung(tidy(protect(network.gap, title)), title);
  drawing(network);
}

std::string LadderWriter::run() {
  page_.gap(tidy(source_.preamble));
  for (const Unit& unit : source_.program.units) {
    const bool nothing = unit.lead.empty() && unit.comment.empty() && withoutEnd(unit).empty();
    if (nothing && unit.kind == UnitKind::Level && unit.number != language_.mainLevel()) continue;
    begin(unit);
    for (const Network& network : withoutEnd(unit)) this->network(network);
  }
  page_.blank();
  page_.gap(tidy(source_.tail));
  return page_.take();
}

} // namespace

std::string writeLadder(const Language& language, const SourceProgram& source) {
  return LadderWriter(language, source).run();
}

// Writes a program as a command list.

namespace {

class ListWriter {
public:
  ListWriter(const Language& language, const SourceProgram& source) : language_(language), source_(source) {}
  std::string run();

private:
  void command(const Written& command, bool begins);
  void function(const Row& row, std::string_view comment = {}) {
    write({.command = Command::Function, .operand = row.info.mnemonic}, comment, false);
  }
  void write(const Written& command, std::string_view comment, bool begins) {
    page_.line(language_.list.command(language_, command, begins), comment);
  }
  void begin(const Unit& unit);
  void end(const Unit& unit);
  void network(const Network& network);
  Gap afterPending(const Gap& gap) {
    pending_.insert(pending_.end(), gap.begin(), gap.end());
    return std::exchange(pending_, {});
  }
  // Writes a gap; a blank line precedes it if it has items.
  void lead(const Gap& gap) {
    if (!gap.empty()) page_.blank();
    page_.gap(gap);
  }

  const Language& language_;
  const SourceProgram& source_;
  GapPage page_{language_, Form::List};
  Gap pending_; // gap before the first level, which has no command that begins it
};

void ListWriter::command(const Written& command, bool begins) {
  for (const std::string& text : command.before) page_.comment(text);
  write(command, command.comment, begins);
}

void ListWriter::network(const Network& network) {
  lead(tidy(protect(afterPending(network.gap), clean(network.title))));
  bool begins = true;
  for (const Written& command : network.written) this->command(command, std::exchange(begins, false));
}

void ListWriter::begin(const Unit& unit) {
  Gap gap = afterPending(unit.lead);
  if (unit.kind == UnitKind::Level && unit.number == 0) {
    pending_ = std::move(gap);
    if (!unit.comment.empty()) pending_.push_back({Item::Kind::Comment, unit.comment});
    return;
  }
  page_.blank();
  page_.gap(tidy(gap));
  if (unit.kind == UnitKind::Level) {
    function(language_.endOf(unit.number - 1), unit.comment);
  } else {
    bool begins = true;
    for (const Written& command : unit.condition) this->command(command, std::exchange(begins, false));
    function(language_.rowOf(Control::Sp), unit.comment);
    write({.command = Command::Parameter, .operand = source_.sources.text(unit.nameRange)}, {}, false);
  }
  page_.blank();
}

void ListWriter::end(const Unit& unit) {
  const bool isLevel = unit.kind == UnitKind::Level;
  if (isLevel && unit.number + 1 != language_.levels.size()) return; // the next level begins with this command
  if (isLevel && language_.levels[unit.number].optional && withoutEnd(unit).empty()) return;
  page_.blank();
  function(isLevel ? language_.endOf(unit.number) : language_.rowOf(Control::Spe));
}

std::string ListWriter::run() {
  const auto frame = language_.list.frame;
  if (frame == nullptr) {
    page_.gap(tidy(source_.preamble));
    page_.blank();
  }
  for (const Unit& unit : source_.program.units) {
    begin(unit);
    for (const Network& network : withoutEnd(unit)) this->network(network);
    end(unit);
  }
  lead(tidy(source_.tail));
  if (const Row* end = language_.findRowOf(Control::ProgramEnd); end != nullptr && language_.needsProgramEnd) {
    if (source_.tail.empty()) page_.blank();
    function(*end);
  }
  return frame == nullptr ? page_.take() : frame(source_.preamble, source_.declarations, page_.take());
}

// Moves the declarations out of a gap. Constants and the comment of the dialect statement remain as comments.
void takeDeclarations(Gap& gap, std::vector<Item>& declarations) {
  Gap rest;
  for (Item& item : gap) {
    if (item.kind == Kind::Const)
      rest.push_back({Kind::Comment, fmt::format("const {} {}", item.text, item.value)});
    else if (isDeclaration(item.kind)) {
      if (item.kind != Kind::Symbol && !item.comment.empty()) rest.push_back({Kind::Comment, item.comment});
      declarations.push_back(std::move(item));
    } else if (item.kind != Kind::Dialect)
      rest.push_back(std::move(item));
    else if (!item.comment.empty())
      rest.push_back({Kind::Comment, std::move(item.comment)});
  }
  gap = std::move(rest);
}

// Visits all gaps of a program in the order of its text.
template <class Visit>
void eachGap(SourceProgram& source, Visit visit) {
  visit(source.preamble);
  for (Unit& unit : source.program.units) {
    visit(unit.lead);
    for (Network& network : unit.networks) visit(network.gap);
  }
  visit(source.tail);
}

} // namespace

void prepareForList(const Language& language, SourceProgram& source) {
  if (language.list.frame == nullptr) return;
  const auto keyOf = [&](std::string_view name) {
    return language.namesIgnoreCase ? text::upper(name) : std::string(name);
  };
  std::map<std::string, std::string_view> constants;
  eachGap(source, [&](Gap& gap) {
    for (const Item& item : gap)
      if (item.kind == Kind::Const) constants.emplace(keyOf(item.text), source.values.emplace_back(item.value));
    takeDeclarations(gap, source.declarations);
  });
  for (Unit& unit : source.program.units)
    for (Network& network : unit.networks)
      for (Written& command : network.written)
        if (command.command == Command::Parameter || command.command == Command::Table)
          if (const auto found = constants.find(keyOf(command.operand)); found != constants.end())
            command.operand = found->second;
}

std::string writeList(const Language& language, const SourceProgram& source) {
  return ListWriter(language, source).run();
}

} // namespace rung::frontend::network

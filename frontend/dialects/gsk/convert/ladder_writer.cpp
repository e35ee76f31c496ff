// The source model as ladder text.
#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/gsk/convert/drawing.h"
#include "frontend/dialects/gsk/convert/gap_writer.h"
#include "frontend/dialects/gsk/convert/hints.h"
#include "frontend/dialects/gsk/convert/writers.h"
#include "frontend/dialects/gsk/read/canonical.h"
#include "frontend/dialects/gsk/read/condition.h"

namespace rung::gsk::convert {
namespace {

using Kind = Item::Kind;

// A comment line that would be read as something else.
bool looksLikeHint(std::string_view text) { return parseTag(text) || parseBlocksHint(text); }

class LadderWriter {
public:
  std::string run(const SourceProgram& program);

private:
  void begin(const SourceUnit& unit);
  void network(const SourceNetwork& network);
  void rung(Gap gap, std::string_view title);
  void drawing(const SourceNetwork& network);

  Page page_{Form::Ladder};
};

void LadderWriter::begin(const SourceUnit& unit) {
  page_.blank();
  page_.gap(tidy(unit.lead));
  switch (unit.kind) {
  case UnitKind::Level1: page_.line("module LEVEL1", unit.comment); break;
  case UnitKind::Level2: page_.line("module LEVEL2", unit.comment); break;
  case UnitKind::Subprogram: page_.line(fmt::format("module SUB {}", unit.number), unit.comment); break;
  }
  for (const SourceCommand& command : unit.condition)
    page_.comment(fmt::format("{} {}{}{}", kConditionComment, nameOf(command.command),
                              command.operand.empty() ? "" : " ", command.operand));
}

// The title is after the word `rung` where it begins the last block of comments: so it is found again there.
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

void LadderWriter::drawing(const SourceNetwork& network) {
  const Drawing drawing = draw(network);
  std::vector<std::string> tags;
  const auto addTagged = [&](bool before, uint32_t command, std::string_view text) {
    if (tags.empty()) tags = tagsOf(network);
    page_.comment(tagged(before, tags[command], text));
  };
  const std::string hint = blocksHint(logicOf(network.commands));
  if (!hint.empty()) page_.comment(hint);
  std::vector<const std::string*> remarks(drawing.lines.size(), nullptr);
  std::vector<const std::vector<std::string>*> above(drawing.lines.size(), nullptr);
  for (uint32_t i = 0; i < network.commands.size(); ++i) {
    const SourceCommand& command = network.commands[i];
    const uint32_t line = drawing.lineOf[i];
    if (!command.before.empty() && line != kNone && line > 0 && drawing.ends[line].first == i &&
        std::none_of(command.before.begin(), command.before.end(), looksLikeHint))
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

// After `module SUB Pn` the blank line ends the condition, or says that the comments after it are none.
void LadderWriter::network(const SourceNetwork& network) {
  page_.blank();
  rung(tidy(protect(network.gap, network.title)), network.title);
  drawing(network);
}

std::string LadderWriter::run(const SourceProgram& program) {
  page_.gap(tidy(program.preamble));
  for (const SourceUnit& unit : program.units) {
    const bool nothing = unit.lead.empty() && unit.comment.empty() && unit.networks.empty();
    if (unit.kind == UnitKind::Level1 && nothing) continue;
    begin(unit);
    for (const SourceNetwork& network : unit.networks) this->network(network);
  }
  page_.blank();
  page_.gap(tidy(program.tail));
  return page_.take();
}

} // namespace

std::string writeLadder(const SourceProgram& program) { return LadderWriter().run(program); }

} // namespace rung::gsk::convert

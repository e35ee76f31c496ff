// The source model as ladder text.
#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/convert/drawing.h"
#include "frontend/network/convert/gap_writer.h"
#include "frontend/network/convert/hints.h"
#include "frontend/network/convert/writers.h"
#include "frontend/network/read/canonical.h"
#include "frontend/network/read/condition.h"

namespace rung::network::convert {
namespace {

using Kind = Item::Kind;

// A comment line that would be read as something else.
bool looksLikeHint(const Language& language, std::string_view text) {
  return parseTag(text) || parseBlocksHint(language, text);
}

class LadderWriter {
public:
  explicit LadderWriter(const Language& language) : language_(language) {}
  std::string run(const SourceProgram& program);

private:
  void begin(const SourceUnit& unit);
  void network(const SourceNetwork& network);
  void rung(Gap gap, std::string_view title);
  void drawing(const SourceNetwork& network);

  const Language& language_;
  Page page_{language_, Form::Ladder};
};

void LadderWriter::begin(const SourceUnit& unit) {
  page_.blank();
  page_.gap(tidy(unit.lead));
  page_.line(unit.kind == UnitKind::Subprogram ? fmt::format("module {} {}", language_.subprogram, unit.number)
                                               : fmt::format("module {}", language_.levels[unit.level].name),
             unit.comment);
  for (const SourceCommand& command : unit.condition)
    page_.comment(fmt::format("{} {}{}{}", kConditionComment, language_.nameOf(command.command),
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
  const Drawing drawing = draw(language_, network);
  std::vector<std::string> tags;
  const auto addTagged = [&](bool before, uint32_t command, std::string_view text) {
    if (tags.empty()) tags = tagsOf(language_, network);
    page_.comment(tagged(before, tags[command], text));
  };
  const std::string hint = blocksHint(language_, logicOf(network.commands));
  if (!hint.empty()) page_.comment(hint);
  std::vector<const std::string*> remarks(drawing.lines.size(), nullptr);
  std::vector<const std::vector<std::string>*> above(drawing.lines.size(), nullptr);
  for (uint32_t i = 0; i < network.commands.size(); ++i) {
    const SourceCommand& command = network.commands[i];
    const uint32_t line = drawing.lineOf[i];
    if (!command.before.empty() && line != kNone && line > 0 && drawing.ends[line].first == i &&
        std::ranges::none_of(command.before, [&](const std::string& text) { return looksLikeHint(language_, text); }))
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
    if (nothing && unit.kind == UnitKind::Level && unit.level != language_.mainLevel()) continue;
    begin(unit);
    for (const SourceNetwork& network : unit.networks) this->network(network);
  }
  page_.blank();
  page_.gap(tidy(program.tail));
  return page_.take();
}

} // namespace

std::string writeLadder(const Language& language, const SourceProgram& program) {
  return LadderWriter(language).run(program);
}

} // namespace rung::network::convert

// A program as ladder text.
#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/convert/drawing.h"
#include "frontend/network/convert/gap_writer.h"
#include "frontend/network/convert/writers.h"
#include "frontend/network/read/canonical.h"
#include "frontend/network/read/condition.h"
#include "frontend/network/read/drawn_comments.h"
#include "frontend/network/read/gaps.h"

namespace rung::frontend::network {
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

// After `module SUB Pn` the blank line ends the condition, or says that the comments after it are none.
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

} // namespace rung::frontend::network

// Ladder text to the source model. The ladder parser has no use for comments, so the lines are walked beside what it
// found; comments of a drawing go to the commands that its elements mean.
#include <map>
#include <optional>

#include "frontend/ladder/text/drawing.h"
#include "frontend/network/convert/collector.h"
#include "frontend/network/convert/hints.h"
#include "frontend/network/read/canonical.h"
#include "frontend/network/read/condition.h"
#include "ir/support/check.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::network::convert {
namespace {

struct LineComment {
  uint32_t line = 0;
  std::string text;
};

// The comments of one rung.
struct RungText {
  uint32_t firstDrawn = 0;          // line
  std::vector<LineComment> lines;   // lines of their own
  std::vector<LineComment> remarks; // after a line of the drawing
};

// A rung and the network that it draws, to commands with their comments.
class RungCollector {
public:
  RungCollector(const Language& language, const Network& network, Gap& gap)
      : language_(language), network_(network), gap_(gap) {}

  SourceNetwork run(const RungText& text);

private:
  bool isBlocksHint(const LineComment& comment) const;
  void index();
  void remark(const LineComment& comment);
  void ownLine(const LineComment& comment, uint32_t firstDrawn);
  bool byTag(const LineComment& comment);
  void before(uint32_t command, const std::string& text);
  void toGap(const std::string& text) { gap_.push_back({Item::Kind::Comment, text}); }

  const Language& language_;
  const Network& network_;
  Gap& gap_;
  SourceNetwork result_;
  std::map<uint32_t, LineEnds> ends_; // by line
  std::map<std::string, uint32_t, std::less<>> tags_;
};

void RungCollector::index() {
  for (uint32_t i = 0; i < result_.commands.size(); ++i)
    if (isElement(result_.commands[i].command))
      ends_[result_.commands[i].line].add(i, [&](uint32_t command) { return result_.commands[command].range.begin; });
}

void RungCollector::before(uint32_t command, const std::string& text) {
  if (command == 0)
    toGap(text);
  else
    result_.commands[command].before.push_back(text);
}

void RungCollector::remark(const LineComment& comment) {
  const auto at = ends_.find(comment.line);
  if (at == ends_.end()) return toGap(comment.text);
  std::string& own = result_.commands[at->second.last].comment;
  if (own.empty())
    own = comment.text;
  else
    before(at->second.last, comment.text);
}

bool RungCollector::byTag(const LineComment& comment) {
  const auto tag = parseTag(comment.text);
  if (!tag) return false;
  if (tags_.empty()) {
    const auto tags = tagsOf(language_, result_);
    for (uint32_t i = 0; i < tags.size(); ++i) tags_.emplace(tags[i], i);
  }
  const auto at = tags_.find(tag->tag);
  if (at == tags_.end()) return false;
  std::string& own = result_.commands[at->second].comment;
  if (tag->before || !own.empty() || tag->text.empty())
    before(at->second, std::string(tag->text));
  else
    own = tag->text;
  return true;
}

void RungCollector::ownLine(const LineComment& comment, uint32_t firstDrawn) {
  if (byTag(comment)) return;
  const auto at = ends_.upper_bound(comment.line);
  if (comment.line < firstDrawn || at == ends_.end())
    toGap(comment.text);
  else
    before(at->second.first, comment.text);
}

// One that was heeded: the commands are what it says.
bool RungCollector::isBlocksHint(const LineComment& comment) const {
  const auto blocks = parseBlocksHint(language_, comment.text);
  return blocks && *blocks == logicOf(result_.commands);
}

SourceNetwork RungCollector::run(const RungText& text) {
  result_.row = network_.function.row;
  result_.range = network_.range;
  result_.title = clean(network_.title);
  for (const Written& written : network_.written) result_.commands.push_back({written});
  index();
  for (const LineComment& comment : text.remarks) remark(comment);
  for (const LineComment& comment : text.lines)
    if (!isBlocksHint(comment)) ownLine(comment, text.firstDrawn);
  return std::move(result_);
}

class LadderCollector {
public:
  LadderCollector(Collector& collector, const ladder::LadderFile& file) : out_(collector), file_(file) {}

  void run() {
    LineReader lines(out_.context.sources, file_.file);
    for (SourceLine line; lines.next(line);) read(line);
  }

private:
  void read(const SourceLine& line);
  void statement(const SourceLine& line);
  void comment(const SourceLine& line, std::string_view text);
  void drawn(const SourceLine& line);
  void module(uint32_t line);
  void openRung();
  void insertTitle(std::string text);

  Collector& out_;
  const ladder::LadderFile& file_;
  LineWords words_;
  size_t nextRung_ = 0;
  const ladder::Rung* rung_ = nullptr; // whose drawing has not ended
  RungText text_;
  uint32_t unit_ = 0;
  uint32_t conditionEnd_ = 0; // the last line of the condition of a subprogram
};

void LadderCollector::read(const SourceLine& line) {
  const std::string_view text = text::trimmed(line.text);
  const bool isComment = !text.empty() && text[0] == ';';
  if (text.empty())
    out_.blank();
  else if (isComment)
    comment(line, text::trimmed(text.substr(1)));
  else if (ladder::beginsDrawing(text[0]))
    drawn(line);
  else
    statement(line);
}

void LadderCollector::comment(const SourceLine& line, std::string_view text) {
  if (line.number <= conditionEnd_) return;
  if (rung_ != nullptr)
    text_.lines.push_back({line.number, clean(text)});
  else
    out_.comment(text);
}

// No operand has a ';' in it.
void LadderCollector::drawn(const SourceLine& line) {
  RUNG_CHECK(rung_ != nullptr, "a drawing belongs to a rung");
  if (text_.firstDrawn == 0) text_.firstDrawn = line.number;
  const size_t remark = line.text.find(';');
  if (remark != std::string_view::npos) {
    std::string text = clean(line.text.substr(remark + 1));
    if (!text.empty()) text_.remarks.push_back({line.number, std::move(text)});
  }
  if (line.number < rung_->lastLine) return;
  SourceNetwork network = RungCollector(out_.context.language, out_.takeNetwork(), out_.gap).run(text_);
  network.gap = out_.takeGap();
  out_.program.units[unit_].networks.push_back(std::move(network));
  rung_ = nullptr;
}

void LadderCollector::statement(const SourceLine& line) {
  splitWords(line, {}, words_);
  const std::string_view keyword = words_.words[0].text;
  if (keyword == "rung") return openRung();
  if (keyword == "module") return module(line.number);
  if (keyword == "dialect") return out_.statement(Item::Kind::Dialect, {}, words_.comment);
  if (keyword == "symbol") return out_.statement(Item::Kind::Symbol, words_.words, words_.comment);
  if (keyword == "const") return out_.statement(Item::Kind::Const, words_.words, words_.comment);
  RUNG_CHECK(keyword == "section", "no other statement is without errors");
  out_.gap.push_back({Item::Kind::Section, clean(words_.words[1].text)});
  if (!text::trimmed(words_.comment).empty()) out_.comment(words_.comment);
}

// In a list the title is the first line of the last block of comment lines.
void LadderCollector::insertTitle(std::string text) {
  auto at = out_.gap.end();
  while (at != out_.gap.begin() && std::prev(at)->kind == Item::Kind::Comment) --at;
  out_.gap.insert(at, {Item::Kind::Comment, std::move(text)});
}

void LadderCollector::openRung() {
  rung_ = &file_.rungs[nextRung_++];
  text_ = {};
  std::string title = clean(rung_->comment);
  if (!title.empty()) insertTitle(std::move(title));
  if (!text::trimmed(words_.comment).empty()) out_.comment(words_.comment);
}

void LadderCollector::module(uint32_t line) {
  SourceUnit unit;
  if (words_.words.size() > 2) {
    unit.kind = UnitKind::Subprogram;
    unit.number = words_.words[2].text;
  } else {
    unit.level = out_.context.language.findLevel(words_.words[1].text).value();
  }
  unit.lead = out_.takeGap();
  unit.comment = clean(words_.comment);
  if (unit.kind == UnitKind::Subprogram) {
    const Condition condition = conditionAfter(out_.context, file_.file, line);
    for (const Written& written : condition.commands) unit.condition.push_back({written});
    conditionEnd_ = condition.lastLine;
  }
  unit_ = static_cast<uint32_t>(out_.program.units.size());
  out_.program.units.push_back(std::move(unit));
}

} // namespace

void collectLadder(Collector& collector, const ladder::LadderFile& file) { LadderCollector(collector, file).run(); }

} // namespace rung::network::convert

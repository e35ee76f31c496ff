// Attaches comments to commands.
#include "frontend/network/read/drawn_comments.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "frontend/network/read/canonical.h"
#include "frontend/network/read/gaps.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::network {
namespace {

// Tag of a parameter: the name of its operand, or the number of a table row.
std::string parameterText(const Language& language, const Row& row, Command command, size_t index) {
  if (command == Command::Table) return fmt::format("{{{} {} {}}}", row.info.mnemonic, language.nameOf(command), index);
  return fmt::format("{{{} {}}}", row.info.mnemonic, row.info.operands[index].name);
}

class Attachment {
public:
  Attachment(const Language& language, Network& network) : language_(language), network_(network) {
    for (uint32_t i = 0; i < written().size(); ++i)
      if (isElement(written()[i].command))
        ends_[written()[i].line].add(i, [&](uint32_t command) { return written()[command].range.begin; });
  }

  void remark(const ladder::Comment& comment);
  void line(const ladder::Comment& comment, bool isAbove);

private:
  std::vector<Written>& written() const { return network_.written; }
  void toGap(std::string text) { network_.gap.push_back({Item::Kind::Comment, std::move(text)}); }
  void before(uint32_t command, std::string text);
  void after(uint32_t command, std::string text);
  bool byTag(std::string_view text);

  const Language& language_;
  Network& network_;
  std::map<uint32_t, LineEnds> ends_; // per line
  std::vector<std::string> tags_;
};

void Attachment::before(uint32_t command, std::string text) {
  if (command == 0)
    toGap(std::move(text));
  else
    written()[command].before.push_back(std::move(text));
}

// Adds the comment after a command; a second one becomes a line before it.
void Attachment::after(uint32_t command, std::string text) {
  std::string& comment = written()[command].comment;
  if (comment.empty() && !text.empty())
    comment = std::move(text);
  else
    before(command, std::move(text));
}

void Attachment::remark(const ladder::Comment& comment) {
  std::string text = clean(comment.text);
  if (text.empty()) return;
  if (const auto at = ends_.find(comment.line); at != ends_.end())
    after(at->second.last, std::move(text));
  else
    toGap(std::move(text));
}

bool Attachment::byTag(std::string_view text) {
  if (!looksTagged(text)) return false;
  if (tags_.empty()) tags_ = tagsOf(language_, network_);
  const bool isBefore = text.starts_with(kBefore);
  if (isBefore) text = text::trimmed(text.substr(kBefore.size()));
  for (uint32_t i = 0; i < tags_.size(); ++i) {
    if (!text.starts_with(tags_[i])) continue;
    const std::string_view rest = text.substr(tags_[i].size());
    if (!rest.empty() && rest[0] != ' ') continue; // [A] must not match [A]#2
    std::string own(text::trimmed(rest));
    if (isBefore)
      before(i, std::move(own));
    else
      after(i, std::move(own));
    return true;
  }
  return false;
}

// Attaches a comment line to the next line of the drawing that has an element.
void Attachment::line(const ladder::Comment& comment, bool isAbove) {
  std::string text = clean(comment.text);
  if (byTag(text)) return;
  const auto at = ends_.upper_bound(comment.line);
  if (isAbove || at == ends_.end())
    toGap(std::move(text));
  else
    before(at->second.first, std::move(text));
}

} // namespace

bool canBeDrawn(std::string_view operand) { return operand.find_first_of("\"[](){}") == std::string_view::npos; }

std::string drawnOperand(std::string_view operand) {
  const bool isMarked = operand.find_first_of("/@%~") == 0;
  return isMarked ? fmt::format("\"{}\"", operand) : std::string(operand);
}

std::string elementText(Command command, std::string_view operand) {
  constexpr std::string_view kCoils[] = {"", "/", "S ", "R "};
  const std::string_view mark = isClosed(command) ? "/" : command == Command::LoadFalling ? "%" : "";
  if (isContact(command)) return fmt::format("[{}{}]", mark, drawnOperand(operand));
  if (isCoil(command))
    return fmt::format("({}{})", kCoils[static_cast<size_t>(coilOf(command))], drawnOperand(operand));
  return fmt::format("{{{}}}", operand);
}

std::vector<std::string> tagsOf(const Language& language, const Network& network) {
  std::vector<std::string> tags;
  std::unordered_map<std::string, uint32_t> seen;
  size_t parameters = 0;
  size_t rows = 0;
  for (const Written& written : network.written) {
    const bool isParameter = written.command == Command::Parameter || written.command == Command::Table;
    size_t& count = written.command == Command::Table ? rows : parameters;
    std::string tag = isParameter ? parameterText(language, *network.function.row, written.command, count++)
                      : isBlock(written.command) ? fmt::format("[{}]", language.nameOf(written.command))
                                                 : elementText(written.command, written.operand);
    const uint32_t number = ++seen[tag];
    if (number > 1) tag += fmt::format("#{}", number);
    tags.push_back(std::move(tag));
  }
  return tags;
}

bool looksTagged(std::string_view comment) { return comment.starts_with(kBefore) || comment.find_first_of("[({") == 0; }

std::optional<std::vector<Logic>> blocksIn(const Language& language, const ladder::Rung& rung) {
  if (rung.comments.empty() || !rung.comments[0].alone || rung.comments[0].line != rung.firstLine + 1)
    return std::nullopt;
  return parseBlocksHint(language, rung.comments[0].text);
}

void attachComments(const Language& language, const ladder::Rung& rung, Network& network) {
  uint32_t drawn = rung.firstLine + 1; // the first line of the drawing
  std::span comments(rung.comments);
  if (blocksIn(language, rung) == logicOf(network.written)) {
    comments = comments.subspan(1);
    ++drawn;
  }
  Attachment attachment(language, network);
  for (const ladder::Comment& comment : comments)
    if (!comment.alone) attachment.remark(comment);
  for (const ladder::Comment& comment : comments) {
    if (!comment.alone) continue;
    const bool isAbove = comment.line == drawn;
    if (isAbove) ++drawn;
    attachment.line(comment, isAbove);
  }
}

// Comments as titles.

namespace {

bool isDecoration(std::string_view text) {
  return std::ranges::none_of(
      text, [](char c) { return text::isDigit(c) || text::isLetter(c) || static_cast<signed char>(c) < 0; });
}

} // namespace

std::optional<std::string_view> sectionIn(std::string_view comment) {
  constexpr std::string_view kBegin = "section \"";
  if (!comment.starts_with(kBegin)) return std::nullopt;
  const std::string_view text = comment.substr(kBegin.size());
  if (text.find('"') + 1 != text.size()) return std::nullopt;
  return text.substr(0, text.size() - 1);
}

bool isTitle(std::string_view comment) { return !isDecoration(comment) && comment[0] != ';'; }

void TitleRule::comment(std::string_view text) {
  if (sectionIn(text)) return statement();
  if (!isTitle(text)) return;
  if (!inBlock_) title_ = text;
  inBlock_ = true;
}

} // namespace rung::frontend::network

// Collects the lines between networks as items, and assigns them to what they belong to.
#include "frontend/network/read/gaps.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "frontend/network/read/drawn_comments.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend::network {

using Kind = Item::Kind;

std::string clean(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return std::string(text::trimmed(result));
}

Item commentItem(std::string_view text) {
  const auto section = sectionIn(text);
  return {section ? Kind::Section : Kind::Comment, clean(section.value_or(text))};
}

void Gaps::comment(std::string_view text) {
  Item item = commentItem(text);
  begun_ = begun_ || item.kind == Kind::Section;
  add(std::move(item));
}

void Gaps::dialect(std::string_view comment) {
  if (!std::exchange(begun_, true))
    add({.kind = Kind::Dialect, .comment = clean(comment)});
  else if (comment.empty())
    blank();
  else
    this->comment(comment);
}

void Gaps::declaration(Kind kind, const Word& name, const Word& value, std::string_view comment) {
  begun_ = true;
  add({kind, std::string(name.text), clean(value.text), clean(comment), value.range});
}

void Gaps::section(std::string_view title, std::string_view comment) {
  begun_ = true;
  add({Kind::Section, clean(title)});
  if (!comment.empty()) this->comment(comment);
}

void Gaps::title(std::string_view text) {
  auto at = gap_.end();
  while (at != gap_.begin() && std::prev(at)->kind == Kind::Comment) --at;
  if (kept_) gap_.insert(at, {Kind::Comment, clean(text)});
}

void Gaps::remark(std::string_view text) {
  if (!sectionIn(text)) return comment(text);
  begun_ = true;
  const auto mayBelongToTitle = [](const Item& item) { return item.kind == Kind::Comment || item.kind == Kind::Blank; };
  auto at = gap_.end();
  while (at != gap_.begin() && mayBelongToTitle(*std::prev(at))) --at;
  if (kept_) gap_.insert(at, commentItem(text));
}

void Gaps::giveBack(Gap&& gap) {
  gap_.insert(gap_.begin(), std::make_move_iterator(gap.begin()), std::make_move_iterator(gap.end()));
}

Gap Gaps::take() {
  begun_ = true;
  return std::exchange(gap_, {});
}

std::vector<std::string> Gaps::takeComments(Gap& network) {
  std::vector<std::string> comments;
  Gap statements;
  for (Item& item : take()) {
    switch (item.kind) {
    case Kind::Blank: break;
    case Kind::Comment: comments.push_back(std::move(item.text)); break;
    case Kind::Section: comments.push_back(fmt::format("section \"{}\"", item.text)); break;
    case Kind::Dialect:
    case Kind::Symbol:
    case Kind::Const:
    case Kind::Message:
    case Kind::Data: statements.push_back(std::move(item)); break;
    }
  }
  const auto isOther = [](const Item& item) { return !isDeclaration(item.kind) && item.kind != Kind::Dialect; };
  network.insert(std::ranges::find_if(network, isOther), std::make_move_iterator(statements.begin()),
                 std::make_move_iterator(statements.end()));
  return comments;
}

} // namespace rung::frontend::network

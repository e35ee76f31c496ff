// Comments, declarations and sections between networks.
#include "frontend/dialects/gsk/convert/gap_writer.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/dialects/gsk/read/title.h"

namespace rung::gsk::convert {
namespace {

using Kind = Item::Kind;
constexpr size_t kCommentColumn = 18; // of a list

bool isDeclaration(const Item& item) { return item.kind == Kind::Symbol || item.kind == Kind::Const; }

} // namespace

void Page::line(std::string_view text, std::string_view comment) {
  blank_ = false;
  text_ += text;
  if (!comment.empty()) {
    const size_t column = form_ == Form::List ? kCommentColumn : 0;
    text_.append(text.size() + 2 < column ? column - text.size() : 2, ' ');
    text_.append("; ").append(comment);
  }
  text_ += '\n';
}

void Page::blank() {
  if (!blank_) text_ += '\n';
  blank_ = true;
}

// A run of them, in columns.
size_t Page::declarations(const Gap& gap, size_t first) {
  size_t end = first;
  size_t name = 0;
  size_t value = 0;
  for (; end < gap.size() && isDeclaration(gap[end]); ++end) {
    name = std::max(name, gap[end].text.size());
    value = std::max(value, gap[end].value.size());
  }
  for (size_t i = first; i < end; ++i) {
    const Item& item = gap[i];
    blank_ = false;
    text_ += fmt::format("{:<6} {:<{}} ", item.kind == Kind::Symbol ? "symbol" : "const", item.text, name);
    text_ += item.comment.empty() ? item.value : fmt::format("{:<{}} ; {}", item.value, value, item.comment);
    text_ += '\n';
  }
  return end;
}

void Page::gap(const Gap& gap) {
  for (size_t i = 0; i < gap.size();) {
    const Item& item = gap[i];
    switch (item.kind) {
    case Kind::Comment: comment(item.text); break;
    case Kind::Blank: blank(); break;
    case Kind::Dialect: line("dialect gsk", item.comment); break;
    case Kind::Section: line(fmt::format("{}section \"{}\"", form_ == Form::List ? "; " : "", item.text)); break;
    case Kind::Symbol:
    case Kind::Const: i = declarations(gap, i); continue;
    }
    ++i;
  }
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

} // namespace rung::gsk::convert

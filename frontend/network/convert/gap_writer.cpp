// Comments, declarations and sections between networks.
#include "frontend/network/convert/gap_writer.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/read/title.h"

namespace rung::frontend::network {
namespace {

using Kind = Item::Kind;
constexpr Table kNames; // symbol, const

} // namespace

std::string commandText(const Language& language, Command command, std::string_view operand) {
  const std::string_view name = language.nameOf(command);
  return operand.empty() ? std::string(name) : fmt::format("{:<4} {}", name, operand);
}

void GapPage::declaration(const Item& item) {
  lines_.row(kNames, {item.kind == Kind::Symbol ? "symbol" : "const", item.text, item.value}, remark(item.comment));
}

void GapPage::gap(const Gap& gap) {
  for (const Item& item : gap) {
    switch (item.kind) {
    case Kind::Comment: comment(item.text); break;
    case Kind::Blank: blank(); break;
    case Kind::Dialect: line(fmt::format("dialect {}", language_.name), item.comment); break;
    case Kind::Section: line(fmt::format("{}section \"{}\"", form_ == Form::List ? "; " : "", item.text)); break;
    case Kind::Symbol:
    case Kind::Const: declaration(item); break;
    }
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

} // namespace rung::frontend::network

// Elements of PLC tables' files (see table_reader.h).
#include "machine/io/tables/table_reader.h"

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/text/blanks.h"

namespace rung::io {

using text::trimmed;

namespace {

constexpr size_t kShown = 40; // bytes of a text in a complaint

constexpr bool isText(Element element) {
  switch (element) {
  case Element::DefinitionId:
  case Element::Count:
  case Element::Selected:
  case Element::ColumnId:
  case Element::ColumnType:
  case Element::Cell: return true;
  default: return false;
  }
}

} // namespace

std::string TableReader::word() {
  const std::string_view text = trimmed(text_);
  if (text.empty()) complain("<" + open_.back().name + "> is empty");
  return std::string(text);
}

std::optional<uint32_t> TableReader::number(uint32_t most) {
  const auto value = nc::technol::integerOf(text_);
  if (value && *value >= 0 && *value <= most) return static_cast<uint32_t>(*value);
  complain("<" + open_.back().name + "> is " + inQuotes(inOneLine(text_.substr(0, kShown))) + ", expected 0 to " +
           std::to_string(most));
  return std::nullopt;
}

std::optional<uint32_t> TableReader::ordinal(Attributes& attributes, uint32_t most) {
  const std::string text = attributes.required("No");
  if (text.empty()) return std::nullopt;
  const auto value = nc::technol::integerOf(text);
  if (value && *value >= 0 && *value <= most) return static_cast<uint32_t>(*value);
  attributes.wrong("No", text, "0 to " + std::to_string(most));
  return std::nullopt;
}

std::string TableReader::expectedIn(Element parent) const {
  std::vector<std::string> written;
  for (const Child& child : children_)
    if (child.parent == parent) written.push_back("<" + std::string(child.name) + ">");
  const std::vector<std::string_view> names(written.begin(), written.end());
  return listed(names);
}

Element TableReader::childOf(Element parent, std::string_view name) {
  if (parent == Element::Foreign) return Element::Foreign;
  for (const Child& child : children_) {
    if (child.parent != parent || child.name != name) continue;
    if (parent != Element::None) checkTimes(child);
    return child.element;
  }
  if (parent == Element::None)
    complain("found <" + std::string(name) + ">, expected " + expectedIn(parent));
  else
    complainAboutChild(name, expectedIn(parent));
  return Element::Foreign;
}

void TableReader::checkTimes(const Child& child) {
  const uint32_t bit = 1u << static_cast<unsigned>(child.element);
  if (child.times != Times::Any && (elements_.back().seen & bit) != 0)
    complain("<" + open_.back().name + "> has a second <" + std::string(child.name) + ">");
  elements_.back().seen |= bit;
}

void TableReader::checkLacks() {
  for (const Child& child : children_)
    if (child.parent == elements_.back().element && child.times == Times::Once &&
        (elements_.back().seen & 1u << static_cast<unsigned>(child.element)) == 0)
      complain("<" + open_.back().name + "> lacks its <" + std::string(child.name) + ">");
}

void TableReader::opens(std::string_view name) {
  const Element outer = parent();
  if (outer != Element::None && outer != Element::Foreign && !isText(outer)) complainAboutText();
  elements_.push_back({childOf(outer, name)});
}

void TableReader::begin(std::string_view, const char** list) {
  const Element element = elements_.back().element;
  if (element == Element::Foreign) return;
  Attributes attributes(*this, list);
  begins(element, attributes);
  attributes.finish();
}

void TableReader::end() {
  const Element element = elements_.back().element;
  if (element != Element::Foreign) {
    if (!isText(element)) complainAboutText();
    checkLacks();
    ends(element);
  }
  elements_.pop_back();
}

} // namespace rung::io

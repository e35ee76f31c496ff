// Follows the elements of a PLC table's file by a list of what each of them holds, and how often.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/xml_reader.h"

namespace rung::io {

enum class Element : uint8_t {
  None, // around the document
  Foreign,
  Document,
  Definition,
  DefinitionId,
  Count,
  Selected,
  Column,
  ColumnId,
  ColumnType,
  Line,
  Cell,
};

enum class Times : uint8_t { Any, AtMostOnce, Once };

struct Child {
  Element parent;
  std::string_view name;
  Element element;
  Times times;
};

// Follows the elements of a document by the table of what they hold.
class TableReader : public XmlReader {
protected:
  TableReader(std::string_view name, std::span<const Child> children) : XmlReader(name), children_(children) {}

  std::string read(std::string_view text) { return parse(text); }
  virtual void begins(Element element, Attributes& attributes) = 0;
  virtual void ends(Element element) = 0;

  // The text of an element that is not empty, without blanks at its ends.
  std::string word();
  // The text as a number from 0; nothing after a complaint.
  std::optional<uint32_t> number(uint32_t most);
  // An element's attribute No; nothing after a complaint.
  std::optional<uint32_t> ordinal(Attributes& attributes, uint32_t most);

private:
  struct OpenElement {
    Element element = Element::None;
    uint32_t seen = 0; // a bit for each element that it held
  };

  Element parent() const { return elements_.empty() ? Element::None : elements_.back().element; }
  std::string expectedIn(Element parent) const;
  Element childOf(Element parent, std::string_view name);
  void checkTimes(const Child& child);
  void checkLacks();
  void opens(std::string_view name) final;
  void begin(std::string_view name, const char** list) final;
  void end() final;

  std::span<const Child> children_;
  std::vector<OpenElement> elements_;
};

} // namespace rung::io

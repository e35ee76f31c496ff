// Shared by the readers of the control's XML files: the parser (expat) with its limits and encodings, the open
// elements, errors with their positions, and attributes. Each reader knows the meaning of its elements.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct XML_ParserStruct;

namespace rung::host {

// A position in a file, for messages: "FILE:LINE:COLUMN".
using FilePlace = std::string;

// "A, B or C".
std::string listed(std::span<const std::string_view> names);
std::string inQuotes(std::string_view text);
// Replaces line breaks, with the blanks around them, by one blank.
std::string inOneLine(std::string_view text);

// Reads the whole file. Returns "", or why it cannot be read.
std::string textOfFile(const std::string& path, std::string& text);

class XmlReader {
public:
  explicit XmlReader(std::string_view name); // name of the file in messages
  virtual ~XmlReader() = default;
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

protected:
  struct Open {
    std::string name;
    uint64_t line;
  };

  // Parses a text. Returns "", or the errors, one line "FILE:LINE:COLUMN: ..." each.
  std::string parse(std::string_view text);

  FilePlace place() const; // the position that is being read
  void complain(const std::string& what) { complainAt(place(), what); }
  void complainAt(const FilePlace& where, const std::string& what);
  // Reports that <OUTER> must not contain <NAME>; `expected` is "<A> or <B>", or empty if a text was expected.
  void complainAboutChild(std::string_view name, const std::string& expected);
  // Reports text beside an element, where none is expected.
  void complainAboutText();

  std::vector<Open> open_; // open elements, innermost last
  std::string text_;       // text since the last beginning or end of an element

private:
  friend class Attributes;
  struct Free {
    void operator()(XML_ParserStruct* parser) const;
  };

  // Called at the beginning of an element (`opens` before it is added to the open ones) and at its end (before it is
  // removed from them).
  virtual void opens(std::string_view name) = 0;
  virtual void begin(std::string_view name, const char** attributes) = 0;
  virtual void end() = 0;
  void notWellFormed();

  std::string name_;
  std::unique_ptr<XML_ParserStruct, Free> parser_;
  std::string complaints_;
  size_t complaintCount_ = 0;
};

// The attributes of one element. Each is requested by its name; those not requested until `finish` are unknown. Names
// are not case-sensitive (the manual writes MinVal and Minval).
class Attributes {
public:
  Attributes(XmlReader& reader, const char** list);

  std::string required(std::string_view name);
  // The value without blanks at its ends; "" if the attribute is missing.
  std::string optional(std::string_view name);
  void flag(std::string_view name, bool& value);
  void number(std::string_view name, uint32_t most, uint32_t& value);
  void real(std::string_view name, double& value);
  void real(std::string_view name, std::optional<double>& value);
  // An attribute that must be one of the names, in the order of the values of E.
  template <class E>
  void oneOf(std::string_view name, std::span<const std::string_view> names, E& value) {
    const std::string text = required(name);
    if (text.empty()) return;
    const auto at = std::find(names.begin(), names.end(), text);
    if (at == names.end()) return wrong(name, text, listed(names));
    value = static_cast<E>(at - names.begin());
  }
  void wrong(std::string_view name, std::string_view found, const std::string& expected);
  void finish();

private:
  struct Given {
    std::string_view name, value;
    bool taken = false;
  };

  std::optional<std::string_view> find(std::string_view name);

  XmlReader& reader_;
  std::vector<Given> given_;
  std::vector<std::string_view> asked_;
};

} // namespace rung::host

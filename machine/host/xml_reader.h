// What the readers of the control's XML files share: the parser (expat) with its limits and encodings, the elements
// that are open, mistakes with their places, and attributes. A reader says what the elements mean.
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

// Where something is written, for messages about it: "FILE:LINE:COLUMN".
using FilePlace = std::string;

// "A, B or C".
std::string listed(std::span<const std::string_view> names);
std::string inQuotes(std::string_view text);
// Line breaks with the blanks around them become one blank.
std::string inOneLine(std::string_view text);

// The whole file; "" or why it cannot be read.
std::string textOfFile(const std::string& path, std::string& text);

class XmlReader {
public:
  explicit XmlReader(std::string_view name); // the file's in messages
  virtual ~XmlReader() = default;
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;

protected:
  struct Open {
    std::string name;
    uint64_t line;
  };

  // "" or the mistakes, a line "FILE:LINE:COLUMN: ..." each.
  std::string parse(std::string_view text);

  FilePlace place() const; // of what is being read
  void complain(const std::string& what) { complainAt(place(), what); }
  void complainAt(const FilePlace& where, const std::string& what);
  // <OUTER> holds no <NAME>; `expected` is "<A> or <B>", or empty where a text is.
  void complainAboutChild(std::string_view name, const std::string& expected);
  // Reports text around an element, where none is expected.
  void complainAboutText();

  std::vector<Open> open_; // the innermost one last
  std::string text_;       // since the last beginning or end of an element

private:
  friend class Attributes;
  struct Free {
    void operator()(XML_ParserStruct* parser) const;
  };

  // An element begins, which is not among the open ones yet when `opens` is asked; ends, when it still is.
  virtual void opens(std::string_view name) = 0;
  virtual void begin(std::string_view name, const char** attributes) = 0;
  virtual void end() = 0;
  void notWellFormed();

  std::string name_;
  std::unique_ptr<XML_ParserStruct, Free> parser_;
  std::string complaints_;
  size_t complaintCount_ = 0;
};

// The attributes of one element: each is asked for by its name, what is left over at the end is unknown. Names in any
// case (the manual writes MinVal and Minval).
class Attributes {
public:
  Attributes(XmlReader& reader, const char** list);

  std::string required(std::string_view name);
  // Without blanks at its ends; "" where it is not given.
  std::string optional(std::string_view name);
  void flag(std::string_view name, bool& value);
  void number(std::string_view name, uint32_t most, uint32_t& value);
  void real(std::string_view name, double& value);
  void real(std::string_view name, std::optional<double>& value);
  // One of the names, which number the values of E.
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

// The parser common to the readers of XML files (see xml_reader.h).
#include "machine/host/xml_reader.h"

#include <cerrno>
#include <cstring>
#include <expat.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/regular_file.h"

namespace rung::host {

using text::trimmed;

namespace {

constexpr size_t kMostBytes = size_t{1} << 28;
constexpr size_t kMostComplaints = 100;
constexpr size_t kShown = 40; // bytes of a text in a message

// Czech single-byte encodings; expat itself knows UTF-8, UTF-16, ISO-8859-1 and US-ASCII.
int knowEncoding(void*, const XML_Char* name, XML_Encoding* encoding) {
  struct Named {
    std::string_view name;
    nc::CodePage page;
  };
  constexpr Named kNames[] = {{"windows-1250", nc::CodePage::Windows1250},
                              {"cp1250", nc::CodePage::Windows1250},
                              {"cp852", nc::CodePage::Cp852},
                              {"ibm852", nc::CodePage::Cp852}};
  for (const Named& known : kNames) {
    if (!text::equalsIgnoringCase(known.name, name)) continue;
    for (int byte = 0; byte < 256; ++byte)
      encoding->map[byte] = static_cast<int>(unicodeOf(known.page, static_cast<uint8_t>(byte)));
    encoding->data = nullptr;
    encoding->convert = nullptr;
    encoding->release = nullptr;
    return XML_STATUS_OK;
  }
  return XML_STATUS_ERROR;
}

} // namespace

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

std::string inQuotes(std::string_view text) { return "'" + std::string(text) + "'"; }

std::string inOneLine(std::string_view text) {
  text = text::trimmed(text);
  std::string line;
  for (size_t i = 0; i < text.size();) {
    const size_t end = std::min(text.find_first_not_of(" \t\r\n", i), text.size());
    const std::string_view blanks = text.substr(i, end - i);
    if (blanks.find_first_of("\r\n") != std::string_view::npos)
      line += ' ';
    else
      line += blanks;
    if (end < text.size()) line += text[end];
    i = end + 1;
  }
  return line;
}

std::string textOfFile(const std::string& path, std::string& text) {
  const std::string problem = text::readRegular(path, text::kMostSource, text);
  return problem.empty() ? std::string() : path + ": cannot be read: " + problem;
}

// ---- the parser -----------------------------------------------------------------------------------------------------

XmlReader::XmlReader(std::string_view name) : name_(name), parser_(XML_ParserCreate(nullptr)) {}

void XmlReader::Free::operator()(XML_ParserStruct* parser) const { XML_ParserFree(parser); }

FilePlace XmlReader::place() const {
  return name_ + ":" + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ":" +
         std::to_string(XML_GetCurrentColumnNumber(parser_.get()) + 1);
}

void XmlReader::complainAt(const FilePlace& where, const std::string& what) {
  if (++complaintCount_ > kMostComplaints) return;
  if (!complaints_.empty()) complaints_ += '\n';
  complaints_ += where + ": " + what;
}

void XmlReader::complainAboutChild(std::string_view name, const std::string& expected) {
  complain("<" + open_.back().name + "> holds no <" + std::string(name) + ">" +
           (expected.empty() ? ", but a text" : ", expected " + expected));
}

void XmlReader::complainAboutText() {
  const std::string_view text = trimmed(text_);
  if (!text.empty())
    complain("<" + open_.back().name + "> holds the text " + inQuotes(inOneLine(text.substr(0, kShown))) +
             ", expected elements or nothing");
}

void XmlReader::notWellFormed() {
  const XML_Error code = XML_GetErrorCode(parser_.get());
  std::string what = "this is not well-formed XML: " + std::string(XML_ErrorString(code));
  const bool atTag =
      code == XML_ERROR_TAG_MISMATCH || code == XML_ERROR_NO_ELEMENTS || code == XML_ERROR_UNCLOSED_TOKEN;
  if (code == XML_ERROR_UNKNOWN_ENCODING) what += ", expected utf-8, windows-1250 or cp852";
  if (atTag && !open_.empty())
    what += ", expected the end of <" + open_.back().name + "> of line " + std::to_string(open_.back().line);
  complain(what);
}

std::string XmlReader::parse(std::string_view text) {
  XML_Parser parser = parser_.get();
  XML_SetUserData(parser, this);
  XML_SetElementHandler(
      parser,
      [](void* self, const char* name, const char** attributes) {
        auto& reader = *static_cast<XmlReader*>(self);
        reader.opens(name);
        reader.text_.clear();
        reader.open_.push_back({name, XML_GetCurrentLineNumber(reader.parser_.get())});
        reader.begin(name, attributes);
      },
      [](void* self, const char*) {
        auto& reader = *static_cast<XmlReader*>(self);
        reader.end();
        reader.text_.clear();
        reader.open_.pop_back();
      });
  XML_SetCharacterDataHandler(parser, [](void* self, const char* bytes, int count) {
    static_cast<XmlReader*>(self)->text_.append(bytes, static_cast<size_t>(count));
  });
  XML_SetUnknownEncodingHandler(parser, knowEncoding, nullptr);
  if (text.size() > kMostBytes)
    complainAt(name_, "the file has " + std::to_string(text.size()) + " bytes, at most " + std::to_string(kMostBytes) +
                          " are read");
  else if (XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1) != XML_STATUS_OK)
    notWellFormed();
  if (complaintCount_ > kMostComplaints)
    complaints_ += "\n" + name_ + ": and " + std::to_string(complaintCount_ - kMostComplaints) + " more mistakes";
  return std::move(complaints_);
}

// ---- attributes -----------------------------------------------------------------------------------------------------

Attributes::Attributes(XmlReader& reader, const char** list) : reader_(reader) {
  for (; *list != nullptr; list += 2) given_.push_back({list[0], list[1]});
}

std::string Attributes::required(std::string_view name) {
  const auto value = find(name);
  if (!value || trimmed(*value).empty()) {
    reader_.complain("<" + reader_.open_.back().name + "> lacks the attribute " + std::string(name));
    return {};
  }
  return std::string(trimmed(*value));
}

std::string Attributes::optional(std::string_view name) { return std::string(trimmed(find(name).value_or(""))); }

void Attributes::flag(std::string_view name, bool& value) {
  uint32_t bit = value ? 1 : 0;
  number(name, 1, bit);
  value = bit != 0;
}

void Attributes::number(std::string_view name, uint32_t most, uint32_t& value) {
  const auto text = find(name);
  if (!text) return;
  const auto number = nc::technol::integerOf(*text);
  if (!number || *number < 0 || *number > most) return wrong(name, *text, "0 to " + std::to_string(most));
  value = static_cast<uint32_t>(*number);
}

void Attributes::real(std::string_view name, double& value) {
  std::optional<double> found;
  real(name, found);
  value = found.value_or(value);
}

void Attributes::real(std::string_view name, std::optional<double>& value) {
  const auto text = find(name);
  if (!text) return;
  value = nc::technol::realOf(*text);
  if (!value) wrong(name, *text, "a number");
}

void Attributes::wrong(std::string_view name, std::string_view found, const std::string& expected) {
  reader_.complain("attribute " + std::string(name) + " is " + inQuotes(found) + ", expected " + expected);
}

void Attributes::finish() {
  for (const Given& given : given_)
    if (!given.taken)
      reader_.complain("<" + reader_.open_.back().name + "> has no attribute " + inQuotes(given.name) + "; expected " +
                       (asked_.empty() ? "none" : listed(asked_)));
}

std::optional<std::string_view> Attributes::find(std::string_view name) {
  asked_.push_back(name);
  for (Given& given : given_) {
    if (given.taken || !text::equalsIgnoringCase(given.name, name)) continue;
    given.taken = true;
    return given.value;
  }
  return std::nullopt;
}

} // namespace rung::host

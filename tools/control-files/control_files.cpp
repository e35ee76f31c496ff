// The control's XML files (see control_files.h).
#include "tools/control-files/control_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <expat.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <sstream>
#include <system_error>

#include "rtlib/nc/control/technol/values.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::control_files {
namespace {

constexpr size_t kMostBytes = size_t{1} << 28;
constexpr size_t kMostComplaints = 100;
constexpr uint32_t kMostNumber = 65535; // of a message: a WORD
constexpr int kMostValues = 3;          // of a message's text

enum class Element : uint8_t {
  Foreign, // of another part of the control
  Messages,
  Message,
  MessageText,
  Constants,
  Constant,
  Plc,
  Parameter,
  Terminal,
  Connections,
  Connection,
};

constexpr std::string_view kKindNames[] = {"ErrCritical", "Err", "Wrn1", "Wrn2", "Wrn3", "Info", "Event"};
constexpr std::string_view kValidityNames[] = {"Transient", "Persistent"};
constexpr std::string_view kTypeNames[] = {"Int", "Real", "String", "Binary"};
constexpr std::string_view kTerminalNames[] = {"Input", "Output", "AnalogInput", "AnalogOutput"};

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

std::string inQuotes(std::string_view text) { return "'" + std::string(text) + "'"; }

// Line breaks with the blanks around them become one blank.
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

int valuesIn(std::string_view text) {
  int count = 0;
  for (size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '%' && (text[i + 1] == 'd' || text[i + 1] == 'x' || text[i + 1] == 'X')) ++count;
  return count;
}

class Reader {
public:
  Reader(ControlFileKind kind, std::string_view name, const ControlFiles& earlier);
  std::string read(std::string_view text, ControlFiles& out);

private:
  friend class Attributes;
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };
  struct Open {
    Element element;
    std::string name;
    uint64_t line;
  };

  FilePlace place() const;
  void complain(const std::string& what) { complainAt(place(), what); }
  void complainAt(const FilePlace& where, const std::string& what);
  void notWellFormed();

  void begin(const char* name, const char** attributes);
  void end();
  Element elementOf(std::string_view name);
  Element inChannel(Element parent, std::string_view name) const;
  Element childOf(std::string_view name, std::string_view expected, Element child);
  void checkText();
  // False after a complaint: there is one already.
  bool isNew(std::string_view what, const std::string& id, const FilePlace& at);

  void beginMessage(const char** attributes);
  void beginConstant(const char** attributes);
  void beginParameter(const char** attributes);
  void beginTerminal(std::string_view name, const char** attributes);
  void beginConnection(const char** attributes);
  void endMessage();
  void endParameter();

  ControlFileKind kind_;
  std::string name_;
  std::unique_ptr<XML_ParserStruct, Free> parser_;
  std::vector<Open> open_;
  std::string text_; // of the innermost element
  bool hasText_ = false;
  ControlFiles found_;
  std::map<std::string, FilePlace, std::less<>> known_; // by kind and identifier
  std::string complaints_;
  size_t complaintCount_ = 0;
};

// The attributes of one element: each is asked for by its name, what is left over at the end is unknown. Names in any
// case (the manual writes MinVal and Minval).
class Attributes {
public:
  Attributes(Reader& reader, const char** list) : reader_(reader) {
    for (; *list != nullptr; list += 2) given_.push_back({list[0], list[1]});
  }

  std::string required(std::string_view name) {
    const auto value = find(name);
    if (!value || text::trimmed(*value).empty()) {
      reader_.complain("<" + reader_.open_.back().name + "> lacks the attribute " + std::string(name));
      return {};
    }
    return std::string(text::trimmed(*value));
  }
  void flag(std::string_view name, bool& value) {
    uint32_t number = value ? 1 : 0;
    this->number(name, 1, number);
    value = number != 0;
  }
  void number(std::string_view name, uint32_t most, uint32_t& value) {
    const auto text = find(name);
    if (!text) return;
    const auto number = nc::technol::integerOf(*text);
    if (!number || *number < 0 || *number > most) return wrong(name, *text, "0 to " + std::to_string(most));
    value = static_cast<uint32_t>(*number);
  }
  void real(std::string_view name, double& value) {
    std::optional<double> found;
    real(name, found);
    value = found.value_or(value);
  }
  void real(std::string_view name, std::optional<double>& value) {
    const auto text = find(name);
    if (!text) return;
    value = nc::technol::realOf(*text);
    if (!value) wrong(name, *text, "a number");
  }
  // One of the names, which number the values of E.
  template <class E>
  void oneOf(std::string_view name, std::span<const std::string_view> names, E& value) {
    const std::string text = required(name);
    if (text.empty()) return;
    const auto at = std::find(names.begin(), names.end(), text);
    if (at == names.end()) return wrong(name, text, listed(names));
    value = static_cast<E>(at - names.begin());
  }
  void wrong(std::string_view name, std::string_view found, const std::string& expected) {
    reader_.complain("attribute " + std::string(name) + " is " + inQuotes(found) + ", expected " + expected);
  }
  void finish() {
    for (const Given& given : given_)
      if (!given.taken)
        reader_.complain("<" + reader_.open_.back().name + "> has no attribute " + inQuotes(given.name) +
                         "; expected " + listed(asked_));
  }

private:
  struct Given {
    std::string_view name, value;
    bool taken = false;
  };

  std::optional<std::string_view> find(std::string_view name) {
    asked_.push_back(name);
    for (Given& given : given_) {
      if (given.taken || !text::equalsIgnoringCase(given.name, name)) continue;
      given.taken = true;
      return given.value;
    }
    return std::nullopt;
  }

  Reader& reader_;
  std::vector<Given> given_;
  std::vector<std::string_view> asked_;
};

// ---- the parser -----------------------------------------------------------------------------------------------------

// Czech sets of one byte a character; expat knows UTF-8, UTF-16, ISO-8859-1 and US-ASCII itself.
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

Reader::Reader(ControlFileKind kind, std::string_view name, const ControlFiles& earlier)
    : kind_(kind), name_(name), parser_(XML_ParserCreate(nullptr)) {
  for (const PlacedMessage& message : earlier.messages)
    known_.emplace("message " + std::to_string(message.number), message.place);
  for (const ConstantDefinition& constant : earlier.constants)
    known_.emplace("constant " + constant.id, constant.place);
  for (const ParameterDefinition& parameter : earlier.parameters)
    known_.emplace("parameter " + parameter.id, parameter.place);
  for (const TerminalDefinition& terminal : earlier.terminals)
    known_.emplace("input or output " + terminal.id, terminal.place);
}

FilePlace Reader::place() const {
  return name_ + ":" + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ":" +
         std::to_string(XML_GetCurrentColumnNumber(parser_.get()) + 1);
}

void Reader::complainAt(const FilePlace& where, const std::string& what) {
  if (++complaintCount_ > kMostComplaints) return;
  if (!complaints_.empty()) complaints_ += '\n';
  complaints_ += where + ": " + what;
}

void Reader::notWellFormed() {
  const XML_Error code = XML_GetErrorCode(parser_.get());
  std::string what = "this is not well-formed XML: " + std::string(XML_ErrorString(code));
  const bool atTag =
      code == XML_ERROR_TAG_MISMATCH || code == XML_ERROR_NO_ELEMENTS || code == XML_ERROR_UNCLOSED_TOKEN;
  if (code == XML_ERROR_UNKNOWN_ENCODING) what += ", expected utf-8, windows-1250 or cp852";
  if (atTag && !open_.empty())
    what += ", expected the end of <" + open_.back().name + "> of line " + std::to_string(open_.back().line);
  complain(what);
}

std::string Reader::read(std::string_view text, ControlFiles& out) {
  XML_Parser parser = parser_.get();
  XML_SetUserData(parser, this);
  XML_SetElementHandler(
      parser,
      [](void* self, const char* name, const char** attributes) {
        static_cast<Reader*>(self)->begin(name, attributes);
      },
      [](void* self, const char*) { static_cast<Reader*>(self)->end(); });
  XML_SetCharacterDataHandler(parser, [](void* self, const char* bytes, int count) {
    static_cast<Reader*>(self)->text_.append(bytes, static_cast<size_t>(count));
  });
  XML_SetUnknownEncodingHandler(parser, knowEncoding, nullptr);
  if (text.size() > kMostBytes)
    complainAt(name_, "the file has " + std::to_string(text.size()) + " bytes, at most " + std::to_string(kMostBytes) +
                          " are read");
  else if (XML_Parse(parser, text.data(), static_cast<int>(text.size()), 1) != XML_STATUS_OK)
    notWellFormed();
  if (complaintCount_ > kMostComplaints)
    complaints_ += "\n" + name_ + ": and " + std::to_string(complaintCount_ - kMostComplaints) + " more mistakes";
  if (!complaints_.empty()) return std::move(complaints_);
  const auto append = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  append(out.messages, found_.messages);
  append(out.parameters, found_.parameters);
  append(out.constants, found_.constants);
  append(out.connections, found_.connections);
  append(out.terminals, found_.terminals);
  return {};
}

// ---- elements -------------------------------------------------------------------------------------------------------

Element Reader::childOf(std::string_view name, std::string_view expected, Element child) {
  if (name == expected) return child;
  const std::string& outer = open_.back().name;
  complain("<" + outer + "> holds no <" + std::string(name) + ">" +
           (expected.empty() ? ", but a text" : ", expected <" + std::string(expected) + ">"));
  return Element::Foreign;
}

Element Reader::inChannel(Element parent, std::string_view name) const {
  if (parent == Element::Plc && name == "PlcParam") return Element::Parameter;
  if (parent == Element::Plc &&
      std::find(std::begin(kTerminalNames), std::end(kTerminalNames), name) != std::end(kTerminalNames))
    return Element::Terminal;
  if (name == "Plc") return Element::Plc;
  return name == "Connections" ? Element::Connections : Element::Foreign;
}

Element Reader::elementOf(std::string_view name) {
  if (open_.empty()) {
    switch (kind_) {
    case ControlFileKind::Messages: return name == "PlcError" ? Element::Message : Element::Messages;
    case ControlFileKind::Constants:
      if (name == "PlcConstants") return Element::Constants;
      complain("found <" + std::string(name) + ">, expected <PlcConstants>");
      return Element::Foreign;
    case ControlFileKind::Channel: return inChannel(Element::Foreign, name);
    }
  }
  const Element parent = open_.back().element;
  switch (parent) {
  case Element::Messages: return childOf(name, "PlcError", Element::Message);
  case Element::Message: return childOf(name, "Text", Element::MessageText);
  case Element::Constants: return childOf(name, "Constant", Element::Constant);
  case Element::Connections: return childOf(name, "Connection", Element::Connection);
  case Element::MessageText:
  case Element::Constant:
  case Element::Parameter:
  case Element::Terminal:
  case Element::Connection: return childOf(name, {}, Element::Foreign);
  case Element::Plc: return inChannel(parent, name);
  case Element::Foreign: break;
  }
  return kind_ == ControlFileKind::Channel ? inChannel(parent, name) : Element::Foreign;
}

// What is around an element is not a text of the ones read here.
void Reader::checkText() {
  const bool foreign =
      open_.empty() || open_.back().element == Element::Foreign || open_.back().element == Element::Plc;
  const std::string_view text = text::trimmed(text_);
  if (!foreign && !text.empty())
    complain("<" + open_.back().name + "> holds the text " + inQuotes(inOneLine(text.substr(0, 40))) +
             ", expected elements or nothing");
  text_.clear();
}

void Reader::begin(const char* name, const char** attributes) {
  checkText();
  const Element element = elementOf(name);
  open_.push_back({element, name, XML_GetCurrentLineNumber(parser_.get())});
  switch (element) {
  case Element::Message: return beginMessage(attributes);
  case Element::Constant: return beginConstant(attributes);
  case Element::Parameter: return beginParameter(attributes);
  case Element::Terminal: return beginTerminal(name, attributes);
  case Element::Connection: return beginConnection(attributes);
  case Element::Foreign:
  case Element::Messages:
  case Element::MessageText:
  case Element::Constants:
  case Element::Plc:
  case Element::Connections: return;
  }
}

void Reader::end() {
  const Element element = open_.back().element;
  if (element == Element::MessageText) {
    endMessage();
  } else if (element == Element::Parameter) {
    endParameter();
  } else {
    if (element == Element::Message && !hasText_) complain("<PlcError> lacks its <Text>");
    checkText();
  }
  text_.clear();
  open_.pop_back();
}

bool Reader::isNew(std::string_view what, const std::string& id, const FilePlace& at) {
  if (id.empty()) return false;
  const auto [entry, fresh] = known_.emplace(std::string(what) + " " + id, at);
  if (!fresh) complain(entry->first + " is defined again; the first definition is at " + entry->second);
  return fresh;
}

void Reader::beginMessage(const char** list) {
  Attributes attributes(*this, list);
  PlacedMessage& message = found_.messages.emplace_back();
  message.place = place();
  hasText_ = false;
  const std::string number = attributes.required("No");
  const auto value = nc::technol::integerOf(number);
  if (!number.empty() && (!value || *value < 0 || *value > kMostNumber))
    attributes.wrong("No", number, "0 to " + std::to_string(kMostNumber));
  else if (value && isNew("message", std::to_string(*value), message.place))
    message.number = static_cast<uint32_t>(*value);
  attributes.oneOf("Type", kKindNames, message.kind);
  attributes.oneOf("Validity", kValidityNames, message.validity);
  attributes.finish();
}

void Reader::endMessage() {
  if (hasText_) complain("<PlcError> has a second <Text>");
  hasText_ = true;
  PlacedMessage& message = found_.messages.back();
  message.text = inOneLine(text_);
  if (const int values = valuesIn(message.text); values > kMostValues)
    complain("the text takes " + std::to_string(values) + " values, a message has " + std::to_string(kMostValues));
}

void Reader::beginConstant(const char** list) {
  Attributes attributes(*this, list);
  ConstantDefinition constant{attributes.required("ID"), attributes.required("Value"), place()};
  attributes.finish();
  if (isNew("constant", constant.id, constant.place)) found_.constants.push_back(std::move(constant));
}

void Reader::beginParameter(const char** list) {
  Attributes attributes(*this, list);
  ParameterDefinition& parameter = found_.parameters.emplace_back();
  parameter.place = place();
  parameter.id = attributes.required("ID");
  attributes.oneOf("Type", kTypeNames, parameter.type);
  attributes.finish();
  isNew("parameter", parameter.id, parameter.place);
}

void Reader::endParameter() {
  ParameterDefinition& parameter = found_.parameters.back();
  parameter.value = text::trimmed(text_);
  const auto wrong = [&](std::string_view expected) {
    complainAt(parameter.place, "parameter " + parameter.id + " is " + inQuotes(parameter.value) + ", expected " +
                                    std::string(expected));
  };
  if (parameter.type == ParameterType::Int && !nc::technol::integerOf(parameter.value)) wrong("an integer");
  if (parameter.type == ParameterType::Real && !nc::technol::realOf(parameter.value)) wrong("a number");
}

void Reader::beginTerminal(std::string_view name, const char** list) {
  constexpr uint32_t kMostPort = 128, kMostBit = 7, kMostPhysical = 99;
  Attributes attributes(*this, list);
  TerminalDefinition terminal;
  terminal.place = place();
  const auto* kind = std::find(std::begin(kTerminalNames), std::end(kTerminalNames), name);
  terminal.kind = static_cast<TerminalKind>(kind - std::begin(kTerminalNames));
  terminal.id = attributes.required("ID");
  if (terminal.kind == TerminalKind::Input || terminal.kind == TerminalKind::Output) {
    attributes.number("Port", kMostPort, terminal.port);
    attributes.number("Bit", kMostBit, terminal.bit);
    attributes.flag("Invert", terminal.invert);
    bool otherwise = false;
    attributes.flag("Default", otherwise);
    terminal.otherwise = otherwise ? 1 : 0;
  } else {
    attributes.number("PhysNo", kMostPhysical, terminal.physical);
    attributes.real("Scale", terminal.scale);
    attributes.real("Offset", terminal.offset);
    attributes.real("MinVal", terminal.least);
    attributes.real("MaxVal", terminal.most);
    attributes.real("Default", terminal.otherwise);
    if (terminal.least && terminal.most && *terminal.least > *terminal.most) complain("MinVal is greater than MaxVal");
  }
  attributes.flag("Connected", terminal.connected);
  attributes.finish();
  if (isNew("input or output", terminal.id, terminal.place)) found_.terminals.push_back(std::move(terminal));
}

void Reader::beginConnection(const char** list) {
  Attributes attributes(*this, list);
  ConnectionDefinition connection;
  connection.place = place();
  connection.source = attributes.required("Source");
  connection.destination = attributes.required("Destination");
  attributes.flag("Invert", connection.invert);
  attributes.real("Scale", connection.scale);
  attributes.real("Offset", connection.offset);
  attributes.flag("Connected", connection.connected);
  attributes.finish();
  found_.connections.push_back(std::move(connection));
}

} // namespace

std::string parseControlFile(ControlFileKind kind, std::string_view name, std::string_view text, ControlFiles& files) {
  return Reader(kind, name, files).read(text, files);
}

std::string readControlFile(ControlFileKind kind, const std::string& path, ControlFiles& files) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return path + ": this is a folder, expected a file";
  std::ifstream file(path, std::ios::binary);
  if (!file) return path + ": cannot be read: " + std::strerror(errno);
  std::ostringstream text;
  text << file.rdbuf();
  return parseControlFile(kind, path, text.view(), files);
}

} // namespace rung::control_files

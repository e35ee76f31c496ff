// The control's XML files (see control_files.h).
#include "machine/host/control_files.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "machine/host/xml_reader.h"
#include "rtlib/nc/control/technol/values.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::host {
namespace {

constexpr uint32_t kMostNumber = 65535; // number of a message: a WORD
constexpr int kMostValues = 3;          // values in the text of a message

enum class Element : uint8_t {
  Foreign, // belongs to another part of the control
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
  Device,
};

constexpr std::string_view kKindNames[] = {"ErrCritical", "Err", "Wrn1", "Wrn2", "Wrn3", "Info", "Event"};
constexpr std::string_view kValidityNames[] = {"Transient", "Persistent"};
constexpr std::string_view kTypeNames[] = {"Int", "Real", "String", "Binary"};
constexpr std::string_view kTerminalNames[] = {"Input", "Output", "AnalogInput", "AnalogOutput"};
constexpr std::string_view kDeviceNames[] = {"NCAxis", "CANChannel", "ComChannel", "Servo"};

std::string deviceName(const DeviceDefinition& device) {
  return std::string(kDeviceNames[static_cast<size_t>(device.kind)]);
}

int valuesIn(std::string_view text) {
  int count = 0;
  for (size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '%' && (text[i + 1] == 'd' || text[i + 1] == 'x' || text[i + 1] == 'X')) ++count;
  return count;
}

class Reader : public XmlReader {
public:
  Reader(ControlFileKind kind, std::string_view name, const ControlFiles& earlier);
  std::string read(std::string_view text, ControlFiles& out);

private:
  void opens(std::string_view name) override;
  void begin(std::string_view name, const char** attributes) override;
  void end() override;
  Element elementOf(std::string_view name);
  Element inChannel(Element parent, std::string_view name) const;
  Element childOf(std::string_view name, std::string_view expected, Element child);
  void checkText();
  // Returns whether the identifier is new; reports a duplicate. An empty one has already been reported.
  bool isNew(std::string_view what, const std::string& id, const FilePlace& at);

  void beginMessage(const char** attributes);
  void beginConstant(const char** attributes);
  void beginParameter(const char** attributes);
  void beginTerminal(std::string_view name, const char** attributes);
  void beginConnection(const char** attributes);
  void beginDevice(std::string_view name, const char** attributes);
  void endMessage();
  void endParameter();

  ControlFileKind kind_;
  std::vector<Element> elements_; // open elements
  bool hasText_ = false;
  ControlFiles found_;
  std::map<std::string, FilePlace, std::less<>> known_; // positions by kind and identifier
};

Reader::Reader(ControlFileKind kind, std::string_view name, const ControlFiles& earlier)
    : XmlReader(name), kind_(kind) {
  for (const PlacedMessage& message : earlier.messages)
    known_.emplace("message " + std::to_string(message.number), message.place);
  for (const ConstantDefinition& constant : earlier.constants)
    known_.emplace("constant " + constant.id, constant.place);
  for (const ParameterDefinition& parameter : earlier.parameters)
    known_.emplace("parameter " + parameter.id, parameter.place);
  for (const TerminalDefinition& terminal : earlier.terminals)
    known_.emplace("input or output " + terminal.id, terminal.place);
  for (const DeviceDefinition& device : earlier.devices)
    known_.emplace(deviceName(device) + " " + std::to_string(device.number), device.place);
}

std::string Reader::read(std::string_view text, ControlFiles& out) {
  if (std::string complaints = parse(text); !complaints.empty()) return complaints;
  const auto append = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  append(out.messages, found_.messages);
  append(out.parameters, found_.parameters);
  append(out.constants, found_.constants);
  append(out.connections, found_.connections);
  append(out.terminals, found_.terminals);
  append(out.devices, found_.devices);
  return {};
}

// ---- elements -------------------------------------------------------------------------------------------------------

Element Reader::childOf(std::string_view name, std::string_view expected, Element child) {
  if (name == expected) return child;
  complainAboutChild(name, expected.empty() ? std::string() : "<" + std::string(expected) + ">");
  return Element::Foreign;
}

Element Reader::inChannel(Element parent, std::string_view name) const {
  if (parent == Element::Plc && name == "PlcParam") return Element::Parameter;
  if (parent == Element::Plc &&
      std::find(std::begin(kTerminalNames), std::end(kTerminalNames), name) != std::end(kTerminalNames))
    return Element::Terminal;
  if (std::ranges::find(kDeviceNames, name) != std::end(kDeviceNames)) return Element::Device;
  if (name == "Plc") return Element::Plc;
  return name == "Connections" ? Element::Connections : Element::Foreign;
}

Element Reader::elementOf(std::string_view name) {
  if (elements_.empty()) {
    switch (kind_) {
    case ControlFileKind::Messages: return name == "PlcError" ? Element::Message : Element::Messages;
    case ControlFileKind::Constants:
      if (name == "PlcConstants") return Element::Constants;
      complain("found <" + std::string(name) + ">, expected <PlcConstants>");
      return Element::Foreign;
    case ControlFileKind::Channel: return inChannel(Element::Foreign, name);
    }
  }
  const Element parent = elements_.back();
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
  case Element::Device: // its content belongs to another part of the control
  case Element::Foreign: break;
  }
  return kind_ == ControlFileKind::Channel ? inChannel(parent, name) : Element::Foreign;
}

// Reports text in elements that have no text; foreign elements may contain any.
void Reader::checkText() {
  constexpr Element kWithTexts[] = {Element::Foreign, Element::Plc, Element::Device};
  const bool foreign = elements_.empty() || std::ranges::find(kWithTexts, elements_.back()) != std::end(kWithTexts);
  if (!foreign) complainAboutText();
}

void Reader::opens(std::string_view name) {
  checkText();
  elements_.push_back(elementOf(name));
}

void Reader::begin(std::string_view name, const char** attributes) {
  const Element element = elements_.back();
  switch (element) {
  case Element::Message: return beginMessage(attributes);
  case Element::Constant: return beginConstant(attributes);
  case Element::Parameter: return beginParameter(attributes);
  case Element::Terminal: return beginTerminal(name, attributes);
  case Element::Connection: return beginConnection(attributes);
  case Element::Device: return beginDevice(name, attributes);
  case Element::Foreign:
  case Element::Messages:
  case Element::MessageText:
  case Element::Constants:
  case Element::Plc:
  case Element::Connections: return;
  }
}

void Reader::end() {
  const Element element = elements_.back();
  if (element == Element::MessageText) {
    endMessage();
  } else if (element == Element::Parameter) {
    endParameter();
  } else {
    if (element == Element::Message && !hasText_) complain("<PlcError> lacks its <Text>");
    checkText();
  }
  elements_.pop_back();
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

void Reader::beginDevice(std::string_view name, const char** list) {
  constexpr uint32_t kLast = 15;
  Attributes attributes(*this, list);
  DeviceDefinition device;
  device.place = place();
  device.kind = static_cast<DeviceKind>(std::ranges::find(kDeviceNames, name) - std::begin(kDeviceNames));
  const std::string number = attributes.required("No");
  const auto value = nc::technol::integerOf(number);
  const bool isNumber = value && *value >= 0 && *value <= int64_t{kLast};
  if (!isNumber && !number.empty()) attributes.wrong("No", number, "0 to " + std::to_string(kLast));
  if (!isNumber) return;
  device.number = static_cast<uint32_t>(*value);
  for (; *list != nullptr; list += 2)
    if (!text::equalsIgnoringCase(list[0], "No"))
      device.attributes.push_back({list[0], std::string(text::trimmed(list[1]))});
  if (isNew(name, std::to_string(device.number), device.place)) found_.devices.push_back(std::move(device));
}

} // namespace

std::string parseControlFile(ControlFileKind kind, std::string_view name, std::string_view text, ControlFiles& files) {
  return Reader(kind, name, files).read(text, files);
}

std::string readControlFile(ControlFileKind kind, const std::string& path, ControlFiles& files) {
  std::string text;
  if (std::string wrong = textOfFile(path, text); !wrong.empty()) return wrong;
  return parseControlFile(kind, path, text, files);
}

} // namespace rung::host

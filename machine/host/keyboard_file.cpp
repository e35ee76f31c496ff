// Files of keyboards (see keyboard_file.h).
#include "machine/host/keyboard_file.h"

#include <algorithm>

#include "rtlib/nc/control/technol/values.h"

namespace rung::host {
namespace {

constexpr uint32_t kMostFunction = 3;
constexpr int64_t kMostScan = 255;
constexpr std::string_view kTypes[] = {"Normal", "Multi"};

class KeyboardReader final : public XmlReader {
public:
  KeyboardReader(std::string_view name, const std::vector<KeyDefinition>& earlier) : XmlReader(name), found_(earlier) {}

  std::string read(std::string_view text, std::vector<KeyDefinition>& keys) {
    std::string wrong = parse(text);
    if (wrong.empty()) keys = std::move(found_);
    return wrong;
  }

private:
  enum class Element : uint8_t { Foreign, Document, Key, Function };

  void opens(std::string_view name) override {
    if (!elements_.empty() && elements_.back() != Element::Foreign) complainAboutText();
    elements_.push_back(elementOf(name));
  }
  void begin(std::string_view name, const char** list) override;
  void end() override;

  Element elementOf(std::string_view name);
  static uint8_t scanOf(Attributes& attributes);
  void readCommands(Attributes& attributes, KeyDefinition& key);
  void add(const KeyDefinition& key);

  std::vector<Element> elements_;
  std::vector<KeyDefinition> found_;
  KeyDefinition key_; // the open element KeyConfig
  bool hasFunctions_ = false;
};

KeyboardReader::Element KeyboardReader::elementOf(std::string_view name) {
  if (elements_.empty()) {
    if (name == "KeyboardConfig") return Element::Document;
    complain("found <" + std::string(name) + ">, expected <KeyboardConfig>");
    return Element::Foreign;
  }
  switch (elements_.back()) {
  case Element::Document:
    if (name == "KeyConfig") return Element::Key;
    if (name != "Comment") complainAboutChild(name, "<KeyConfig>"); // man. l.17666
    return Element::Foreign;
  case Element::Key:
    if (name == "Function") return Element::Function;
    [[fallthrough]];
  case Element::Function:
    if (name != "Dialog" && name != "Layout" && name != "Multikey")
      complainAboutChild(name, "<Function>, <Dialog>, <Layout> or <Multikey>");
    return Element::Foreign;
  case Element::Foreign: break;
  }
  return Element::Foreign;
}

uint8_t KeyboardReader::scanOf(Attributes& attributes) {
  const std::string text = attributes.required("ScanCode");
  const auto scan = nc::technol::integerOf(text);
  const bool isScan = scan && *scan >= 0 && *scan <= kMostScan;
  if (!isScan && !text.empty()) attributes.wrong("ScanCode", text, "0x00 to 0xFF");
  return isScan ? static_cast<uint8_t>(*scan) : uint8_t{0};
}

void KeyboardReader::readCommands(Attributes& attributes, KeyDefinition& key) {
  const std::string type = attributes.optional("Type");
  if (!type.empty() && std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes))
    attributes.wrong("Type", type, listed(kTypes));
  key.plcCommand = attributes.optional("PlcCommand");
  key.rtmCommand = attributes.optional("RtmCommand");
  for (const std::string_view other : {"VirtualKey", "EnableRepeat", "UnicodeCharLower", "UnicodeCharUpper", "Command"})
    attributes.optional(other);
}

void KeyboardReader::begin(std::string_view, const char** list) {
  if (elements_.back() != Element::Key && elements_.back() != Element::Function) return;
  Attributes attributes(*this, list);
  if (elements_.back() == Element::Key) {
    key_ = {.scan = scanOf(attributes), .place = place()};
    hasFunctions_ = false;
    readCommands(attributes, key_);
  } else {
    uint32_t number = 0;
    attributes.number("No", kMostFunction, number);
    KeyDefinition key{.scan = key_.scan, .function = static_cast<uint8_t>(number), .place = place()};
    readCommands(attributes, key);
    hasFunctions_ = true;
    add(key);
  }
  attributes.finish();
}

void KeyboardReader::end() {
  const Element element = elements_.back();
  if (element != Element::Foreign) complainAboutText();
  if (element == Element::Key && !hasFunctions_) add(key_);
  elements_.pop_back();
}

void KeyboardReader::add(const KeyDefinition& key) {
  for (const KeyDefinition& old : found_)
    if (old.scan == key.scan && (old.function == key.function || old.function == KeyDefinition::kAnyFunction ||
                                 key.function == KeyDefinition::kAnyFunction))
      return complainAt(key.place,
                        "this function of the key is defined again; the first definition is at " + old.place);
  found_.push_back(key);
}

} // namespace

std::string parseKeyboardFile(std::string_view name, std::string_view text, std::vector<KeyDefinition>& keys) {
  return KeyboardReader(name, keys).read(text, keys);
}

std::string readKeyboardFile(const std::string& path, std::vector<KeyDefinition>& keys) {
  std::string text;
  const std::string wrong = textOfFile(path, text);
  return wrong.empty() ? parseKeyboardFile(path, text, keys) : wrong;
}

} // namespace rung::host

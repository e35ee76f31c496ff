// MR 201 and MW 202 (see mailbox.h).
#include "tools/sim/nct/mailbox.h"

#include <algorithm>
#include <cstring>

#include "rtlib/text/number.h"

namespace rung::sim::nct {
namespace {

constexpr uint32_t kRead = 201;
constexpr uint32_t kWrite = 202;
constexpr int64_t kTimeoutUs = 1'000'000;

// Abort codes of CANopen and errors of Sercos that devices answer with.
constexpr uint32_t kCoeNoObject = 0x06020000;
constexpr uint32_t kCoeNoSubindex = 0x06090011;
constexpr uint32_t kCoeWrongAccess = 0x06010000;
constexpr uint32_t kCoeWrongLength = 0x06070010;
constexpr uint32_t kSoeNoElement = 0x1001;
constexpr uint32_t kSoeWrongElement = 0x1009; // invalid access to an element
constexpr uint32_t kSoeWrongLength = 0x7001;  // data too short or too long
constexpr uint32_t kSoeReadOnly = 0x7004;

// Elements of an IDN by the bits of word 8 (l.6040-6050).
enum SoeElement : uint32_t { kState, kName, kAttribute, kUnit, kMinimum, kMaximum, kValue, kDefault };

std::optional<uint64_t> integer(std::string_view text) {
  const bool hex = text.starts_with("0x");
  if (hex) text.remove_prefix(2);
  return text::numberIn<uint64_t>(text, hex ? 16 : 10);
}

uint64_t ones(uint32_t bytes) { return bytes >= 8 ? ~uint64_t{0} : (uint64_t{1} << 8 * bytes) - 1; }

} // namespace

bool Mailbox::serves(bool write, uint32_t function) const { return function == (write ? kWrite : kRead); }

// The amounts of the tables (l.5973-6120); "not 3" beside code 2 is wrong (l.6132).
bool Mailbox::fits(int32_t protocol, int32_t amount) {
  if (protocol == static_cast<int32_t>(Protocol::Voe)) return amount == 4;
  if (protocol == static_cast<int32_t>(Protocol::Soe)) return amount == 7;
  if (protocol == static_cast<int32_t>(Protocol::Coe)) return amount >= 5 && amount <= 7;
  return amount >= 4 && amount <= 7;
}

bool Mailbox::speaks(const Device& device, Protocol protocol) {
  switch (protocol) {
  case Protocol::Coe: return device.coe;
  case Protocol::Soe: return device.soe;
  case Protocol::Voe: return device.voe;
  }
  return false;
}

Mailbox::Device* Mailbox::find(int32_t index) {
  const auto found =
      std::ranges::find_if(devices_, [&](const Device& d) { return static_cast<int64_t>(d.index) == index; });
  return found == devices_.end() ? nullptr : &*found;
}

Mailbox::Object* Mailbox::find(const Device& device, Protocol protocol, uint32_t index, uint32_t sub) {
  for (Object& object : objects_)
    if (object.device == device.index && object.protocol == protocol && object.index == index && object.sub == sub)
      return &object;
  return nullptr;
}

// A mailbox answers in a later cycle than that of the request.
std::optional<int32_t> Mailbox::service(uint32_t function, Block& block) {
  const bool write = function == kWrite;
  if (!fits(block.word(2), block.amount())) return 2;
  Device* device = find(block.word(3));
  if (device == nullptr) return 200;
  const auto protocol = static_cast<Protocol>(block.word(2));
  if (block.word(2) < 0 || block.word(2) > 15 || !speaks(*device, protocol)) return 201;
  const int32_t bytes = block.word(4);
  const int32_t address = block.word(5);
  if (bytes < 1 || bytes > kMostBytes || address < 1 || !links().memory.contains(address, (bytes + 3) / 4)) return 202;
  if (device->silent) {
    if (links().requestAgeUs < kTimeoutUs) return std::nullopt;
    return write ? 204 : 203;
  }
  if (links().requestAgeUs == 0) return std::nullopt;
  size_ = 0;
  if (write) {
    size_ = static_cast<size_t>(bytes);
    for (uint32_t i = 0; i < size_; ++i) {
      const auto word = static_cast<uint32_t>(links().memory.word(static_cast<uint32_t>(address) + i / 4));
      buffer_[i] = static_cast<uint8_t>(word >> 8 * (i % 4));
    }
  }
  return finish(write, block, device->error != 0 ? device->error : exchange(write, block, *device, protocol));
}

// Data that were read go to the program's memory; an object that is longer than the program waits for is its error.
int32_t Mailbox::finish(bool write, Block& block, uint32_t error) {
  if (block.amount() >= 6) block.setWord(7, static_cast<int32_t>(error));
  if (error != 0) return 205;
  if (write) return 0;
  if (size_ > static_cast<size_t>(block.word(4))) return 202;
  for (size_t at = 0; at < size_; at += 4) {
    uint32_t word = 0;
    std::memcpy(&word, buffer_.data() + at, std::min<size_t>(4, size_ - at));
    links().memory.setWord(static_cast<uint32_t>(block.word(5)) + static_cast<uint32_t>(at / 4),
                           static_cast<int32_t>(word));
  }
  return 0;
}

// ---- protocols ---------------------------------------------------------------------------------------------------

void Mailbox::append(uint64_t value, uint32_t bytes) {
  for (uint32_t i = 0; i < bytes && size_ < buffer_.size(); ++i)
    buffer_[size_++] = static_cast<uint8_t>(value >> 8 * i);
}

uint64_t Mailbox::valueOf(std::span<const uint8_t> bytes) {
  uint64_t value = 0;
  std::memcpy(&value, bytes.data(), std::min<size_t>(bytes.size(), 8));
  return value;
}

uint32_t Mailbox::exchange(bool write, Block& block, Device& device, Protocol protocol) {
  switch (protocol) {
  case Protocol::Coe: return exchangeCoe(write, block, device);
  case Protocol::Soe: return exchangeSoe(write, block, device);
  case Protocol::Voe: break;
  }
  // Vendor's data: the device gives back what it was given last.
  if (write) {
    device.vendor.resize(size_); // has room for all that a mailbox holds
    std::memcpy(device.vendor.data(), buffer_.data(), size_);
    return 0;
  }
  size_ = std::min(device.vendor.size(), static_cast<size_t>(block.word(4)));
  std::memcpy(buffer_.data(), device.vendor.data(), size_);
  return 0;
}

uint32_t Mailbox::exchangeCoe(bool write, Block& block, Device& device) {
  const auto place = static_cast<uint32_t>(block.word(6));
  const uint32_t index = place & 0xFFFF;
  const uint32_t sub = place >> 16 & 0xFF;
  if (block.amount() == 7 && block.word(8) != 0) return exchangeWhole(write, device, index, sub);
  Object* object = find(device, Protocol::Coe, index, sub);
  if (object == nullptr) {
    const bool known = std::ranges::any_of(objects_, [&](const Object& o) {
      return o.device == device.index && o.protocol == Protocol::Coe && o.index == index;
    });
    return known ? kCoeNoSubindex : kCoeNoObject;
  }
  if (!write) {
    append(object->value, object->bytes);
    return 0;
  }
  if (size_ != object->bytes) return kCoeWrongLength;
  object->value = valueOf(std::span(buffer_).first(size_));
  return 0;
}

// CompleteAccess: the subindices from 0 or 1 on, one after the other; subindex 0 takes two bytes.
uint32_t Mailbox::exchangeWhole(bool write, Device& device, uint32_t index, uint32_t sub) {
  if (sub > 1) return kCoeWrongAccess;
  size_t at = 0;
  for (uint32_t i = sub; i <= 0xFF; ++i) {
    Object* object = find(device, Protocol::Coe, index, i);
    if (object == nullptr) continue;
    const uint32_t bytes = i == 0 ? 2 : object->bytes;
    if (!write) {
      append(object->value, bytes);
    } else if (at + bytes <= size_) {
      if (i != 0) object->value = valueOf(std::span(buffer_).subspan(at, bytes)); // their number does not change
    }
    at += bytes;
  }
  if (at == 0) return kCoeNoObject;
  return write && at != size_ ? kCoeWrongLength : 0;
}

uint32_t Mailbox::exchangeSoe(bool write, Block& block, Device& device) {
  const auto place = static_cast<uint32_t>(block.word(6));
  const uint32_t idn = place & 0xFFFF;
  Object* element = find(device, Protocol::Soe, idn, place >> 16 & 0xFF);
  if (element == nullptr) return kSoeNoElement;
  const auto flags = static_cast<uint32_t>(block.word(8)) & 0xFF;
  if (flags == 0) return kSoeWrongElement;
  if (write) {
    if (flags != uint32_t{1} << kValue) return kSoeReadOnly;
    if (size_ != element->bytes) return kSoeWrongLength;
    element->value = valueOf(std::span(buffer_).first(size_));
    return 0;
  }
  constexpr uint32_t kNameBytes = 8; // "IDN12345"
  for (uint32_t bit = 0; bit < 8; ++bit) {
    if ((flags >> bit & 1) == 0) continue;
    switch (static_cast<SoeElement>(bit)) {
    case kState: append(0, 2); break;
    case kName:
      append(kNameBytes | uint64_t{kNameBytes} << 16, 4); // length now, at most
      for (const char letter : {'I', 'D', 'N'}) append(static_cast<uint8_t>(letter), 1);
      for (uint32_t unit = 10000; unit != 0; unit /= 10) append('0' + idn / unit % 10, 1);
      break;
    case kAttribute: append(element->bytes, 4); break;
    case kUnit: append(0, 4); break; // a text of no letters
    case kMinimum: append(0, element->bytes); break;
    case kMaximum: append(ones(element->bytes), element->bytes); break;
    case kValue: append(element->value, element->bytes); break;
    case kDefault: append(element->initial, element->bytes); break;
    }
  }
  return 0;
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

std::string Mailbox::addDevice(uint32_t index, std::string_view protocols) {
  if (index < 1 || find(static_cast<int32_t>(index)) != nullptr) return "devices are numbered from 1, each once";
  Device device;
  device.index = index;
  while (!protocols.empty()) {
    const std::string_view name = protocols.substr(0, protocols.find('+'));
    protocols.remove_prefix(std::min(protocols.size(), name.size() + 1));
    if (name != "coe" && name != "soe" && name != "voe") return "protocols are coe, soe, voe, joined by +";
    device.coe |= name == "coe";
    device.soe |= name == "soe";
    device.voe |= name == "voe";
  }
  device.vendor.reserve(kMostBytes);
  devices_.push_back(std::move(device));
  return {};
}

// "1.coe.0x6041.0" and "0x237/2".
std::string Mailbox::addObject(std::string_view place, std::string_view value) {
  std::vector<std::string_view> parts;
  for (std::string_view rest = place;;) {
    parts.push_back(rest.substr(0, rest.find('.')));
    if (parts.back().size() == rest.size()) break;
    rest.remove_prefix(parts.back().size() + 1);
  }
  if (parts.size() != 4) return "expected ethercat.DEVICE.coe.INDEX.SUBINDEX or ethercat.DEVICE.soe.IDN.DRIVE";
  const auto device = integer(parts[0]);
  const auto index = integer(parts[2]);
  const auto sub = integer(parts[3]);
  const size_t slash = value.find('/');
  const auto number = integer(value.substr(0, slash));
  const auto bytes = slash == std::string_view::npos ? std::optional<uint64_t>(4) : integer(value.substr(slash + 1));
  if (!device || !index || !sub || *index > 0xFFFF || *sub > 0xFF) return "wrong number of a device or an object";
  if (!number || !bytes || *bytes < 1 || *bytes > 8) return "expected VALUE or VALUE/BYTES, 1 to 8 bytes";
  if (parts[1] != "coe" && parts[1] != "soe") return "objects belong to coe or soe";
  Object object{.device = static_cast<uint32_t>(*device),
                .protocol = parts[1] == "coe" ? Protocol::Coe : Protocol::Soe,
                .index = static_cast<uint32_t>(*index),
                .sub = static_cast<uint32_t>(*sub),
                .bytes = static_cast<uint32_t>(*bytes),
                .initial = *number,
                .value = *number};
  if (find(static_cast<int32_t>(object.device)) == nullptr) return "there is no such device yet";
  objects_.push_back(object);
  return {};
}

Handled Mailbox::config(std::string_view key, std::string_view value) {
  constexpr std::string_view kPrefix = "ethercat.";
  if (!key.starts_with(kPrefix)) return std::nullopt;
  const std::string_view place = key.substr(kPrefix.size());
  const auto device = integer(place);
  const std::string wrong = device ? addDevice(static_cast<uint32_t>(*device), value) : addObject(place, value);
  return wrong.empty() ? std::string() : std::string(key) + ": " + wrong;
}

Handled Mailbox::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (name != "ethercat") return std::nullopt;
  if (std::string wrong = unknownKey(name, keys, {"device", "error", "silent"}); !wrong.empty()) return wrong;
  Device* device = find(static_cast<int32_t>(integerKey(keys, "device", 0)));
  if (device == nullptr) return "event ethercat takes device=N of a configured device";
  if (findKey(keys, "error") != nullptr) device->error = static_cast<uint32_t>(integerKey(keys, "error", 0));
  if (findKey(keys, "silent") != nullptr) device->silent = integerKey(keys, "silent", 0) != 0;
  return "";
}

// ETHERCAT.DEVICE.INDEX.SUBINDEX, decimal.
std::optional<double> Mailbox::quantity(std::string_view name) const {
  const auto key = numbersAfter(name, "ETHERCAT.");
  if (!key || key->size() != 3) return std::nullopt;
  for (const Object& object : objects_)
    if (object.device == (*key)[0] && object.index == (*key)[1] && object.sub == (*key)[2])
      return static_cast<double>(object.value);
  return std::nullopt;
}

void Mailbox::powerOn(nc::PowerOn kind) {
  for (Device& device : devices_) {
    device.silent = false;
    device.error = 0;
    device.vendor.clear();
  }
  if (kind == nc::PowerOn::Warm) return;
  for (Object& object : objects_) object.value = object.initial;
}

} // namespace rung::sim::nct

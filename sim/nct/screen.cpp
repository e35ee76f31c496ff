// MW 70.
#include "sim/nct/screen.h"

#include <algorithm>
#include <cstring>

#include "rtlib/nc/nct/parameters.h"
#include "rtlib/nc/nct/windows.h"

namespace rung::sim::nct {

bool Screen::serves(bool write, uint32_t function) const { return write && function == 70; }

// Parameters beyond the amount are 0. There is no execution code for a wrong parameter value.
std::optional<int32_t> Screen::service(uint32_t, Block& block) {
  const int32_t amount = block.amount();
  if (amount < 2 || amount > 4) return 2;
  if (block.word(3) < 0 || block.word(3) > static_cast<int32_t>(nc::nct::kChannels)) return 6;
  if (nc::nct::findScreenWindow(block.word(2)) == nullptr) return 70;
  if (!connected_) return 71;
  window_ = {block.word(2), block.word(3), amount >= 3 ? block.word(4) : 0, amount >= 4 ? block.word(5) : 0};
  return 0;
}

Handled Screen::config(std::string_view key, std::string_view value) {
  if (key != "display") return std::nullopt;
  configured_ = value == "on";
  return "";
}

Handled Screen::event(std::string_view name, const std::vector<NcArgument>& keys) {
  if (std::string wrong = unknownKey(name, keys, {"on"}); !wrong.empty()) return wrong;
  if (findKey(keys, "on") == nullptr) return "event display takes on=0 or on=1";
  connected_ = integerKey(keys, "on", 1) != 0;
  return "";
}

std::optional<double> Screen::quantity(std::string_view name) const {
  if (name == "WINDOW") return window_[0];
  if (name == "WINDOW.CHANNEL") return window_[1];
  if (name == "WINDOW.P1") return window_[2];
  if (name == "WINDOW.P2") return window_[3];
  return std::nullopt;
}

void Screen::powerOn(nc::PowerOn) {
  connected_ = configured_;
  window_ = {};
}

// MR 201 and MW 202.

namespace {

constexpr uint32_t kRead = 201;
constexpr uint32_t kWrite = 202;
constexpr int64_t kTimeoutUs = 1'000'000;

// Abort codes of CANopen and error codes of Sercos in answers of devices.
constexpr uint32_t kCoeNoObject = 0x06020000;
constexpr uint32_t kCoeNoSubindex = 0x06090011;
constexpr uint32_t kCoeWrongAccess = 0x06010000;
constexpr uint32_t kCoeWrongLength = 0x06070010;
constexpr uint32_t kSoeNoElement = 0x1001;
constexpr uint32_t kSoeWrongElement = 0x1009; // invalid access to an element
constexpr uint32_t kSoeWrongLength = 0x7001;  // data too short or too long
constexpr uint32_t kSoeReadOnly = 0x7004;

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
  case Protocol::Coe: return device.protocols.coe;
  case Protocol::Soe: return device.protocols.soe;
  case Protocol::Voe: return device.protocols.voe;
  }
  return false;
}

Mailbox::Device* Mailbox::find(int32_t index) {
  const auto found =
      std::ranges::find_if(devices_, [&](const Device& d) { return static_cast<int64_t>(d.index) == index; });
  return found == devices_.end() ? nullptr : &*found;
}

EthercatObject* Mailbox::find(const Device& device, Protocol protocol, uint32_t index, uint32_t sub) {
  for (EthercatObject& object : objects_)
    if (object.slave == device.index && object.isIdn == (protocol == Protocol::Soe) && object.index == index &&
        object.sub == sub)
      return &object;
  return nullptr;
}

// A mailbox answers in a later cycle than the request.
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

// Data that were read are written to the program's memory; an object longer than the program expects is an error.
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

uint32_t Mailbox::exchange(bool write, Block& block, Device& device, Protocol protocol) {
  switch (protocol) {
  case Protocol::Coe: return exchangeCoe(write, block, device);
  case Protocol::Soe: return exchangeSoe(write, block, device);
  case Protocol::Voe: break;
  }
  // Vendor data: the device returns the last data written.
  if (write) {
    device.vendor.resize(size_); // has room for the contents of a mailbox
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
  EthercatObject* object = find(device, Protocol::Coe, index, sub);
  if (object == nullptr) {
    const bool known = std::ranges::any_of(
        objects_, [&](const EthercatObject& o) { return o.slave == device.index && !o.isIdn && o.index == index; });
    return known ? kCoeNoSubindex : kCoeNoObject;
  }
  if (!write) {
    MailboxData data{buffer_};
    data.append(object->value, object->bytes);
    size_ = data.size;
    return 0;
  }
  if (size_ != object->bytes) return kCoeWrongLength;
  object->value = littleEndian(std::span(buffer_).first(size_));
  return 0;
}

// CompleteAccess: all subindices from 0 or 1 on, concatenated; subindex 0 takes two bytes.
uint32_t Mailbox::exchangeWhole(bool write, Device& device, uint32_t index, uint32_t sub) {
  if (sub > 1) return kCoeWrongAccess;
  size_t at = 0;
  MailboxData data{buffer_};
  for (uint32_t i = sub; i <= 0xFF; ++i) {
    EthercatObject* object = find(device, Protocol::Coe, index, i);
    if (object == nullptr) continue;
    const uint32_t bytes = i == 0 ? 2 : object->bytes;
    if (!write) {
      data.append(object->value, bytes);
    } else if (at + bytes <= size_) {
      if (i != 0) object->value = littleEndian(std::span(buffer_).subspan(at, bytes)); // their number does not change
    }
    at += bytes;
  }
  if (at == 0) return kCoeNoObject;
  if (!write) size_ = data.size;
  return write && at != size_ ? kCoeWrongLength : 0;
}

uint32_t Mailbox::exchangeSoe(bool write, Block& block, Device& device) {
  const auto place = static_cast<uint32_t>(block.word(6));
  const uint32_t idn = place & 0xFFFF;
  EthercatObject* element = find(device, Protocol::Soe, idn, place >> 16 & 0xFF);
  if (element == nullptr) return kSoeNoElement;
  const auto flags = static_cast<uint32_t>(block.word(8)) & 0xFF; // bits of SoeElement (l.6040-6050)
  if (flags == 0) return kSoeWrongElement;
  if (write) {
    if (flags != uint32_t{1} << kValue) return kSoeReadOnly;
    if (size_ != element->bytes) return kSoeWrongLength;
    element->value = littleEndian(std::span(buffer_).first(size_));
    return 0;
  }
  MailboxData data{buffer_};
  appendSoeElements(*element, flags, data);
  size_ = data.size;
  return 0;
}

// ---- configuration, events, quantities ---------------------------------------------------------------------------

std::string Mailbox::addDevice(uint32_t index, std::string_view protocols) {
  if (index < 1 || find(static_cast<int32_t>(index)) != nullptr) return "devices are numbered from 1, each once";
  Device device;
  device.index = index;
  if (std::string wrong = parseProtocols(protocols, device.protocols); !wrong.empty()) return wrong;
  device.vendor.reserve(kMostBytes);
  devices_.push_back(std::move(device));
  return {};
}

// "1.coe.0x6041.0" and "0x237/2".
std::string Mailbox::addObject(std::string_view place, std::string_view value) {
  EthercatObject object;
  if (std::string wrong = parseObjectPlace(place, object); !wrong.empty()) return wrong;
  if (std::string wrong = parseObjectValue(value, object); !wrong.empty()) return wrong;
  if (find(static_cast<int32_t>(object.slave)) == nullptr) return "there is no such device yet";
  objects_.push_back(object);
  return {};
}

Handled Mailbox::config(std::string_view key, std::string_view value) {
  constexpr std::string_view kPrefix = "ethercat.";
  if (!key.starts_with(kPrefix)) return std::nullopt;
  const std::string_view place = key.substr(kPrefix.size());
  const auto device = unsignedIn(place);
  const std::string wrong = device ? addDevice(static_cast<uint32_t>(*device), value) : addObject(place, value);
  return wrong.empty() ? std::string() : std::string(key) + ": " + wrong;
}

Handled Mailbox::event(std::string_view name, const std::vector<NcArgument>& keys) {
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
  for (const EthercatObject& object : objects_)
    if (object.slave == (*key)[0] && object.index == (*key)[1] && object.sub == (*key)[2])
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
  for (EthercatObject& object : objects_) object.value = object.initial;
}

} // namespace rung::sim::nct

// Objects of simulated EtherCAT slaves (see ethercat_object.h).
#include "sim/ethercat_object.h"

#include <algorithm>
#include <vector>

#include "rtlib/text/number.h"

namespace rung::sim {

uint64_t littleEndian(std::span<const uint8_t> bytes) {
  uint64_t value = 0;
  for (size_t i = 0; i < std::min<size_t>(bytes.size(), 8); ++i) value |= uint64_t{bytes[i]} << 8 * i;
  return value;
}

std::optional<uint64_t> unsignedIn(std::string_view text) { return text::wholeIn<uint64_t>(text); }

std::string parseProtocols(std::string_view text, EthercatProtocols& protocols) {
  while (!text.empty()) {
    const std::string_view name = text.substr(0, text.find('+'));
    text.remove_prefix(std::min(text.size(), name.size() + 1));
    if (name != "coe" && name != "soe" && name != "voe") return "protocols are coe, soe, voe, joined by +";
    protocols.coe |= name == "coe";
    protocols.soe |= name == "soe";
    protocols.voe |= name == "voe";
  }
  return {};
}

std::string parseObjectPlace(std::string_view text, EthercatObject& object) {
  std::vector<std::string_view> parts;
  for (std::string_view rest = text;;) {
    parts.push_back(rest.substr(0, rest.find('.')));
    if (parts.back().size() == rest.size()) break;
    rest.remove_prefix(parts.back().size() + 1);
  }
  if (parts.size() != 4) return "expected ethercat.DEVICE.coe.INDEX.SUBINDEX or ethercat.DEVICE.soe.IDN.DRIVE";
  const auto slave = unsignedIn(parts[0]);
  const auto index = unsignedIn(parts[2]);
  const auto sub = unsignedIn(parts[3]);
  if (!slave || !index || !sub || *slave > 0xFFFF || *index > 0xFFFF || *sub > 0xFF)
    return "wrong number of a device or an object";
  if (parts[1] != "coe" && parts[1] != "soe") return "objects belong to coe or soe";
  object.slave = static_cast<uint32_t>(*slave);
  object.isIdn = parts[1] == "soe";
  object.index = static_cast<uint32_t>(*index);
  object.sub = static_cast<uint32_t>(*sub);
  return {};
}

std::string parseObjectValue(std::string_view text, EthercatObject& object) {
  const size_t slash = text.find('/');
  const std::string_view number = text.substr(0, slash);
  const bool negative = number.starts_with('-');
  const auto size = unsignedIn(number.substr(negative ? 1 : 0));
  const auto bytes = slash == std::string_view::npos ? std::optional<uint64_t>(4) : unsignedIn(text.substr(slash + 1));
  if (!size || !bytes || *bytes < 1 || *bytes > 8) return "expected VALUE or VALUE/BYTES, 1 to 8 bytes";
  const auto width = static_cast<uint32_t>(*bytes);
  const uint64_t most = negative ? onesOf(width) / 2 + 1 : onesOf(width);
  if (*size > most) return "'" + std::string(number) + "' needs more than " + std::to_string(8 * width) + " bits";
  object.bytes = width;
  object.initial = object.value = (negative ? uint64_t{0} - *size : *size) & onesOf(width);
  return {};
}

void MailboxData::append(uint64_t value, uint32_t bytes) {
  for (uint32_t i = 0; i < bytes && size < room.size(); ++i) room[size++] = static_cast<uint8_t>(value >> 8 * i);
}

namespace {

void appendName(uint32_t idn, MailboxData& to) {
  constexpr uint32_t kBytes = 8;
  to.append(kBytes | uint64_t{kBytes} << 16, 4); // present length, maximum length
  for (const char letter : {'I', 'D', 'N'}) to.append(static_cast<uint8_t>(letter), 1);
  for (uint32_t unit = 10000; unit != 0; unit /= 10) to.append('0' + idn / unit % 10, 1);
}

void appendElement(const EthercatObject& idn, SoeElement element, MailboxData& to) {
  switch (element) {
  case kState: return to.append(0, 2);
  case kName: return appendName(idn.index, to);
  case kAttribute: return to.append(idn.bytes, 4);
  case kUnit: return to.append(0, 4);
  case kMinimum: return to.append(idn.least, idn.bytes);
  case kMaximum: return to.append(idn.most, idn.bytes);
  case kValue: return to.append(idn.value, idn.bytes);
  case kDefault: return to.append(idn.initial, idn.bytes);
  }
}

} // namespace

void appendSoeElements(const EthercatObject& idn, uint32_t flags, MailboxData& to) {
  for (uint32_t bit = 0; bit < 8; ++bit)
    if ((flags >> bit & 1) != 0) appendElement(idn, static_cast<SoeElement>(bit), to);
}

} // namespace rung::sim

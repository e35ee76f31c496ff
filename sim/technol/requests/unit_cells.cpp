// Shared structures of CAN units (see unit_cells.h).
#include "sim/technol/requests/unit_cells.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/technol/code_page.h"

namespace rung::sim::technol {

using namespace io;

namespace {

constexpr std::string_view kGroups[kUnitGroups] = {"INPUTOUTPUT_CAN2_", "PANEL_CAN2_", "KNOB_CAN2_"}; // canonical

// The decimal digits at the beginning of the text, which loses them.
std::optional<uint32_t> takeDecimal(std::string_view& text) {
  const size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  const auto number = nc::technol::decimal(text.substr(0, end));
  text.remove_prefix(end);
  return number;
}

} // namespace

// Canonical, after INOUT_. Where there is `wire`, the byte of the unit's physical side.
struct UnitCell::Element {
  enum class Wire : uint8_t { None, Input, Key, Analogue, Encoder, Output };

  std::string_view name;
  InoutsItem item; // of the first one
  uint32_t count = 1;
  bool hasBits = false; // also as NAME0[bit], NAME1[bit]
  Wire wire = Wire::None;
  bool isText = false;
};

namespace {

using Wire = UnitCell::Element::Wire;

constexpr UnitCell::Element kElements[] = {
    {"PRESENT", inouts::kPresent},
    {"MODE", inouts::kMode},
    {"VENDORID", inouts::kVendor},
    {.name = "DEVICENAME", .item = inouts::kDeviceName, .isText = true},
    {.name = "HWVERSION", .item = inouts::kHardwareVersion, .isText = true},
    {.name = "SWVERSION", .item = inouts::kSoftwareVersion, .isText = true},
    {"IN", {inouts::kIn}, kUnitInputs, true, Wire::Input},
    {"OUT", {inouts::kOut}, kUnitOutputs, true, Wire::Output},
    {"ANL", {inouts::kAnalogue}, 8, false, Wire::Analogue},
    {"ERROR", inouts::kError},
    {"ERR_CODE", inouts::kErrorCode},
    {"ERR_STAT", inouts::kErrorStatus},
    {"CONTROL", inouts::kControl},
    {"COUNT", inouts::kCount},
    {"SEND_REQ", inouts::kSendRequest},
    {"RESP_COUNT", inouts::kAnswerCount},
    {"TL", {inouts::kKeys}, 4, true, Wire::Key},
    {"RPDO_COUNT", inouts::kRpdoCount},
    {"TPDO_COUNT", inouts::kTpdoCount},
    {"SHORT_OUT", {inouts::kShort}, kUnitOutputs, true},
    {"IRC", {inouts::kEncoder, 2}, 2, false, Wire::Encoder},
};

const UnitCell::Element* elementOf(std::string_view name) {
  const auto* const found = std::ranges::find(kElements, name, &UnitCell::Element::name);
  return found == std::end(kElements) ? nullptr : found;
}

} // namespace

std::optional<UnitCell> UnitCell::named(std::string_view name) {
  const std::string canonical = nc::technol::canonical(name);
  for (uint32_t group = 1; group <= kUnitGroups; ++group) {
    std::string_view rest = canonical;
    if (!nc::technol::takePrefix(rest, kGroups[group - 1])) continue;
    const auto number = takeDecimal(rest);
    const bool isUnit = number && *number < kMostUnits[group - 1] && nc::technol::takePrefix(rest, ".INOUT_");
    if (!isUnit) return std::nullopt;
    UnitCell cell(group, *number + 1);
    cell.takeElement(rest);
    return cell;
  }
  return std::nullopt;
}

// "IN[2]"; "IN2[7]" is a bit of it.
void UnitCell::takeElement(std::string_view text) {
  std::string_view name = text.substr(0, text.find('['));
  text.remove_prefix(name.size());
  index_ = nc::technol::takeIndex(text).value_or(0);
  if (!text.empty()) return;
  element_ = elementOf(name);
  if (element_ != nullptr || name.empty() || name.back() < '0' || name.back() > '9') return;
  bit_ = index_;
  index_ = static_cast<uint32_t>(name.back() - '0');
  name.remove_suffix(1);
  const Element* const ports = elementOf(name);
  if (ports != nullptr && ports->hasBits) element_ = ports;
}

std::string UnitCell::problem(const CanDevices& can) const {
  if (can.unit(group_, board_) == nullptr)
    return "there is no such unit; `config CAN[1]." + std::string(kUnitGroupNames[group_ - 1].count) + " " +
           std::to_string(board_) + "` adds it";
  if (element_ == nullptr) {
    std::string names;
    for (const Element& known : kElements) names.append(names.empty() ? "INOUT_" : ", INOUT_").append(known.name);
    return "a unit has " + names;
  }
  const std::string name = "INOUT_" + std::string(element_->name);
  if (index_ >= element_->count)
    return name + (element_->count == 1 ? " has no elements"
                                        : " has the elements 0 to " + std::to_string(element_->count - 1));
  if (bit_ && *bit_ > 7) return name + std::to_string(index_) + " has the bits 0 to 7";
  return {};
}

NcCell UnitCell::read(const CanDevices& can) const {
  const Inouts& data = *can.inouts(group_, board_);
  if (element_->isText) {
    const auto* first = reinterpret_cast<const char*>(&data.at(element_->item.offset));
    return {.isText = true, .text = nc::shownText(std::string_view(first, strnlen(first, element_->item.bytes)))};
  }
  const uint32_t bytes = element_->item.bytes;
  const uint64_t value = element_->wire == Wire::Output ? can.unit(group_, board_)->output(index_)
                                                        : data.get({element_->item.offset + index_ * bytes, bytes});
  if (bit_) return {.width = 1, .bits = value >> *bit_ & 1};
  return {.width = 8 * bytes, .bits = value};
}

// Terminals of INOUT08 are the ports of the program (CanInputs).
uint8_t* UnitCell::wiredByte(CanDevices& can, CanInputs& inputs) const {
  UnitWires& wires = *can.wires(group_, board_);
  switch (element_->wire) {
  case Wire::Input:
    return group_ == kInOut08 ? &inputs.terminals[kUnitInputs * (board_ - 1) + index_] : &wires.in[index_];
  case Wire::Key: return &wires.keys[index_];
  case Wire::Analogue: return &wires.analogue[index_];
  case Wire::Encoder:
  case Wire::Output:
  case Wire::None: break;
  }
  return nullptr;
}

std::string UnitCell::write(CanDevices& can, CanInputs& inputs, const NcCell& value) const {
  const uint64_t most = bit_ ? 1 : element_->wire == Wire::Encoder ? 0xFFFF : 0xFF;
  const bool isWired = element_->wire != Wire::None && element_->wire != Wire::Output;
  if (!isWired) return "it is what the unit does or says; set are INOUT_IN, INOUT_TL, INOUT_ANL and INOUT_IRC";
  if (element_->wire == Wire::Key && group_ == kHandwheel)
    return "a handwheel has its keys in INOUT_IN[0] and INOUT_IN[1], from which PTLTOC_P1 comes";
  if (element_->wire == Wire::Encoder && group_ != kHandwheel) return "only handwheels have encoders";
  if (value.isText || value.isReal || value.bits > most) return "expected 0 to " + std::to_string(most);
  if (element_->wire == Wire::Encoder) {
    can.wires(group_, board_)->encoders[index_] = static_cast<uint16_t>(value.bits);
    return {};
  }
  uint8_t& byte = *wiredByte(can, inputs);
  const auto set = static_cast<uint8_t>(value.bits << bit_.value_or(0));
  byte = bit_ ? static_cast<uint8_t>((byte & ~(1u << *bit_)) | set) : set;
  return {};
}

} // namespace rung::sim::technol

// Cells of modules (see module_cells.h).
#include "sim/technol/module_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/nc/technol/signals.h"
#include "sim/technol/devices/axis.h"
#include "sim/technol/devices/ethercat_servo.h"

namespace rung::sim::technol {
namespace {

constexpr uint32_t kKeys = 256; // of the virtual keyboard (man. l.12492)

// The manual's INT32 are all signals of the servo loops, and the two angles (man. l.12871-12925, l.13214-13218).
bool isSigned(const nc::Signal& signal) {
  return std::string_view(signal.area).starts_with("RTM.Servo") || std::string_view(signal.symbol).ends_with("_ANGLE");
}

nc::ExchangeType typeOf(const nc::Signal& signal) {
  switch (signal.type) {
  case nc::SignalType::Byte: return nc::ExchangeType::Uns8;
  case nc::SignalType::Word: return nc::ExchangeType::Uns16;
  case nc::SignalType::Dword: return isSigned(signal) ? nc::ExchangeType::Int32 : nc::ExchangeType::Uns32;
  case nc::SignalType::Qword: return nc::ExchangeType::Int64;
  case nc::SignalType::Real: return nc::ExchangeType::Real;
  case nc::SignalType::Bit:
  case nc::SignalType::Struct:
  case nc::SignalType::String: return nc::ExchangeType::Bit;
  }
  return nc::ExchangeType::Bit;
}

struct RtmModule {
  std::string_view name; // canonical, after "RTM."
  const char* area;
  uint32_t members; // 1: without an index
};
constexpr RtmModule kModules[] = {{"AXIS", "RTM.Axis", 16},
                                  {"SERVO", "RTM.Servo", 16},
                                  {"SPINDLE", "RTM.Spindle", 1},
                                  {"MAN", "RTM.Man", 1},
                                  {"CONTROL", "RTM.Control", 1}};

struct Part {
  std::string_view symbol;
  uint32_t part;
};
constexpr Part kDriveParts[] = {{"DriveStatus", kServoStatus},
                                {"DriveErrReg", kServoError},
                                {"DrivePos", kServoPosition},
                                {"DriveControl", kServoControl},
                                {"DrivePosReq", kServoRequestedPosition},
                                {"DriveVeloReq", kServoRequestedVelocity},
                                {"State", kServoState},
                                {"MoveDisReq", kServoBlocksMotion},
                                {"Error", kServoFaulty}};
constexpr Part kServoParts[] = {
    {"ICounter", kFollowingErrorMm},     {"ICounter_S", kFollowingErrorUm},          {"ServoPosition", kMeasuredMm},
    {"ServoPosition_S", kMeasuredUm},    {"ServoPosition_Inc", kMeasuredIncrements}, {"ServoReqPosition", kRequestedMm},
    {"ServoReqPosition_S", kRequestedUm}};
constexpr Part kIncrements[] = {
    {"IncPt_Ax", kPerTick},         {"Inc_Ax", kPerMinute},        {"IncManPos1_Ax", kByHand},
    {"IncManPos2_Ax", kByHand},     {"IncManPos3_Ax", kByHand},    {"IncManPos4_Ax", kByHand},
    {"IncManPos5_Ax", kByHand},     {"Pos5Inc", kPath5PerTick},    {"Pos6Inc", kPath6PerTick},
    {"Pos5IncPm", kPath5PerMinute}, {"Pos6IncPm", kPath6PerMinute}};

ModulePoint pointIn(std::span<const Part> parts, std::string_view symbol, ModulePoint::Kind kind, uint32_t number) {
  const auto found = std::ranges::find(parts, symbol, &Part::symbol);
  return found == parts.end() ? ModulePoint{} : ModulePoint{kind, number, found->part};
}

ModulePoint sharedPoint(std::string_view area, std::string_view symbol, uint32_t number) {
  for (uint32_t i = 0; i < std::size(kSharedElements); ++i)
    if (kSharedElements[i].area == area && kSharedElements[i].element == symbol)
      return {ModulePoint::Kind::Shared, number, i};
  return {};
}

// The elements of the real-time manager that simulated devices have (man. l.12760-12868, l.12871-12920).
ModulePoint pointOf(std::string_view area, std::string_view symbol, uint32_t number) {
  using Kind = ModulePoint::Kind;
  if (const ModulePoint shared = sharedPoint(area, symbol, number); shared.kind != Kind::None) return shared;
  if (area == "RTM.Servo.Edrv") return pointIn(kDriveParts, symbol, Kind::Servo, number);
  if (area == "RTM.Servo") return pointIn(kServoParts, symbol, Kind::Servo, number);
  if (area != "RTM.Axis") return {};
  if (symbol == "Pos6Shift_Ax") return {Kind::Shift, number};
  if (const ModulePoint of = pointIn(kIncrements, symbol, Kind::Increment, number); of.kind != Kind::None) return of;
  const bool isPosition = symbol.size() == 7 && symbol.starts_with("Pos") && symbol.ends_with("_Ax");
  if (!isPosition) return {};
  return {Kind::Position, number, static_cast<uint32_t>(symbol[3] - '0')};
}

// MODULE[x].NAME or MODULE.NAME[x]: x is the axis or servo in both (man. l.12753 reads RTM.Axis[2].Pos0_AX).
std::optional<ModuleElement> rtmElement(std::string_view rest, std::string& problem) {
  for (const RtmModule& module : kModules) {
    std::string_view name = rest;
    if (!nc::technol::takePrefix(name, module.name)) continue;
    const uint32_t member = nc::technol::takeIndex(name).value_or(0);
    if (!nc::technol::takePrefix(name, ".") || member >= module.members) break;
    std::string area = module.area;
    for (const char* part : {"Edrv", "Enc"})
      if (std::string_view("RTM.Servo") == module.area &&
          nc::technol::takePrefix(name, nc::technol::canonical(part) + "."))
        area += std::string(".") + part;
    const nc::technol::Reference last = nc::technol::withoutIndex({.base = name, .element = 0, .bit = {}});
    const nc::Signal* signal = findSignal(nc::technolSignals(), last.base, area);
    if (signal == nullptr) break;
    const uint32_t element = last.element != 0 ? last.element : signal->count > 1 ? member : 0;
    if (element >= signal->count || (last.element != 0 && member != 0 && last.element != member)) {
      problem = std::string(signal->symbol) + " has the elements 0 to " + std::to_string(signal->count - 1);
      return std::nullopt;
    }
    // Elements common to all axes are one element, whichever axis is named.
    const bool isCommon = module.area == std::string_view("RTM.Axis");
    const bool ofMember = signal->count == 1 && module.members > 1 && !isCommon;
    const uint32_t number = ofMember ? member : element;
    ModuleElement made{.key = area + "." + signal->symbol + "/" + std::to_string(number),
                       .type = typeOf(*signal),
                       .point = pointOf(area, signal->symbol, number)};
    made.isSource = signal->direction != nc::Direction::Out;
    made.isDestination = signal->direction != nc::Direction::In;
    return made;
  }
  problem = "the real-time manager has no such element";
  return std::nullopt;
}

} // namespace

std::optional<ModuleElement> moduleElement(std::string_view identifier, std::string& problem) {
  std::string_view rest = identifier;
  if (nc::technol::takePrefix(rest, "RTM.")) return rtmElement(rest, problem);
  if (nc::technol::takePrefix(rest, "ECAT."))
    return ModuleElement{.key = std::string(identifier), .typeIsOpen = true, .period = nc::ExchangePeriod::Fastest};
  if (!nc::technol::takePrefix(rest, "VKEYBOARD.VKEY")) return std::nullopt;
  const uint32_t key = rest.empty() ? 0 : nc::technol::takeIndex(rest).value_or(kKeys);
  if (!rest.empty() || key >= kKeys) {
    problem = "the virtual keyboard has the keys VKey[0] to VKey[255]";
    return std::nullopt;
  }
  return ModuleElement{.key = "VKEYBOARD." + std::to_string(key),
                       .period = nc::ExchangePeriod::Slow,
                       .isSource = false,
                       .point = {ModulePoint::Kind::Key, key}};
}

std::optional<ModuleElement> ModuleCells::element(std::string_view identifier, std::string& problem) const {
  if (image_ == nullptr || !image_->isOfSlave(identifier)) return moduleElement(identifier, problem);
  const uint32_t entry = image_->find(identifier);
  if (entry == RUNG_NONE) {
    problem = "the device has no such process data: `config ethercat.D.pdo.Inputs.NAME INDEX.SUB`, or pdo.Outputs";
    return std::nullopt;
  }
  constexpr nc::ExchangeType kTypes[] = {nc::ExchangeType::Uns8, nc::ExchangeType::Uns16, nc::ExchangeType::Uns32,
                                         nc::ExchangeType::Uns64};
  const bool isInput = (*image_)[entry].isInput;
  return ModuleElement{.key = "ECAT/" + std::to_string(entry),
                       .type = kTypes[std::bit_width(image_->bytesOf(entry) - 1)],
                       .signIsOpen = true,
                       .period = nc::ExchangePeriod::Fastest,
                       .isSource = isInput,
                       .isDestination = !isInput,
                       .point = {ModulePoint::Kind::ProcessData, entry}};
}

void ModuleCells::reset() {
  for (ModuleCell& cell : cells_) cell.bits = cell.given = 0;
}

bool ModuleCells::isPossible(const PointCell& point) const {
  const uint32_t number = point.point.number, part = point.point.part;
  if (point.cell >= cells_.size()) return false;
  switch (point.point.kind) {
  case ModulePoint::Kind::None: return true;
  case ModulePoint::Kind::Key: return number < kKeys;
  case ModulePoint::Kind::ProcessData: return image_ != nullptr && number < image_->count();
  case ModulePoint::Kind::Position:
  case ModulePoint::Kind::Shift:
  case ModulePoint::Kind::Increment: return number < kMaxAxes && part <= kPath6PerMinute;
  case ModulePoint::Kind::Servo: return number < EthercatServos::kCount;
  case ModulePoint::Kind::Shared: return number < kMaxAxes && part < std::size(kSharedElements);
  }
  return false;
}

bool ModuleCells::settle() {
  byKey_.clear();
  for (uint32_t i = 0; i < keys_.size(); ++i) byKey_.emplace(keys_[i], i);
  const bool isGood = keys_.size() == cells_.size() && byKey_.size() == cells_.size() &&
                      std::ranges::all_of(points_, [this](const PointCell& point) { return isPossible(point); });
  if (isGood) return true;
  keys_.clear();
  cells_.clear();
  points_.clear();
  byKey_.clear();
  return false;
}

void ModuleCells::addShared() {
  std::string problem;
  for (const SharedElement& shared : kSharedElements) {
    const bool isServo = shared.area != "RTM.Axis";
    const std::string element(shared.element);
    const uint32_t count = findSignal(nc::technolSignals(), element, shared.area)->count;
    for (uint32_t i = 0; i < count; ++i) {
      const std::string index = "[" + std::to_string(i) + "]";
      const std::string name = isServo ? "RTM.Servo" + index + ".Edrv." + element : "RTM.Axis." + element + index;
      cellOf(*moduleElement(nc::technol::canonical(name), problem));
    }
  }
}

uint32_t ModuleCells::cellOf(const ModuleElement& element) {
  const auto [entry, isNew] = byKey_.emplace(element.key, static_cast<uint32_t>(cells_.size()));
  if (!isNew) return entry->second;
  keys_.push_back(element.key);
  cells_.push_back(
      {.type = element.typeIsOpen ? nc::ExchangeType::Uns64 : element.type, .typeIsOpen = element.typeIsOpen});
  if (element.point.kind != ModulePoint::Kind::None) points_.push_back({element.point, entry->second});
  return entry->second;
}

namespace {

uint64_t cut(uint64_t bits, uint32_t width) { return width >= 64 ? bits : bits & ((uint64_t{1} << width) - 1); }

uint64_t bitsOf(nc::ExchangeType type, const NcCell& value) {
  if (type == nc::ExchangeType::Real) {
    const double real =
        value.isReal ? std::bit_cast<double>(value.bits) : static_cast<double>(static_cast<int64_t>(value.bits));
    return std::bit_cast<uint64_t>(real);
  }
  const uint64_t integer =
      !value.isReal ? value.bits : static_cast<uint64_t>(std::llrint(std::bit_cast<double>(value.bits)));
  return cut(integer, widthOf(type));
}

} // namespace

std::optional<NcCell> ModuleCells::read(std::string_view name) const {
  const std::string inMemory = nc::technol::canonical(nc::memoryText(name));
  const nc::technol::Reference reference = nc::technol::withoutBit(inMemory);
  std::string problem;
  const auto element = this->element(reference.base, problem);
  if (!element) return std::nullopt;
  const auto found = byKey_.find(element->key);
  // The connection determines the type of an EtherCAT element.
  if (found == byKey_.end() && element->typeIsOpen) return std::nullopt;
  const ModuleCell cell = found == byKey_.end() ? ModuleCell{.type = element->type} : cells_[found->second];
  NcCell value{.isReal = cell.type == nc::ExchangeType::Real, .width = widthOf(cell.type), .bits = cell.bits};
  if (!reference.bit) return value;
  if (value.isReal || *reference.bit >= value.width) return std::nullopt;
  return NcCell{.isReal = false, .width = 1, .bits = value.bits >> *reference.bit & 1};
}

bool ModuleCells::write(std::string_view name, const NcCell& value) {
  if (value.isText) return false;
  const std::string inMemory = nc::technol::canonical(nc::memoryText(name));
  const nc::technol::Reference reference = nc::technol::withoutBit(inMemory);
  std::string problem;
  const auto element = this->element(reference.base, problem);
  if (!element || (element->typeIsOpen && !byKey_.contains(element->key))) return false;
  ModuleCell& cell = cells_[cellOf(*element)];
  if (!reference.bit) {
    cell.bits = bitsOf(cell.type, value);
    return true;
  }
  if (cell.type == nc::ExchangeType::Real || *reference.bit >= widthOf(cell.type)) return false;
  const uint64_t mask = uint64_t{1} << *reference.bit;
  cell.bits = bitsOf(nc::ExchangeType::Bit, value) != 0 ? cell.bits | mask : cell.bits & ~mask;
  return true;
}

} // namespace rung::sim::technol

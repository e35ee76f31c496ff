// Names of data in devices, outside the program's memory (see simulated_devices.h; inventory of the services, 15.5,
// 15.6).
#include "sim/technol/requests/device_cells.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/text/hex.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "sim/technol/requests/simulated_devices.h"

namespace rung::sim::technol {

namespace {

constexpr std::string_view kLineCount = "LinesCount", kSelectedLine = "SelLine"; // of a table

// SA0+n:w, w 1, 2, 4 or 8.
struct AreaCell {
  uint32_t area = 0, offset = 0, width = 0;
};
bool isAreaName(std::string_view name) {
  return text::takePrefixIgnoringCase(name, "SA") && name.size() > 1 && name[0] >= '0' && name[0] <= '9' &&
         name[1] == '+';
}
std::optional<AreaCell> areaCell(std::string_view name) {
  if (!isAreaName(name)) return std::nullopt;
  name.remove_prefix(2);
  const size_t colon = name.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto area = text::numberIn<uint32_t>(name.substr(0, 1)),
             offset = text::numberIn<uint32_t>(name.substr(2, colon - 2)),
             width = text::numberIn<uint32_t>(name.substr(colon + 1));
  const bool fits = area && offset && width && (*width == 1 || *width == 2 || *width == 4 || *width == 8) &&
                    *offset + *width <= io::SharedAreas::kAreaBytes && *area < io::SharedAreas::kAreas;
  return fits ? std::optional(AreaCell{*area, *offset, *width}) : std::nullopt;
}

// PlcTable0[2].Feed, PlcTable0.LinesCount, PlcTable0.SelLine.
struct TableCell {
  uint32_t table = 0;
  std::optional<uint32_t> line;
  std::string_view column;
};
std::optional<TableCell> tableCell(std::string_view name) {
  if (!text::takePrefixIgnoringCase(name, "PlcTable")) return std::nullopt;
  const size_t end = name.find_first_of("[.");
  const auto table = text::numberIn<uint32_t>(name.substr(0, end));
  if (!table || end == std::string_view::npos) return std::nullopt;
  TableCell cell{.table = *table, .line = {}, .column = {}};
  name.remove_prefix(end);
  if (name.front() == '[') {
    const size_t close = name.find(']');
    cell.line = close == std::string_view::npos ? std::nullopt : text::numberIn<uint32_t>(name.substr(1, close - 1));
    if (!cell.line) return std::nullopt;
    name.remove_prefix(close + 1);
  }
  if (name.empty() || name.front() != '.') return std::nullopt;
  cell.column = name.substr(1);
  return cell;
}

// KnobSelAx0, Pos6ShiftAx0 …: data of the axes on panels (l.10926-10937).
std::optional<NcCell> panelCell(const AxisOutputs& out, std::string_view name) {
  const bool shift = text::takePrefixIgnoringCase(name, "Pos6ShiftAx");
  if (!shift && !text::takePrefixIgnoringCase(name, "KnobSelAx")) return std::nullopt;
  const auto axis = text::numberIn<uint32_t>(name);
  if (!axis || *axis >= kMaxAxes) return std::nullopt;
  if (shift) return NcCell{.isReal = true, .bits = std::bit_cast<uint64_t>(out.shiftMm[*axis])};
  return NcCell{.width = 8, .bits = out.knobSelected[*axis]};
}

// Data of SHIFT and the handwheel on panels: cells of the program (l.10940-10944) as of the last scan.
std::optional<NcCell> shownCell(const AxisInputs& in, const AxisRequests& requests, std::string_view name) {
  if (text::equalsIgnoringCase(name, "ReqShift")) return NcCell{.width = 1, .bits = requests.shiftSelected ? 1u : 0u};
  if (text::equalsIgnoringCase(name, "ActShift")) return NcCell{.width = 1, .bits = requests.shiftActive ? 1u : 0u};
  if (text::equalsIgnoringCase(name, "KnobStep")) return NcCell{.width = 16, .bits = requests.knobStep};
  if (text::equalsIgnoringCase(name, "ShiftEnable")) return NcCell{.width = 8, .bits = in.shiftEnable};
  return std::nullopt;
}

// DISPTOC1.Shown[0][16]: row and column in pixels.
struct ShownAt {
  uint32_t wheel = 0; // from 1
  uint32_t row = 0, column = 0;
};
std::optional<ShownAt> shownAt(std::string_view name) {
  if (!text::takePrefixIgnoringCase(name, "DISPTOC") || name.empty()) return std::nullopt;
  const auto wheel = text::numberIn<uint32_t>(name.substr(0, 1));
  name.remove_prefix(1);
  if (!wheel || *wheel < 1 || *wheel > io::kHandwheels || !text::takePrefixIgnoringCase(name, ".Shown"))
    return std::nullopt;
  const auto row = nc::technol::takeIndex(name), column = nc::technol::takeIndex(name);
  if (!row || !column || !name.empty()) return std::nullopt;
  return ShownAt{*wheel, *row, *column};
}

} // namespace

std::optional<NcCell> SimulatedDevices::readCell(std::string_view name) const {
  if (const auto at = areaCell(name)) {
    const auto bytes = const_cast<io::SharedAreas&>(areas_).bytes(at->area).subspan(at->offset, at->width);
    NcCell cell{.width = at->width * 8, .untyped = true};
    for (uint32_t i = 0; i < at->width; ++i) cell.bits |= uint64_t{bytes[i]} << 8 * i;
    return cell;
  }
  if (const auto cell = simulated_ ? panelCell(axisOutputs_, name) : std::nullopt) return cell;
  if (const auto cell = simulated_ ? shownCell(axisInputs_, axisRequests_, name) : std::nullopt) return cell;
  if (const auto at = shownAt(name)) {
    const HandwheelDisplay* display = displayOf(at->wheel);
    if (display == nullptr || !HandwheelDisplay::isPixel(at->row, at->column)) return std::nullopt;
    return NcCell{.isText = true, .text = nc::shownText(display->text(at->row, at->column))};
  }
  if (const auto unit = UnitCell::named(name))
    return simulated_ && unit->problem(can_).empty() ? std::optional(unit->read(can_)) : std::nullopt;
  if (const auto value = readModule(name)) return value;
  return readTable(name);
}

// Reads elements of modules that devices provide. Cells have the others, and connected ones (module_cells.h).
std::optional<NcCell> SimulatedDevices::readModule(std::string_view name) const {
  const std::string identifier = nc::technol::canonical(nc::memoryText(name));
  const nc::technol::Reference reference = nc::technol::withoutBit(identifier);
  auto whole = readElement(reference.base);
  if (!whole || !reference.bit) return whole;
  const bool hasBit = !whole->isReal && *reference.bit < whole->width;
  return hasBit ? std::optional(NcCell{.width = 1, .bits = whole->bits >> *reference.bit & 1}) : std::nullopt;
}

// Reads an input of the simulated net, or an element of axes and servos.
std::optional<NcCell> SimulatedDevices::readElement(std::string_view identifier) const {
  if (const uint32_t entry = inputOfNet(identifier); entry != RUNG_NONE)
    return NcCell{.width = 8 * ethercat_.image().bytesOf(entry), .bits = ethercat_.image().read(entry)};
  const auto element = givenElement(identifier);
  if (!element) return std::nullopt;
  const auto bits = givenAt(element->point, axisOutputs_, axes_.count(), servoCells_);
  if (!bits) return std::nullopt;
  return NcCell{.isReal = element->type == nc::ExchangeType::Real, .width = widthOf(element->type), .bits = *bits};
}

uint32_t SimulatedDevices::inputOfNet(std::string_view identifier) const {
  const EthercatImage& image = ethercat_.image();
  const uint32_t entry = simulated_ ? image.find(identifier) : RUNG_NONE;
  return entry != RUNG_NONE && image[entry].isInput ? entry : RUNG_NONE;
}

std::optional<ModuleElement> SimulatedDevices::givenElement(std::string_view identifier) const {
  std::string problem;
  const auto element = simulated_ ? moduleElement(identifier, problem) : std::nullopt;
  const bool isGiven = element && givenAt(element->point, axisOutputs_, axes_.count(), servoCells_);
  return isGiven ? element : std::nullopt;
}

std::string SimulatedDevices::givenProblem(std::string_view identifier) const {
  if (inputOfNet(identifier) != RUNG_NONE)
    return "it is what the device gives: `set NC.ETHERCAT.DEVICE.INDEX.SUB` sets the object";
  const auto element = givenElement(identifier);
  if (!element) return {};
  if (element->point.kind == ModulePoint::Kind::Servo) return "it is what the servo gives";
  return "it is where the axis is: `set NC.TRUE." + std::to_string(element->point.number + 1) + "` moves it";
}

const HandwheelDisplay* SimulatedDevices::displayOf(uint32_t wheel) const {
  const SimulatedUnit* unit = simulated_ ? can_.unit(io::kHandwheel, wheel) : nullptr;
  return unit == nullptr ? nullptr : unit->display();
}

std::optional<NcCell> SimulatedDevices::readTable(std::string_view name) const {
  const auto at = tableCell(name);
  if (!at || !tables_.exists(at->table)) return std::nullopt;
  uint32_t number = 0;
  if (!at->line) {
    const bool lines = text::equalsIgnoringCase(at->column, kLineCount);
    if (!lines && !text::equalsIgnoringCase(at->column, kSelectedLine)) return std::nullopt;
    lines ? tables_.lineCount(at->table, number) : tables_.selectedLine(at->table, number);
    return NcCell{.width = 32, .bits = number};
  }
  if (tables_.columnIndex(at->table, nc::memoryText(at->column), number) != io::TableError::None) return std::nullopt;
  int32_t integer = 0;
  if (tables_.getInt(at->table, *at->line, number, integer) == io::TableError::None)
    return NcCell{.width = 32, .bits = static_cast<uint32_t>(integer)};
  double real = 0;
  if (tables_.getReal(at->table, *at->line, number, real) == io::TableError::None)
    return NcCell{.isReal = true, .bits = std::bit_cast<uint64_t>(real)};
  std::string_view text;
  if (tables_.getText(at->table, *at->line, number, text) == io::TableError::None)
    return NcCell{.isText = true, .text = nc::shownText(text)};
  std::span<const uint8_t> bytes;
  if (tables_.getBinary(at->table, *at->line, number, bytes) == io::TableError::None)
    return NcCell{.isText = true, .text = text::hexOf(bytes)};
  return std::nullopt;
}

std::optional<std::string> SimulatedDevices::writeCell(std::string_view name, const NcCell& value) {
  if (const auto at = areaCell(name)) {
    if (value.isText) return "a shared area holds numbers, not a text";
    const auto bytes = areas_.bytes(at->area).subspan(at->offset, at->width);
    for (uint32_t i = 0; i < at->width; ++i) bytes[i] = static_cast<uint8_t>(value.bits >> 8 * i);
    return std::string();
  }
  const std::string identifier = nc::technol::canonical(nc::memoryText(name));
  if (std::string problem = givenProblem(nc::technol::withoutBit(identifier).base); !problem.empty()) return problem;
  if (shownAt(name)) return "what the display shows is written by the program, to DISPTOC1 and DISPTOC2";
  if (const auto unit = UnitCell::named(name)) {
    if (!simulated_ || !unit->problem(can_).empty()) return std::nullopt;
    return unit->write(can_, canInputs_, value);
  }
  return writeTable(name, value);
}

std::optional<std::string> SimulatedDevices::writeTable(std::string_view name, const NcCell& value) {
  const auto at = tableCell(name);
  if (!at || !tables_.exists(at->table)) return std::nullopt;
  if (at->line && value.isText) return tables_.edit(at->table, *at->line, at->column, value.text);
  const double number =
      value.isReal ? std::bit_cast<double>(value.bits) : static_cast<double>(static_cast<int64_t>(value.bits));
  if (at->line) return tables_.edit(at->table, *at->line, at->column, number);
  if (!text::equalsIgnoringCase(at->column, kSelectedLine)) return std::nullopt;
  const bool isLine = !value.isText && number >= 0 && number < io::PlcTables::kMostLines;
  return isLine ? tables_.selectByOperator(at->table, static_cast<uint32_t>(number)) : "a line is a number from 0";
}

std::string SimulatedDevices::displayProblem(uint32_t wheel) const {
  if (displayOf(wheel) == nullptr)
    return "there is no such handwheel; `config CAN[1].KnobCnt " + std::to_string(wheel) + "` adds it";
  return "a display has the rows 0 to " + std::to_string(HandwheelDisplay::kRows - 1) + " and the columns 0 to " +
         std::to_string(HandwheelDisplay::kColumns - 1);
}

std::string SimulatedDevices::cellProblem(std::string_view name) const {
  if (isAreaName(name) && !areaCell(name))
    return "a cell of a shared area is SA0+OFFSET:WIDTH or SA1+OFFSET:WIDTH, of 1, 2, 4 or 8 bytes within " +
           std::to_string(io::SharedAreas::kAreaBytes);
  const auto unit = UnitCell::named(name);
  const auto shown = shownAt(name);
  if ((unit || shown) && !simulated_) return "it is there with `config nc simulated`";
  if (unit) return unit->problem(can_);
  if (shown) return displayProblem(shown->wheel);
  const auto at = tableCell(name);
  if (!at) return {};
  const std::string table = "PLC table " + std::to_string(at->table);
  if (!tables_.exists(at->table)) return "there is no " + table;
  uint32_t number = 0;
  if (!at->line) return table + " has " + std::string(kLineCount) + " and " + std::string(kSelectedLine);
  if (tables_.columnIndex(at->table, nc::memoryText(at->column), number) != io::TableError::None)
    return table + " has no column '" + std::string(at->column) + "'";
  return tables_.lineProblem(at->table, *at->line);
}

bool SimulatedDevices::cellMayCome(std::string_view name) const {
  const auto at = tableCell(name);
  uint32_t number = 0;
  return at && at->line && *at->line < io::PlcTables::kMostLines &&
         tables_.columnIndex(at->table, nc::memoryText(at->column), number) == io::TableError::None;
}

// Shared structures of CAN units.

using namespace io;

namespace {

constexpr std::string_view kGroups[kUnitGroups] = {"INPUTOUTPUT_CAN2_", "PANEL_CAN2_", "KNOB_CAN2_"}; // canonical

// Takes decimal digits from the beginning of the text.
std::optional<uint32_t> takeDecimal(std::string_view& text) {
  const size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  const auto number = nc::technol::decimal(text.substr(0, end));
  text.remove_prefix(end);
  return number;
}

} // namespace

// An element by its canonical name after INOUT_. `wire`: the byte is on the unit's physical side.
struct UnitCell::Element {
  enum class Wire : uint8_t { None, Input, Key, Analogue, Encoder, Output };

  std::string_view name;
  InoutsItem item; // of the first element
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

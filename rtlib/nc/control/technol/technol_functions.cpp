// Functions as blocks of TECHNOL (see technol_functions.h).
#include "rtlib/nc/control/technol/technol_functions.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc {

using technol::locateSignal;

namespace {

constexpr uint32_t kMostTool = 99'999'999;

// Groups of M functions (man. l.6703-6743, 7157-7182). A machine may have further functions in any group; functions
// without a group belong to 14 (l.7184-7214).
struct GroupOfM {
  uint8_t code;
  uint8_t group;
};
constexpr GroupOfM kGroupsOfM[] = {{0, 1},  {1, 1},  {2, 1},  {30, 1}, {3, 2},  {4, 2},  {5, 2},  {19, 2}, {40, 3},
                                   {41, 3}, {42, 3}, {43, 3}, {44, 3}, {7, 5},  {8, 5},  {9, 5},  {17, 5}, {50, 6},
                                   {51, 6}, {52, 6}, {53, 6}, {10, 7}, {11, 7}, {48, 8}, {49, 8}, {6, 9},  {60, 9}};
constexpr uint8_t kOtherGroup = 14;
// M40 leaves the gear to the control, which sets M41PI to M44PI by the speed (l.6904-6907).
constexpr uint32_t kAutomaticGear = 40;

// The cells with the code of a group in BCD (l.6785-6806).
struct CodeCell {
  uint32_t group;
  const char* cell;
};
constexpr CodeCell kCodeCells[] = {{2, "PB06"}, {10, "PB03"}, {11, "PB13"}, {12, "PB14"}, {13, "PB15"}, {14, "PB16"}};
constexpr const char* kToolCells[] = {"PB07", "PB08", "PB09", "PB10"}; // the lowest digits first

// Bits that these codes set to 1, and other codes of their group to 0 (l.6841-6968; BLK: l.6988-6989).
struct DecodedBit {
  const char* cell;
  uint32_t group;
  uint32_t codes[2];
};
constexpr DecodedBit kDecodedBits[] = {
    {"M00_PID", 1, {0, 0}},     {"M01_PID", 1, {1, 1}},         {"M02_PID", 1, {2, 2}},  {"M30_PID", 1, {30, 30}},
    {"BLK[0].Stop", 1, {0, 0}}, {"BLK[0].CondStop", 1, {1, 1}}, {"M03PI", 2, {3, 3}},    {"M04PI", 2, {4, 4}},
    {"M19PI", 2, {19, 19}},     {"M41PI", 3, {41, 41}},         {"M42PI", 3, {42, 42}},  {"M43PI", 3, {43, 43}},
    {"M44PI", 3, {44, 44}},     {"M07PI", 5, {7, 17}},          {"M08PI", 5, {8, 17}},   {"M50PI", 6, {50, 52}},
    {"M51PI", 6, {51, 52}},     {"M10PID", 7, {10, 10}},        {"M11PID", 7, {11, 11}}, {"M06PID", 9, {6, 6}},
    {"M60PI", 9, {60, 60}}};

int64_t bcd(uint32_t number) {
  int64_t digits = 0;
  for (uint32_t shift = 0; number != 0; shift += 4, number /= 10) digits |= int64_t{number % 10} << shift;
  return digits;
}

} // namespace

TechnolFunctions::TechnolFunctions(technol::Blocks& blocks) : blocks_(blocks) {
  groupOfM_.fill(kOtherGroup);
  for (const GroupOfM& row : kGroupsOfM) groupOfM_[row.code] = row.group;
}

bool TechnolFunctions::setGroup(uint32_t code, uint32_t group) {
  const bool fixed = std::ranges::find(kGroupsOfM, code, &GroupOfM::code) != std::end(kGroupsOfM);
  if (fixed || code > kMostM || group < 1 || group > kGroups) return false;
  groupOfM_[code] = static_cast<uint8_t>(group);
  return true;
}

const TechnolFunctions::Places TechnolFunctions::kNothing{};

TechnolFunctions::Places::Places(const rung_program& program) {
  static_assert(std::size(kDecodedBits) == kDecoded);
  automatic = locateSignal(program, "AUTPI");
  for (uint32_t i = 1; i <= kGroups; ++i) {
    const std::string number = std::to_string(i);
    groups[i] = {.changed = locateSignal(program, "ZMM" + number + "PI"),
                 .code = {},
                 .blockChanged = locateSignal(program, "BLK[0].M" + number),
                 .blockCode = locateSignal(program, "BLK[0].M[" + number + "]")};
  }
  for (const CodeCell& each : kCodeCells) groups[each.group].code = locateSignal(program, each.cell);
  for (uint32_t i = 0; i < kDecoded; ++i) decoded[i] = locateSignal(program, kDecodedBits[i].cell);
  speedChanged = locateSignal(program, "ZMSSPI");
  speed = locateSignal(program, "BLK[0].SpindleSpeed");
  toolChanged = locateSignal(program, "ZMSTPI");
  blockToolChanged = locateSignal(program, "BLK[0].TProg");
  blockTool = locateSignal(program, "BLK[0].T");
  for (uint32_t i = 0; i < toolDigits.size(); ++i) toolDigits[i] = locateSignal(program, kToolCells[i]);
  onCommand = technol::Procedure(program, "_ON_CMD");
  hChanged = locateSignal(program, "ZMSHPI");
  hCode = locateSignal(program, "PB05");
  blockHChanged = locateSignal(program, "BLK[0].HProg");
  blockH = locateSignal(program, "BLK[0].H");
}

bool TechnolFunctions::supports(FunctionKind kind, uint32_t code) const {
  switch (kind) {
  case FunctionKind::M:
  case FunctionKind::H: return code <= kMostM;
  case FunctionKind::S: return code <= static_cast<uint32_t>(std::numeric_limits<int32_t>::max());
  case FunctionKind::T: return code <= kMostTool;
  case FunctionKind::Key: return true;
  case FunctionKind::B: return false;
  }
  return false;
}

// The block belongs to the automatic mode (l.6748-6755).
std::optional<uint32_t> TechnolFunctions::start(FunctionKind kind, uint32_t code) {
  if (kind == FunctionKind::Key) return press(code);
  if (blocks_.busy()) return std::nullopt;
  Values values;
  values.add(places_->automatic, 1);
  switch (kind) {
  case FunctionKind::M: addM(values, code); break;
  case FunctionKind::S: addSpeed(values, code); break;
  case FunctionKind::T: addTool(values, code); break;
  case FunctionKind::H: addH(values, code); break;
  case FunctionKind::B:
  case FunctionKind::Key: return std::nullopt;
  }
  blocks_.start(*instance_, std::span(values.all).first(values.count));
  blocks_.reached(*instance_); // it has no motion
  return kBlockLine;
}

std::optional<uint32_t> TechnolFunctions::press(uint32_t code) {
  if (key_ != Key::None) return std::nullopt;
  key_ = Key::Waits;
  keyCode_ = code;
  return kKeyLine;
}

// Acts only between two scans.
void TechnolFunctions::step() {
  if (key_ == Key::None || !instance_->atListStart()) return;
  const auto code = static_cast<uint64_t>(static_cast<int64_t>(static_cast<int32_t>(keyCode_)));
  const bool pressed = key_ == Key::Waits;
  if (!instance_->stopped()) places_->onCommand.run(*instance_, code, pressed);
  key_ = pressed ? Key::Pressed : Key::None;
}

void TechnolFunctions::addM(Values& values, uint32_t code) const {
  const uint32_t number = groupOfM_[code];
  const Group& group = places_->groups[number];
  values.add(group.changed, 1);
  values.add(group.code, bcd(code));
  values.add(group.blockChanged, 1);
  values.add(group.blockCode, bcd(code));
  for (uint32_t i = 0; i < kDecoded && code != kAutomaticGear; ++i) {
    const DecodedBit& bit = kDecodedBits[i];
    if (bit.group == number) values.add(places_->decoded[i], bit.codes[0] == code || bit.codes[1] == code ? 1 : 0);
  }
}

// The output for the drive (PB11, PB12, rSPINDLE_OUTPUT_1) is not written: it depends on the configured gears
// (l.8180-8236).
void TechnolFunctions::addSpeed(Values& values, uint32_t code) const {
  values.add(places_->speedChanged, 1);
  values.addReal(places_->speed, code);
}

void TechnolFunctions::addTool(Values& values, uint32_t code) const {
  values.add(places_->toolChanged, 1);
  values.add(places_->blockToolChanged, 1);
  values.add(places_->blockTool, code);
  for (uint32_t i = 0; i < places_->toolDigits.size(); ++i)
    values.add(places_->toolDigits[i], bcd(code) >> 8 * i & 0xFF);
}

void TechnolFunctions::addH(Values& values, uint32_t code) const {
  values.add(places_->hChanged, 1);
  values.add(places_->hCode, bcd(code));
  values.add(places_->blockHChanged, 1);
  values.addReal(places_->blockH, code);
}

} // namespace rung::nc

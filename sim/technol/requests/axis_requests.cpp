// Requests to the axes.
#include "sim/technol/requests/axis_requests.h"

#include <iterator>
#include <optional>
#include <string>

#include "machine/io/analog/analog.h"
#include "machine/io/axes/axis_requests.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::sim::technol {

using io::DeviceCall, io::ServiceKind;

namespace {

// The interface of the axes for analogue outputs and positioning units.
class Target final : public io::AnalogTarget, public io::PositionTarget {
public:
  explicit Target(Axes& axes) : axes_(axes) {}
  void analogPort(int64_t port) override { axes_.analogPort(port); }
  AnalogOutput analog(int64_t value) override { return axes_.analog(value); }
  AnalogOutput analogOnSpindle(int64_t value, int64_t axis, int64_t spi) override {
    return axes_.analogOnSpindle(value, axis, spi);
  }
  AnalogOutput analogSpi(int64_t value, int64_t axis) override { return axes_.analogSpi(value, axis); }
  AnalogOutput axSpi(int64_t axis, SpindleRole role) override { return axes_.axSpi(axis, role); }
  void spiMain(int64_t axis) override { axes_.spiMain(axis); }
  void posInit(int64_t axis, int64_t space, bool loopClosed) override { axes_.posInit(axis, space, loopClosed); }
  PositioningUnits::Mode posMode(int64_t axis, int32_t length, uint16_t acceleration) override {
    return axes_.posMode(axis, length, acceleration);
  }
  PositioningUnits::State posControl(int64_t axis, uint32_t feed, bool mp) override {
    return axes_.posControl(axis, feed, mp);
  }
  void posReset(int64_t axis) override { axes_.posReset(axis); }

private:
  Axes& axes_;
};

void toAxis(Axes& axes, DeviceCall& call) {
  const auto given = [&](uint32_t number) -> std::optional<int64_t> {
    return call.arg(number) == nc::technol::kNotGiven ? std::nullopt : std::optional(call.arg(number));
  };
  if (!axes.spiAx(call.arg(4), {.feed1 = given(0), .feed2 = given(1), .angle = given(2), .accel = given(3)}))
    call.refuse();
}

} // namespace

void answerAxis(Axes& axes, const AxisPlaces& places, DeviceCall& call) {
  Target target(axes);
  if (io::answerAnalog(target, call)) return;
  if (io::answerPosition(target, places.cells(), call)) return;
  if (call.kind() == ServiceKind::ToAxis) return toAxis(axes, call);
  axes.regul(static_cast<int64_t>(call.kind()) - static_cast<int64_t>(ServiceKind::RegulatorX) + 1, call.arg(0));
}

// Cells of the axes.

namespace {

template <class Struct, class Member>
struct Cell {
  const char* name;
  Member Struct::* member;
};

// Single bits, one for each axis.
constexpr Cell<AxisInputs, AxisMask> kInputMasks[] = {
    {"MP#MAN", &AxisInputs::manualEnabled},   {"KR#", &AxisInputs::refSwitch},
    {"KRR#", &AxisInputs::reverseSwitch},     {"ZPR#", &AxisInputs::slowSwitch},
    {"REF_SERV_%", &AxisInputs::servoSwitch}, {"EXM_#0", &AxisInputs::externalPlus},
    {"EXM_#1", &AxisInputs::externalMinus}};
constexpr Cell<AxisOutputs, AxisMask> kOutputMasks[] = {{"MM_#0", &AxisOutputs::manualPlus},
                                                        {"MM_#1", &AxisOutputs::manualMinus}};
constexpr Cell<AxisInputs, bool> kInputFlags[] = {{"PO_F", &AxisInputs::block},
                                                  {"STOPPI", &AxisInputs::stopPi},
                                                  {"FEED_OVR", &AxisInputs::feedOvr},
                                                  {"EN_AUTMAN", &AxisInputs::autmanAllowed},
                                                  {"AUTMAN_REQ", &AxisInputs::autmanReq},
                                                  {"REQ_EXT_CONT_AUTMAN", &AxisInputs::externalControl},
                                                  {"REQ_EXT_SELECT_AUTMAN", &AxisInputs::externalSelect},
                                                  {"REQ_EXT_G00_AUTMAN", &AxisInputs::externalRapid},
                                                  {"REQ_EXT_FEED_AUTMAN", &AxisInputs::externalFeed},
                                                  {"REQ_EXT_FEED_G00_AUTMAN", &AxisInputs::externalRapidFeed},
                                                  {"G95_AUTMAN", &AxisInputs::perRevolution},
                                                  {"AUTMAN_WHEEL_DIS", &AxisInputs::noWheelSelect},
                                                  {"AUTMAN_KNOB_TOGGLE", &AxisInputs::selectToggles}};
constexpr Cell<AxisRequests, bool> kRequestFlags[] = {{"HOMING_SINGLE", &AxisRequests::homingSingle},
                                                      {"HOMING_PLC", &AxisRequests::homingPlc},
                                                      {"HOMING_GROUP", &AxisRequests::homingGroup},
                                                      {"STOP_REQ", &AxisRequests::stopReq},
                                                      {"STOP_EMERGENCY_REQ", &AxisRequests::stopEmergencyReq},
                                                      {"AUTMAN_SELECT", &AxisRequests::autmanSelect},
                                                      {"AUTMAN_CANCEL", &AxisRequests::autmanCancel},
                                                      {"REQ_ESHIFT", &AxisRequests::shiftSelected},
                                                      {"ACT_ESHIFT", &AxisRequests::shiftActive}};
// Words with a bit for each axis.
constexpr Cell<AxisRequests, AxisMask> kRequestMasks[] = {{"HOMING", &AxisRequests::homing},
                                                          {"HOMING_REQ", &AxisRequests::homingReq},
                                                          {"HOMING_START_REQ", &AxisRequests::homingStartReq},
                                                          {"PB_HOMING_AXIS", &AxisRequests::homingAxes},
                                                          {"NlcAxisEnable", &AxisRequests::nonlinearEnable},
                                                          {"SLS_REFER", &AxisRequests::softLimits}};
constexpr Cell<AxisOutputs, bool> kOutputFlags[] = {{"INPOS", &AxisOutputs::inPosition},
                                                    {"REFPI", &AxisOutputs::reference},
                                                    {"ACK_AUTMAN", &AxisOutputs::manual},
                                                    {"INPOS_STOP", &AxisOutputs::atStop},
                                                    {"AUTMAN_CONT_NC", &AxisOutputs::panelControl},
                                                    {"AUTMAN_CONT_TOC", &AxisOutputs::wheelControl},
                                                    {"AUTMAN_CONT_SELECT", &AxisOutputs::selecting},
                                                    {"AUTMAN_CONT_G00", &AxisOutputs::rapid}};

using nc::technol::locateElements;
using nc::technol::locateSignal;

} // namespace

AxisPlaces::AxisPlaces(const rung_program& program) : cells_(program), positioning_(program, "POLOHV_#") {
  const auto names = [&](auto& places, const auto& cells) {
    for (const auto& cell : cells) places.push_back(locateSignal(program, cell.name));
  };
  for (const auto& cell : kInputMasks) inputMasks_.emplace_back(program, cell.name);
  for (const auto& cell : kOutputMasks) outputMasks_.emplace_back(program, cell.name);
  names(inputFlags_, kInputFlags);
  names(outputFlags_, kOutputFlags);
  names(requestFlags_, kRequestFlags);
  names(requestMasks_, kRequestMasks);
  // BZH09 and BZH10 are one word (man. l.6530).
  if (const auto word = nc::technol::signalPlace(program, "BZH09"))
    feedOverride_ = runtime::locate({program, nullptr}, runtime::intRef(word->space, word->byte, 16));
  feedMultiplier_ = locateSignal(program, "FEED_OVR_MULTIPLIER");
  feed_ = locateSignal(program, "EXT_FEED_AUTMAN");
  rapidFeed_ = locateSignal(program, "EXT_FEED_G00_AUTMAN");
  shiftEnable_ = locateSignal(program, "SHIFT_ENABLE");
  shiftControl_ = locateSignal(program, "SHIFT_CONTROL");
  knobStep_ = locateSignal(program, "KNOB_STEP");
  locateElements(program, "REFPOINT_DIST", refpointDist_);
  locateElements(program, "SERVO_POSITION", servoPosition_);
  locateElements(program, "SHIFT_x", shift_);
  locateElements(program, "SU_OUT_PLC", output_);
  for (uint32_t i = 0; i < kMaxAxes; ++i) knobSelected_[i] = locateSignal(program, "KnobSelAx" + std::to_string(i));
}

void AxisPlaces::read(const core::Memory& memory, AxisInputs& in, AxisRequests& requests) const {
  cells_.read(memory, in);
  for (size_t i = 0; i < inputMasks_.size(); ++i) in.*kInputMasks[i].member = inputMasks_[i].read(memory);
  for (size_t i = 0; i < inputFlags_.size(); ++i) in.*kInputFlags[i].member = memory.read(inputFlags_[i]) != 0;
  in.blockMotion = static_cast<AxisMask>(in.blockMotion & cells_.motions().read(memory));
  in.feedOverride = static_cast<uint16_t>(memory.read(feedOverride_));
  in.feedMultiplier = static_cast<uint16_t>(memory.read(feedMultiplier_));
  in.feed = static_cast<uint16_t>(memory.read(feed_));
  in.rapidFeed = static_cast<uint16_t>(memory.read(rapidFeed_));
  in.shiftEnable = static_cast<uint8_t>(memory.read(shiftEnable_));
  for (uint32_t i = 0; i < kMaxAxes; ++i) {
    in.refpointDist[i] = memory.readSigned(refpointDist_[i]);
    in.servoPosition[i] = static_cast<int32_t>(memory.readSigned(servoPosition_[i]));
  }
  requests.positioning = positioning_.read(memory);
  for (size_t i = 0; i < requestMasks_.size(); ++i)
    requests.*kRequestMasks[i].member = static_cast<AxisMask>(memory.read(requestMasks_[i]));
  for (size_t i = 0; i < requestFlags_.size(); ++i)
    requests.*kRequestFlags[i].member = memory.read(requestFlags_[i]) != 0;
  requests.knobStep = static_cast<uint16_t>(memory.read(knobStep_));
}

void AxisPlaces::write(const core::Memory& memory, uint32_t count, const AxisRequests& requests,
                       const AxisOutputs& out) const {
  const auto all = static_cast<AxisMask>((1u << count) - 1);
  cells_.write(memory, all, out);
  for (size_t i = 0; i < outputMasks_.size(); ++i) outputMasks_[i].write(memory, all, out.*kOutputMasks[i].member);
  for (size_t i = 0; i < outputFlags_.size(); ++i) memory.write(outputFlags_[i], out.*kOutputFlags[i].member ? 1 : 0);
  positioning_.write(memory, ~AxisMask{0}, requests.positioning);
  for (size_t i = 0; i < requestMasks_.size(); ++i) memory.write(requestMasks_[i], requests.*kRequestMasks[i].member);
  for (size_t i = 0; i < requestFlags_.size(); ++i)
    memory.write(requestFlags_[i], requests.*kRequestFlags[i].member ? 1 : 0);
  memory.write(knobStep_, requests.knobStep);
  memory.write(shiftControl_, out.shiftControl);
  for (uint32_t i = 0; i < shift_.size(); ++i) memory.write(shift_[i], static_cast<uint64_t>(out.shift[i]));
  for (uint32_t i = 0; i < count; ++i) memory.write(knobSelected_[i], out.knobSelected[i]);
}

void AxisPlaces::zeroOutputs(const core::Memory& memory) const {
  for (const core::Place& place : output_) memory.write(place, 0);
}

// Cells of EtherCAT drives.

namespace {

// Names are followed by the servo's number.
struct Flag {
  const char* name;
  bool ServoCells::* member;
};
constexpr Flag kFlagNames[] = {{"flEdrvInit", &ServoCells::init},
                               {"flEdrvOn", &ServoCells::on},
                               {"flEdrvEnable", &ServoCells::enable},
                               {"flEdrvDisable", &ServoCells::disable},
                               {"flEdrvDone", &ServoCells::done},
                               {"flEdrvErase", &ServoCells::erase},
                               {"flEdrvSimul", &ServoCells::isSimulated},
                               {"flEdrvError", &ServoCells::isFaulty},
                               {"flEdrvMoveDisReq", &ServoCells::blocksMotion}};
constexpr const char* kWordNames[] = {"wEdrvDriveStatus", "wEdrvDriveErrReg",  "wEdrvDriveControl",
                                      "bEdrvState",       "dwEdrvDrivePosReq", "dwEdrvDriveVeloReq"};

} // namespace

ServoPlaces::ServoPlaces(const rung_program& program) {
  static_assert(std::size(kFlagNames) == kFlags && std::size(kWordNames) == kWords);
  for (uint32_t servo = 0; servo < EthercatServos::kCount; ++servo) {
    const std::string number = std::to_string(servo);
    for (uint32_t i = 0; i < kFlags; ++i)
      flags_[servo][i] = nc::technol::locateSignal(program, kFlagNames[i].name + number);
    for (uint32_t i = 0; i < kWords; ++i) words_[servo][i] = nc::technol::locateSignal(program, kWordNames[i] + number);
    position_[servo] = nc::technol::locateSignal(program, "dwEdrvDrivePos" + number);
    velocityScale_[servo] = nc::technol::locateSignal(program, "rEdrvScaleSpeed" + number);
  }
  nc::technol::locateElements(program, "DIFCIT_X", followingError_);
  nc::technol::locateElements(program, "ServoReqPosition", requested_);
  nc::technol::locateElements(program, "ServoPosition", measured_);
  nc::technol::locateElements(program, "SERVO_POSITION", increments_);
}

void ServoPlaces::read(const core::Memory& memory, EthercatServos::Cells& servos) const {
  for (uint32_t servo = 0; servo < servos.size(); ++servo) {
    for (uint32_t i = 0; i < kFlags; ++i) servos[servo].*kFlagNames[i].member = memory.read(flags_[servo][i]) != 0;
    servos[servo].status = static_cast<uint16_t>(memory.read(words_[servo][0]));
    servos[servo].error = static_cast<uint16_t>(memory.read(words_[servo][1]));
    servos[servo].position = static_cast<int32_t>(memory.readSigned(position_[servo]));
    servos[servo].velocityScale = memory.readReal(velocityScale_[servo]);
  }
}

void ServoPlaces::write(const core::Memory& memory, const EthercatServos::Cells& servos) const {
  for (uint32_t servo = 0; servo < servos.size(); ++servo) {
    const ServoCells& cells = servos[servo];
    if (!cells.exists()) continue;
    for (uint32_t i = 0; i < kFlags; ++i) memory.write(flags_[servo][i], cells.*kFlagNames[i].member ? 1 : 0);
    const uint64_t numbers[] = {cells.status,
                                cells.error,
                                cells.control,
                                static_cast<uint64_t>(cells.state),
                                static_cast<uint64_t>(cells.requestedPosition),
                                static_cast<uint64_t>(cells.requestedVelocity)};
    for (uint32_t i = 0; i < kWords; ++i) memory.write(words_[servo][i], numbers[i]);
    for (const OfServos* places : {&position_, &increments_})
      memory.write((*places)[servo], static_cast<uint64_t>(cells.position));
    memory.write(measured_[servo], static_cast<uint64_t>(cells.micrometres(cells.position)));
    memory.write(requested_[servo], static_cast<uint64_t>(cells.micrometres(cells.requestedPosition)));
    memory.write(followingError_[servo], static_cast<uint64_t>(cells.micrometres(cells.followingError())));
  }
}

} // namespace rung::sim::technol

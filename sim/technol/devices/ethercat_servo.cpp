// Servos of EtherCAT drives.
#include "sim/technol/devices/ethercat_servo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::sim::technol {

namespace {

struct Request {
  bool ServoCells::* bit;
  ServoState state; // the state after execution
};
// Requests that stop a drive come first, so that a request that cannot be executed does not keep a drive on.
constexpr Request kRequests[] = {{&ServoCells::done, ServoState::Done},
                                 {&ServoCells::disable, ServoState::On},
                                 {&ServoCells::init, ServoState::Init},
                                 {&ServoCells::on, ServoState::On},
                                 {&ServoCells::enable, ServoState::Enable}};

const Request* requested(const ServoCells& cells) {
  for (const Request& request : kRequests)
    if (cells.*request.bit) return &request;
  return nullptr;
}

// The control word for the next step of the request from that status. Disabling clears ENABLE (l.10366), so a drive
// that is not switched on stays so.
uint16_t controlFor(const Request& request, uint16_t status, uint16_t control) {
  if (request.bit == &ServoCells::enable) return kControlEnable;
  if (request.bit == &ServoCells::disable) return control & kControlSwitchOn;
  if (request.bit != &ServoCells::on) return 0;
  const bool isReady = status == kReadyToSwitchOn || status == kSwitchedOn || status == kOperationEnabled;
  return isReady ? kControlSwitchOn : kControlShutdown;
}

bool isCarriedOut(const Request& request, uint16_t status) {
  if (request.bit == &ServoCells::init) return true; // its status is readable
  if (request.bit == &ServoCells::enable) return status == kOperationEnabled;
  if (request.bit == &ServoCells::disable) return status != kOperationEnabled;
  const bool isOn = status == kSwitchedOn || status == kOperationEnabled;
  return request.bit == &ServoCells::done ? !isOn : status == kSwitchedOn;
}

// Positions are INT32 that wrap (l.10337), so they are computed as unsigned.
uint32_t incrementsAt(const ServoCells& cells) {
  return static_cast<uint32_t>(std::llround(cells.place * 1000 * cells.incrementsPerUm));
}

int32_t limited(double value) {
  using Limits = std::numeric_limits<int32_t>;
  return static_cast<int32_t>(std::lround(std::clamp<double>(value, Limits::min(), Limits::max())));
}

} // namespace

void EthercatServo::serve(ServoCells& cells) {
  const Request* request = requested(cells);
  if (request == nullptr) return;
  const auto status = static_cast<uint16_t>(cells.status & kStatusMask);
  control_ = controlFor(*request, status, control_);
  if (!isCarriedOut(*request, status)) return;
  cells.*request->bit = false;
  if (request->bit != &ServoCells::disable || status == kSwitchedOn) cells.state = request->state;
}

// A drive needs a rising edge, so it gets one in every other scan while the fault lasts.
void EthercatServo::eraseFault(ServoCells& cells) {
  cells.erase = cells.erase && cells.isFaulty;
  pulse_ = cells.erase && !pulse_;
}

// The motor has an absolute encoder, and moves to the position requested in the last scan.
void EthercatServo::simulate(ServoCells& cells) {
  own_.step(cells.control);
  if (!isPlaced_) ownPosition_ = static_cast<int32_t>(incrementsAt(cells));
  isPlaced_ = true;
  if (own_.status() == kOperationEnabled) ownPosition_ = cells.requestedPosition;
  cells.status = own_.status();
  cells.error = own_.error();
  cells.position = ownPosition_;
}

// A drive that is not enabled is requested to stay at its position, so that it does not jump when it is enabled. The
// velocity is the mean of the last scan: a drive that keeps it for a scan moves by the requested distance.
void EthercatServo::follow(ServoCells& cells) {
  constexpr double kScansPerSecond = 50;
  const uint32_t place = incrementsAt(cells);
  const auto before = static_cast<uint32_t>(cells.requestedPosition);
  const bool isHeld = cells.blocksMotion || !hasBase_;
  if (isHeld) base_ = static_cast<uint32_t>(cells.position) - place;
  hasBase_ = true;
  cells.requestedPosition = static_cast<int32_t>(base_ + place);
  const double scale = cells.velocityScale == 0 ? 1 : cells.velocityScale;
  const auto way = static_cast<int32_t>(base_ + place - before);
  cells.requestedVelocity = isHeld ? 0 : limited(way * kScansPerSecond * scale);
}

void EthercatServo::scan(ServoCells& cells) {
  if (!cells.exists()) return;
  if (cells.isSimulated) simulate(cells);
  cells.isFaulty = (cells.status & kFault) != 0;
  cells.blocksMotion = (cells.status & kStatusMask) != kOperationEnabled;
  follow(cells);
  serve(cells);
  eraseFault(cells);
  cells.control = static_cast<uint16_t>(control_ | (pulse_ ? kControlFaultReset : 0));
}

std::string EthercatServos::configure(std::string_view key, std::string_view value) {
  std::string_view rest = key.substr(std::string_view("servo.").size());
  const auto number = text::takeNumber<uint32_t>(rest);
  if (!number || *number >= kCount || !rest.starts_with('.'))
    return "'" + std::string(key) + "' needs a servo from 0 to 15: servo.0.MeasConstNumerator";
  return measures_[*number].set(rest.substr(1), value);
}

void EthercatServos::powerOn() {
  for (EthercatServo& servo : servos_) servo.powerOn();
  ticks_ = 0;
}

void EthercatServos::tick(Cells& cells) {
  if (++ticks_ < kScanTicks) return;
  ticks_ = 0;
  for (uint32_t i = 0; i < kCount; ++i) servos_[i].scan(cells[i]);
}

// Increments of servos.

namespace {

constexpr std::string_view kType = "ServoType", kNumerator = "MeasConstNumerator",
                           kDenominator = "MeasConstDenominator";

} // namespace

bool ServoMeasure::has(std::string_view name) {
  return text::equalsIgnoringCase(name, kType) || text::equalsIgnoringCase(name, kNumerator) ||
         text::equalsIgnoringCase(name, kDenominator);
}

std::string ServoMeasure::set(std::string_view name, std::string_view value) {
  if (!has(name))
    return "a servo has ServoType, MeasConstNumerator and MeasConstDenominator, not '" + std::string(name) + "'";
  const auto number = text::wholeIn<int32_t>(value);
  if (!number) return "'" + std::string(name) + "' needs a whole number; found '" + std::string(value) + "'";
  const bool isType = text::equalsIgnoringCase(name, kType);
  int32_t& place = isType ? type_ : text::equalsIgnoringCase(name, kNumerator) ? numerator_ : denominator_;
  place = *number;
  incrementsPerMicrometre_ = computed();
  return {};
}

double ServoMeasure::computed() const {
  if (numerator_ == 0 && denominator_ == 0) return 1;
  const double numerator = numerator_ == 0 ? 1 : numerator_, denominator = denominator_ == 0 ? 1 : denominator_;
  const bool isTrajectory = type_ == kTrajectoryCoe || type_ == kTrajectorySoe;
  return isTrajectory ? 65536 * numerator / denominator : denominator / numerator;
}

} // namespace rung::sim::technol

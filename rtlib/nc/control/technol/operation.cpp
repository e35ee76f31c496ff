// START, STOP and motion (see operation.h).
#include "rtlib/nc/control/technol/operation.h"

#include <string>

#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc::technol {
namespace {

constexpr const char* kAxisNames[] = {"X", "Y", "Z", "4", "5", "6"};

} // namespace

const Operation::Places Operation::kNothing{};

Operation::Places::Places(const rung_program& program) {
  const auto at = [&](const std::string& name) { return locateSignal(program, name); };
  runs = at("SF_RUN"), stopped = at("SF_STOP"), moves = at("SF_NOTINPOS"), byHand = at("SF_MANUALMODE");
  rapid = at("G00PI"), thread = at("G33PI");
  stop = at("STOPPI"), stopRequest = at("STOP_REQ"), emergencyRequest = at("STOP_EMERGENCY_REQ");
  startDisable = at("START_DISABLE"), startSuspend = at("START_SUSPEND"), stopDone = at("PO_STOP");
  handEnabled = at("EN_AUTMAN"), handSelect = at("AUTMAN_SELECT"), handCancel = at("AUTMAN_CANCEL");
  homed = at("HOMING"), homingRequest = at("HOMING_START_REQ"), zeroRequest = at("HOMING_REQ");
  automatic = at("AUTPI");
  onEvent = Procedure(program, "_ON_EVENT");
  for (uint32_t i = 0; i < kAxes; ++i) {
    const std::string name = std::string("MP") + kAxisNames[i];
    axes[i] = {.allowed = at(name + "PI"), .enabled = at(name)};
  }
}

void Operation::reset() {
  runs_ = stopped_ = asked_ = moves_ = stopKey_ = false;
  homed_ = 0;
}

void Operation::beforeScan(runtime::Instance& instance) {
  const bool moves = get(instance, places_->moves) && !get(instance, places_->byHand);
  const bool runs = moves || get(instance, places_->runs);
  const bool stopped = get(instance, places_->stopped);
  const bool starts = (runs && !runs_) || (stopped_ && !stopped);
  runs_ = runs;
  takeRequests(instance);
  if (stopped && !stopped_) stop(instance, PlcEvent::StopRequest);
  stopped_ = stopped;
  if (starts) askForStart(instance);
  start(instance);
  follow(instance, moves);
  endHoming(instance);
}

void Operation::send(runtime::Instance& instance, PlcEvent event) const {
  places_->onEvent.run(instance, static_cast<uint64_t>(event), false);
}

// The program resets STOPPI; the control resets the other requests (l.6402-6414, 11022-11030), which the host sees for
// one scan.
void Operation::takeRequests(runtime::Instance& instance) {
  const core::Memory memory = instance.memory();
  const bool key = get(instance, places_->stop);
  const bool request = get(instance, places_->stopRequest);
  const bool emergency = get(instance, places_->emergencyRequest);
  if (request) memory.write(places_->stopRequest, 0);
  if (emergency) memory.write(places_->emergencyRequest, 0);
  memory.write(places_->handSelect, 0);
  memory.write(places_->handCancel, 0);
  const bool pressed = key && !stopKey_;
  stopKey_ = key;
  if (emergency)
    stop(instance, PlcEvent::EmergencyStopRequest);
  else if (request || pressed)
    stop(instance, PlcEvent::StopRequest);
}

// If nothing runs, there is nothing to stop (l.6494-6496).
void Operation::stop(runtime::Instance& instance, PlcEvent request) {
  if (get(instance, places_->stopDone) || !runs_) return;
  asked_ = false;
  send(instance, request);
  instance.memory().write(places_->stopDone, 1);
  send(instance, PlcEvent::Stop);
}

void Operation::askForStart(runtime::Instance& instance) {
  instance.memory().write(places_->startSuspend, 0);
  asked_ = true;
  send(instance, PlcEvent::StartRequest);
}

void Operation::start(runtime::Instance& instance) {
  if (!runs_ && !get(instance, places_->stopDone)) asked_ = false; // the start was cancelled
  if (!asked_ || get(instance, places_->startDisable) || get(instance, places_->startSuspend)) return;
  asked_ = false;
  instance.memory().write(places_->stopDone, 0);
  send(instance, PlcEvent::Start);
}

// A motion of the host is one block from its beginning to its end, with the host's kind of motion.
void Operation::follow(runtime::Instance& instance, bool moves) {
  if (moves_ && !blocks_.busy()) moves_ = false; // ended by an annulment
  if (moves && !moves_) {
    const core::Memory memory = instance.memory();
    const CommandValue values[] = {
        {.place = places_->automatic, .integer = 1},
        {.place = places_->rapid, .integer = static_cast<int64_t>(memory.read(places_->rapid))},
        {.place = places_->thread, .integer = static_cast<int64_t>(memory.read(places_->thread))}};
    moves_ = blocks_.start(instance, values);
  }
  if (moves_ && !moves && blocks_.reached(instance)) moves_ = false;
}

// HOMING_START_REQ requests a reference, HOMING_REQ a zero point, until the axis has it (l.6643-6652).
void Operation::endHoming(runtime::Instance& instance) {
  const core::Memory memory = instance.memory();
  const uint64_t homed = memory.read(places_->homed);
  if (homed == homed_) return;
  const uint64_t others = ~(homed & ~homed_);
  for (const core::Place& request : {places_->homingRequest, places_->zeroRequest})
    memory.write(request, memory.read(request) & others);
  homed_ = homed;
}

void Operation::afterSlice(runtime::Instance& instance) const {
  const core::Memory memory = instance.memory();
  const bool free = get(instance, places_->byHand) ? get(instance, places_->handEnabled)
                                                   : blocks_.inMotion() && !asked_ && !get(instance, places_->stopDone);
  for (const Places::Axis& axis : places_->axes)
    memory.write(axis.enabled, free && memory.read(axis.allowed) != 0 ? 1 : 0);
}

} // namespace rung::nc::technol

// The scan: pins in, due slices of the schedule, pins out.
#include "tools/rung-hal/box.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "rtlib/host/program_info.h"

namespace rung::hal {
namespace {

rt::ListedPlace listed(const rt::Memory& memory, const host::Ref& place, PinType type, double scale) {
  using enum rt::ValueForm;
  constexpr rt::ValueForm kForms[] = {Raw, Signed, Raw, Real}; // of Bit, S32, U32, Float
  return {host::locate(memory, place), kForms[static_cast<size_t>(type)], scale};
}

uint64_t valueOf(PinType type, const PinCell& cell) noexcept {
  switch (type) {
  case PinType::Bit: return *cell.bit ? 1 : 0;
  case PinType::S32: return static_cast<uint64_t>(int64_t{*cell.s32});
  case PinType::U32: return *cell.u32;
  case PinType::Float: return std::bit_cast<uint64_t>(double{*cell.real});
  }
  return 0;
}

void setPin(PinType type, const PinCell& cell, uint64_t value) noexcept {
  switch (type) {
  case PinType::Bit: *cell.bit = value != 0; return;
  case PinType::S32: *cell.s32 = static_cast<int32_t>(value); return;
  case PinType::U32: *cell.u32 = static_cast<uint32_t>(value); return;
  case PinType::Float: *cell.real = std::bit_cast<double>(value); return;
  }
}

} // namespace

Box::Box(const rung_program& program, MapFile map, std::string retain)
    : map_(std::move(map)), retain_(std::move(retain)), control_(nc::makeControl(program.dialect)),
      instance_(program, control_.get()), pace_(instance_) {}

std::unique_ptr<Box> Box::make(const rung_program& program, MapFile map, std::vector<std::string>& errors,
                               const std::string& retain, std::vector<std::string>& warnings) {
  if (host::scanPeriodUs(program) == 0) {
    errors.push_back(std::string(program.name) + ": the program's schedule has no period");
    return nullptr;
  }
  std::unique_ptr<Box> box(new Box(program, std::move(map), retain));
  box->binding_ = bindMap(box->map_, box->instance_, *box->control_, errors);
  if (!errors.empty()) return nullptr;
  box->locatePlaces();
  box->functions_ = std::make_unique<FunctionQueue>(box->map_, *box->control_);
  if (!box->start(errors, warnings)) return nullptr;
  return box;
}

bool Box::start(std::vector<std::string>& errors, std::vector<std::string>& warnings) {
  std::optional<nc::PowerOn> kind = nc::PowerOn::Cold;
  if (!retain_.empty()) {
    retained_ = std::make_unique<nc::Retention>(*control_, instance_, retain_);
    std::string report;
    std::string error;
    kind = retained_->load(report, error);
    if (!kind) errors.push_back(error);
    if (!report.empty()) warnings.push_back(report);
  }
  if (!kind) return false;
  control_->powerOn(instance_, *kind);
  return true;
}

// The memory that the fault left is not what the program continues with: its retained part comes from the disk, where
// the last whole scan is.
bool Box::serve(std::vector<std::string>& reports) {
  if (state_.load(std::memory_order_acquire) != State::Restarting) return false;
  if (retained_)
    if (std::string error = retained_->finish(); !error.empty()) reports.push_back(error);
  retained_.reset();
  functions_->restart();
  pace_.restart();
  state_.store(start(reports, reports) ? State::Running : State::Stopped, std::memory_order_release);
  return true;
}

std::string Box::close() {
  if (state_.load(std::memory_order_acquire) == State::Running) lastScans();
  if (cells_ != nullptr) clearPins();
  return retained_ ? retained_->finish() : std::string();
}

// What MODULE_DONE switches off goes to the pins.
void Box::lastScans() noexcept {
  if (retained_) retained_->finish(); // for the case that the program faults in its last scans
  control_->powerOff(instance_, [this] {
    do slice();
    while (!instance_.atListStart() && !instance_.faulted());
  });
}

StepResult Box::step(int64_t ns, bool reset) noexcept {
  const bool asked = reset && !wasReset_;
  wasReset_ = reset;
  const State state = state_.load(std::memory_order_acquire);
  if (state == State::Stopped && asked) state_.store(State::Restarting, std::memory_order_release);
  if (state != State::Running) return StepResult::Waiting;
  functions_->sample(cells_, ns);
  pace_.elapse(ns);
  StepResult result = StepResult::Waiting;
  while (!instance_.faulted() && pace_.take()) {
    slice();
    result = StepResult::Ran;
  }
  if (!instance_.faulted()) return result;
  clearPins();
  state_.store(State::Stopped, std::memory_order_release);
  return StepResult::Failed;
}

void Box::slice() noexcept {
  if (cells_ != nullptr) {
    functions_->advance(cells_);
    readPins();
  }
  instance_.slice();
  control_->afterSlice(instance_);
  if (retained_) retained_->afterSlice();
  passMessages();
  if (instance_.faulted() || cells_ == nullptr) return;
  if (instance_.atListStart()) ++scans_;
  writePins();
}

// The values of constants follow those of the pins, and never change.
void Box::locatePlaces() {
  const rt::Memory memory = instance_.memory();
  for (const PinLink& link : binding_.inputs) inputs_.push_back(listed(memory, link.place, link.type, link.scale));
  inputValues_.resize(inputs_.size());
  for (const ConstLink& constant : binding_.constants) {
    inputs_.push_back(listed(memory, constant.place, constant.type, 1));
    inputValues_.push_back(constant.type == PinType::Float
                               ? std::bit_cast<uint64_t>(constant.value)
                               : static_cast<uint64_t>(static_cast<int64_t>(constant.value)));
  }
  for (const PinLink& link : binding_.outputs) outputs_.push_back(listed(memory, link.place, link.type, link.scale));
  outputValues_.resize(outputs_.size());
}

// Constants too in every slice: neither a restart nor the control can undo them.
void Box::readPins() noexcept {
  for (size_t i = 0; i < binding_.inputs.size(); ++i) {
    const PinLink& link = binding_.inputs[i];
    inputValues_[i] = valueOf(link.type, cells_[link.pin]);
  }
  rt::writePlaces(instance_.memory(), inputs_, inputValues_);
}

void Box::writePins() noexcept {
  rt::readPlaces(instance_.memory(), outputs_, outputValues_);
  for (size_t i = 0; i < binding_.outputs.size(); ++i) {
    const PinLink& link = binding_.outputs[i];
    setPin(link.type, cells_[link.pin], outputValues_[i]);
  }
}

void Box::clearPins() noexcept {
  for (size_t i = 0; i < map_.pins.size(); ++i)
    if (map_.pins[i].output) setPin(map_.pins[i].type, cells_[i], 0);
}

void Box::passMessages() noexcept {
  rung_message message;
  for (uint32_t i = 0; i < rt::kMessageCapacity && instance_.messages().pop(message); ++i) {
    control_->accept(message);
    if (sink_ != nullptr) sink_(*control_, instance_.program(), message);
  }
}

} // namespace rung::hal

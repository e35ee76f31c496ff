// The scan: pins in, due slices of the schedule, pins out.
#include "tools/rung-hal/box.h"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

namespace rung::hal {
namespace {

Value valueOf(PinType type, const PinCell& cell) noexcept {
  switch (type) {
  case PinType::Bit: return {.bit = *cell.bit};
  case PinType::S32: return {.s32 = *cell.s32};
  case PinType::U32: return {.u32 = *cell.u32};
  case PinType::Float: return {.real = *cell.real};
  }
  return {};
}

Value constant(PinType type, double value) noexcept {
  switch (type) {
  case PinType::Bit: return {.bit = value != 0};
  case PinType::S32: return {.s32 = static_cast<int32_t>(value)};
  case PinType::U32: return {.u32 = static_cast<uint32_t>(value)};
  case PinType::Float: return {.real = value};
  }
  return {};
}

void setPin(PinType type, const PinCell& cell, const Value& value) noexcept {
  switch (type) {
  case PinType::Bit: *cell.bit = value.bit; return;
  case PinType::S32: *cell.s32 = value.s32; return;
  case PinType::U32: *cell.u32 = value.u32; return;
  case PinType::Float: *cell.real = value.real; return;
  }
}

} // namespace

Box::Box(const Image& image, MapFile map, const std::string& retain)
    : map_(std::move(map)), options_{.size = sizeof options_, .user = this, .log = &Box::log}, plc_(image, &options_),
      kept_(!retain.empty()) {
  if (kept_) check(rung_instance_keep(plc_.handle(), retain.c_str()));
}

// No exception may go through the library, which is one of C.
void Box::log(void* box, int32_t level, const char* text) try {
  if (level != RUNG_LOG_INFO) static_cast<Box*>(box)->logged_.emplace_back(text);
} catch (const std::bad_alloc&) {
  static_cast<Box*>(box)->logged_.clear(); // room for what comes next
}

std::unique_ptr<Box> Box::make(const Image& image, MapFile map, std::vector<std::string>& errors,
                               const std::string& retain, std::vector<std::string>& warnings) try {
  std::unique_ptr<Box> box(new Box(image, std::move(map), retain));
  box->binding_ = bindMap(box->map_, box->plc_.handle(), *rung_image_program(image.handle()), errors);
  if (!errors.empty()) return nullptr;
  box->bindValues();
  box->functions_ = std::make_unique<FunctionQueue>(box->map_, box->plc_.handle());
  const bool started = box->start(errors);
  warnings = std::move(box->logged_);
  return started ? std::move(box) : nullptr;
} catch (const Error& error) {
  errors.emplace_back(error.what());
  return nullptr;
}

// Constants in every slice, too: neither a restart nor the control can undo them.
void Box::bindValues() {
  inputs_.resize(binding_.inputs.size());
  outputs_.resize(binding_.outputs.size());
  constants_.resize(binding_.constants.size());
  for (size_t i = 0; i < inputs_.size(); ++i)
    bind(binding_.inputs[i], inputs_[i], RUNG_TO_PROGRAM, binding_.inputs[i].scale);
  for (size_t i = 0; i < constants_.size(); ++i) {
    const ConstLink& link = binding_.constants[i];
    constants_[i] = constant(link.type, link.value);
    bind(link, constants_[i], RUNG_TO_PROGRAM, 1);
  }
  for (size_t i = 0; i < outputs_.size(); ++i)
    bind(binding_.outputs[i], outputs_[i], RUNG_FROM_PROGRAM, binding_.outputs[i].scale);
}

template <class Link>
void Box::bind(const Link& link, Value& value, rung_direction direction, double scale) {
  constexpr rung_host_type kTypes[] = {RUNG_HOST_BOOL, RUNG_HOST_I32, RUNG_HOST_U32, RUNG_HOST_F64}; // by PinType
  const uint32_t words = link.words ? uint32_t{RUNG_BOUND_REAL} : 0;
  const rung_variable variable{link.name.c_str(), &value, kTypes[static_cast<size_t>(link.type)], direction | words,
                               scale};
  check(rung_instance_bind(plc_.handle(), &variable, 1));
}

// A fault at the power-on shows in the first step.
bool Box::start(std::vector<std::string>& reports) {
  const int32_t status = rung_instance_power_on(plc_.handle(), kept_ ? RUNG_WARM : RUNG_COLD);
  if (status < RUNG_OK) reports.emplace_back(rung_error_text());
  return status >= RUNG_OK;
}

bool Box::serve(std::vector<std::string>& reports) {
  const State state = state_.load(std::memory_order_acquire);
  if (state == State::Running) return false;
  const bool isNew = !std::exchange(reported_, true);
  if (const std::optional<rung_fault_info> info = fault(); info && isNew) {
    faultLine_.store(info->line, std::memory_order_relaxed);
    reports.push_back("the program has stopped: " + std::string(info->text) +
                      "; all output pins are 0 until pin reset rises");
  }
  if (state == State::Stopped) return isNew;
  functions_->restart();
  const bool started = start(reports);
  std::ranges::move(logged_, std::back_inserter(reports));
  logged_.clear();
  reports.emplace_back(started ? "the program has been restarted" : "the program cannot be restarted");
  reported_ = !started;
  state_.store(started ? State::Running : State::Stopped, std::memory_order_release);
  return true;
}

std::string Box::close() {
  std::string error;
  const int32_t status = rung_instance_power_off(plc_.handle());
  if (status < RUNG_OK && status != RUNG_WRONG_STATE) error = rung_error_text(); // it may be off
  passMessages();
  if (cells_ != nullptr) clearPins();
  return error;
}

StepResult Box::step(int64_t ns, bool reset) noexcept {
  const bool asked = reset && !wasReset_;
  wasReset_ = reset;
  const State state = state_.load(std::memory_order_acquire);
  if (state == State::Stopped && asked) state_.store(State::Restarting, std::memory_order_release);
  if (state != State::Running) return StepResult::Waiting;
  functions_->sample(cells_, ns);
  return run(ns);
}

StepResult Box::run(int64_t ns) noexcept {
  const rung_state before = state();
  if (before.wait_ns <= ns) {
    functions_->advance(cells_);
    readPins();
  }
  const int32_t status = rung_instance_run_due(plc_.handle(), ns);
  passMessages();
  if (status == RUNG_FAULTED) {
    clearPins();
    state_.store(State::Stopped, std::memory_order_release);
    return StepResult::Failed;
  }
  if (before.wait_ns > ns) return StepResult::Waiting;
  writePins();
  return StepResult::Ran;
}

rung_state Box::state() const noexcept {
  rung_state state{};
  state.size = sizeof state;
  rung_instance_state(plc_.handle(), &state);
  return state;
}

std::optional<rung_fault_info> Box::fault() const noexcept {
  rung_fault_info info{};
  info.size = sizeof info;
  return rung_instance_fault(plc_.handle(), &info) == RUNG_OK ? std::optional(info) : std::nullopt;
}

void Box::readPins() noexcept {
  for (size_t i = 0; i < inputs_.size(); ++i) {
    const PinLink& link = binding_.inputs[i];
    inputs_[i] = valueOf(link.type, cells_[link.pin]);
  }
}

void Box::writePins() noexcept {
  for (size_t i = 0; i < outputs_.size(); ++i) {
    const PinLink& link = binding_.outputs[i];
    setPin(link.type, cells_[link.pin], outputs_[i]);
  }
}

void Box::clearPins() noexcept {
  for (size_t i = 0; i < map_.pins.size(); ++i)
    if (map_.pins[i].output) setPin(map_.pins[i].type, cells_[i], {});
}

void Box::passMessages() noexcept {
  rung_message_info message{};
  message.size = sizeof message;
  while (rung_instance_next_message(plc_.handle(), &message) == RUNG_OK)
    if (sink_ != nullptr) sink_(message);
}

} // namespace rung::hal

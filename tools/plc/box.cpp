// The scan: pins in, due slices of the schedule, pins out.
#include "tools/plc/box.h"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "tools/mapping/message_texts.h"

namespace rung::plc {
namespace {

Value constant(mapping::PinType type, double value) noexcept {
  switch (type) {
  case mapping::PinType::Bit: return {.bit = value != 0};
  case mapping::PinType::S32: return {.s32 = static_cast<int32_t>(value)};
  case mapping::PinType::U32: return {.u32 = static_cast<uint32_t>(value)};
  case mapping::PinType::Float: return {.real = value};
  }
  return {};
}

Value bitsOf(const std::vector<uint32_t>& numbers, const Pins& pins) noexcept {
  Value value{.u32 = 0};
  for (size_t i = 0; i < numbers.size(); ++i) value.u32 |= uint32_t{pins[numbers[i]].bit} << i;
  return value;
}

int32_t readProfile(const rung_instance* plc, Order& order) noexcept {
  const uint32_t wanted = std::exchange(order.count, 0);
  int32_t status = RUNG_OK;
  while (order.count < wanted && status == RUNG_OK) {
    rung_profile& profile = order.profiles[order.count];
    profile.size = sizeof profile;
    status = rung_instance_profile(plc, order.index + order.count, &profile);
    if (status == RUNG_OK) ++order.count;
  }
  return status;
}

} // namespace

Box::Box(const Image& image, mapping::File map, const std::string& retain, const NewInstance& newInstance)
    : map_(std::move(map)), options_{.size = sizeof options_, .user = this, .log = &Box::log, .request = &Box::request},
      plc_(newInstance ? newInstance(image, options_) : Instance(image, &options_)), kept_(!retain.empty()),
      pins_(map_.pins) {
  if (kept_) check(rung_instance_keep(plc_.handle(), retain.c_str()));
}

// No exception may go through the library, which is one of C.
void Box::log(void* box, int32_t level, const char* text) try {
  if (level != RUNG_LOG_INFO) static_cast<Box*>(box)->logged_.emplace_back(text);
} catch (const std::bad_alloc&) {
  static_cast<Box*>(box)->logged_.clear(); // room for what comes next
}

int32_t Box::request(void* box, rung_instance*, const rung_request* request, rung_reply* reply) {
  return services::atOnce(*request, static_cast<Box*>(box)->live_, *reply);
}

std::unique_ptr<Box> Box::make(const Image& image, mapping::File map, std::vector<std::string>& errors,
                               const std::string& retain, std::vector<std::string>& warnings,
                               const NewInstance& newInstance) try {
  std::unique_ptr<Box> box(new Box(image, std::move(map), retain, newInstance));
  box->binding_ = mapping::bindMap(box->map_, box->plc_.handle(), *rung_image_program(image.handle()), errors);
  mapping::defineMessages(box->map_, box->plc_.handle(), errors);
  if (!errors.empty()) return nullptr;
  box->bindValues();
  box->functions_ = std::make_unique<FunctionQueue>(box->map_, box->plc_.handle());
  const bool started = box->start(errors);
  warnings = std::move(box->logged_);
  for (const mapping::Pin& pin : box->map_.pins)
    if (pin.holds) warnings.push_back("pin " + pin.name + " holds its last value where the program does not run");
  return started ? std::move(box) : nullptr;
} catch (const Error& error) {
  errors.emplace_back(error.what());
  return nullptr;
}

// Constants in every slice, too: neither a restart nor the control can undo them.
void Box::bindValues() {
  values_.resize(binding_.links.size());
  constants_.resize(binding_.constants.size());
  for (size_t i = 0; i < values_.size(); ++i) {
    const mapping::PinLink& link = binding_.links[i];
    if (mapping::toProgram(link.direction)) {
      bind(link, values_[i], RUNG_TO_PROGRAM, link.scale);
      toProgram_.push_back(i);
    }
    if (mapping::fromProgram(link.direction)) {
      bind(link, values_[i], RUNG_FROM_PROGRAM, link.scale);
      fromProgram_.push_back(i);
    }
  }
  for (size_t i = 0; i < constants_.size(); ++i) {
    const mapping::ConstLink& link = binding_.constants[i];
    constants_[i] = constant(link.type, link.value);
    bind(link, constants_[i], RUNG_TO_PROGRAM, 1);
  }
}

template <class Link>
void Box::bind(const Link& link, Value& value, rung_direction direction, double scale) {
  constexpr rung_host_type kTypes[] = {RUNG_HOST_BOOL, RUNG_HOST_I32, RUNG_HOST_U32,
                                       RUNG_HOST_F64}; // by mapping::PinType
  const uint32_t words = link.words ? uint32_t{RUNG_BOUND_REAL} : 0;
  const rung_variable variable{link.name.c_str(), &value, kTypes[static_cast<size_t>(link.type)], direction | words,
                               scale};
  check(rung_instance_bind(plc_.handle(), &variable, 1));
}

// A fault at the power-on shows in the first step.
bool Box::start(std::vector<std::string>& reports) {
  const int32_t status = rung_instance_power_on(plc_.handle(), kept_ ? RUNG_WARM : RUNG_COLD);
  if (status < RUNG_OK) reports.emplace_back(rung_error_text());
  const bool first = !pins_.connected();
  for (const size_t link : toProgram_) beginWith(link, first);
  if (!first) pins_.write();
  return status >= RUNG_OK;
}

// What both sides write begins with the program's value; a parameter keeps a person's.
void Box::beginWith(size_t index, bool first) noexcept {
  const mapping::PinLink& link = binding_.links[index];
  const bool parameter = link.direction == mapping::Direction::Parameter && first;
  if (parameter && link.value)
    values_[index] = constant(link.type, *link.value);
  else if (parameter || link.direction == mapping::Direction::Io)
    values_[index] = valueInProgram(link);
  else
    return;
  if (!first) setPins(link, values_[index]);
}

Value Box::valueInProgram(const mapping::PinLink& link) noexcept {
  rung_cell cell = 0;
  rung_cell_info info{};
  info.size = sizeof info;
  rung_value value{};
  const int32_t access = link.words ? RUNG_WRITE | RUNG_REAL : RUNG_WRITE;
  if (rung_instance_find(plc_.handle(), link.name.c_str(), access, &cell) != RUNG_OK ||
      rung_instance_cell(plc_.handle(), cell, &info) != RUNG_OK ||
      rung_instance_read(plc_.handle(), cell, 0, 1, &value) != RUNG_OK)
    return {};
  if (link.type != mapping::PinType::Float) return constant(link.type, static_cast<double>(value.integer));
  const double real = info.type == RUNG_TYPE_F64 ? value.real : static_cast<double>(value.integer);
  return {.real = real / link.scale};
}

void Box::connect(const PinCell* cells, const PinAccess& access) noexcept {
  pins_.connect(cells, access);
  clearPins();
  for (const size_t i : toProgram_)
    if (binding_.links[i].direction != mapping::Direction::In) setPins(binding_.links[i], values_[i]);
  pins_.write();
}

bool Box::serve(std::vector<std::string>& reports) {
  const State state = state_.load(std::memory_order_acquire);
  if (state == State::Running) return false;
  bool isNew = false;
  if (const std::optional<rung_fault_info> info = reported_ ? std::nullopt : fault()) { // or the scan thread has it
    isNew = reported_ = true;
    faultLine_.store(info->line, std::memory_order_relaxed);
    reports.push_back("the program has stopped: " + std::string(info->text) +
                      "; output pins have their safe values until pin reset rises");
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
  if (pins_.connected()) clearPins();
  return error;
}

bool Box::ends() noexcept {
  if (rung_instance_begin_power_off(plc_.handle()) == RUNG_LATER) return false;
  // What the control runs first may have faulted: `serve` reports that as any other fault.
  if (running() && (state().flags & RUNG_STATE_FAULTED) != 0) state_.store(State::Stopped, std::memory_order_release);
  return true;
}

StepResult Box::step(int64_t ns, bool reset) noexcept {
  if (!beginStep(ns, reset)) return StepResult::Waiting;
  const StepResult result = run(ns, &rung_instance_run_due);
  sliceBegun_ = false;
  return result;
}

StepResult Box::stepFast(int64_t ns, bool reset) noexcept {
  if (!beginStep(ns, reset)) return StepResult::Waiting;
  const StepResult result = run(ns, &rung_instance_run_due_fast);
  sliceBegun_ = result == StepResult::Ran;
  return result;
}

// False: the program does not run.
bool Box::beginStep(int64_t ns, bool reset) noexcept {
  const bool resets = reset && restartable_;
  const bool asked = resets && !wasReset_;
  wasReset_ = resets;
  orders_.take([this](Order& order) { return obey(order); });
  const State state = state_.load(std::memory_order_acquire);
  if (state == State::Stopped && asked) state_.store(State::Restarting, std::memory_order_release);
  if (state != State::Running) return false;
  pins_.read();
  functions_->sample(pins_, ns);
  return true;
}

// Functions begin where a slice does, and so do inputs.
StepResult Box::run(int64_t ns, int32_t (*due)(rung_instance*, int64_t)) noexcept {
  const rung_state before = state();
  if (before.wait_ns <= ns && !sliceBegun_) {
    functions_->advance(pins_);
    readPins();
  }
  const int32_t status = due(plc_.handle(), ns);
  if (status == RUNG_FAULTED) {
    clearPins();
    state_.store(State::Stopped, std::memory_order_release);
    return StepResult::Failed;
  }
  const bool wasDue = before.wait_ns <= ns;
  if (wasDue) writePins();
  pins_.write();
  return wasDue ? StepResult::Ran : StepResult::Waiting;
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
  for (const size_t i : toProgram_) {
    const mapping::PinLink& link = binding_.links[i];
    values_[i] = link.bits.empty() ? pins_[link.pin] : bitsOf(link.bits, pins_);
  }
}

void Box::writePins() noexcept {
  for (const size_t i : fromProgram_) setPins(binding_.links[i], values_[i]);
}

void Box::setPins(const mapping::PinLink& link, const Value& value) noexcept {
  if (link.bits.empty()) return pins_.set(link.pin, value);
  for (size_t bit = 0; bit < link.bits.size(); ++bit) pins_.set(link.bits[bit], {.bit = (value.u32 >> bit & 1) != 0});
}

void Box::clearPins() noexcept {
  for (uint32_t i = 0; i < map_.pins.size(); ++i) {
    const mapping::Pin& pin = map_.pins[i];
    if (mapping::fromProgram(pin.direction) && !pin.holds && !pin.ofHost) pins_.set(i, constant(pin.type, pin.safe));
  }
  pins_.write();
}

bool Box::nextMessage(rung_message_info& message) const noexcept {
  message.size = sizeof message;
  return rung_instance_next_message(plc_.handle(), &message) == RUNG_OK;
}

bool Box::nextRequest(services::Request& request) const {
  request.given.size = sizeof request.given;
  if (rung_instance_next_request(plc_.handle(), &request.given) != RUNG_OK) return false;
  request.service = request.given.service;
  return true;
}

int32_t Box::obey(Order& order) noexcept {
  const State now = state_.load(std::memory_order_acquire);
  if (order.kind == Order::Kind::Restart && now == State::Stopped) {
    if (!restartable_) return RUNG_LATER;
    state_.store(State::Restarting, std::memory_order_release);
    return RUNG_OK;
  }
  if (now == State::Restarting) return RUNG_LATER; // the instance is another thread's
  if (order.kind == Order::Kind::Restart) return RUNG_EMPTY;
  const int32_t status = obeyRunning(order);
  return status == RUNG_WRONG_THREAD ? int32_t{RUNG_LATER} : status; // of a stopped program: who serves it
}

int32_t Box::obeyRunning(Order& order) noexcept {
  rung_instance* plc = plc_.handle();
  switch (order.kind) {
  case Order::Kind::State: order.state = state(); return RUNG_OK;
  case Order::Kind::Write: {
    const int32_t status = rung_instance_read(plc, order.cell, 0, 1, &order.former);
    return status != RUNG_OK ? status : rung_instance_write(plc, order.cell, 0, 1, &order.value);
  }
  case Order::Kind::Forced:
    order.force.size = sizeof order.force;
    return rung_instance_forced(plc, order.index, &order.force);
  case Order::Kind::Force: return rung_instance_force(plc, order.forces);
  case Order::Kind::Replace: return rung_instance_replace(plc, order.replacement);
  case Order::Kind::Shadow: return rung_instance_shadow(plc, order.shadow);
  case Order::Kind::Stop: return rung_instance_stop(plc);
  case Order::Kind::Start: return rung_instance_start(plc);
  case Order::Kind::Profile: return readProfile(plc, order);
  case Order::Kind::ClearProfile: return rung_instance_clear_profile(plc);
  case Order::Kind::Act: return order.act(order.actor), RUNG_OK;
  case Order::Kind::Restart: break; // obey
  }
  return RUNG_EMPTY;
}

} // namespace rung::plc

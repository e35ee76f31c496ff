// The scan: pins in, due slices of the schedule, pins out.
#include "machine/host/plc_host.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

#include "machine/host/message_texts.h"

namespace rung::host {
namespace {

Value constant(PinType type, double value) noexcept {
  switch (type) {
  case PinType::Bit: return {.bit = value != 0};
  case PinType::S32: return {.s32 = static_cast<int32_t>(value)};
  case PinType::U32: return {.u32 = static_cast<uint32_t>(value)};
  case PinType::Float: return {.real = value};
  }
  return {};
}

Value bitsOf(const std::vector<uint32_t>& numbers, const Pins& pins) noexcept {
  Value value{.u32 = 0};
  for (size_t i = 0; i < numbers.size(); ++i) value.u32 |= uint32_t{pins[numbers[i]].bit} << i;
  return value;
}

int32_t readProfile(const rung_instance* plc, Command& command) noexcept {
  const uint32_t wanted = std::exchange(command.count, 0);
  int32_t status = RUNG_OK;
  while (command.count < wanted && status == RUNG_OK) {
    rung_profile& profile = command.profiles[command.count];
    profile.size = sizeof profile;
    status = rung_instance_profile(plc, command.index + command.count, &profile);
    if (status == RUNG_OK) ++command.count;
  }
  return status;
}

} // namespace

namespace {

// From the root, as clients with other working directories read it.
std::string recordingFolder(const RecordingSetting& setting, const std::string& retain) {
  if (setting.off || (setting.folder.empty() && retain.empty())) return {};
  return std::filesystem::absolute(setting.folder.empty() ? retain + ".recording" : setting.folder).string();
}

} // namespace

PlcHost::PlcHost(const Image& image, File map, const Options& options)
    : map_(std::move(map)), translation_(translationOf(image.program().dialect)),
      options_{.size = sizeof options_,
               .flags = options.measure ? uint32_t{RUNG_MEASURE} : 0,
               .user = this,
               .log = &PlcHost::log,
               .request = &PlcHost::request,
               .catch_up = options.catchUp},
      plc_(options.newInstance ? options.newInstance(image, options_) : Instance(image, &options_)),
      kept_(!options.retain.empty()), recordingFolder_(recordingFolder(map_.recording, options.retain)),
      reset_(options.reset), pins_(map_.pins), clock_(*options.clock) {
  if (kept_) plc_.keep(options.retain);
}

// Exceptions must not pass through the library, which has a C interface.
void PlcHost::log(void* host, int32_t level, const char* text) try {
  if (level != RUNG_LOG_INFO) static_cast<PlcHost*>(host)->logged_.emplace_back(text);
} catch (const std::bad_alloc&) {
  static_cast<PlcHost*>(host)->logged_.clear(); // frees memory for the next texts
}

int32_t PlcHost::request(void* host, rung_instance*, const rung_request* request, rung_reply* reply) {
  const PlcHost& self = *static_cast<PlcHost*>(host);
  if (!self.live_.served.load(std::memory_order_acquire)) return RUNG_REFUSE;
  return self.translation_.atOnce(*request, self.live_, *reply);
}

std::unique_ptr<PlcHost> PlcHost::make(const Image& image, File map, const Options& options,
                                       std::vector<std::string>& errors, std::vector<std::string>& warnings) {
  std::unique_ptr<PlcHost> host(new PlcHost(image, std::move(map), options));
  host->binding_ = bindMap(host->map_, host->plc_.handle(), *rung_image_program(image.handle()), errors);
  defineMessages(host->map_, host->plc_.handle(), errors);
  if (!errors.empty()) return nullptr;
  host->bindValues();
  host->functions_ = std::make_unique<FunctionQueue>(host->map_, host->plc_.handle());
  std::string problem;
  const std::string notRecorded = host->record();
  const int32_t status = host->start(problem);
  if (status >= RUNG_OK && !notRecorded.empty()) warnings.push_back("nothing is recorded: " + notRecorded);
  std::ranges::move(host->logged_, std::back_inserter(warnings));
  host->logged_.clear();
  for (const Pin& pin : host->map_.pins)
    if (pin.holds) warnings.push_back("pin " + pin.name + " holds its last value while the program does not run");
  if (status < RUNG_OK) throw Error(status, problem.c_str());
  return host;
}

// Constants are written in every slice as well, so that neither a restart nor the control can change them.
void PlcHost::bindValues() {
  values_.resize(binding_.links.size());
  constants_.resize(binding_.constants.size());
  for (size_t i = 0; i < values_.size(); ++i) {
    const PinLink& link = binding_.links[i];
    if (toProgram(link.direction)) {
      bind(link, values_[i], RUNG_TO_PROGRAM, link.scale);
      toProgram_.push_back(i);
      feeds_.push_back({link.name, "pin " + map_.pins[link.pin].name, {}});
      for (const uint32_t pin : link.bits) feeds_.back().bits.push_back(map_.pins[pin].name);
      rung_cell cell = 0;
      const bool isBits = link.type == PinType::Bit || !link.bits.empty();
      if (isBits && link.direction == Direction::In &&
          rung_instance_find(plc_.handle(), link.name.c_str(), RUNG_WRITE, &cell) == RUNG_OK)
        fedBits_.emplace_back(i, cell);
    }
    if (fromProgram(link.direction)) {
      bind(link, values_[i], RUNG_FROM_PROGRAM, link.scale);
      fromProgram_.push_back(i);
    }
  }
  for (size_t i = 0; i < constants_.size(); ++i) {
    const ConstLink& link = binding_.constants[i];
    constants_[i] = constant(link.type, link.value);
    bind(link, constants_[i], RUNG_TO_PROGRAM, 1);
    feeds_.push_back({link.name, "a constant of the mapping file", {}});
  }
}

template <class Link>
void PlcHost::bind(const Link& link, Value& value, rung_direction direction, double scale) {
  constexpr rung_host_type kTypes[] = {RUNG_HOST_BOOL, RUNG_HOST_I32, RUNG_HOST_U32, RUNG_HOST_F64}; // by PinType
  const uint32_t words = link.words ? uint32_t{RUNG_BOUND_REAL} : 0;
  const rung_variable variable{link.name.c_str(), &value, kTypes[static_cast<size_t>(link.type)], direction | words,
                               scale};
  check(rung_instance_bind(plc_.handle(), &variable, 1));
}

// A program runs without its recording, too. Returns why nothing is recorded; "": it is, or is not wanted.
std::string PlcHost::record() {
  if (recordingFolder_.empty()) return {};
  auto options = sized<rung_recording_options>();
  options.folder = recordingFolder_.c_str();
  options.limit_bytes = map_.recording.limitBytes;
  options.kept_bytes = map_.recording.keptBytes;
  return rung_instance_record(plc_.handle(), &options) == RUNG_OK ? "" : rung_error_text();
}

// A fault at power-on is noticed in the first step.
int32_t PlcHost::start(std::string& problem) {
  hasRun_ = false;
  const int32_t status = rung_instance_power_on(plc_.handle(), kept_ ? RUNG_WARM : RUNG_COLD);
  if (status < RUNG_OK) problem = rung_error_text();
  const bool first = !pins_.connected();
  for (const size_t link : toProgram_) beginWith(link, first);
  if (!first) pins_.write();
  return status;
}

// Pins that both sides write begin with the program's value; parameters keep the user's value.
void PlcHost::beginWith(size_t index, bool first) noexcept {
  const PinLink& link = binding_.links[index];
  const bool parameter = link.direction == Direction::Parameter && first;
  if (parameter && link.value)
    values_[index] = constant(link.type, *link.value);
  else if (parameter || link.direction == Direction::Io)
    values_[index] = valueInProgram(link);
  else
    return;
  if (!first) setPins(link, values_[index]);
}

Value PlcHost::valueInProgram(const PinLink& link) noexcept {
  rung_cell cell = 0;
  rung_cell_info info{};
  info.size = sizeof info;
  rung_value value{};
  const int32_t access = link.words ? RUNG_WRITE | RUNG_REAL : RUNG_WRITE;
  if (rung_instance_find(plc_.handle(), link.name.c_str(), access, &cell) != RUNG_OK ||
      rung_instance_cell(plc_.handle(), cell, &info) != RUNG_OK ||
      rung_instance_read(plc_.handle(), cell, 0, 1, &value) != RUNG_OK)
    return {};
  if (link.type != PinType::Float) return constant(link.type, static_cast<double>(value.integer));
  const double real = info.type == RUNG_TYPE_F64 ? value.real : static_cast<double>(value.integer);
  return {.real = real / link.scale};
}

void PlcHost::connect(const PinCell* cells, const PinAccess& access) noexcept {
  pins_.connect(cells, access);
  clearPins();
  for (const size_t i : toProgram_)
    if (binding_.links[i].direction != Direction::In) setPins(binding_.links[i], values_[i]);
  pins_.write();
}

std::string PlcHost::stopText(const rung_fault_info& fault) const {
  const rung_program_info program = plc_.program();
  const bool isOthers = program.faulted != 0;
  std::string text = isOthers ? "the program " + std::string(program.faulted_name) : "the program";
  text += " has stopped: " + std::string(fault.text) + "; output pins have their safe values until " + reset_;
  if (isOthers) text += "; then " + std::string(program.name) + " runs";
  return text;
}

// Reports each fault once.
void PlcHost::reportFault() {
  const std::optional<rung_fault_info> info = reported_ ? std::nullopt : fault(); // or the scan thread has it
  if (!info) return;
  reported_ = true;
  reports_.push_back({.kind = Report::Kind::Fault,
                      .text = stopText(*info),
                      .rung = info->rung,
                      .file = info->file,
                      .line = info->line});
}

void PlcHost::restart() {
  if (state_.load(std::memory_order_acquire) != State::Restarting) return;
  reportFault();
  functions_->restart();
  live_.served.store(false, std::memory_order_release); // the provider has commands of the run that has stopped
  std::string problem;
  const bool started = start(problem) >= RUNG_OK;
  if (!started) reports_.push_back({.text = problem});
  restartProblem_ = started ? "" : problem;
  for (std::string& text : std::exchange(logged_, {})) reports_.push_back({.text = std::move(text)});
  if (started) ++restarts_;
  reports_.push_back({.kind = Report::Kind::Restart,
                      .text = started ? "the program has been restarted" : "the program cannot be restarted"});
  reported_ = !started;
  state_.store(started ? State::Running : State::Stopped, std::memory_order_release);
}

// Reports when saving begins to fail, fails for another reason, or works again.
void PlcHost::reportSaving() {
  const std::string problem = plc_.unsaved().value_or("");
  if (unsaved_ == problem) return;
  unsaved_ = problem;
  reports_.push_back({.text = unsaved_.empty() ? "the retained memory is written again"
                                               : "the retained memory is not written: " + unsaved_});
}

// Reports when a recording begins to fail, fails for another reason, or works again; looks once a second.
void PlcHost::reportRecording() {
  const int64_t now = clock_.nowNs();
  constexpr int64_t kLookNs = 1'000'000'000;
  if (recordingFolder_.empty() || (recordingLookedNs_ && now - *recordingLookedNs_ < kLookNs)) return;
  recordingLookedNs_ = now;
  auto info = sized<rung_recording_info>();
  if (rung_instance_recording(plc_.handle(), &info) != RUNG_OK || recordingProblem_ == info.problem) return;
  recordingProblem_ = info.problem;
  reports_.push_back(
      {.text = recordingProblem_.empty() ? "the recording is written again" : "the recording: " + recordingProblem_});
}

bool PlcHost::serve(std::vector<Report>& reports) {
  const runtime::Alone::In service(serves_);
  restart();
  if (state_.load(std::memory_order_acquire) == State::Stopped) reportFault();
  if (kept_) reportSaving();
  reportRecording();
  std::ranges::move(reports_, std::back_inserter(reports));
  return !std::exchange(reports_, {}).empty();
}

CommandResult PlcHost::post(Command& command, std::chrono::milliseconds time) {
  const runtime::Alone::In service(serves_);
  if (ended()) return {RUNG_WRONG_STATE, "the program has been switched off"};
  CommandResult answer = commands_.give(command, time, clock_, [this] { restart(); });
  if (command.kind != Command::Kind::Restart || !answer.ok()) return answer;
  restart();
  if (restartProblem_.empty()) return answer;
  return {RUNG_FAILED, "the program cannot be restarted: " + restartProblem_};
}

namespace {

// The place of a name in the running or in the new program; nothing if it does not exist.
std::optional<rung_cell_info> placeOf(rung_instance* plc, const rung_replacement* in, const PinLink& link) {
  rung_cell_info info{};
  info.size = sizeof info;
  int64_t value = 0;
  const int32_t access = toProgram(link.direction) ? RUNG_WRITE : RUNG_READ;
  if (rung_instance_describe(plc, in, link.name.c_str(), access, &info, &value) != RUNG_OK) return std::nullopt;
  return info;
}

} // namespace

PlcHost::Losses PlcHost::lossesBy(const rung_replacement* replacement, const rung_program& next) const {
  Losses losses = lossesBy(replacement);
  bindMap(map_, plc_.handle(), replacement, next, losses.mistakes);
  return losses;
}

PlcHost::Losses PlcHost::lossesBy(const rung_replacement* replacement) const {
  Losses losses;
  for (size_t i = 0; i < binding_.links.size(); ++i) {
    const PinLink& link = binding_.links[i];
    const std::optional<rung_cell_info> now = placeOf(plc_.handle(), nullptr, link);
    const std::optional<rung_cell_info> later = placeOf(plc_.handle(), replacement, link);
    if (!now || (later && isSamePlace(*now, *later))) continue;
    losses.moved.push_back("pin " + map_.pins[link.pin].name + ": " + link.name +
                           (later ? " moves from " + std::string(now->address) + " to " + later->address
                                  : ", at " + std::string(now->address) + ", is gone"));
    rung_cell cell = 0;
    if (toProgram(link.direction) && rung_instance_find(plc_.handle(), link.name.c_str(), RUNG_WRITE, &cell) == RUNG_OK)
      losses.dead.push_back(cell); // the handle of a bound cell, which is not released
  }
  return losses;
}

std::string PlcHost::close() {
  std::string error;
  const int32_t status = rung_instance_power_off(plc_.handle());
  if (status < RUNG_OK && status != RUNG_WRONG_STATE) error = rung_error_text(); // the instance may already be off
  if (pins_.connected()) clearPins();
  return error;
}

bool PlcHost::powerOffDone() noexcept {
  ending_ = true;
  if (restarting()) return false;
  if (plc_.beginPowerOff()) return false;
  ended_.store(true, std::memory_order_release);
  // The control may have caused a fault in its first run: `serve` reports it like any other fault.
  if (running() && (state().flags & RUNG_STATE_FAULTED) != 0) stop();
  return true;
}

StepResult PlcHost::step(int64_t ns, bool reset) noexcept {
  const runtime::Alone::In scan(scans_);
  if (!beginStep(ns, reset)) return StepResult::Waiting;
  const StepResult result = run(ns, &rung_instance_run_due);
  sliceBegun_ = false;
  return result;
}

StepResult PlcHost::stepFast(int64_t ns, bool reset) noexcept {
  const runtime::Alone::In scan(scans_);
  if (!beginStep(ns, reset)) return StepResult::Waiting;
  const StepResult result = run(ns, &rung_instance_run_due_fast);
  sliceBegun_ = result == StepResult::Ran;
  return result;
}

// Returns false if the program does not run.
bool PlcHost::beginStep(int64_t ns, bool reset) noexcept {
  const bool resets = reset && restartable_ && !ending_;
  const bool asked = resets && !wasReset_;
  wasReset_ = resets;
  commands_.take([this](Command& command) { return execute(command); });
  const State state = state_.load(std::memory_order_acquire);
  if (state == State::Stopped) {
    functions_->age(ns);
    plc_.sample();
    if (asked) state_.store(State::Restarting, std::memory_order_release); // from now on `serve` has all of them
  }
  if (state != State::Running) return false;
  if (!map_.axisGroups.empty()) plc_.serving(live_.served.load(std::memory_order_acquire));
  pins_.read();
  functions_->sample(pins_, ns);
  return true;
}

// Begins functions and reads inputs before each slice.
StepResult PlcHost::run(int64_t ns, int32_t (*due)(rung_instance*, int64_t)) noexcept {
  const rung_state before = state();
  if (before.wait_ns <= ns && !sliceBegun_) {
    functions_->advance(pins_);
    readPins();
  }
  const int32_t status = due(plc_.handle(), ns);
  if (status == RUNG_FAULTED) {
    clearPins();
    stop();
    return StepResult::Failed;
  }
  const bool wasDue = before.wait_ns <= ns;
  hasRun_ = hasRun_ || (wasDue && (before.flags & RUNG_STATE_STOPPED) == 0);
  if (wasDue && hasRun_) writePins(); // a program that was stopped before its first slice has not written any
  pins_.write();
  return wasDue ? StepResult::Ran : StepResult::Waiting;
}

// Stops after a fault. `serve` gets the text, which needs memory: the size given here excludes it.
void PlcHost::stop() noexcept {
  rung_fault_info info{};
  info.size = offsetof(rung_fault_info, text);
  if (rung_instance_fault(plc_.handle(), &info) == RUNG_OK) faultLine_.store(info.line, std::memory_order_relaxed);
  state_.store(State::Stopped, std::memory_order_release);
}

rung_state PlcHost::state() const noexcept {
  rung_state state{};
  state.size = sizeof state;
  rung_instance_state(plc_.handle(), &state);
  return state;
}

std::optional<rung_fault_info> PlcHost::fault() const noexcept {
  rung_fault_info info{};
  info.size = sizeof info;
  return rung_instance_fault(plc_.handle(), &info) == RUNG_OK ? std::optional(info) : std::nullopt;
}

void PlcHost::readPins() noexcept {
  for (const size_t i : toProgram_) {
    const PinLink& link = binding_.links[i];
    values_[i] = link.bits.empty() ? pins_[link.pin] : bitsOf(link.bits, pins_);
  }
}

void PlcHost::writePins() noexcept {
  for (const size_t i : fromProgram_) setPins(binding_.links[i], values_[i]);
}

// Pins are only copied to a program that runs.
void PlcHost::lookAtOverwritten(std::span<bool> overwritten) const noexcept {
  if (!running() || !hasRun_ || (state().flags & RUNG_STATE_STOPPED) != 0) return;
  for (const auto& [i, cell] : fedBits_) {
    rung_value now{};
    if (rung_instance_read(plc_.handle(), cell, 0, 1, &now) != RUNG_OK) continue;
    const PinLink& link = binding_.links[i];
    if (link.bits.empty()) overwritten[link.pin] = (now.integer != 0) != values_[i].bit;
    for (size_t bit = 0; bit < link.bits.size(); ++bit)
      overwritten[link.bits[bit]] = ((static_cast<uint64_t>(now.integer) ^ values_[i].u32) >> bit & 1) != 0;
  }
}

void PlcHost::setPins(const PinLink& link, const Value& value) noexcept {
  if (link.bits.empty()) return pins_.set(link.pin, value);
  for (size_t bit = 0; bit < link.bits.size(); ++bit) pins_.set(link.bits[bit], {.bit = (value.u32 >> bit & 1) != 0});
}

void PlcHost::clearPins() noexcept {
  for (uint32_t i = 0; i < map_.pins.size(); ++i) {
    const Pin& pin = map_.pins[i];
    if (fromProgram(pin.direction) && !pin.holds && !pin.ofHost) pins_.set(i, constant(pin.type, pin.safe));
  }
  pins_.write();
}

bool PlcHost::nextMessage(rung_message_info& message) const noexcept {
  message.size = sizeof message;
  return rung_instance_next_message(plc_.handle(), &message) == RUNG_OK;
}

bool PlcHost::nextRequest(rung_request& request) const noexcept {
  request.size = sizeof request;
  return rung_instance_next_request(plc_.handle(), &request) == RUNG_OK;
}

CommandSlot::Outcome PlcHost::execute(Command& command) noexcept {
  using Kind = Command::Kind;
  const State now = state_.load(std::memory_order_acquire);
  if (now == State::Restarting) return {RUNG_LATER, "the program is being restarted"};
  if (command.kind == Kind::Restart) {
    if (ending_) return {RUNG_WRONG_STATE, "the program is being switched off"};
    if (now == State::Running)
      return {RUNG_WRONG_STATE, (state().flags & RUNG_STATE_STOPPED) != 0
                                    ? "the operator has stopped the program; start continues it"
                                    : "the program is running; a reset is needed only after a fault"};
    if (!restartable_) return {RUNG_LATER, "axes of the program are still moving"};
    state_.store(State::Restarting, std::memory_order_release);
    return {};
  }
  if (now == State::Stopped && (command.kind == Kind::Stop || command.kind == Kind::Start))
    return {RUNG_WRONG_STATE, "a fault has stopped the program: a reset restarts it"};
  const int32_t status = executeRunning(command);
  if (status == RUNG_OK || status == RUNG_EMPTY) return {status};
  const bool isOff = now == State::Stopped && (state().flags & RUNG_STATE_ON) == 0; // a restart has failed
  if (status == RUNG_FAULTED || isOff) return {status, "a fault has stopped the program: a reset restarts it"};
  return {status == RUNG_WRONG_THREAD ? int32_t{RUNG_LATER} : status, rung_error_text()}; // the service thread has it
}

// An input without a pin must not keep a value that permits something. If the new program cannot take over now, the pin
// feeds it again before the next slice.
int32_t PlcHost::replace(Command& command) noexcept {
  const rung_value none{};
  if (command.dead != nullptr)
    for (const rung_cell cell : *command.dead) rung_instance_write(plc_.handle(), cell, 0, 1, &none);
  const int32_t status = rung_instance_replace(plc_.handle(), command.replacement);
  command.state = state();
  return status;
}

int32_t PlcHost::executeRunning(Command& command) noexcept {
  rung_instance* plc = plc_.handle();
  switch (command.kind) {
  case Command::Kind::State:
    command.state = state();
    command.functions = functions_->state();
    return RUNG_OK;
  case Command::Kind::Write: {
    command.state = state();
    const int32_t status = rung_instance_read(plc, command.cell, 0, 1, &command.former);
    return status != RUNG_OK ? status : rung_instance_write(plc, command.cell, 0, 1, &command.value);
  }
  case Command::Kind::Forced:
    command.force.size = sizeof command.force;
    return rung_instance_forced(plc, command.index, &command.force);
  case Command::Kind::Force: return rung_instance_force(plc, command.forces);
  case Command::Kind::Replace: return replace(command);
  case Command::Kind::Shadow: return rung_instance_shadow(plc, command.shadow);
  case Command::Kind::Stop: return rung_instance_stop(plc);
  case Command::Kind::Start: return rung_instance_start(plc);
  case Command::Kind::Profile: return readProfile(plc, command);
  case Command::Kind::ClearProfile: return rung_instance_clear_profile(plc);
  case Command::Kind::Act: return command.act(command.actor), RUNG_OK;
  case Command::Kind::Restart: break; // handled by execute
  }
  return RUNG_EMPTY;
}

} // namespace rung::host

// The CNC beside a program of the PMC family: messages of the A area, window requests, machine positions, and in
// simulated mode the CNC itself (simulator.h). Presets of timers and counters are configured in the compiler, as
// initial contents of T and C.
#include "sim/pmc/simulated_pmc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/pmc/pmc_control.h"
#include "sim/keys.h"
#include "sim/pmc/simulator.h"
#include "sim/retained_tables.h"

namespace rung::sim::pmc {
namespace {

constexpr std::string_view kEvents[] = {"program", "mdi", "reset", "handwheel", "alarm"};

class SimulatedPmc final : public SimulatedNc {
public:
  std::string config(std::string_view key, std::string_view value) override;

  explicit SimulatedPmc(const Cnc& cnc) : cnc_(&cnc), control_(*cnc.model), simulator_(cnc) {
    waiting_.reserve(core::ServiceQueue::kMaxPending);
  }

  nc::Control& control() override { return control_; }
  const nc::Control& control() const override { return control_; }

  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override {
    SimulatedNc::powerOn(instance, kind);
    findPlaces(instance);
    if (simulated_) clearArea(instance, "F"); // the CNC is switched on, too
    simulator_.powerOn(kind == nc::PowerOn::Warm);
    waiting_.clear();
  }

  void programChanged(runtime::Instance& instance, const rung_program& former) override {
    const Relocation relocation(former, instance.program());
    for (Waiting& waiting : waiting_) relocation.renumber(waiting.request);
    findPlaces(instance);
  }

  void save(core::Saver& saver) const noexcept override {
    SimulatedNc::save(saver);
    saver(*this);
  }
  void load(runtime::Instance& instance, core::Loader& loader) override {
    SimulatedNc::load(instance, loader);
    loader(*this);
    for (Waiting& waiting : waiting_) instance.services().setName(waiting.request);
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(simulator_, waiting_, scriptedPositions_);
    archive.require(waiting_.size() <= core::ServiceQueue::kMaxPending);
  }

  // Called for every slice, which is a slot.
  void beforePart(runtime::Instance& instance) override {
    if (simulated_ && !instance.faulted()) {
      simulator_.setMessageAlarm(control_.showsAlarm(instance));
      simulator_.step(*control_.signals());
      answerLowSpeed(instance, *control_.signals());
    }
    writePositions(instance);
  }
  void afterPart(runtime::Instance& instance) override {
    SimulatedNc::afterPart(instance);
    takeRequests(instance);
  }

  std::vector<std::string_view> events() const override { return {std::begin(kEvents), std::end(kEvents)}; }
  std::string event(runtime::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override;

  std::string setQuantity(std::string_view name, double value) override {
    if (simulated_) return simulator_.setQuantity(name, value);
    const auto axis = axisOfPosition(name);
    if (!axis) return "the scripted NC has no variable 'NC." + std::string(name) + "'";
    scriptedPositions_[*axis] = value;
    return {};
  }
  std::optional<double> quantity(std::string_view name) const override {
    if (simulated_) return simulator_.quantity(name);
    const auto axis = axisOfPosition(name);
    return axis ? scriptedPositions_[*axis] : std::nullopt;
  }

protected:
  // A high-speed request is answered in the scan of the call (man. l.8505). Called if the scenario has prepared no
  // answer: in scripted mode the function is not provided (inventory §18).
  bool serve(runtime::Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    if (!isWindow(request)) return false;
    if (!isHighSpeed(static_cast<uint32_t>(request.args[0]))) return false;
    reply = answerOf(request, control_.signals());
    return true;
  }

private:
  struct Waiting {
    core::ServiceRequest request;
    uint32_t slots = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(request, slots);
    }
  };

  void findPlaces(runtime::Instance& instance) {
    const uint32_t space = runtime::findSpace(instance.program(), "@MPOS");
    for (uint32_t axis = 0; axis < kAxes; ++axis)
      positionPlaces_[axis] = space == RUNG_NONE ? core::Place() : instance.memory().locate(space, 4 * axis, 4);
  }

  // The axis, from 0, of MPOS.1 to MPOS.8.
  static std::optional<uint32_t> axisOfPosition(std::string_view name) {
    const auto axis = numbersAfter(name, "MPOS.");
    if (!axis || axis->size() != 1 || axis->front() < 1 || axis->front() > kAxes) return std::nullopt;
    return axis->front() - 1;
  }

  // Writes the positions that PSGNL and PSGN2 read: 8 positions of 4 bytes in 0.001 mm.
  void writePositions(runtime::Instance& instance) const {
    for (uint32_t axis = 0; axis < kAxes; ++axis) {
      const double position = simulated_ ? simulator_.machinePosition(axis) : scriptedPositions_[axis].value_or(0);
      instance.memory().write(positionPlaces_[axis], static_cast<uint64_t>(std::llround(position)));
    }
  }

  void takeRequests(runtime::Instance& instance) {
    core::ServiceRequest request;
    while (simulated_ && waiting_.size() < waiting_.capacity() && instance.services().take(request))
      waiting_.push_back({request, kLowSpeedSlots});
  }

  void answerLowSpeed(runtime::Instance& instance, const nc::pmc::SignalsIo& signals) {
    for (Waiting& waiting : waiting_) --waiting.slots;
    while (!waiting_.empty() && waiting_.front().slots == 0) {
      instance.services().complete(answerOf(waiting_.front().request, &signals));
      waiting_.erase(waiting_.begin());
    }
  }

  static bool isWindow(const core::ServiceRequest& request) {
    const auto kind = static_cast<nc::pmc::ServiceKind>(request.name->kind);
    return kind == nc::pmc::ServiceKind::ReadWindow || kind == nc::pmc::ServiceKind::WriteWindow;
  }

  // A function of another path, which the CNC does not have, is as fast as that of the first one.
  bool isHighSpeed(uint32_t code) const {
    const uint32_t ofPath = cnc_->windowsOfPath == 0 ? code : code % cnc_->windowsOfPath;
    const nc::pmc::WindowFunction* function = nc::pmc::findWindowFunction(cnc_->windowFunctions(), ofPath);
    return function != nullptr && function->speed == nc::pmc::WindowSpeed::High;
  }

  core::ServiceReply answerOf(const core::ServiceRequest& request, const nc::pmc::SignalsIo* signals) {
    core::ServiceReply reply = control_.refuse(request);
    if (simulated_ && isWindow(request)) simulator_.answer(request, *signals, reply);
    return reply;
  }

  static void clearArea(runtime::Instance& instance, const char* area) {
    const uint32_t space = runtime::findSpace(instance.program(), area);
    if (space == RUNG_NONE) return;
    for (uint32_t i = 0; i < instance.program().spaces[space].byte_count; ++i) instance.memory().writeByte(space, i, 0);
  }

  bool simulated_ = false;
  const Cnc* cnc_;
  nc::PmcControl control_;
  Simulator simulator_;
  std::vector<Waiting> waiting_; // low-speed window requests, oldest first; with room for kMaxPending
  std::array<core::Place, kAxes> positionPlaces_ = {};              // @MPOS
  std::array<std::optional<double>, kAxes> scriptedPositions_ = {}; // 0.001 mm
};

std::string SimulatedPmc::config(std::string_view key, std::string_view value) {
  const nc::ConfigKey* row = findConfigKey(cnc_->configKeys(), key);
  if (row == nullptr || row->reader != nc::ConfigReader::Control) return SimulatedNc::config(key, value);
  if (std::string wrong = wrongValue(*row, key, value); !wrong.empty()) return wrong;
  if (key == "axes") return simulator_.setAxes(value);
  if (key == "nc") simulated_ = value == "simulated";
  if (key == "overtravel") simulator_.setLimitSwitches(value == "on");
  if (key == "encoders") simulator_.setAbsoluteEncoders(value == "absolute");
  if (key == "protect") simulator_.setProtected(value == "on");
  if (key == "jog") simulator_.setJogSpeed(text::realIn(value).value_or(0));
  if (!key.starts_with("param.")) return {};
  // param.N for all axes, or param.N.A for axis A.
  const size_t dot = key.find('.', 6);
  const auto parameter = text::numberIn<uint32_t>(key.substr(6, dot == std::string_view::npos ? dot : dot - 6));
  const uint32_t axis = dot == std::string_view::npos ? 1 : text::numberIn<uint32_t>(key.substr(dot + 1)).value_or(0);
  if (!parameter) return std::string(key) + ": a parameter has a number, " + std::string(cnc_->exampleParameter);
  if (axis < 1 || axis > kAxes) return std::string(key) + ": there are axes 1 to 8";
  simulator_.setParameter(*parameter, axis - 1, text::realIn(value).value_or(0));
  return {};
}

std::string SimulatedPmc::event(runtime::Instance& instance, std::string_view name,
                                const std::vector<NcArgument>& keys) {
  if (std::ranges::find(kEvents, name) == std::end(kEvents)) return SimulatedNc::event(instance, name, keys);
  if (!simulated_) return "event " + std::string(name) + " needs 'config nc simulated'";
  if (name == "program" || name == "mdi") {
    if (std::string wrong = unknownKey(name, keys, {"blocks", "block"}); !wrong.empty()) return wrong;
    const NcArgument* blocks = findKey(keys, findKey(keys, "blocks") != nullptr ? "blocks" : "block");
    if (blocks == nullptr || !blocks->isText) return "event " + std::string(name) + " takes blocks=\"...\"";
    return simulator_.loadProgram(blocks->text, name == "mdi");
  }
  if (name == "reset") {
    if (std::string wrong = unknownKey(name, keys, {}); !wrong.empty()) return wrong;
    simulator_.pressReset();
    return {};
  }
  if (name == "alarm") {
    if (std::string wrong = unknownKey(name, keys, {"number"}); !wrong.empty()) return wrong;
    const NcArgument* alarm = findKey(keys, "number");
    if (alarm == nullptr || alarm->integer <= 0 || alarm->integer > UINT32_MAX) return "event alarm takes number=N";
    simulator_.raiseAlarm(static_cast<uint32_t>(alarm->integer));
    return {};
  }
  if (std::string wrong = unknownKey(name, keys, {"pulses", "wheel"}); !wrong.empty()) return wrong;
  const NcArgument* pulses = findKey(keys, "pulses");
  const NcArgument* wheel = findKey(keys, "wheel");
  const int64_t which = wheel == nullptr ? 1 : wheel->integer;
  if (pulses == nullptr || which < 1 || which > 2) return "event handwheel takes pulses=N and wheel=1 or wheel=2";
  simulator_.turnWheel(static_cast<uint32_t>(which), pulses->integer);
  return {};
}

} // namespace

std::unique_ptr<SimulatedNc> makeSimulatedPmc(const Cnc& cnc) { return std::make_unique<SimulatedPmc>(cnc); }

} // namespace rung::sim::pmc

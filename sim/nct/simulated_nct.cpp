// The simulated NC of an NCT PLC: axes are assigned to the PLC on request, and in simulated mode the whole machine is
// simulated (nct/simulator.h).
#include <algorithm>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/control/nct/nct_control.h"
#include "rtlib/nc/nct/signals.h"
#include "sim/nct/simulator.h"
#include "sim/simulated_nc.h"

namespace rung::sim {
namespace {

constexpr std::string_view kCancel = "cancel"; // also with `nc scripted`

class SimulatedNct final : public SimulatedNc {
public:
  std::string config(std::string_view key, std::string_view value) override;

  nc::Control& control() override { return control_; }
  const nc::Control& control() const override { return control_; }

  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override {
    log_.clear();
    if (nvramLost_) control_.reportRetainedLost();
    control_.prepare(instance, kind);
    if (kind == nc::PowerOn::Warm && byEthercat_) loseRetained(instance);
    control_.signals().set(onSimulator_, true);
    control_.signals().set(nvramByEthercat_, byEthercat_);
    if (ran_) ownAcknowledge_ = 0; // written before the first power-on, it stays
    ran_ = false;
    requested_ = 0;
    if (simulated_)
      simulator_.powerOn(instance, control_.signals(), std::exchange(restored_, false) ? nc::PowerOn::Warm : kind);
    control_.start(instance);
  }

  void programChanged(runtime::Instance& instance, const rung_program&) override {
    simulator_.programChanged(instance, control_.signals());
  }

  void save(core::Saver& saver) const noexcept override {
    SimulatedNc::save(saver);
    saver(*this);
  }
  void load(runtime::Instance& instance, core::Loader& loader) override {
    SimulatedNc::load(instance, loader);
    loader(*this);
    simulator_.nameRequests(instance.services());
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(ran_, ownAcknowledge_, requested_);
    if (simulated_) archive(simulator_);
  }

  uint32_t retainedSize() override {
    nct::Retained size = nct::Retained::measure();
    if (simulated_) simulator_.retain(size);
    return size.size();
  }
  void copyRetained(std::span<uint8_t> image) noexcept override {
    nct::Retained save = nct::Retained::save(image);
    simulator_.retain(save);
  }
  void restoreRetained(std::span<const uint8_t> image) override {
    simulator_.deliver();
    if (image.empty()) return;
    nct::Retained restore = nct::Retained::restore(image);
    simulator_.retain(restore);
    restored_ = true;
  }

  void onHook(runtime::Instance& instance, uint32_t work) override {
    control_.onHook(instance, work);
    const bool first = control_.slice() == nc::nct::Messages::Slice::First;
    ran_ = ran_ || first;
    if (simulated_)
      simulator_.timeSlice(instance, first);
    else if (first)
      giveAxes();
  }

  void afterPart(runtime::Instance& instance) override {
    SimulatedNc::afterPart(instance);
    if (simulated_ && !instance.faulted()) simulator_.betweenScans(instance);
  }

  void setRealTime() override { simulator_.setRealTime(); }

  std::vector<std::string_view> events() const override {
    std::vector<std::string_view> names = simulator_.events();
    names.push_back(kCancel);
    return names;
  }
  std::string event(runtime::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override {
    if (name == kCancel) return cancel(keys);
    if (simulated_)
      if (nct::Handled handled = simulator_.event(name, keys)) return *handled;
    const bool known = std::ranges::any_of(events(), [&](std::string_view event) { return event == name; });
    return known ? "event " + std::string(name) + " needs 'config nc simulated'"
                 : SimulatedNc::event(instance, name, keys);
  }

  std::string setQuantity(std::string_view name, double value) override {
    if (!simulated_) return SimulatedNc::setQuantity(name, value);
    if (nct::Handled handled = simulator_.setQuantity(name, value)) return *handled;
    return "the simulated NC has no variable 'NC." + std::string(name) + "' to be set";
  }
  std::optional<double> quantity(std::string_view name) const override {
    return simulated_ ? simulator_.quantity(name) : SimulatedNc::quantity(name);
  }

  std::optional<runtime::Ref> writePlace(const rung_program& program, std::string_view name) const override {
    const std::optional<runtime::Ref> place = control_.writePlace(program, name);
    if (place) noteWritten(*place);
    return place;
  }

protected:
  bool serve(runtime::Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    return simulated_ && simulator_.respond(request, reply);
  }

private:
  // Controls whose non-volatile memory is on EtherCAT do not retain PLCNVRAM (man. l.8061).
  static void loseRetained(runtime::Instance& instance) {
    std::vector<uint8_t> nothing(instance.retainedSize());
    instance.restoreRetained(nothing);
  }

  // In scripted mode an axis is assigned to the PLC on request, unless the scenario changes that afterwards (inventory
  // 8).
  void giveAxes() {
    for (uint32_t i = 0; i < plcAxis_.count(); ++i) {
      const bool request = control_.signals().get(plcAxisRequest_, i);
      if (request == ((requested_ >> i & 1) != 0)) continue;
      requested_ ^= uint32_t{1} << i;
      if ((ownAcknowledge_ >> i & 1) == 0) control_.signals().set(plcAxis_, i, request);
    }
  }

  // The operator's buttons: CANCEL for the top message, with NUMBER, CHANNEL and INDEX for a selected one, with ALL=1
  // for all.
  std::string cancel(const std::vector<NcArgument>& keys) {
    if (std::string wrong = unknownKey(kCancel, keys, {"number", "channel", "index", "all"}); !wrong.empty())
      return wrong;
    nc::nct::Messages& list = control_.list();
    const auto key = [&](std::string_view name) { return static_cast<uint32_t>(integerKey(keys, name, 0)); };
    if (findKey(keys, "number") != nullptr)
      return list.cancel(nc::nct::messageCode(key("number"), key("channel"), key("index")))
                 ? ""
                 : "event cancel: this message is not displayed";
    if (key("all") != 0)
      list.cancelAll();
    else
      list.cancelTop();
    return {};
  }

  // If the scenario writes AN_PLCA of an axis, it acknowledges this axis from then on.
  void noteWritten(const runtime::Ref& place) const {
    const nc::Signal& acknowledge = *findSignal(nc::nctSignals(), "AN_PLCA");
    const uint32_t first = acknowledge.byteOffset + acknowledge.bit / 8;
    if (place.kind != runtime::RefKind::Bit || place.bit != acknowledge.bit % 8 || place.byte < first) return;
    const uint32_t axis = (place.byte - first) / acknowledge.strideBytes;
    if ((place.byte - first) % acknowledge.strideBytes == 0 && axis < acknowledge.count)
      ownAcknowledge_ |= uint32_t{1} << axis;
  }

  bool simulated_ = false;
  bool byEthercat_ = false;
  bool nvramLost_ = false;
  bool restored_ = false;
  nc::nct::BitSignal onSimulator_{"N_SIMU"};
  nc::nct::BitSignal nvramByEthercat_{"N_NVECAT"};
  nc::nct::BitSignal plcAxisRequest_{"AP_PLCR"};
  nc::nct::BitSignal plcAxis_{"AN_PLCA"};
  nc::NctControl control_;
  nct::Simulator simulator_;
  bool ran_ = false;                    // a cycle has run since the power-on
  mutable uint32_t ownAcknowledge_ = 0; // axes whose AN_PLCA the scenario writes
  uint32_t requested_ = 0;              // AP_PLCR of the last cycle, a bit for each axis
};

std::string SimulatedNct::config(std::string_view key, std::string_view value) {
  const nc::ConfigKey* row = findConfigKey(nc::nctConfigKeys(), key);
  if (row == nullptr || row->reader != nc::ConfigReader::Control) return SimulatedNc::config(key, value);
  if (std::string wrong = wrongValue(*row, key, value); !wrong.empty()) return wrong;
  if (key == "nc") simulated_ = value == "simulated";
  if (key == "nvecat") byEthercat_ = value == "on";
  if (key == "nvram") nvramLost_ = value == "lost";
  if (key == "nc" || key == "nvecat" || key == "nvram") return {};
  return simulator_.config(key, value).value_or("there is no '" + std::string(key) + "'");
}

} // namespace

std::unique_ptr<SimulatedNc> makeSimulatedNct() { return std::make_unique<SimulatedNct>(); }

} // namespace rung::sim

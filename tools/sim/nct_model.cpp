// The NC beside an NCT PLC: constant and clock signals, the hardware side of the NC area (the time-slice memory), and
// in simulated mode the control itself (nct/simulator.h).
#include <algorithm>
#include <utility>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/config_key.h"
#include "tools/sim/nc_model.h"
#include "tools/sim/nct/messages.h"
#include "tools/sim/nct/simulator.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::nc {
namespace {

using nct::BitSignal;
using nct::SignalMemory;

// Clock signals with their periods, 50 % duty (man. 7.12, l.7892-7896).
struct Clock {
  BitSignal signal;
  int64_t periodUs;
};

// The signals that the model itself writes, in both modes.
struct CommonSignals {
  BitSignal on{"N_ON"};
  BitSignal simulator{"N_SIMU"};
  BitSignal ready{"N_NCREADY"};
  BitSignal nvramOk{"N_NVRAMOK"};
  BitSignal nvramByEthercat{"N_NVECAT"};
  BitSignal firstCycle{"N_FIRSTCC"};
  BitSignal timeSliceClock{"N_P2MS"};
  BitSignal cycleClock{"N_P2T"};
  Clock clocks[3] = {
      {BitSignal("N_P100MS"), 100'000}, {BitSignal("N_P1S"), 1'000'000}, {BitSignal("N_P1M"), 60'000'000}};
  BitSignal bufferEmpty{"AN_BEPTY"};
  BitSignal motionDone{"AN_IEPTY"};
  BitSignal plcAxisRequest{"AP_PLCR"};
  BitSignal plcAxis{"AN_PLCA"};
};

uint32_t hooksOf(const rung_program& program) {
  uint32_t hooks = 0;
  for (uint32_t i = 0; i < program.scan_count; ++i)
    if (program.scan[i].op == RUNG_STEP_HOOK) ++hooks;
  return hooks;
}

class NctModel final : public NcModel {
public:
  std::string config(std::string_view key, std::string_view value) override;

  void powerOn(host::Instance& instance, PowerOn kind) override {
    NcModel::powerOn(instance, kind);
    if (kind == PowerOn::Warm && byEthercat_) loseRetained(instance);
    ts_ = SignalMemory(instance);
    slicesOfCycle_ = hooksOf(instance.program());
    if (cycles_ != 0) ownAcknowledge_ = 0; // pins are bound before the first power-on
    timeSlices_ = cycles_ = slice_ = 0;
    requested_ = 0;
    messages_.powerOn(instance);
    writeConstants();
    if (simulated_) simulator_.powerOn(instance, std::exchange(keptRestored_, false) ? PowerOn::Warm : kind);
    retainedLost_ = false;
    showInputs(instance);
  }

  uint32_t keptSize() override {
    nct::Kept size = nct::Kept::measure();
    if (simulated_) simulator_.keep(size);
    return size.size();
  }
  void copyKept(std::span<uint8_t> image) noexcept override {
    nct::Kept save = nct::Kept::save(image);
    simulator_.keep(save);
  }
  void restoreKept(std::span<const uint8_t> image) override {
    simulator_.deliver();
    if (image.empty()) return;
    nct::Kept restore = nct::Kept::restore(image);
    simulator_.keep(restore);
    keptRestored_ = true;
  }
  void reportRetainedLost() override { retainedLost_ = true; }

  // In front of every time slice, while NC inputs go to the time-slice memory. The first one of a scan begins a PLC
  // cycle; a time slice that the scenario runs by itself (`fast`) belongs to none.
  void onHook(host::Instance& instance, uint32_t) override {
    const bool first = !instance.atListStart() && slice_++ % std::max(slicesOfCycle_, 1u) == 0;
    if (first) beginCycle();
    ts_.set(common_.timeSliceClock, ++timeSlices_ % 2 != 0);
    for (const Clock& clock : common_.clocks)
      ts_.set(clock.signal, instance.nowUs() % clock.periodUs >= clock.periodUs / 2);
    takeMessages(instance);
    using Slice = nct::Messages::Slice;
    messages_.timeSlice(ts_,
                        instance.atListStart() ? Slice::Alone
                        : first                ? Slice::First
                                               : Slice::Further,
                        instance.messages().lost());
    if (simulated_) simulator_.timeSlice(instance, first);
  }

  void scan(host::Instance& instance) override {
    NcModel::scan(instance);
    messages_.endCycle();
    answer(instance);
  }
  void slot(host::Instance& instance) override {
    NcModel::slot(instance);
    messages_.endCycle();
    answer(instance);
  }
  void fast(host::Instance& instance) override {
    NcModel::fast(instance);
    answer(instance);
  }
  void betweenSlices(host::Instance& instance) override {
    simulator_.setRealTime();
    answer(instance);
  }

  bool respond(host::Instance&, const rt::ServiceRequest& request, rt::ServiceReply& reply) override {
    return simulated_ && simulator_.respond(request, reply);
  }

  void takeMessages(host::Instance& instance) override {
    rung_message message;
    while (instance.messages().pop(message)) {
      if (message.op == RUNG_MESSAGE_SHOW_LOG || message.op == RUNG_MESSAGE_LOG)
        board_.log(nct::logLine(instance.program(), message));
      messages_.accept(message);
    }
  }
  void accept(const rung_message& message) override { messages_.accept(message); }
  std::vector<ShownMessage> messages(const host::Instance& instance) const override {
    return messages_.shown(instance.program());
  }

  std::string event(host::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override {
    if (name == "cancel") return messages_.cancel(keys);
    if (!simulated_) return NcModel::event(instance, name, keys) + "; most events need 'config nc simulated'";
    if (nct::Handled handled = simulator_.event(name, keys)) return *handled;
    return NcModel::event(instance, name, keys);
  }

  std::string setQuantity(std::string_view name, double value) override {
    if (!simulated_) return NcModel::setQuantity(name, value);
    if (nct::Handled handled = simulator_.setQuantity(name, value)) return *handled;
    return "the simulated NC has no quantity 'NC." + std::string(name) + "' to be set";
  }
  std::optional<double> quantity(std::string_view name) const override {
    return simulated_ ? simulator_.quantity(name) : NcModel::quantity(name);
  }

  // The NC and the hardware write the time-slice memory; the program sees it at the next synchronisation.
  std::optional<host::Ref> writePlace(const host::Instance& instance, std::string_view name) const override {
    std::optional<host::Ref> place = readPlace(instance, name);
    const uint32_t memory = host::findSpace(instance.program(), "M");
    const uint32_t slice = host::findSpace(instance.program(), "TS");
    if (place && slice != RUNG_NONE && place->space == memory && place->byte >= 8 &&
        place->byte < instance.program().spaces[slice].byte_count)
      place->space = slice;
    if (place) noteWritten(*place);
    return place;
  }

protected:
  std::optional<host::Ref> signal(const host::Instance& instance, std::string_view name) const override {
    const Signal* found = findSignal(nctSignals(), name);
    if (found == nullptr) return std::nullopt;
    const uint32_t memory = host::findSpace(instance.program(), "M");
    if (found->type == SignalType::Bit) return host::bitRef(memory, found->byteOffset, found->bit);
    host::Ref place = found->type == SignalType::Real ? host::realRef(memory, found->byteOffset)
                                                      : host::intRef(memory, found->byteOffset, 32);
    place.count = found->count;
    return place;
  }

private:
  void writeConstants() {
    for (const BitSignal& signal : {common_.on, common_.simulator, common_.ready, common_.nvramOk, common_.firstCycle})
      ts_.set(signal, true);
    if (nvramLost_ || retainedLost_) ts_.set(common_.nvramOk, false);
    ts_.set(common_.nvramByEthercat, byEthercat_);
    for (uint32_t i = 0; i < common_.bufferEmpty.count(); ++i) {
      ts_.set(common_.bufferEmpty, i, true);
      ts_.set(common_.motionDone, i, true);
    }
  }

  // At power-on both memories hold what the NC says.
  static void showInputs(host::Instance& instance) {
    const uint32_t memory = host::findSpace(instance.program(), "M");
    const uint32_t slice = host::findSpace(instance.program(), "TS");
    if (memory == RUNG_NONE || slice == RUNG_NONE) return;
    const uint32_t end = areaBytes(nctSignals(), "M");
    for (uint32_t byte = 8; byte < end; ++byte)
      instance.memory().writeByte(memory, byte, instance.memory().readByte(slice, byte));
  }

  // Controls whose non-volatile memory lies on EtherCAT do not keep PLCNVRAM (man. l.8061).
  static void loseRetained(host::Instance& instance) {
    std::vector<uint8_t> nothing(instance.retainedSize());
    instance.restoreRetained(nothing);
  }

  void beginCycle() {
    ts_.set(common_.firstCycle, cycles_ == 0);
    ts_.set(common_.cycleClock, cycles_++ % 2 != 0);
    if (simulated_) return;
    // Scripted, an axis goes to the PLC on request, unless the scenario says otherwise afterwards (inventory 8).
    for (uint32_t i = 0; i < common_.plcAxis.count(); ++i) {
      const bool request = ts_.get(common_.plcAxisRequest, i);
      if (request == ((requested_ >> i & 1) != 0)) continue;
      requested_ ^= uint32_t{1} << i;
      if ((ownAcknowledge_ >> i & 1) != 0) continue;
      ts_.set(common_.plcAxis, i, request);
    }
  }

  // Whoever writes AN_PLCA of an axis acknowledges it from then on.
  void noteWritten(const host::Ref& place) const {
    const Signal& acknowledge = *findSignal(nctSignals(), "AN_PLCA");
    const uint32_t first = acknowledge.byteOffset + acknowledge.bit / 8;
    if (place.kind != host::RefKind::Bit || place.bit != acknowledge.bit % 8 || place.byte < first) return;
    const uint32_t axis = (place.byte - first) / acknowledge.strideBytes;
    if ((place.byte - first) % acknowledge.strideBytes == 0 && axis < acknowledge.count)
      ownAcknowledge_ |= uint32_t{1} << axis;
  }

  void answer(host::Instance& instance) {
    if (simulated_ && !instance.faulted()) simulator_.betweenScans(instance);
  }

  bool simulated_ = false;
  bool byEthercat_ = false;
  bool nvramLost_ = false;    // by configuration
  bool retainedLost_ = false; // the image on disk
  bool keptRestored_ = false;
  CommonSignals common_;
  SignalMemory ts_;
  nct::Simulator simulator_;
  nct::Messages messages_;
  uint64_t timeSlices_ = 0;
  uint64_t cycles_ = 0;
  uint32_t slice_ = 0;                  // of all PLC cycles
  uint32_t slicesOfCycle_ = 0;          // of one
  mutable uint32_t ownAcknowledge_ = 0; // axes whose AN_PLCA the scenario writes
  uint32_t requested_ = 0;              // AP_PLCR of the cycle before, a bit an axis
};

std::string NctModel::config(std::string_view key, std::string_view value) {
  const ConfigKey* row = findConfigKey(nctConfigKeys(), key);
  if (row == nullptr || row->reader != ConfigReader::Control) return NcModel::config(key, value);
  if (std::string wrong = wrongValue(*row, key, value); !wrong.empty()) return wrong;
  if (key == "nc") simulated_ = value == "simulated";
  if (key == "nvecat") byEthercat_ = value == "on";
  if (key == "nvram") nvramLost_ = value == "lost";
  if (key == "nc" || key == "nvecat" || key == "nvram") return {};
  return simulator_.config(key, value).value_or("there is no '" + std::string(key) + "'");
}

} // namespace

std::unique_ptr<NcModel> makeNctModel() { return std::make_unique<NctModel>(); }

} // namespace rung::nc

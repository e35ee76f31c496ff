// The NC beside an NCT PLC: constant and clock signals, and the hardware side of the NC area (the time-slice memory).
#include "rtlib/host/program_info.h"
#include "rtlib/nc/model/nc_model.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::nc {
namespace {

// Clock signals with their periods, 50 % duty (man. 7.12, l.7892-7896).
struct Clock {
  const char* symbol;
  int64_t periodUs;
};
constexpr Clock kClocks[] = {{"N_P100MS", 100'000}, {"N_P1S", 1'000'000}, {"N_P1M", 60'000'000}};
constexpr const char* kAlwaysOn[] = {"N_ON", "N_SIMU", "N_NCREADY", "N_NVRAMOK"};
constexpr const char* kAxisOn[] = {"AN_BEPTY", "AN_IEPTY"};

class NctModel final : public NcModel {
public:
  // The compiler takes PLCNVRAM, PLCRAM and timeslice; nothing is left for the NC.
  std::string config(std::string_view key, std::string_view value) override { return NcModel::config(key, value); }

  void powerOn(host::Instance& instance, PowerOn kind) override {
    NcModel::powerOn(instance, kind);
    timeSlices_ = cycles_ = 0;
    for (const char* symbol : kAlwaysOn) setBoth(instance, symbol, 0, true);
    for (const char* symbol : kAxisOn)
      if (const Signal* axis = findSignal(nctSignals(), symbol))
        for (uint32_t i = 0; i < axis->count; ++i) setBoth(instance, symbol, i, true);
    setBoth(instance, "N_FIRSTCC", 0, true);
  }

  // In front of every time slice, while NC inputs go to the time-slice memory.
  void onHook(host::Instance& instance, uint32_t) override {
    ++timeSlices_;
    set(instance, "N_P2MS", timeSlices_ % 2 != 0);
    set(instance, "N_P2T", cycles_ % 2 != 0);
    for (const Clock& clock : kClocks)
      set(instance, clock.symbol, instance.nowUs() % clock.periodUs >= clock.periodUs / 2);
    board_.take(instance);
    set(instance, "N_MSGA", !board_.shown().empty());
    set(instance, "N_MSG0", !board_.shown().empty());
  }

  void scan(host::Instance& instance) override {
    NcModel::scan(instance);
    ++cycles_;
    set(instance, "N_FIRSTCC", false);
  }

  // The NC and the hardware write the time-slice memory; the program sees it at the next synchronisation.
  std::optional<host::Ref> writePlace(const host::Instance& instance, std::string_view name) const override {
    std::optional<host::Ref> place = readPlace(instance, name);
    const uint32_t memory = host::findSpace(instance.program(), "M");
    const uint32_t slice = host::findSpace(instance.program(), "TS");
    if (place && slice != RUNG_NONE && place->space == memory && place->byte >= 8 &&
        place->byte < instance.program().spaces[slice].byte_count)
      place->space = slice;
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
  static void write(host::Instance& instance, const char* space, const char* symbol, uint32_t index, bool value) {
    const Signal* found = findSignal(nctSignals(), symbol);
    const uint32_t area = host::findSpace(instance.program(), space);
    if (found == nullptr || area == RUNG_NONE) return;
    const uint32_t byte = found->byteOffset + index * found->strideBytes;
    if (byte + 4 <= instance.program().spaces[area].byte_count)
      instance.write(host::bitRef(area, byte, found->bit), value ? 1 : 0);
  }
  static void set(host::Instance& instance, const char* symbol, bool value) { write(instance, "TS", symbol, 0, value); }
  // At power-on both memories hold what the NC says.
  static void setBoth(host::Instance& instance, const char* symbol, uint32_t index, bool value) {
    write(instance, "TS", symbol, index, value);
    write(instance, "M", symbol, index, value);
  }

  uint64_t timeSlices_ = 0;
  uint64_t cycles_ = 0;
};

} // namespace

std::unique_ptr<NcModel> makeNctModel() { return std::make_unique<NctModel>(); }

} // namespace rung::nc

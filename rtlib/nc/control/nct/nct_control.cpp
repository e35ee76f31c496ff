// Signals, messages and names of NCT (see nct_control.h).
#include "rtlib/nc/control/nct/nct_control.h"

#include <algorithm>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/nct.h"
#include "rtlib/nc/nct/messages.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::nc {
namespace {

constexpr uint32_t kFirstNcByte = 8; // words 0000 and 0001 belong to the program

uint32_t hooksOf(const rung_program& program) {
  const std::span steps(program.scan, program.scan_count);
  return static_cast<uint32_t>(std::ranges::count(steps, RUNG_STEP_HOOK, &rung_step::op));
}

struct NctPlaces final : Places {
  explicit NctPlaces(const rung_program& program)
      : timeSlice(program, nct::kTimeSliceSpace), slicesOfCycle(std::max(hooksOf(program), 1u)), messages(program) {}

  nct::PackedSpace timeSlice;
  uint32_t slicesOfCycle;
  nct::Messages::Places messages;
};

} // namespace

// N_SIMU stays 0: the software does not run on the manufacturer's simulator (man. l.7927).
void NctControl::prepare(runtime::Instance& instance, PowerOn kind) {
  messages_.powerOn(); // forgets earlier messages without clearing them
  Control::prepare(instance, kind);
  timeSlices_ = cycles_ = 0;
  for (NctFunctions& channel : functions_) channel.powerOn(instance);
  writeConstants();
  retainedLost_ = false;
}

std::unique_ptr<Places> NctControl::locate(const rung_program& program) const {
  return std::make_unique<NctPlaces>(program);
}

// Called between two scans, so the next time slice is the first of a cycle.
void NctControl::usePlaces(runtime::Instance& instance, Places& places) noexcept {
  auto& of = static_cast<NctPlaces&>(places);
  ts_ = nct::SignalMemory(instance, of.timeSlice);
  slicesOfCycle_ = of.slicesOfCycle;
  slice_ = 0;
  messages_.use(instance, of.messages);
  for (NctFunctions& channel : functions_) channel.use(ts_);
}

void NctControl::writeConstants() {
  for (const nct::BitSignal& signal : {on_, ready_, nvramOk_, firstCycle_}) ts_.set(signal, true);
  if (retainedLost_) ts_.set(nvramOk_, false);
  for (uint32_t i = 0; i < bufferEmpty_.count(); ++i) {
    ts_.set(bufferEmpty_, i, true);
    ts_.set(motionDone_, i, true);
  }
}

void NctControl::start(runtime::Instance& instance) {
  const uint32_t memory = runtime::findSpace(instance.program(), "M");
  const uint32_t slice = runtime::findSpace(instance.program(), "TS");
  if (memory == RUNG_NONE || slice == RUNG_NONE) return;
  const uint32_t end = areaBytes(nctSignals(), "M");
  for (uint32_t byte = kFirstNcByte; byte < end; ++byte)
    instance.memory().writeByte(memory, byte, instance.memory().readByte(slice, byte));
}

// The first time slice of a scan begins a PLC cycle; a time slice that is run separately belongs to none.
void NctControl::onHook(runtime::Instance& instance, uint32_t) {
  using Slice = nct::Messages::Slice;
  if (instance.atListStart())
    now_ = Slice::Alone;
  else
    now_ = slice_++ % slicesOfCycle_ == 0 ? Slice::First : Slice::Further;
  nct::SignalWord common(ts_, timeSliceClock_);
  if (now_ == Slice::First) beginCycle(common);
  common.set(timeSliceClock_, ++timeSlices_ % 2 != 0);
  for (const Clock& clock : clocks_) common.set(clock.signal, instance.nowUs() % clock.periodUs >= clock.periodUs / 2);
  messages_.timeSlice(ts_, common, now_, instance.messages().lost());
  common.write();
}

void NctControl::beginCycle(nct::SignalWord& common) {
  common.set(firstCycle_, cycles_ == 0);
  common.set(cycleClock_, cycles_++ % 2 != 0);
}

void NctControl::afterSlice(runtime::Instance& instance) {
  if (instance.atListStart()) messages_.endCycle();
}

std::optional<runtime::Ref> NctControl::writePlace(const rung_program& program, std::string_view name) const {
  const std::optional<runtime::Ref> place = readPlace(program, name);
  return place ? std::optional(nctTimeSlicePlace(program, *place)) : std::nullopt;
}

// Signals on which programs rely (man. 7.12, l.7892-7901), except N_NCREADY and N_NVRAMOK, which a host may set.
bool NctControl::writesItself(const rung_program& program, const runtime::Ref& place) const {
  constexpr std::string_view kOwn[] = {"N_ON", "N_OFF", "N_FIRSTCC", "N_P2MS", "N_P2T", "N_P100MS", "N_P1S", "N_P1M"};
  const auto first = [](const runtime::Ref& ref) { return uint64_t{8} * ref.byte + ref.bit; };
  return std::ranges::any_of(kOwn, [&](std::string_view name) {
    const std::optional<runtime::Ref> own = writePlace(program, name);
    return own && own->space == place.space && first(place) <= first(*own) &&
           first(*own) < first(place) + uint64_t{place.width} * place.count;
  });
}

size_t NctControl::describe(const rung_program& program, const rung_message& message,
                            std::span<char> out) const noexcept {
  return nct::logLine(program, message, out);
}

} // namespace rung::nc

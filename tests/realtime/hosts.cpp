// See hosts.h.
#include "tests/realtime/hosts.h"

#include <functional>

#include "machine/host/plc_host.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/run/realtime.h"
#include "tests/realtime/guard.h"
#include "tests/realtime/places.h"
#include "tests/support/fake_clock.h"

namespace rung::test {
namespace {

constexpr int64_t kNsInMs = 1'000'000;

std::string inSlice(uint64_t slice, const std::string& offences) {
  return offences.empty() ? std::string() : "slice " + std::to_string(slice) + ": " + offences;
}

// ---- LinuxCNC ----

union PinValue {
  bool bit;
  int32_t s32;
  uint32_t u32;
  double real = 0;
};

// Pins as HAL would have them.
class Pins {
public:
  explicit Pins(const std::vector<host::Pin>& pins) : pins_(pins), values_(pins.size()) {
    for (PinValue& value : values_) cells_.push_back({.any = &value});
  }
  const host::PinCell* cells() const { return cells_.data(); }

  void toggle() {
    for (size_t i = 0; i < pins_.size(); ++i)
      if (host::toProgram(pins_[i].direction)) toggle(pins_[i].type, values_[i]);
  }
  // The first pin that has another value there; "" where none has.
  std::string difference(const Pins& other) const {
    for (size_t i = 0; i < pins_.size(); ++i)
      if (values_[i].u32 != other.values_[i].u32) return pins_[i].name;
    return {};
  }

private:
  void toggle(host::PinType type, PinValue& value) {
    switch (type) {
    case host::PinType::Bit: value.bit = toggles_.next(value.bit); return;
    case host::PinType::S32: value.s32 = toggles_.nextNumber(value.s32); return;
    case host::PinType::U32:
      value.u32 = static_cast<uint32_t>(toggles_.nextNumber(static_cast<int32_t>(value.u32)));
      return;
    case host::PinType::Float: value.real = toggles_.nextNumber(static_cast<int32_t>(value.real)); return;
    }
  }

  const std::vector<host::Pin>& pins_;
  std::vector<PinValue> values_;
  std::vector<host::PinCell> cells_;
  Toggles toggles_;
};

uint64_t shown = 0;

// As the component prints it.
void describe(const nc::Control& control, const rung_program& program, const rung_message& message) {
  ++shown;
  char line[nc::kMessageLine];
  line[control.describe(program, message, std::span(line).first(sizeof line - 1))] = '\0';
}

// ---- a host of its own ----

class Bare {
public:
  Bare(const rung_program& program, const std::string& retain)
      : control_(nc::makeControl(program.dialect)), instance_(program, control_.get()),
        retention_(*control_, instance_, retain), inputs_(instance_, *control_, namesOf(instance_, *control_).inputs) {
    std::string report;
    std::string error;
    const auto kind = retention_.load(report, error);
    if (kind)
      control_->powerOn(instance_, *kind);
    else
      outcome_.problem = error;
  }

  runtime::Instance& instance() { return instance_; }
  Guard& guard() { return guard_; }
  Outcome& outcome() { return outcome_; }

  // All that follows the slice, in real time.
  void afterSlice() {
    control_->afterSlice(instance_);
    retention_.afterSlice();
    rung_message message;
    while (instance_.messages().pop(message)) {
      control_->accept(message);
      describe(*control_, instance_.program(), message);
      ++outcome_.messages;
    }
    ++outcome_.slices;
  }

  // Not in real time.
  void betweenSlices() {
    outcome_.problem = inSlice(outcome_.slices, guard_.offences());
    inputs_.toggle(instance_);
    if (!instance_.faulted()) return;
    ++outcome_.faults;
    control_->powerOn(instance_, nc::PowerOn::Warm);
  }

  bool goesOn() const { return outcome_.problem.empty() && instance_.nowUs() < int64_t{kRunMs} * 1000; }

  Outcome end() {
    const std::string error = retention_.finish();
    if (outcome_.problem.empty()) outcome_.problem = error;
    return outcome_;
  }

private:
  std::unique_ptr<nc::Control> control_;
  runtime::Instance instance_;
  nc::Retention retention_;
  Inputs inputs_;
  Guard guard_;
  Outcome outcome_;
};

} // namespace

Outcome runInBox(const rung_program& program, host::File map, const std::string& retain) {
  Outcome outcome;
  std::vector<std::string> errors;
  std::vector<std::string> reports;
  const std::unique_ptr<host::PlcHost> host =
      host::PlcHost::make(Image::adopt(program), std::move(map), {.retain = retain}, errors, reports);
  for (const std::string& error : errors) outcome.problem += error + "\n";
  if (!host) return outcome;
  Pins pins(host->pins());
  host->connect(pins.cells());
  Guard guard;
  bool reset = false;
  for (int ms = 0; ms < kRunMs && outcome.problem.empty(); ++ms) {
    pins.toggle();
    host::StepResult result;
    {
      const Guarded realTime(guard);
      if (host->running()) host->setTimeLimit(1000 * kNsInMs);
      host->prefetch(runtime::monotonicNs() + kNsInMs); // as rung-run does with --early
      result = host->step(kNsInMs, reset);
    }
    outcome.problem = inSlice(outcome.slices, guard.offences());
    outcome.slices += result == host::StepResult::Ran ? 1 : 0;
    outcome.faults += result == host::StepResult::Failed ? 1 : 0;
    reset = !host->running() && !reset;
    std::vector<host::Report> served;
    host->serve(served);
    rung_message_info message{};
    while (host->nextMessage(message)) ++outcome.messages;
  }
  const std::string error = host->close();
  if (outcome.problem.empty()) outcome.problem = error;
  return outcome;
}

Outcome runFastApart(const rung_program& program, const host::File& map) {
  Outcome outcome;
  std::vector<std::string> reports;
  const std::unique_ptr<host::PlcHost> whole = host::PlcHost::make(Image::adopt(program), map, {}, reports, reports);
  const std::unique_ptr<host::PlcHost> apart = host::PlcHost::make(Image::adopt(program), map, {}, reports, reports);
  Pins wholePins(whole->pins());
  Pins apartPins(apart->pins());
  whole->connect(wholePins.cells());
  apart->connect(apartPins.cells());
  Guard guard;
  bool reset = false;
  for (int ms = 0; ms < kRunMs && outcome.problem.empty(); ++ms) {
    wholePins.toggle();
    apartPins.toggle();
    outcome.slices += whole->step(kNsInMs, reset) == host::StepResult::Ran ? 1 : 0;
    {
      const Guarded realTime(guard);
      apart->stepFast(kNsInMs, reset);
      apart->step(0, reset);
    }
    outcome.problem = inSlice(outcome.slices, guard.offences());
    if (const std::string pin = wholePins.difference(apartPins); !pin.empty())
      outcome.problem = inSlice(outcome.slices, "pin " + pin + " differs");
    outcome.faults += whole->running() ? 0 : 1;
    reset = !whole->running() && !reset;
    std::vector<host::Report> served;
    whole->serve(served);
    apart->serve(served);
  }
  return outcome;
}

Outcome runBare(const rung_program& program, const std::string& retain) {
  Bare bare(program, retain);
  while (bare.goesOn()) {
    {
      const Guarded realTime(bare.guard());
      bare.instance().slice();
      bare.afterSlice();
    }
    bare.betweenSlices();
  }
  return bare.end();
}

Outcome runOnClock(const rung_program& program, const std::string& retain) {
  Bare bare(program, retain);
  FakeClock clock(bare.instance().nowUs() * 1000);
  const std::function<bool()> keepGoing = [&] {
    bare.afterSlice();
    bare.guard().exit();
    bare.betweenSlices();
    clock.setLateness(bare.outcome().slices % 400 == 0 ? 350 * kNsInMs : 0); // scans are left out, too
    bare.guard().enter();
    return bare.goesOn();
  };
  while (bare.goesOn()) {
    {
      const Guarded realTime(bare.guard());
      runtime::runRealTime(bare.instance(), [&] { bare.instance().slice(); }, keepGoing);
    }
    bare.betweenSlices(); // after a fault
  }
  return bare.end();
}

host::File mapOfAll(const rung_program& program) {
  const std::unique_ptr<nc::Control> control = nc::makeControl(program.dialect);
  const runtime::Instance instance(program, control.get());
  return mapOf(namesOf(instance, *control));
}

} // namespace rung::test

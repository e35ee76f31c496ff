// Start, stop and end of the PLC program (see program_life.h).
#include "rtlib/nc/control/technol/program_life.h"

namespace rung::nc::technol {
namespace {

enum : uint64_t { kPower = 0, kCommand = 1 }; // in DR (man. l.2583, l.2627)

} // namespace

const ProgramLife::Places ProgramLife::kNothing{};

ProgramLife::Places::Places(const rung_program& program)
    : done(program, "DONE"), donePending(locateCell(program, "@DONE.PENDING")) {}

void ProgramLife::powerOn(runtime::Instance& instance) {
  stopping_ = false;
  instance.setStopped(false);
  runWith(instance, "INIT", kPower, false);
}

bool ProgramLife::donePending(const runtime::Instance& instance) const {
  return instance.memory().read(places_->donePending) != 0;
}

// A stopped program has already been shut down.
bool ProgramLife::powerOff(runtime::Instance& instance) {
  if (instance.stopped()) return false;
  places_->done.run(instance, kPower, false);
  return donePending(instance);
}

void ProgramLife::start(runtime::Instance& instance) {
  stopping_ = false;
  instance.setStopped(false);
  runWith(instance, "INIT", kCommand, false);
}

void ProgramLife::stop(runtime::Instance& instance) {
  if (instance.stopped() || stopping_) return;
  places_->done.run(instance, kCommand, false);
  stopping_ = true;
  afterScan(instance);
}

void ProgramLife::clear(runtime::Instance& instance) { runWith(instance, "CLEAR", 0, false); }

void ProgramLife::afterScan(runtime::Instance& instance) {
  if (!stopping_ || donePending(instance)) return;
  stopping_ = false;
  instance.setStopped(true);
}

} // namespace rung::nc::technol

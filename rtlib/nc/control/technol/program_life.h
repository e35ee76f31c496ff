// Start, stop and end of the PLC program: MODULE_INIT, MODULE_DONE, MODULE_CLEAR and the waits for MODULE_x_FINISHED
// (man. l.2556-2649).
#pragma once
#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc::technol {

class ProgramLife {
public:
  // The places for the end of one program.
  class Places {
  public:
    Places() = default; // a program without these
    explicit Places(const rung_program& program);

  private:
    friend class ProgramLife;
    Procedure done;
    core::Place donePending;
  };

  // Sets the places of the running program, which outlive their use.
  void use(const Places& places) { places_ = &places; }

  template <class Archive>
  void state(Archive& archive) {
    archive(stopping_);
  }

  // Called after the reset of the memory. Runs MODULE_INIT with DR = 0: the control was switched on.
  void powerOn(runtime::Instance& instance);
  // Runs MODULE_DONE with DR = 0. True: the program has to continue, because MODULE_DONE_FINISHED is pending.
  bool powerOff(runtime::Instance& instance);
  bool donePending(const runtime::Instance& instance) const;

  // The commands START PLC and STOP PLC (DR = 1), and CLEAR.
  void start(runtime::Instance& instance);
  void stop(runtime::Instance& instance);
  void clear(runtime::Instance& instance);
  // Called after a scan: stops the program when the end of its shutdown is no longer pending.
  void afterScan(runtime::Instance& instance);

private:
  static const Places kNothing;

  const Places* places_ = &kNothing;
  bool stopping_ = false;
};

} // namespace rung::nc::technol

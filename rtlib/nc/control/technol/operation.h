// What the control does with the part program while its host moves the axes: START and STOP with their events (man.
// l.1625-1644, 6396-6500), blocks with motion (l.2682-2711), and the enabling of the axes that follows from all of
// that (MPX to MP6, l.6227).
//
// The host says by the status bits of the interface (8.3.6, l.7254-7317) what it does:
//   SF_RUN         a part program runs, also while it is stopped
//   SF_STOP        it is stopped
//   SF_NOTINPOS    a motion is under way, or waits for MPX to MP6
//   SF_MANUALMODE  axes are moved by hand: motions are not blocks
// It moves no axis whose MPx is 0, and stops when PO_STOP comes.
#pragma once
#include <array>

#include "rtlib/nc/control/technol/blocks.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc::technol {

// What _ON_EVENT has in DR (l.1638-1644).
enum class PlcEvent : uint8_t { StopRequest = 1, EmergencyStopRequest, Stop, Start, StartRequest };

class Operation {
  static constexpr uint32_t kAxes = 6; // that have an MPx

public:
  // Where one program has the cells.
  class Places {
  public:
    Places() = default; // a program that has none of them
    explicit Places(const rung_program& program);

  private:
    friend class Operation;
    struct Axis {
      rt::Place allowed, enabled; // MPxPI, MPx
    };
    rt::Place runs, stopped, moves, byHand; // of the host
    rt::Place rapid, thread;                // G00PI, G33PI
    rt::Place stop, stopRequest, emergencyRequest;
    rt::Place startDisable, startSuspend, stopDone;
    rt::Place handEnabled, handSelect, handCancel;
    rt::Place homed, homingRequest, zeroRequest;
    rt::Place automatic; // AUTPI
    std::array<Axis, kAxes> axes;
    Procedure onEvent;
  };

  explicit Operation(Blocks& blocks) : blocks_(blocks) {}
  // At power-on: nothing runs.
  void reset();
  // Those of the program that runs now, which outlive their use.
  void use(const Places& places) { places_ = &places; }

  // Before a pass, when the host has written its signals.
  void beforePass(host::Instance& instance);
  // After a slice, for a host that has called beforePass.
  void afterSlice(host::Instance& instance) const;

private:
  void send(host::Instance& instance, PlcEvent event) const;
  void takeRequests(host::Instance& instance);
  void stop(host::Instance& instance, PlcEvent request);
  void askForStart(host::Instance& instance);
  void start(host::Instance& instance);
  void follow(host::Instance& instance, bool moves);
  void endHoming(host::Instance& instance);
  bool get(const host::Instance& instance, const rt::Place& place) const { return instance.memory().read(place) != 0; }

  static const Places kNothing;

  Blocks& blocks_;
  const Places* places_ = &kNothing;
  bool runs_ = false;    // a program, or a block of MDI
  bool stopped_ = false; // SF_STOP
  bool asked_ = false;   // START_REQ is out, START is not
  bool moves_ = false;   // the block under way is a motion
  bool stopKey_ = false; // STOPPI
  uint64_t homed_ = 0;
};

} // namespace rung::nc::technol

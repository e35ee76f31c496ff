// The control's handling of the part program while its host moves the axes: START and STOP with their events (man.
// l.1625-1644, 6396-6500), blocks with motion (l.2682-2711), and the resulting enabling of the axes (MPX to MP6,
// l.6227). Scan thread.
//
// The host reports its state by the status bits of the interface (8.3.6, l.7254-7317):
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

// The events that _ON_EVENT gets in DR (l.1638-1644).
enum class PlcEvent : uint8_t { StopRequest = 1, EmergencyStopRequest, Stop, Start, StartRequest };

class Operation {
  static constexpr uint32_t kAxes = 6; // axes with an MPx

public:
  // The places of the cells in one program.
  class Places {
  public:
    Places() = default; // a program without these cells
    explicit Places(const rung_program& program);

  private:
    friend class Operation;
    struct Axis {
      core::Place allowed, enabled; // MPxPI, MPx
    };
    core::Place runs, stopped, moves, byHand; // written by the host
    core::Place rapid, thread;                // G00PI, G33PI
    core::Place stop, stopRequest, emergencyRequest;
    core::Place startDisable, startSuspend, stopDone;
    core::Place handEnabled, handSelect, handCancel;
    core::Place homed, homingRequest, zeroRequest;
    core::Place automatic; // AUTPI
    std::array<Axis, kAxes> axes;
    Procedure onEvent;
  };

  explicit Operation(Blocks& blocks) : blocks_(blocks) {}
  // At power-on: nothing runs.
  void reset();
  // Sets the places of the running program, which outlive their use.
  void use(const Places& places) { places_ = &places; }

  template <class Archive>
  void state(Archive& archive) {
    archive(runs_, stopped_, asked_, moves_, stopKey_, homed_);
  }

  // Called before a scan, when the host has written its signals.
  void beforeScan(runtime::Instance& instance);
  // Called after a slice, by a host that calls beforeScan.
  void afterSlice(runtime::Instance& instance) const;

private:
  void send(runtime::Instance& instance, PlcEvent event) const;
  void takeRequests(runtime::Instance& instance);
  void stop(runtime::Instance& instance, PlcEvent request);
  void askForStart(runtime::Instance& instance);
  void start(runtime::Instance& instance);
  void follow(runtime::Instance& instance, bool moves);
  void endHoming(runtime::Instance& instance);
  bool get(const runtime::Instance& instance, const core::Place& place) const {
    return instance.memory().read(place) != 0;
  }

  static const Places kNothing;

  Blocks& blocks_;
  const Places* places_ = &kNothing;
  bool runs_ = false;    // a part program or an MDI block is running
  bool stopped_ = false; // SF_STOP
  bool asked_ = false;   // START_REQ has been sent, START has not
  bool moves_ = false;   // the block under way is a motion
  bool stopKey_ = false; // STOPPI
  uint64_t homed_ = 0;
};

} // namespace rung::nc::technol

// The part of a channel's part program besides the functions: modal codes, motions of its axes, dwells, and the signals
// that report them (man. l.9578-9730). All axes of a block start and end together; circles are chords.
#pragma once
#include <array>

#include "sim/nct/channel_functions.h"
#include "sim/nct/topic.h"
#include "sim/part_program.h"

namespace rung::sim::nct {

class ChannelMotion {
public:
  ChannelMotion(Links& links, uint32_t channel, const ChannelSignals& signals, const ChannelParameters& parameters)
      : links_(links), channel_(channel), signals_(signals), parameters_(parameters) {}

  // Resets modal codes to those after power-on: G0, G90, G94, G97; G20 and G21 stay (`powerOn`: G21).
  void reset(bool powerOn);
  // A program begins at the current positions of the axes.
  void begin();
  // Prepares motion and dwell of a block. `locked`: the axes do not move, but the time passes (machine lock, test).
  void prepare(const ProgramBlock& block, bool locked);
  bool done() const { return next_ >= count_ && dwellUs_ <= 0 && !checking_; }

  // To be called before a PLC cycle; continues the block while the program runs, and writes its signals.
  void cycle(bool running, int64_t us);
  // To be called before a time slice: holds the axes that must not move.
  void timeSlice(bool running) const;

  // `interrupt` ends the block's motion; `resume` continues it, after a return to its start or to the point of
  // interruption.
  void interrupt();
  void resume(bool toStart, bool toInterruption);
  void cancel();

  double value(const ProgramValue& value) const;
  uint32_t spindle() const; // machining spindle, from 0: CP_SINP, otherwise N0604
  bool overrideDisabled() const { return overrideOff_ || (under() & kThread) != 0 || (under() & kTap) != 0; }
  bool moving() const { return next_ < count_; }
  bool machining() const;                           // moving at a feed that is not held
  int32_t axisOf(char letter) const;                // axis of the channel, from 0; negative: none
  bool takesSpeed(const ProgramBlock& block) const; // S is the surface speed of G96 or the limit of G92

  template <class Archive>
  void state(Archive& archive) {
    archive(motion_, modes_, surface_, exactStop_, overrideOff_, polygon_, gearBox_, highSpeed_, surfaceSpeed_,
            speedLimit_, commanded_, blockStart_, interruption_, way_, started_, locked_, checking_, restUs_, dwellUs_);
    archive.atMost(count_, kWaypoints);
    archive.atMost(next_, kWaypoints);
  }

private:
  // Flags of a waypoint.
  static constexpr uint32_t kFeed = 1 << 0;
  static constexpr uint32_t kThread = 1 << 1;
  static constexpr uint32_t kThreadCycle = 1 << 2;
  static constexpr uint32_t kTap = 1 << 3;
  static constexpr uint32_t kRigid = 1 << 4;
  static constexpr uint32_t kReference = 1 << 5;
  static constexpr uint32_t kSkip = 1 << 6;
  static constexpr uint32_t kExact = 1 << 7; // G9, G61, or positioning with N1337 #0 PCH

  using Position = std::array<double, nc::nct::kAxes>;
  struct Waypoint {
    Position target{};
    uint32_t axes = 0; // mask
    uint32_t flags = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(target, axes, flags);
    }
  };
  static constexpr uint32_t kWaypoints = 6;

  struct Words { // words of one block
    Position target{};
    uint32_t axes = 0;
    bool machine = false, reference = false, skip = false, exact = false, dwell = false;
    double time = 0, speedLimit = -1, height = 0;
  };
  Words read(const ProgramBlock& block);
  void takeCode(int tenths, Words& words);
  void takeAxis(char letter, double value, Words& words);
  void plan(const Words& words);
  void planDrilling(const Words& words);
  void add(uint32_t axes, const Position& target, uint32_t flags);
  void start();
  void command(const Waypoint& waypoint) const;
  double feed() const;
  bool arrived(const Waypoint& waypoint) const;
  uint32_t under() const { return next_ < count_ ? way_[next_].flags : 0; }
  double way(const Waypoint& waypoint) const;
  void showSignals() const;
  void showSurfaceSpeed() const;

  Links& links_;
  uint32_t channel_;
  const ChannelSignals& signals_;
  const ChannelParameters& parameters_;

  // Modal
  int motion_ = 0; // tenths of the G code
  PathModes modes_;
  bool surface_ = false, exactStop_ = false, overrideOff_ = false;
  bool polygon_ = false, gearBox_ = false, highSpeed_ = false;
  double surfaceSpeed_ = 0, speedLimit_ = 0;

  Position commanded_{}; // machine coordinates, at the end of the blocks so far
  Position blockStart_{};
  Position interruption_{};
  std::array<Waypoint, kWaypoints> way_{};
  uint32_t count_ = 0;
  uint32_t next_ = 0;
  bool started_ = false; // the axes have their commands
  bool locked_ = false;
  bool checking_ = false; // CN_POSCHK
  double restUs_ = 0;     // remaining time of a locked motion
  int64_t dwellUs_ = 0;
};

} // namespace rung::sim::nct

// The motion of one axis along an ideal trapezoid: ramps of constant acceleration and runs of constant speed. A motion
// is planned once, as phases that follow each other, and looked at in each step of time by closed formulas, so nothing
// accumulates and the end is exact. Lengths in mm (degrees), times in seconds.
#pragma once
#include <array>
#include <cstdint>

namespace rung::io {

class Motion {
public:
  static constexpr int64_t kTickNs = 1'000'000;

  double position() const { return position_; }
  double speed() const { return speed_; } // per second, signed
  bool isAtRest() const { return speed_ == 0 && time_ >= duration_; }
  bool isAtRestAt(double place) const { return isAtRest() && position_ == place; }
  // Seconds from where the motion was planned to its end; infinite for a run.
  double duration() const { return duration_; }

  // Rests there.
  void place(double position);

  // Orders. One that is given again while it is carried out changes nothing; another one begins from the position and
  // speed of now. Accelerations are positive.
  void stop(double acceleration) { run(0, acceleration); }
  // By a ramp to a signed speed, which it keeps.
  void run(double speed, double acceleration);
  // To a target, by at most `speed`; a target that it cannot brake for is passed and come back to.
  void moveTo(double target, double speed, double acceleration);
  // Runs past a position, which lies in the direction of the signed speed and not within `inRange`, and brakes from
  // there: stops v * v / 2a after it.
  void runPast(double position, double speed, double acceleration);
  // Where it would begin to move in the direction of the signed speed, and no faster.
  double inRange(double speed, double acceleration) const;

  // So much time passes, at least 0.
  void advance(int64_t ns);
  // A millisecond.
  void tick() { advance(kTickNs); }

private:
  enum class Kind : uint8_t { None, Run, To, Past };
  struct Order {
    Kind kind = Kind::None;
    double place = 0, speed = 0, acceleration = 0;
    bool operator==(const Order&) const = default;
  };
  struct Phase {
    double begin = 0, position = 0, speed = 0, acceleration = 0; // at its begin
  };

  bool isNew(const Order& order);
  void rampTo(double speed, double acceleration);
  void cruise(double distance);
  void append(double seconds, double acceleration, double endPosition, double endSpeed);
  void approach(double target, double speed, double acceleration);
  // Phases end here; at `position`, which is what they come to but for the last digits.
  void end(double position, double speed);

  static constexpr uint32_t kPhases = 6;
  double position_ = 0, speed_ = 0;
  Order order_;
  std::array<Phase, kPhases> phases_ = {};
  uint32_t count_ = 0, phase_ = 0;
  Phase last_;     // where planning has got to, then the end
  int64_t ns_ = 0; // since it was planned
  double time_ = 0, duration_ = 0;
};

} // namespace rung::io

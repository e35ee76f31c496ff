// Motions and modal codes of a channel (see channel_motion.h).
#include "sim/nct/channel_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/nct/axes.h"
#include "sim/nct/bits.h"
#include "sim/nct/parameters.h"
#include "sim/nct/spindles.h"

namespace rung::sim::nct {
namespace {

constexpr double kLeastFeed = 1e-9; // 0 would be rapid traverse
constexpr double kMinuteUs = 60e6;

bool isDrilling(int motion) { return motion == 740 || motion == 840 || motion == 842 || motion == 843; }

} // namespace

void ChannelMotion::reset(bool powerOn) {
  motion_ = 0;
  modes_ = {.inch = modes_.inch && !powerOn, .feed = modes_.feed};
  surface_ = exactStop_ = overrideOff_ = polygon_ = gearBox_ = highSpeed_ = false;
  cancel();
}

void ChannelMotion::begin() {
  for (uint32_t axis = 0; axis < nc::nct::kAxes; ++axis) commanded_[axis] = links_.axes->machinePosition(axis);
  cancel();
}

void ChannelMotion::cancel() {
  interrupt();
  count_ = next_ = 0;
  dwellUs_ = 0;
  checking_ = false;
}

double ChannelMotion::value(const ProgramValue& value) const {
  if (value.variable == 0) return value.number;
  return links_.macros->programRead(value.variable, channel_).value_or(0);
}

uint32_t ChannelMotion::spindle() const {
  const int32_t machining = links_.signals.get(signals_.machiningSpindle, channel_);
  const int32_t number = machining != 0 ? machining : links_.parameters->dword(parameters_.defaultSpindle, channel_);
  return number >= 1 && number <= static_cast<int32_t>(nc::nct::kSpindles) ? static_cast<uint32_t>(number) - 1 : 0;
}

// The axis of a letter; negative if there is none. The address of an auxiliary function is not an axis.
int32_t ChannelMotion::axisOf(char letter) const {
  for (const ParameterPlace& place : parameters_.auxiliary)
    if (links_.parameters->dword(place, channel_) == letter) return -1;
  for (uint32_t axis = 0; axis < nc::nct::kAxes; ++axis)
    if (links_.parameters->dword(parameters_.axisName, axis) == letter && links_.axes->exists(axis) &&
        links_.axes->channelOf(axis) == channel_)
      return static_cast<int32_t>(axis);
  return -1;
}

bool ChannelMotion::takesSpeed(const ProgramBlock& block) const {
  return surface_ || std::ranges::any_of(block.words, [&](const ProgramWord& word) {
           return word.letter == 'G' && value(word.value) == 92;
         });
}

// ---- words -------------------------------------------------------------------------------------------------------

void ChannelMotion::takeCode(int tenths, Words& words) {
  modes_.take(tenths);
  switch (tenths) {
  case 0:
  case 10:
  case 20:
  case 30:
  case 330:
  case 740:
  case 780:
  case 840:
  case 842:
  case 843: motion_ = tenths; break;
  case 800: motion_ = isDrilling(motion_) ? 0 : motion_; break;
  case 40: words.dwell = true; break;
  case 51: highSpeed_ = true; break;
  case 90: words.exact = true; break;
  case 280: words.reference = true; break;
  case 310: words.skip = true; break;
  case 502:
  case 512: polygon_ = tenths == 512; break;
  case 530: words.machine = true; break;
  case 610:
  case 620:
  case 630:
  case 640:
    exactStop_ = tenths == 610;
    overrideOff_ = tenths == 630;
    break;
  case 808:
  case 818: gearBox_ = tenths == 818; break;
  case 920: words.speedLimit = 0; break;
  case 960:
  case 970: surface_ = tenths == 960; break;
  default: break; // planes, compensations, zero points have no effect here
  }
}

void ChannelMotion::takeAxis(char letter, double value, Words& words) {
  const int32_t found = axisOf(letter);
  if (found < 0) return;
  const auto axis = static_cast<uint32_t>(found);
  const bool rotary = letter >= 'A' && letter <= 'C';
  const double length = rotary ? value : modes_.length(value);
  words.axes |= uint32_t{1} << axis;
  words.target[axis] = words.machine ? length : modes_.target(length, commanded_[axis], links_.axes->zeroPoint(axis));
}

ChannelMotion::Words ChannelMotion::read(const ProgramBlock& block) {
  Words words;
  words.target = commanded_;
  for (const ProgramWord& word : block.words)
    if (word.letter == 'G') takeCode(static_cast<int>(std::lround(value(word.value) * 10)), words);
  for (const ProgramWord& word : block.words) {
    const double number = value(word.value);
    switch (word.letter) {
    case 'G': break;
    case 'F': modes_.feed = modes_.length(number); break;
    case 'P': words.time = number; break;
    case 'R': words.height = modes_.length(number); break;
    case 'S':
      if (words.speedLimit >= 0)
        speedLimit_ = number;
      else if (surface_)
        surfaceSpeed_ = number;
      break;
    default: takeAxis(word.letter, number, words);
    }
  }
  return words;
}

// ---- the path of a block -----------------------------------------------------------------------------------------

void ChannelMotion::add(uint32_t axes, const Position& target, uint32_t flags) {
  if (axes == 0 || count_ >= kWaypoints) return;
  way_[count_++] = {target, axes, flags};
}

void ChannelMotion::prepare(const ProgramBlock& block, bool locked) {
  count_ = next_ = 0;
  locked_ = locked;
  started_ = false;
  blockStart_ = commanded_;
  const Words words = read(block);
  if (words.dwell) {
    dwellUs_ = static_cast<int64_t>(words.time * 1e6); // G4 P in seconds
    return;
  }
  plan(words);
  if (count_ != 0) commanded_ = way_[count_ - 1].target;
}

void ChannelMotion::plan(const Words& words) {
  const bool check = words.exact || exactStop_;
  const bool positioningCheck = check || links_.parameters->bit(parameters_.execution, 0, channel_);
  if (words.reference) { // through the point of the block to the first reference position
    add(words.axes, words.target, kReference);
    Position home = words.target;
    forBits(words.axes, [&](uint32_t axis) { home[axis] = links_.parameters->real(parameters_.reference1, axis); });
    return add(words.axes, home, kReference);
  }
  if (words.skip) return add(words.axes, words.target, kFeed | kSkip | (check ? kExact : 0));
  if (motion_ == 0 || words.machine) return add(words.axes, words.target, positioningCheck ? kExact : 0);
  if (isDrilling(motion_)) return planDrilling(words);
  if (motion_ == 330) return add(words.axes, words.target, kFeed | kThread);
  if (motion_ == 780) { // one cut and the return
    add(words.axes, words.target, kFeed | kThread | kThreadCycle);
    return add(words.axes, blockStart_, 0);
  }
  add(words.axes, words.target, kFeed | (check ? kExact : 0));
}

// Moves above the hole, to R, in and out with the tap.
void ChannelMotion::planDrilling(const Words& words) {
  const int32_t found = axisOf('Z');
  if (words.axes == 0) return;
  if (found < 0) return add(words.axes, words.target, kFeed);
  const auto z = static_cast<uint32_t>(found);
  const uint32_t depth = uint32_t{1} << z;
  Position above = words.target;
  above[z] = commanded_[z];
  add(words.axes & ~depth, above, 0);
  if ((words.axes & depth) == 0) return;
  above[z] = modes_.target(words.height, commanded_[z], links_.axes->zeroPoint(z));
  Position bottom = above;
  bottom[z] = words.target[z];
  const uint32_t tap = kFeed | kTap | (motion_ == 842 || motion_ == 843 ? kRigid : 0);
  add(depth, above, 0);
  add(depth, bottom, tap);
  add(depth, above, tap);
}

// ---- motion ------------------------------------------------------------------------------------------------------

double ChannelMotion::way(const Waypoint& waypoint) const {
  double sum = 0;
  forBits(waypoint.axes, [&](uint32_t axis) {
    const double part = waypoint.target[axis] - (locked_ ? blockStart_[axis] : links_.axes->machinePosition(axis));
    sum += part * part;
  });
  return std::sqrt(sum);
}

// The feed per minute, before the override, which the axes apply.
double ChannelMotion::feed() const {
  const SignalMemory& signals = links_.signals;
  double feed = modes_.feedPerMinute(links_.spindles->speed(spindle()));
  if (signals.get(signals_.toggle[2], channel_)) feed = links_.parameters->real(parameters_.maxFeed, 0); // dry run
  if (signals.get(signals_.rapidKey, channel_)) feed *= links_.parameters->real(parameters_.feedFactor, channel_);
  const double override = signals.get(signals_.feedOverride, channel_);
  if (overrideDisabled() && override > 0) feed /= override;
  return feed;
}

void ChannelMotion::command(const Waypoint& waypoint) const {
  const double length = way(waypoint);
  forBits(waypoint.axes, [&](uint32_t axis) {
    const double part = std::abs(waypoint.target[axis] - links_.axes->machinePosition(axis));
    if (part < kNear) return;
    const double speed =
        (waypoint.flags & kFeed) != 0 ? std::max(feed() * part / std::max(length, kNear), kLeastFeed) : 0;
    links_.axes->moveTo(axis, waypoint.target[axis], speed);
  });
}

void ChannelMotion::start() {
  const Waypoint& waypoint = way_[next_];
  started_ = true;
  if (locked_) {
    // In test mode all motions have the highest feed, else only positioning.
    const bool fast = (waypoint.flags & kFeed) == 0 || links_.signals.get(signals_.toggle[0], channel_);
    const double perMinute = fast ? links_.parameters->real(parameters_.maxFeed, 0) : feed();
    restUs_ = way(waypoint) / std::max(perMinute, kLeastFeed) * kMinuteUs;
    return;
  }
  command(waypoint);
}

bool ChannelMotion::arrived(const Waypoint& waypoint) const {
  if (locked_) return restUs_ <= 0;
  bool there = true;
  forBits(waypoint.axes, [&](uint32_t axis) { there = there && !links_.axes->moving(axis); });
  return there;
}

bool ChannelMotion::machining() const {
  if ((under() & kFeed) == 0) return false;
  const SignalMemory& signals = links_.signals;
  return signals.get(signals_.feedEnabled, channel_) && !signals.get(signals_.hold, channel_) &&
         !signals.get(signals_.holdAll) && signals.get(signals_.feedOverride, channel_) > 0;
}

void ChannelMotion::timeSlice(bool running) const {
  const bool waits = (under() & kFeed) != 0 && !links_.signals.get(signals_.feedEnabled, channel_); // l.9659
  links_.axes->setProgramHold(channel_, !running || waits);
}

void ChannelMotion::cycle(bool running, int64_t us) {
  checking_ = false;
  if (running && dwellUs_ > 0) dwellUs_ -= us;
  if (running && next_ < count_) {
    const bool feeds = (under() & kFeed) != 0;
    if (!started_) {
      start();
    } else if (locked_) {
      if (!feeds || machining())
        restUs_ -= static_cast<double>(us) * (feeds ? links_.signals.get(signals_.feedOverride, channel_) : 1);
    } else if (feeds && !arrived(way_[next_])) {
      command(way_[next_]); // follows spindle speed, override and rapid key
    }
    if (arrived(way_[next_])) {
      checking_ = (under() & kExact) != 0; // here it stops within N0516 at once, so for one cycle
      ++next_;
      started_ = false;
    }
  }
  showSignals();
}

void ChannelMotion::interrupt() {
  for (uint32_t axis = 0; axis < nc::nct::kAxes; ++axis) {
    interruption_[axis] = links_.axes->machinePosition(axis);
    if (links_.axes->channelOf(axis) == channel_) links_.axes->cancel(axis);
  }
  started_ = false;
}

// Both return motions are of the kind that was interrupted (l.9917-9945).
void ChannelMotion::resume(bool toStart, bool toInterruption) {
  if (next_ >= count_ || (!toStart && !toInterruption)) return;
  const uint32_t from = toStart ? 0 : next_;
  const uint32_t rest = std::min(count_ - from, kWaypoints - 1);
  std::copy_backward(way_.begin() + from, way_.begin() + from + rest, way_.begin() + rest + 1);
  way_[0] = {toStart ? blockStart_ : interruption_, way_[1].axes, way_[1].flags};
  next_ = 0;
  count_ = rest + 1;
}

// ---- signals -----------------------------------------------------------------------------------------------------

void ChannelMotion::showSignals() const {
  const SignalMemory& signals = links_.signals;
  const ChannelSignals& s = signals_;
  const uint32_t flags = under();
  const auto is = [&](uint32_t flag) { return (flags & flag) != 0; };
  signals.setBits(s.feedRequest, channel_, s.pathBits,
                  s.feedRequest.as(is(kFeed)) | s.overrideDisabled.as(overrideDisabled()) | s.thread.as(is(kThread)) |
                      s.threadCycle.as(is(kThreadCycle)) | s.tapping.as(is(kTap) && !is(kRigid)) |
                      s.rigidTapping.as(is(kRigid)) | s.reference.as(is(kReference)) | s.skip.as(is(kSkip)) |
                      s.dwell.as(dwellUs_ > 0) | s.perTurn.as(modes_.perTurn && is(kFeed)) |
                      s.inPositionCheck.as(checking_));
  signals.setBits(s.surfaceSpeed, channel_, s.modalBits,
                  s.surfaceSpeed.as(surface_) | s.polygon.as(polygon_) | s.inch.as(modes_.inch) |
                      s.highSpeed.as(highSpeed_) | s.gearBox.as(gearBox_));
  if (surface_) showSurfaceSpeed();
}

// The position of X is a diameter in mm, the surface speed in m/min.
void ChannelMotion::showSurfaceSpeed() const {
  const int32_t x = axisOf('X');
  const double diameter = x < 0 ? 0
                                : std::abs(links_.axes->machinePosition(static_cast<uint32_t>(x)) -
                                           links_.axes->zeroPoint(static_cast<uint32_t>(x)));
  const double most = speedLimit_ > 0 ? speedLimit_ : 99'999'999;
  const double speed = diameter < kNear ? most : surfaceSpeed_ * 1000 / (std::numbers::pi * diameter);
  links_.signals.set(signals_.surfaceSpindle, channel_,
                     static_cast<int32_t>(std::lround(std::min(speed, 99'999'999.0))));
  links_.signals.set(signals_.speedLimit, channel_, static_cast<int32_t>(std::lround(speedLimit_)));
}

} // namespace rung::sim::nct

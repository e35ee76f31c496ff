// The spindles: rotation with ramps, orientation, closed loop, synchronisation, and the signals SN_…, SP_… (man. 7.14).
// Speeds are in 1/min, negative counter-clockwise; positions in revolutions. A closed position loop keeps the position
// exactly; two synchronised spindles are in phase as soon as their speeds are equal.
#pragma once
#include <array>

#include "sim/nct/parameters.h"
#include "sim/nct/seen_signals.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

inline constexpr double kPulsesPerTurn = 4096; // of a spindle encoder

struct SpindleSignals {
  BitSignal enable{"SP_SEN"}, start{"SP_SSTRT"}, jog{"SP_PAR"}, negative{"SP_NEG"};
  BitSignal orient{"SP_OREQ"}, shortest{"SP_OSHRT"}, synchronise{"SP_SSYNCR"}, shiftPhase{"SP_PHSHFTR"};
  BitSignal closeLoop{"SP_SLCLR"}, detachRequest{"SP_SDETCHR"};
  BitSignal noPositive{"SP_SMTNDP"}, noNegative{"SP_SMTNDN"}, noFeed{"SP_FEEDD"}, noRapid{"SP_RAPD"};
  WordSignal programmed{"SP_PRG"}, range{"SP_RNG"}, master{"SP_MAST"};
  RealSignal speedOverride{"SP_SOVER"};

  BitSignal ramped{"SN_RMPD"}, atSpeed{"SN_NS"}, stopped{"SN_N0"}, fluctuating{"SN_FLU"};
  BitSignal loopClosed{"SN_LPCLSD"}, oriented{"SN_ORIP"}, inPosition{"SN_SINPOS"};
  BitSignal synchronised{"SN_SSYNA"}, phaseShifted{"SN_PHSHFTA"};
  BitSignal wantsPositive{"SN_SMTNRP"}, wantsNegative{"SN_SMTNRN"}, wantsRapid{"SN_SRAPR"};
  BitSignal detached{"SN_SDETCHA"}, alarm{"SN_SALM"}, referenced{"SN_RPE"}, atIndex{"SN_SINDP"};
  WordSignal command{"SN_NCOM"}, actual{"SN_NACT"};
  // The bits that every time slice writes to the word of SN_RMPD.
  uint32_t written =
      BitSignal::masks({ramped, atSpeed, stopped, fluctuating, loopClosed, oriented, inPosition, synchronised,
                        phaseShifted, wantsPositive, wantsNegative, wantsRapid, alarm, referenced, atIndex});
};

struct SpindleParameters {
  ParameterPlace input{601}, output{603}, config{607};
  ParameterPlace percent{627}, window{628}, zeroWindow{629}, fluctuationPercent{632}, fluctuationWindow{633};
  ParameterPlace minimum[8] = {ParameterPlace(642), ParameterPlace(643), ParameterPlace(644), ParameterPlace(645),
                               ParameterPlace(646), ParameterPlace(647), ParameterPlace(648), ParameterPlace(649)};
  ParameterPlace maximum[8] = {ParameterPlace(650), ParameterPlace(651), ParameterPlace(652), ParameterPlace(653),
                               ParameterPlace(654), ParameterPlace(655), ParameterPlace(656), ParameterPlace(657)};
  ParameterPlace jogSpeed[8] = {ParameterPlace(658), ParameterPlace(659), ParameterPlace(660), ParameterPlace(661),
                                ParameterPlace(662), ParameterPlace(663), ParameterPlace(664), ParameterPlace(665)};
  ParameterPlace rampUp[8] = {ParameterPlace(666), ParameterPlace(667), ParameterPlace(668), ParameterPlace(669),
                              ParameterPlace(670), ParameterPlace(671), ParameterPlace(672), ParameterPlace(673)};
  ParameterPlace rampDown[8] = {ParameterPlace(674), ParameterPlace(675), ParameterPlace(676), ParameterPlace(677),
                                ParameterPlace(678), ParameterPlace(679), ParameterPlace(680), ParameterPlace(681)};
  ParameterPlace inPosition[8] = {ParameterPlace(744), ParameterPlace(745), ParameterPlace(746), ParameterPlace(747),
                                  ParameterPlace(748), ParameterPlace(749), ParameterPlace(750), ParameterPlace(751)};
  ParameterPlace orientSpeed[8] = {ParameterPlace(801), ParameterPlace(802), ParameterPlace(803), ParameterPlace(804),
                                   ParameterPlace(805), ParameterPlace(806), ParameterPlace(807), ParameterPlace(808)};
  ParameterPlace gridShift{684}, phaseShift{685}, basicAngle{822};
};

class Spindles final : public Topic {
public:
  explicit Spindles(Links& links);

  // Spindles count from 0. A spindle exists if N0607 #0 SEX=1 and SN_SDETCHA=0 (l.9098).
  bool exists(uint32_t spindle) const;
  double speed(uint32_t spindle) const {
    return spindle < nc::nct::kSpindles ? spindles_[spindle].speed : 0;
  } // measured
  double position(uint32_t spindle) const { return spindles_[spindle].position; }
  double set(uint32_t spindle) const { return spindles_[spindle].set; }         // after override
  double command(uint32_t spindle) const { return spindles_[spindle].command; } // to the drive
  bool closed(uint32_t spindle) const { return spindles_[spindle].closed; }
  bool synchronised(uint32_t spindle) const { return spindles_[spindle].synchronised; }
  uint32_t master(uint32_t spindle) const;
  // Slave minus master, while they are synchronised.
  double synchronousError(uint32_t spindle) const;

  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"spindle"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void cycle() override;
  void timeSlice() override;
  void retain(Retained& retained) override;

  template <class Archive>
  void state(Archive& archive) {
    archive(spindles_);
    if constexpr (Archive::kLoads) resting_ = false, seen_.forget();
  }

private:
  // The program's command to a spindle; the four exclude each other (l.9186-9196).
  enum class Order : uint8_t { None, Rotate, Orient, Synchronise, CloseLoop };
  struct Spindle {
    double speed = 0;
    double command = 0;
    double set = 0;
    double position = 0;    // in revolutions, not reset
    double toGo = 0;        // remaining distance of an orientation, once it has begun
    double disturbance = 0; // added to the measured speed by an event
    Order order = Order::None;
    bool closed = false;
    bool positioning = false;
    bool oriented = false;
    bool synchronised = false;
    bool referenced = true;
    bool detached = false;
    bool alarm = false;
    bool wantsPositive = false;
    bool wantsNegative = false;
    template <class Archive>
    void state(Archive& archive) {
      archive(speed, command, set, position, toGo, disturbance, order, closed, positioning, oriented, synchronised,
              referenced, detached, alarm, wantsPositive, wantsNegative);
    }
  };

  void number(uint32_t count);
  Order orderOf(uint32_t asked) const; // from the word of the requests
  uint32_t gear(uint32_t spindle) const;
  double rotationSpeed(uint32_t spindle) const;
  bool ramp(uint32_t spindle, double target); // true: target reached
  void step(uint32_t spindle, Order order);
  void orient(uint32_t spindle);
  double orientationWay(uint32_t spindle) const;
  void synchronise(uint32_t spindle);
  void turn(uint32_t spindle);
  uint32_t existing();                     // one bit each
  void writeSignals(uint32_t there) const; // of all spindles; `there` has those that exist
  void writeSpindle(uint32_t spindle) const;
  double fraction(uint32_t spindle) const;
  double seconds() const { return static_cast<double>(links().sliceUs) * 1e-6; }
  bool get(const BitSignal& signal, uint32_t spindle) const { return links().signals.get(signal, spindle); }
  void put(const BitSignal& signal, uint32_t spindle, bool value) const { links().signals.set(signal, spindle, value); }
  double real(const ParameterPlace& place, uint32_t spindle) const { return links().parameters->real(place, spindle); }

  std::array<Spindle, nc::nct::kSpindles> spindles_{};
  bool absolute_ = true;
  SpindleSignals signals_;
  SpindleParameters parameters_;
  uint32_t configured_ = 0; // N0607 #0, one bit each, valid for `revision_`
  uint32_t revision_ = 0;
  // While all spindles are at rest, a time slice only has work if one of these changes.
  bool resting_ = false;
  SeenSignals seen_{WordSignal("SP_1"), WordSignal("SP_RNG"), WordSignal("SN_1"), WordSignal("SN_NCOM"),
                    WordSignal("SN_NACT")};
};

} // namespace rung::sim::nct

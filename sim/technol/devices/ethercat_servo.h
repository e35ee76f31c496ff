// How the increments of a servo count: attributes of the element Servo (TECHNOL manual, l.8547-8573, l.10150-10191).
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/technol/devices/ds402_drive.h"

namespace rung::sim::technol {

class ServoMeasure {
public:
  // ServoType, MeasConstNumerator, MeasConstDenominator, in any case. "" or what is wrong.
  std::string set(std::string_view name, std::string_view value);
  static bool has(std::string_view name);

  // Increments a micrometre (1/1000 degree). In the trajectory mode (ServoType 28, 29) they are micrometres * 65536 *
  // numerator / denominator, else increments * numerator / denominator are micrometres; without both they are equal. A
  // constant of 0 is not given, a negative one turns the direction.
  double incrementsPerMicrometre() const { return incrementsPerMicrometre_; }

private:
  double computed() const;

  static constexpr int32_t kTrajectoryCoe = 28, kTrajectorySoe = 29;
  int32_t type_ = 0, numerator_ = 0, denominator_ = 0;
  double incrementsPerMicrometre_ = 1; // scans need it
};

// EtherCAT drives as the control's servos order them (TECHNOL manual 13.18, 13.19, l.10216-10807): what the request
// bits flEdrv…N do to the control word of a drive, by its status word, and the position and velocity that are asked of
// it.

// bEdrvStateN (l.10352; the numbers are not printed there).
enum class ServoState : uint8_t { Done = 0, Init = 1, On = 2, Enable = 3 };

// Cells of servo N and its ends of connections (l.10328-10390).
struct ServoCells {
  // Requests of the program, reset when they are carried out (l.10434-10479).
  bool init = false, on = false, enable = false, disable = false, done = false, erase = false;
  bool isSimulated = false; // flEdrvSimulN: a drive of its own answers
  bool isConnected = false; // a slave gives the status word, and takes the control word
  uint16_t status = 0;      // wEdrvDriveStatusN, 6041h: in, of a simulated one out
  uint16_t error = 0;       // wEdrvDriveErrRegN, 603Fh: likewise
  uint16_t control = 0;     // wEdrvDriveControlN, 6040h: out
  ServoState state = ServoState::Done;
  bool isFaulty = false;     // flEdrvErrorN
  bool blocksMotion = false; // flEdrvMoveDisReqN: the drive is not enabled

  double place = 0;              // where its axis is to be, mm; of an axis that does not exist always 0
  double incrementsPerUm = 1;    // of the configuration
  double velocityScale = 0;      // rEdrvScaleSpeedN; 0, as at a power-on, counts as 1
  int32_t position = 0;          // dwEdrvDrivePosN, 6064h, increments: in, of a simulated one out
  int32_t requestedPosition = 0; // dwEdrvDrivePosReqN, 607Ah, increments: out
  int32_t requestedVelocity = 0; // dwEdrvDriveVeloReqN, 60FFh, increments per second times the scale: out

  bool exists() const { return isSimulated || isConnected; }
  // DIFCIT_X, in increments: 0 while the drive is not enabled.
  int32_t followingError() const {
    return static_cast<int32_t>(static_cast<uint32_t>(requestedPosition) - static_cast<uint32_t>(position));
  }
  // Micrometres (1/1000 degree), which wrap as their cells do.
  int32_t micrometres(int32_t increments) const {
    return static_cast<int32_t>(static_cast<uint32_t>(std::llround(increments / incrementsPerUm)));
  }
};

class EthercatServo {
public:
  void powerOn() { *this = {}; }
  // Once a scan. A servo that is neither simulated nor connected leaves all cells alone.
  void scan(ServoCells& cells);

private:
  void simulate(ServoCells& cells);
  void serve(ServoCells& cells);
  void eraseFault(ServoCells& cells);
  void follow(ServoCells& cells);

  Ds402Drive own_;          // while it is simulated
  int32_t ownPosition_ = 0; // of its motor
  bool isPlaced_ = false;   // its motor is where the axis is
  uint32_t base_ = 0;       // increments of the drive where the axis is at 0
  bool hasBase_ = false;
  uint16_t control_ = 0; // without the pulse that resets faults
  bool pulse_ = false;
};

class EthercatServos {
public:
  static constexpr uint32_t kCount = 16;
  using Cells = std::array<ServoCells, kCount>;

  // `servo.N.ATTRIBUTE`, N from 0, as ServoMeasure. "" or what is wrong.
  static bool owns(std::string_view key) { return key.starts_with("servo."); }
  std::string configure(std::string_view key, std::string_view value);
  double incrementsPerUm(uint32_t servo) const { return measures_[servo].incrementsPerMicrometre(); }

  void powerOn();
  // One millisecond; the servos work in each 20th, so that one step takes one scan.
  void tick(Cells& cells);

private:
  static constexpr uint32_t kScanTicks = 20;
  std::array<EthercatServo, kCount> servos_;
  std::array<ServoMeasure, kCount> measures_;
  uint32_t ticks_ = 0;
};

} // namespace rung::sim::technol

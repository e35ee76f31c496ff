// The scale of a servo's increments: attributes of the element Servo (TECHNOL manual, l.8547-8573, l.10150-10191).
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
  // Sets ServoType, MeasConstNumerator or MeasConstDenominator; case does not matter. Returns "", or the error.
  std::string set(std::string_view name, std::string_view value);
  static bool has(std::string_view name);

  // Increments per micrometre (1/1000 degree). In trajectory mode (ServoType 28, 29): increments = micrometres * 65536
  // * numerator / denominator; otherwise micrometres = increments * numerator / denominator; without both constants
  // they are equal. A constant of 0 counts as not given; a negative one reverses the direction.
  double incrementsPerMicrometre() const { return incrementsPerMicrometre_; }

private:
  double computed() const;

  static constexpr int32_t kTrajectoryCoe = 28, kTrajectorySoe = 29;
  int32_t type_ = 0, numerator_ = 0, denominator_ = 0;
  double incrementsPerMicrometre_ = 1; // computed in advance for scans
};

// EtherCAT drives commanded by the control's servos (TECHNOL manual 13.18, 13.19, l.10216-10807): the control word of a
// drive, derived from the request bits flEdrv…N and its status word, and its commanded position and velocity.

// bEdrvStateN (l.10352; the numbers are not printed there).
enum class ServoState : uint8_t { Done = 0, Init = 1, On = 2, Enable = 3 };

// Cells of servo N and of its connections (l.10328-10390).
struct ServoCells {
  // Requests of the program, reset when they have been executed (l.10434-10479).
  bool init = false, on = false, enable = false, disable = false, done = false, erase = false;
  bool isSimulated = false; // flEdrvSimulN: an internal drive answers
  bool isConnected = false; // a slave supplies the status word and receives the control word
  uint16_t status = 0;      // wEdrvDriveStatusN, 6041h: input; output if simulated
  uint16_t error = 0;       // wEdrvDriveErrRegN, 603Fh: likewise
  uint16_t control = 0;     // wEdrvDriveControlN, 6040h: output
  ServoState state = ServoState::Done;
  bool isFaulty = false;     // flEdrvErrorN
  bool blocksMotion = false; // flEdrvMoveDisReqN: the drive is not enabled

  double place = 0;              // commanded position of its axis, mm; always 0 if the axis does not exist
  double incrementsPerUm = 1;    // from the configuration
  double velocityScale = 0;      // rEdrvScaleSpeedN; 0, as at a power-on, counts as 1
  int32_t position = 0;          // dwEdrvDrivePosN, 6064h, increments: input; output if simulated
  int32_t requestedPosition = 0; // dwEdrvDrivePosReqN, 607Ah, increments: output
  int32_t requestedVelocity = 0; // dwEdrvDriveVeloReqN, 60FFh, increments per second times the scale: output

  bool exists() const { return isSimulated || isConnected; }
  // DIFCIT_X, in increments: 0 while the drive is not enabled.
  int32_t followingError() const {
    return static_cast<int32_t>(static_cast<uint32_t>(requestedPosition) - static_cast<uint32_t>(position));
  }
  // Micrometres (1/1000 degree), which wrap like their cells.
  int32_t micrometres(int32_t increments) const {
    return static_cast<int32_t>(static_cast<uint32_t>(std::llround(increments / incrementsPerUm)));
  }
};

class EthercatServo {
public:
  void powerOn() { *this = {}; }
  // Called once per scan. A servo that is neither simulated nor connected does not change any cells.
  void scan(ServoCells& cells);

  template <class Archive>
  void state(Archive& archive) {
    archive(own_, ownPosition_, isPlaced_, base_, hasBase_, control_, pulse_);
  }

private:
  void simulate(ServoCells& cells);
  void serve(ServoCells& cells);
  void eraseFault(ServoCells& cells);
  void follow(ServoCells& cells);

  Ds402Drive own_;          // used while it is simulated
  int32_t ownPosition_ = 0; // of its motor
  bool isPlaced_ = false;   // the motor has the position of the axis
  uint32_t base_ = 0;       // increments of the drive at axis position 0
  bool hasBase_ = false;
  uint16_t control_ = 0; // without the pulse for a fault reset
  bool pulse_ = false;
};

class EthercatServos {
public:
  static constexpr uint32_t kCount = 16;
  using Cells = std::array<ServoCells, kCount>;

  // Sets `servo.N.ATTRIBUTE`, N from 0, with the attributes of ServoMeasure. Returns "", or the error.
  static bool owns(std::string_view key) { return key.starts_with("servo."); }
  std::string configure(std::string_view key, std::string_view value);
  double incrementsPerUm(uint32_t servo) const { return measures_[servo].incrementsPerMicrometre(); }

  void powerOn();
  // One millisecond; the servos work in every 20th one, so that one step takes one scan.
  void tick(Cells& cells);

  template <class Archive>
  void state(Archive& archive) {
    archive(servos_, ticks_);
  }
  template <class Archive>
  static void archiveCells(Archive& archive, Cells& cells) {
    for (ServoCells& of : cells)
      archive(of.init, of.on, of.enable, of.disable, of.done, of.erase, of.isSimulated, of.isConnected, of.status,
              of.error, of.control, of.state, of.isFaulty, of.blocksMotion, of.place, of.velocityScale, of.position,
              of.requestedPosition, of.requestedVelocity);
  }

private:
  static constexpr uint32_t kScanTicks = 20;
  std::array<EthercatServo, kCount> servos_;
  std::array<ServoMeasure, kCount> measures_;
  uint32_t ticks_ = 0;
};

} // namespace rung::sim::technol

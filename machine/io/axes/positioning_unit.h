// The six positioning units (man. chapter 19): POS_INIT, POS_MODE, POS_CONTROL, POS_RESET. A unit moves an axis by a
// distance, fully controlled by the PLC. Axes are numbered from 1.
#pragma once
#include <array>
#include <cstdint>
#include <utility>

#include "machine/io/axes/axis_permits.h"
#include "machine/io/axes/driven_axis.h"

namespace rung::io {

inline constexpr int64_t kLastSpace = 6; // of the transformations, from 0 (l.12166)

// Status record of POS_CONTROL as a word, the first byte low (l.12065-12093).
inline constexpr uint16_t kUnitMoves = 0x0001, kUnitNegative = 0x0002, kUnitArrived = 0x0008;     // JEDE, SMER, POL
inline constexpr uint16_t kUnitAvailable = 0x0100, kUnitProgrammed = 0x0200, kUnitError = 0x0400; // DISP, PROG, ERR

// Bits of the second byte of the control record (l.12101-12133); the others stay as they are.
inline constexpr uint8_t kControlBits = 0x0F;
inline constexpr uint8_t kControlMp = 1, kControlInit = 4, kControlContinue = 8;

class PositioningUnits {
public:
  static constexpr uint32_t kUnits = 6; // l.12040

  struct Mode {
    bool accepted = false; // else the control record stays, and is not remembered
    uint8_t control = 0;   // of kControlBits
  };
  struct State {
    uint16_t status = 0;
    bool programmed = false; // a control record is remembered, whose bits are to be `control`
    uint8_t control = 0;
  };

  void reset() { *this = PositioningUnits(); }
  // `allowed`: the axis exists, its position loop is closed and nobody else moves it.
  void init(DrivenAxis& axis, uint32_t number, bool allowed);
  // Distance in µm (1/1000 °), acceleration in mm/s² (l.12224-12238).
  Mode program(const DrivenAxis& axis, uint32_t number, int32_t length, uint16_t acceleration);
  // Speed in 1/65536 mm/min (l.12258).
  State control(const DrivenAxis& axis, uint32_t number, uint32_t feed, bool mp);
  void release(DrivenAxis& axis, uint32_t number);
  // The axis became a spindle.
  void lose(DrivenAxis& axis, uint32_t number);
  void fail(uint32_t number) { setBit(errors_, number - 1); }
  bool holds(uint32_t number) const { return find(number) != nullptr; }
  // Fault, HALT: they brake.
  void brakeAll();

  void drive(DrivenAxis& axis, uint32_t number, const AxisPermits& in);
  void look(DrivenAxis& axis, uint32_t number);

private:
  struct Unit {
    uint32_t axis = 0;       // 0: free
    bool programmed = false; // PROG
    bool arrived = false;    // POL
    bool braking = false;    // a motion that POS_INIT has ended
    bool placed = false;     // `target` is known: it has come to a standstill
    bool started = false;    // has moved since POS_MODE
    bool initiated = false;  // a tick since POS_MODE: INIC has become CONT
    bool mp = false;
    double feed = 0; // per second
    double acceleration = 0, length = 0, target = 0;
    bool underWay() const { return programmed && !arrived; }
  };
  const Unit* find(uint32_t number) const;
  Unit* find(uint32_t number) { return const_cast<Unit*>(std::as_const(*this).find(number)); }
  Unit* unitFor(uint32_t number);
  static void follow(Unit& unit, DrivenAxis& axis, uint32_t index, const AxisPermits& in);
  static uint8_t controlOf(const Unit& unit);
  uint16_t statusOf(const DrivenAxis& axis, uint32_t number) const;

  std::array<Unit, kUnits> units_ = {};
  AxisMask errors_ = 0; // ERR, until a POS_INIT succeeds
};

} // namespace rung::io

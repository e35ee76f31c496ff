// The codes of a part program by which all dialects read lengths, coordinates and feeds: G20 and G21, G90 and G91, G94
// and G95.
#pragma once
#include <cmath>

namespace rung::sim {

struct PathModes {
  static constexpr double kMmPerInch = 25.4;

  bool inch = false;        // G20
  bool incremental = false; // G91
  bool perTurn = false;     // G95
  double feed = 0;          // mm per minute or per turn of the spindle

  // A G code in tenths; what is not one of these changes nothing.
  void take(int tenths) {
    switch (tenths) {
    case 200:
    case 210: inch = tenths == 200; return;
    case 900:
    case 910: incremental = tenths == 910; return;
    case 940:
    case 950: perTurn = tenths == 950; return;
    default: return;
    }
  }

  // A length as the program writes it, in mm.
  double length(double written) const { return inch ? written * kMmPerInch : written; }
  // The machine coordinate that a length leads to, in the unit of all three.
  template <class T>
  T target(T length, T from, T zeroPoint) const {
    return incremental ? from + length : length + zeroPoint;
  }
  double feedPerMinute(double turnsPerMinute) const { return perTurn ? feed * std::abs(turnsPerMinute) : feed; }
};

} // namespace rung::sim

// The tables of the simulated CNC: offsets, parameters, macro variables, pitch compensation, tool numbers. Values are
// in units of 0.0001, the scale of the window functions (man. l.8686-8945); a cell that was never written is 0, a
// parameter has its default.
#pragma once
#include <compare>
#include <cstdint>
#include <map>

namespace rung::sim::gsk {

enum class Table : uint8_t { ToolOffset, WorkOffset, Parameter, Macro, Pitch, Tool };

inline constexpr int64_t kTableScale = 10000;

// Parameters that the manual names by number.
inline constexpr uint32_t kParamGuard = 2402;       // .0 RLK l.3716, .7 high-speed M/S/T/B l.6045
inline constexpr uint32_t kParamManyM = 1803;       // .6 l.5980
inline constexpr uint32_t kParamDryRun = 1210;      // mm/min, l.5339
inline constexpr uint32_t kParamRapid = 1225;       // of each axis, mm/min, l.5585
inline constexpr uint32_t kParamRapidF0 = 1231;     // mm/min, l.5591
inline constexpr uint32_t kParamReturn = 1235;      // of each axis, mm/min, l.5018
inline constexpr uint32_t kParamSafeFeed = 1260;    // of each axis, mm/min, l.5727
inline constexpr uint32_t kParamReference2 = 1051;  // then 1052, 1053, of each axis, mm, l.5109
inline constexpr uint32_t kParamExternal = 1971;    // .7 ESCAN l.7537
inline constexpr uint32_t kParamSwitches = 2401;    // .3 SWI
inline constexpr uint32_t kParamSwitchAxis = 2500;  // to 2531, l.4226
inline constexpr uint32_t kParamSwitchHigh = 2532;  // to 2563
inline constexpr uint32_t kParamSwitchLow = 2564;   // to 2595
inline constexpr uint32_t kParamGearKind = 5001;    // .6 GTT: T type, l.6373
inline constexpr uint32_t kParamGearSpeed = 5110;   // SOR, r/min, l.6406
inline constexpr uint32_t kParamMaxSpindle = 5115;  // r/min, l.7393
inline constexpr uint32_t kParamGearMax = 5120;     // to 5123, T type, l.6436
inline constexpr uint32_t kParamGearSwitch = 5130;  // to 5132, M type, l.6388
inline constexpr uint32_t kParamPlcGroup = 7010;    // of each axis, l.8260
inline constexpr uint32_t kParamPlcMaxSpeed = 7122; // mm/min, l.8277

class Tables {
public:
  int64_t get(Table table, uint32_t number, uint32_t attribute = 0) const;
  void set(Table table, uint32_t number, uint32_t attribute, int64_t value);

  // The integer part, a bit, and the real value of a parameter; `axis` counts from 0.
  int64_t parameter(uint32_t number, uint32_t axis = 0) const;
  bool parameterBit(uint32_t number, uint32_t bit) const { return ((parameter(number) >> bit) & 1) != 0; }
  double parameterReal(uint32_t number, uint32_t axis = 0) const;

  void clear() { cells_.clear(); }
  // Clears the common variables #100-#199, which are lost at power-off.
  void clearVolatile();

private:
  struct Key {
    Table table;
    uint32_t number;
    uint32_t attribute;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, int64_t> cells_;
};

} // namespace rung::sim::gsk

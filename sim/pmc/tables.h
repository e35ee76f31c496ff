// The tables of the simulated CNC: offsets, parameters, macro variables, pitch compensation, tool numbers. Values are
// in units of 0.0001; a cell that was never written is 0, a
// parameter has its default.
#pragma once
#include <compare>
#include <cstdint>
#include <map>

#include "sim/pmc/cnc.h"

namespace rung::sim::pmc {

enum class Table : uint8_t { ToolOffset, WorkOffset, Parameter, Macro, Pitch, Tool };

inline constexpr int64_t kTableScale = 10000;

// Highest numbers of this model's tables, which no manual specifies.
inline constexpr uint32_t kToolOffsets = 400;
inline constexpr uint32_t kMaxParameter = 9999;
inline constexpr uint32_t kMaxPitch = 1023;

class Tables {
public:
  // The table of the CNC outlives it.
  explicit Tables(const Cnc& cnc) : cnc_(&cnc) {}

  // Numbers of the parameters.
  const Parameters& numbers() const { return cnc_->parameters; }

  int64_t get(Table table, uint32_t number, uint32_t attribute = 0) const;
  void set(Table table, uint32_t number, uint32_t attribute, int64_t value);

  // The integer part, a bit, and the real value of a parameter; `axis` counts from 0.
  int64_t parameter(uint32_t number, uint32_t axis = 0) const;
  bool parameterBit(const ParameterBit& place) const {
    return place.number == 0 ? place.otherwise : ((parameter(place.number) >> place.bit) & 1) != 0;
  }
  double parameterReal(uint32_t number, uint32_t axis = 0) const;

  void clear() { cells_.clear(); }
  // Clears the common variables #100-#199, which are lost at power-off.
  void clearVolatile();

  template <class Archive>
  void state(Archive& archive) {
    archive(cells_);
  }

private:
  struct Key {
    Table table;
    uint32_t number;
    uint32_t attribute;
    auto operator<=>(const Key&) const = default;
    template <class Archive>
    void state(Archive& archive) {
      archive(table, number, attribute);
    }
  };
  int64_t defaultOf(uint32_t parameter) const;

  const Cnc* cnc_;
  std::map<Key, int64_t> cells_;
};

} // namespace rung::sim::pmc

// The parameters of the control that the PLC manual names, which MR 31/32 and MW 34/35 access in the simulated NC (man.
// 6.20). The manual gives names and meanings; where it does not give index or format of a parameter, the row follows
// from its use.
#pragma once
#include <cstdint>
#include <span>

#include "rtlib/nc/nct/axis_codes.h"

namespace rung::nc::nct {

// A bit parameter is a double word with bits 0…7 (man. l.3653).
enum class ParameterFormat : uint8_t { Bits, Dword, Double };
enum class ParameterIndex : uint8_t { Global, MachineGroup, Channel, Axis, Spindle };

inline constexpr uint32_t kMachineGroups = 8;
inline constexpr uint32_t kChannels = 8;
inline constexpr uint32_t kSpindles = 16;

struct ParameterRow {
  uint16_t number; // the first of `numbers` consecutive parameters
  uint8_t numbers;
  ParameterFormat format;
  ParameterIndex index;
  double initial;
  const char* name;
  uint16_t line; // of the manual
};

// Sorted by number.
std::span<const ParameterRow> parameterRows();
// Null if there is none.
const ParameterRow* findParameter(int64_t number);

// The number of values of one parameter; its indices are 1 to this number, a global parameter has index 0.
constexpr uint32_t valuesOf(ParameterIndex index) {
  switch (index) {
  case ParameterIndex::Global: return 1;
  case ParameterIndex::MachineGroup: return kMachineGroups;
  case ParameterIndex::Channel: return kChannels;
  case ParameterIndex::Axis: return kAxes;
  case ParameterIndex::Spindle: return kSpindles;
  }
  return 0;
}

const char* formatName(ParameterFormat format);
const char* indexName(ParameterIndex index);

} // namespace rung::nc::nct

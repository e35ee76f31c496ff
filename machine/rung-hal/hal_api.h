// Pins and parameters in both versions of HAL's interface. That of LinuxCNC 2.9 returns pointers to variables of their
// types' width; that of LinuxCNC's master since July 2026 returns references to cells of 64 bits, all of which a writer
// sets. Both redirect the contents of a pin's cell, so cells lie in HAL's memory.
#pragma once
#include <hal.h>

#include <cerrno>
#include <string>

#include "machine/host/pins.h"

// A version macro is announced; until it exists, HAL_BOOL is a name that only the headers with references define.
#if defined(HAL_API_VERSION) || defined(HAL_BOOL)
#define RUNG_HAL_REFERENCES 1
#else
#define RUNG_HAL_REFERENCES 0
#endif

namespace rung::hal {

using host::PinType;

#if RUNG_HAL_REFERENCES

#if defined(HAL_API_VERSION) && HAL_API_VERSION != 1
#error "this version of HAL's interface is not known: see docs/linuxcnc.md for those that are"
#endif

template <class Reference>
Reference* referenceIn(host::PinCell& cell) {
  return reinterpret_cast<Reference*>(&cell.any);
}

// Returns 0 or HAL's error, like all functions here that create something.
inline int newPin(const std::string& name, PinType type, hal_pdir_t direction, host::PinCell& cell, int component) {
  const char* const text = name.c_str();
  switch (type) {
  case PinType::Bit: return hal_pin_new_bool(component, direction, referenceIn<hal_bool_t>(cell), false, "%s", text);
  case PinType::S32: return hal_pin_new_si32(component, direction, referenceIn<hal_sint_t>(cell), 0, "%s", text);
  case PinType::U32: return hal_pin_new_ui32(component, direction, referenceIn<hal_uint_t>(cell), 0, "%s", text);
  case PinType::Float: return hal_pin_new_real(component, direction, referenceIn<hal_real_t>(cell), 0, "%s", text);
  }
  return -EINVAL;
}

// Creates a parameter that users can write.
inline int newParameter(const std::string& name, PinType type, host::PinCell& cell, int component) {
  const char* const text = name.c_str();
  switch (type) {
  case PinType::Bit: return hal_param_new_bool(component, HAL_RW, referenceIn<hal_bool_t>(cell), false, "%s", text);
  case PinType::S32: return hal_param_new_si32(component, HAL_RW, referenceIn<hal_sint_t>(cell), 0, "%s", text);
  case PinType::U32: return hal_param_new_ui32(component, HAL_RW, referenceIn<hal_uint_t>(cell), 0, "%s", text);
  case PinType::Float: return hal_param_new_real(component, HAL_RW, referenceIn<hal_real_t>(cell), 0, "%s", text);
  }
  return -EINVAL;
}

// Reads the lower half of integers: components of the older interface leave the upper one unchanged.
inline host::Value read(PinType type, const host::PinCell& cell) noexcept {
  switch (type) {
  case PinType::Bit: return {.bit = hal_get_bool(static_cast<hal_bool_t>(cell.any))};
  case PinType::S32: return {.s32 = hal_get_si32(static_cast<hal_sint_t>(cell.any))};
  case PinType::U32: return {.u32 = hal_get_ui32(static_cast<hal_uint_t>(cell.any))};
  case PinType::Float: return {.real = hal_get_real(static_cast<hal_real_t>(cell.any))};
  }
  return {};
}

inline void write(PinType type, const host::PinCell& cell, const host::Value& value) noexcept {
  switch (type) {
  case PinType::Bit: hal_set_bool(static_cast<hal_bool_t>(cell.any), value.bit); return;
  case PinType::S32: hal_set_si32(static_cast<hal_sint_t>(cell.any), value.s32); return;
  case PinType::U32: hal_set_ui32(static_cast<hal_uint_t>(cell.any), value.u32); return;
  case PinType::Float: hal_set_real(static_cast<hal_real_t>(cell.any), value.real); return;
  }
}

inline constexpr host::PinAccess kAccess{read, write};

#else

inline int newPin(const std::string& name, PinType type, hal_pin_dir_t direction, host::PinCell& cell, int component) {
  constexpr hal_type_t kTypes[] = {HAL_BIT, HAL_S32, HAL_U32, HAL_FLOAT}; // indexed by PinType
  return hal_pin_new(name.c_str(), kTypes[static_cast<size_t>(type)], direction, &cell.any, component);
}

inline int newParameter(const std::string& name, PinType type, host::PinCell& cell, int component) {
  cell.any = hal_malloc(sizeof(hal_data_u));
  if (cell.any == nullptr) return -ENOMEM;
  switch (type) {
  case PinType::Bit: return hal_param_bit_new(name.c_str(), HAL_RW, cell.bit, component);
  case PinType::S32: return hal_param_s32_new(name.c_str(), HAL_RW, cell.s32, component);
  case PinType::U32: return hal_param_u32_new(name.c_str(), HAL_RW, cell.u32, component);
  case PinType::Float: return hal_param_float_new(name.c_str(), HAL_RW, cell.real, component);
  }
  return -EINVAL;
}

inline constexpr const host::PinAccess& kAccess = host::kVariables;

#endif

inline bool bit(const host::PinCell& cell) noexcept { return kAccess.read(PinType::Bit, cell).bit; }
inline uint32_t u32(const host::PinCell& cell) noexcept { return kAccess.read(PinType::U32, cell).u32; }
inline void setBit(const host::PinCell& cell, bool value) noexcept {
  kAccess.write(PinType::Bit, cell, {.bit = value});
}
inline void setU32(const host::PinCell& cell, uint32_t value) noexcept {
  kAccess.write(PinType::U32, cell, {.u32 = value});
}

} // namespace rung::hal

// The quantities of the NC that SCP queries (man. §6.17, l.3323-3388). Used by the compiler for checks, by the
// simulated NC for answers, and by the reference page. A request refers to a symbol by its index in this list.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rung::nc::nct {

// The source of the value: the NC, or the memory of the compiled program.
enum class ScopeSource : uint8_t {
  Nc,
  PlcBit,
  PlcInt,
  PlcDouble,
  DirectPlcBit, // Direct...: the TimeSlice memory
  DirectPlcInt,
  DirectPlcDouble,
};

enum class ScopeLimit : uint8_t {
  Fixed,
  PlcNvram, // `max` is subtracted from PLCNVRAM
};

struct ScopeParameter {
  std::string_view meaning;
  int32_t min = 0;
  int32_t max = 0;
  ScopeLimit limit = ScopeLimit::Fixed;
  constexpr int64_t maximum(uint32_t plcNvram) const {
    return limit == ScopeLimit::Fixed ? max : static_cast<int64_t>(plcNvram) - max;
  }
};

struct ScopeSymbol {
  std::string_view name;
  std::string_view meaning;
  ScopeParameter param1;
  ScopeParameter param2;
  ScopeSource source = ScopeSource::Nc;
  uint16_t line = 0;
};

// In the order of the manual.
std::span<const ScopeSymbol> scopeSymbols();
// The index of a name, in any case.
std::optional<uint32_t> findScopeSymbol(std::string_view name);

} // namespace rung::nc::nct

// Address areas of the GSK25i PLC and addresses in them (man. Part I §3, l.564-589). An address is a byte, or a bit of
// one; multi-byte data begin at their low byte (man. l.788).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rung::gsk {

enum class Area : uint8_t { X, Y, F, G, R, D, C, T, A, K };
inline constexpr uint32_t kAreaCount = 10;

enum class AreaUse : uint8_t { Input, Output, Memory };

struct AreaInfo {
  char letter;
  uint32_t bytes;
  AreaUse use;
  bool retained; // through power-off (man. l.732-790)
  std::string_view doc;
};

inline constexpr std::array<AreaInfo, kAreaCount> kAreas = {{
    {'X', 128, AreaUse::Input, false, "machine to PLC"},
    {'Y', 128, AreaUse::Output, false, "PLC to machine"},
    {'F', 256, AreaUse::Input, false, "CNC to PLC"},
    {'G', 256, AreaUse::Output, false, "PLC to CNC"},
    {'R', 1100, AreaUse::Memory, false, "intermediate relays"},
    {'D', 1860, AreaUse::Memory, true, "data registers"},
    {'C', 400, AreaUse::Memory, true, "counters: preset and value, two bytes each"},
    {'T', 200, AreaUse::Memory, true, "timer presets, two bytes each"},
    {'A', 32, AreaUse::Memory, false, "message display requests"},
    {'K', 32, AreaUse::Memory, true, "keep relays"},
}};

constexpr const AreaInfo& areaInfo(Area area) { return kAreas[static_cast<size_t>(area)]; }

// R1000-R1099 belong to the control (man. l.740); the first six are the result registers (P4, P22).
inline constexpr uint32_t kSystemRelays = 1000;
inline constexpr uint32_t kResultFlags = 1000;
inline constexpr uint32_t kRemainder = 1002;
inline constexpr uint32_t kResultBytes = 6;

struct Address {
  Area area = Area::R;
  uint32_t byte = 0;
  uint8_t bit = 0;
  bool isBit = false;
  bool operator==(const Address&) const = default;
};

// "X2.1", "D10": without leading zeros.
std::string textOf(const Address& address);

// The shape of a word that begins like an address: an area letter and digits, then perhaps a point.
struct AddressText {
  Area area;
  uint64_t byte; // saturated
  bool hasPoint;
  std::string_view bit; // after the point
};
std::optional<AddressText> splitAddress(std::string_view text);

// Digits only, saturating; nullopt for anything else.
std::optional<uint64_t> parseDigits(std::string_view text);
// `[-] number` or `0x` hexadecimal digits.
std::optional<int64_t> parseConstant(std::string_view text);

// Whether `length` bytes from `address` touch a preset: all of T, the first two bytes of every counter in C (P8, P9).
bool touchesPreset(const Address& address, uint32_t length);

} // namespace rung::gsk

// Addresses of a language and numbers as text. An address is a byte, or a bit of one; data of several bytes begin at
// the low byte.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "frontend/network/language.h"
#include "rtlib/nc/signal.h"

namespace rung::frontend::network {

struct Address {
  Area area{};
  uint32_t byte = 0;
  uint8_t bit = 0;
  bool isBit = false;
  bool operator==(const Address&) const = default;
};

// "X2.1", "D10": without leading zeros.
std::string textOf(const Language& language, const Address& address);

// The form of a word that begins like an address: an area letter and digits, possibly followed by a point.
struct AddressText {
  Area area;
  uint64_t byte; // saturated
  bool hasPoint;
  std::string_view bit; // after the point
};
std::optional<AddressText> splitAddress(const Language& language, std::string_view text);
// A word that is an address, whether or not the control has it; a byte of a large number is saturated.
std::optional<Address> parseAddress(const Language& language, std::string_view text);

// The bytes of an area: "X0 to X127, X200 to X327".
std::string bytesText(const AreaInfo& area);

// The address of a signal of the language.
Address addressOf(const Language& language, const nc::Signal& signal);
// Of a bit: 1.
uint32_t bytesOf(const nc::Signal& signal);
// Whether the address is a part of the signal, or the byte in which its bit is.
bool covers(const Language& language, const nc::Signal& signal, const Address& address);

// Digits only, saturating; nullopt for anything else.
std::optional<uint64_t> parseDigits(std::string_view text);
// `[-] number` or, in a language that has them, `0x` hexadecimal digits.
std::optional<int64_t> parseConstant(const Language& language, std::string_view text);

} // namespace rung::frontend::network

// Address areas of the PMC by its type (inventory §3.2, §3.3).
#pragma once
#include <array>
#include <iterator>
#include <span>

#include "frontend/dialects/fanuc/pmc.h"
#include "frontend/network/address.h"

namespace rung::frontend::fanuc {

using network::AreaInfo;
using network::AreaUse;
using network::ByteRange;

// In every type at the same index.
namespace areas {
inline constexpr std::string_view kLetters = "XYFGREAKTCDZMN";
consteval network::Area named(char letter) { return static_cast<network::Area>(kLetters.find(letter)); }
inline constexpr network::Area kX = named('X');
inline constexpr network::Area kF = named('F');
inline constexpr network::Area kG = named('G');
inline constexpr network::Area kR = named('R');
inline constexpr network::Area kE = named('E');
inline constexpr network::Area kA = named('A');
inline constexpr network::Area kK = named('K');
inline constexpr network::Area kT = named('T');
inline constexpr network::Area kC = named('C');
inline constexpr network::Area kZ = named('Z');
} // namespace areas

inline constexpr size_t kAreaCount = areas::kLetters.size();
inline constexpr uint32_t kMessageState = 9000;  // of A: the bytes from this one on belong to the control
inline constexpr uint32_t kAccuracies = 9000;    // of T: the accuracy of timer n in the word 2(n-1) from here
inline constexpr uint32_t kFixedCounters = 5000; // of C: the value of CTRB n in the word 2(n-1) from here

// The system area: result registers at +0 and remainder at +2, start at +15, constants and clocks at +91 (§5.3). It is
// R9000, and Z0 where R is larger.
constexpr network::Address systemArea(Pmc pmc) {
  return pmc >= Pmc::MemC ? network::Address{areas::kZ, 0} : network::Address{areas::kR, 9000};
}
inline constexpr uint32_t kResultBytes = 6;
inline constexpr uint32_t kStartByte = 15;
inline constexpr uint32_t kClockByte = 91;

// Bytes, or a bit of one, in which the control keeps something of its own (inventory §3.2, §5.3). Those of the system
// area have the addresses that they have at R9000.
struct ControlPlace {
  network::Area area{};
  uint32_t first = 0, last = 0; // bytes
  int bit = -1;                 // of byte `first`; -1: whole bytes
  std::string_view doc;

  constexpr bool has(const network::Address& address) const {
    const bool isBit = bit < 0 || !address.isBit || address.bit == bit;
    return address.area == area && address.byte >= first && address.byte <= last && isBit;
  }
};
std::span<const ControlPlace> controlPlaces();
inline constexpr uint32_t kSystemBytes = 100; // of the system area

// The areas of a type, in the order of areas::kLetters.
std::span<const AreaInfo> areasOf(Pmc pmc);

} // namespace rung::frontend::fanuc

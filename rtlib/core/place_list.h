// All the values that a machine exchanges with a program in one direction: read or written by one call, from or to an
// array of 64-bit words.
#pragma once
#include <span>

#include "rtlib/core/memory.h"

namespace rung::core {

// How the word holds the value of a place.
enum class ValueForm : uint8_t {
  Raw,    // the bits of the place, zero-extended
  Signed, // sign-extended; written as Raw
  Real,   // the bits of a double, in units of `scale` each; an integer place is converted
};

struct ListedPlace {
  Place place;
  ValueForm form = ValueForm::Raw;
  double scale = 1; // the program's units in one of the machine's; not 0
};

// As many values as places.
inline void readPlaces(Memory memory, std::span<const ListedPlace> places, std::span<uint64_t> values) noexcept {
  for (size_t i = 0; i < places.size(); ++i) {
    const ListedPlace& from = places[i];
    switch (from.form) {
    case ValueForm::Raw: values[i] = memory.read(from.place); break;
    case ValueForm::Signed: values[i] = static_cast<uint64_t>(memory.readSigned(from.place)); break;
    case ValueForm::Real: values[i] = std::bit_cast<uint64_t>(memory.readReal(from.place) / from.scale); break;
    }
  }
}

inline void writePlaces(Memory memory, std::span<const ListedPlace> places, std::span<const uint64_t> values) noexcept {
  for (size_t i = 0; i < places.size(); ++i) {
    const ListedPlace& to = places[i];
    if (to.form == ValueForm::Real)
      memory.writeReal(to.place, std::bit_cast<double>(values[i]) * to.scale);
    else
      memory.write(to.place, values[i]);
  }
}

} // namespace rung::core

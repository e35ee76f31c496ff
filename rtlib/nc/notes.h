// What DIALECT/signals.csv says after "//": where the manual is not of one mind about a signal, or leaves a name out.
// It is for whoever compares with the manual, and no part of what a signal means.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "rtlib/nc/signal.h"

namespace rung::nc {

struct SignalNote {
  uint16_t row; // of the dialect's table
  const char* text;
};

// Of a row of one of the dialects' tables; "" for most.
std::string_view noteOf(const Signal& signal);
// For reference pages: the meaning with the note in brackets.
std::string meaningWithNote(const Signal& signal);

} // namespace rung::nc

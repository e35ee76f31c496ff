// The text after "//" in DIALECT/signals.csv: where the manual contradicts itself about a signal, or leaves a name out.
// It is for readers who compare with the manual, and not part of the meaning of a signal.
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

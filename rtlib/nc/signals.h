// The signals of a dialect's control, by dialect name, and the notes on them.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "rtlib/nc/signal.h"

namespace rung::nc {

// By rung_program::dialect; null for an unknown dialect.
const SignalTable* signalsOf(std::string_view dialect);

// The text after "//" in DIALECT/signals.csv: where the manual contradicts itself about a signal, or leaves a name out.
// It is for readers who compare with the manual, and not part of the meaning of a signal.
struct SignalNote {
  uint16_t row; // of the dialect's table
  const char* text;
};

// The note on a row of one of the dialects' tables; "" for most rows.
std::string_view noteOf(const Signal& signal);
// For reference pages: the meaning with the note in brackets.
std::string meaningWithNote(const Signal& signal);

} // namespace rung::nc

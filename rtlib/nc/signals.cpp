// The signals of a dialect's control (see signals.h).
#include "rtlib/nc/signals.h"

#include <algorithm>
#include <functional>
#include <span>

#include "rtlib/nc/fanuc/signals.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/nct/signals.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::nc {

const SignalTable* signalsOf(std::string_view dialect) {
  if (dialect == "fanuc") return &fanucSignals();
  if (dialect == "gsk") return &gskSignals();
  if (dialect == "nct") return &nctSignals();
  if (dialect == "technol") return &technolSignals();
  return nullptr;
}

namespace {

std::string_view noteIn(const SignalTable& table, std::span<const SignalNote> notes, const Signal& signal) {
  const std::less<const Signal*> isBefore; // std::less, because the row may belong to another table
  const Signal* const first = table.data();
  if (isBefore(&signal, first) || !isBefore(&signal, first + table.size())) return {};
  const auto row = static_cast<uint16_t>(&signal - first);
  const auto at = std::ranges::lower_bound(notes, row, {}, &SignalNote::row);
  return at != notes.end() && at->row == row ? at->text : std::string_view();
}

} // namespace

std::string_view noteOf(const Signal& signal) {
  for (const std::string_view note :
       {noteIn(fanucSignals(), fanucSignalNotes(), signal), noteIn(gskSignals(), gskSignalNotes(), signal),
        noteIn(nctSignals(), nctSignalNotes(), signal), noteIn(technolSignals(), technolSignalNotes(), signal)})
    if (!note.empty()) return note;
  return {};
}

std::string meaningWithNote(const Signal& signal) {
  const std::string_view note = noteOf(signal);
  return note.empty() ? signal.meaning : std::string(signal.meaning).append(" (").append(note).append(")");
}

} // namespace rung::nc

// What the inventory says of the language as a whole.
#include "frontend/dialects/fanuc/language.h"

#include <array>
#include <utility>

#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/read/mnemonic.h"
#include "frontend/dialects/fanuc/rows/foreign_words.h"
#include "frontend/dialects/fanuc/rows/instructions.h"
#include "ir/support/check.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/nc/fanuc/model.h"
#include "rtlib/nc/fanuc/signals.h"

namespace rung::frontend::fanuc {

namespace {

using network::Control;
using network::Row;

// §2.3; F10.
constexpr network::Level kLevels[] = {
    {.name = "LEVEL1",
     .end = "END1",
     .turn = network::Turn::EverySlot,
     .endMissing = diag::MissingEnd1,
     .endTwice = diag::DuplicateEnd1},
    {.name = "LEVEL2",
     .end = "END2",
     .turn = network::Turn::Parts,
     .endMissing = diag::MissingEnd2,
     .endTwice = diag::DuplicateEnd2},
    {.name = "LEVEL3",
     .end = "END3",
     .turn = network::Turn::LastSlot,
     .endMissing = diag::MissingEnd2,
     .endTwice = diag::DuplicateEnd2,
     .optional = true},
};

int64_t mostNumber(const network::Language& language, const Row& row) {
  const PmcLimits& limits = limitsOf(pmcOf(language));
  if (row.numbers == Row::Numbers::Timer) return limits.timers;
  if (row.numbers == Row::Numbers::Edge) return limits.edges;
  if (row.control == Control::Call || row.control == Control::CallU || row.control == Control::Sp)
    return limits.subprograms;
  return INT64_MAX;
}

// R9091.0 and .1.
static_assert(nc::fanuc::kConstantRelays.inZ == kClockByte && nc::fanuc::kConstantRelays.mask == 0b11);
std::optional<bool> constantOf(const network::Language& language, const network::Address& address) {
  const network::Address system = systemArea(pmcOf(language));
  if (address.area != system.area || address.byte != system.byte + kClockByte || address.bit > 1) return std::nullopt;
  return address.bit == 1;
}

network::Language make(Pmc pmc) {
  return {
      .name = "fanuc",
      .listExtensions = kExtensions,
      .list = kMnemonicForm,
      .commands = {"RD", "RD.NOT", "AND", "AND.NOT", "OR", "OR.NOT", "RDNT", "OR.STK", "AND.STK", "WRT", "WRT.NOT",
                   "SET", "RST", "SUB", "", "TABLE", "", "", ""},
      .rows = networkRows(),
      .areas = areasOf(pmc),
      .signals = nc::fanucSignals,
      .levels = kLevels,
      .subprogram = "SUB",
      .emptyNote = "the file may be incomplete: it has no section %@3, or no command in it",
      .messageTexts = "the text of a bit of area A is `message A0.0 \"1000 TEXT\"`",
      .maxSteps = 1'000'000,
      .stackDepth = 9, // F12
      .maxCallDepth = 8,
      .findBox = findBox,
      .foreign = kForeignWords,
      .mostNumber = mostNumber,
      .nameMarks = "#*+-/=.&$%!?@",
      .namesIgnoreCase = true, // F4
      .hexadecimal = false,
      .dummyCoils = true,    // §8.3
      .cutsConstants = true, // §8.3
      .undeclared = diag::UndefinedSymbol,
      .needsProgramEnd = limitsOf(pmc).hasEnd,
      .calledByNumber = true,
      .constantOf = constantOf,
  };
}

template <size_t... I>
std::array<network::Language, kPmcCount> makeAll(std::index_sequence<I...>) {
  return {make(static_cast<Pmc>(I))...};
}

const std::array<network::Language, kPmcCount>& all() {
  static const auto kLanguages = makeAll(std::make_index_sequence<kPmcCount>());
  return kLanguages;
}

} // namespace

const network::Language& languageOf(Pmc pmc) { return all()[static_cast<size_t>(pmc)]; }

Pmc pmcOf(const network::Language& language) {
  const auto index = static_cast<size_t>(&language - all().data());
  RUNG_CHECK(index < kPmcCount, "the language of a PMC");
  return static_cast<Pmc>(index);
}

} // namespace rung::frontend::fanuc

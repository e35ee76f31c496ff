// Sections of the reference page that follow the instructions.
#include "frontend/dialects/fanuc/reference.h"

#include <fmt/format.h>

#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/rows/instructions.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/structure.h"

namespace rung::frontend::fanuc {
namespace {

using frontend::ReferencePage;

std::string partsText(const AreaInfo& area) {
  if (area.bytes == 0) return "-";
  std::string text;
  for (const ByteRange& part : area.parts)
    text += fmt::format("{}{}-{}", text.empty() ? "" : ", ", part.first, part.last);
  return text;
}

void addressAreas(ReferencePage& page) {
  page.section("Address areas",
               "An address is a byte, `R10`, or a bit of one, `R10.3`; leading zeros are ignored. Data of 2 or 4 bytes "
               "begin at their low byte, at any address. Which bytes there are depends on the type of the PMC.",
               "area | what | SA1 | SA3 | SB7 | memory A | memory B | memory C | memory D");
  for (size_t i = 0; i < kAreaCount; ++i) {
    const auto of = [&](Pmc pmc) { return partsText(areasOf(pmc)[i]); };
    page.row(areas::kLetters.substr(i, 1), areasOf(Pmc::MemB)[i].doc, of(Pmc::Sa1), of(Pmc::Sa3), of(Pmc::Sb7),
             of(Pmc::MemA), of(Pmc::MemB), of(Pmc::MemC), of(Pmc::MemD));
  }
}

void ownPlaces(ReferencePage& page) {
  page.section("Addresses of the control",
               "The system area is from R9000 on; with memory C and larger it is from Z0 on, so that R9091.1 is Z91.1.",
               "address | meaning");
  for (const ControlPlace& place : controlPlaces()) {
    const char letter = areas::kLetters[static_cast<size_t>(place.area)];
    const std::string end = place.bit >= 0              ? fmt::format(".{}", place.bit)
                            : place.last == place.first ? ""
                                                        : fmt::format("-{}{}", letter, place.last);
    page.row(fmt::format("{}{}{}", letter, place.first, end), place.doc);
  }
}

void pins(ReferencePage& page) {
  page.section("Conditions and pins",
               "The conditions of a function in the order of the stack, which is that of the pins of its box in a "
               "drawing.",
               "function | conditions | output");
  for (const Row& row : allRows())
    if (row.info.number >= 0 && row.built)
      page.row(row.info.mnemonic, row.info.pins.size() == 0 ? "none" : frontend::pinNames(row.info),
               row.info.output == frontend::Output::Always     ? "at least one coil"
               : row.info.output == frontend::Output::Optional ? "coils after it take ACT"
                                                               : "none");
}

} // namespace

void addReference(ReferencePage& page) {
  addressAreas(page);
  ownPlaces(page);
  pins(page);
  frontend::addWarnings(page, {diag::MissingEnd, diag::UnknownPmc, diag::UnknownSection, diag::BadListedSymbol,
                               diag::ConstantCut, diag::DuplicateTimer, diag::DuplicateCounter,
                               diag::DuplicateEdgeNumber, diag::DoubleCoil, diag::MixedOutput, diag::SystemAreaWrite,
                               diag::LabelZero, diag::LabelUnused, diag::SubprogramUnused});
}

} // namespace rung::frontend::fanuc

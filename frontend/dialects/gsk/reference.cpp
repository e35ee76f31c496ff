// Sections of the reference page that follow the instructions.
#include "frontend/dialects/gsk/reference.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frontend/dialects/gsk/areas.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/structure.h"
#include "rtlib/nc/gsk/axis_commands.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/gsk/window_functions.h"
#include "rtlib/nc/signals.h"

namespace rung::frontend::gsk {
namespace {

using frontend::ReferencePage;

std::string_view accessOf(network::Area area) {
  if (area == areas::kT) return "read; presets";
  if (area == areas::kC) return "read; values written";
  return kLanguage.at(area).use == network::AreaUse::Input ? "read" : "read, written";
}

void addressAreas(ReferencePage& page) {
  page.section(
      "Address areas",
      fmt::format("An address is a byte, `R10`, or a bit of one, `R10.3`; leading zeros are ignored. Data of 2 or 4 "
                  "bytes begin at their low byte. R{} to R{} belong to the control: R{} has the flags of the "
                  "arithmetic (bit 0 zero, 1 negative, 5 overflow), R{} to R{} DIVB's remainder; each level has its "
                  "own. Manual: l.564-805.",
                  kSystemRelays, kLanguage.at(areas::kR).bytes - 1, kResultFlags, kRemainder,
                  kResultFlags + kResultBytes - 1),
      "area | what | addresses | access | through power-off");
  for (size_t i = 0; i < kAreas.size(); ++i) {
    const network::AreaInfo& a = kAreas[i];
    const std::string_view kept = a.use == network::AreaUse::Input ? "input" : a.retained ? "kept" : "cleared";
    page.row(a.letter, a.doc, fmt::format("{0}0 to {0}{1}", a.letter, a.bytes - 1),
             accessOf(static_cast<network::Area>(i)), kept);
  }
}

void limits(ReferencePage& page) {
  page.section("Limits", "", "what | limit | manual");
  page.row("steps: commands, PRM and TABLE rows", kLanguage.maxSteps, "l.354");
  page.row("Level 1 cycle", "8 ms", "l.352");
  page.row("labels", "L1 to L9999, each once in the program", "l.363, 3022");
  page.row("subprograms", "P1 to P512", "l.364");
  page.row("calls inside calls", kLanguage.maxCallDepth, "-");
  page.row("values in the stack register", kLanguage.stackDepth, "-");
  page.row("TMR / TMRB / CTR numbers", "1 to 100 / 1 to 200 / 1 to 100", "l.359-360, 1148");
  page.row("messages", "1 to 256", "l.361");
}

void pins(ReferencePage& page) {
  page.section(
      "Pins of ladder boxes",
      "The first line of a box carries mnemonic and operands and is its first pin; each further line names its "
      "pin. A function without pins touches the left rail.",
      "box | pins from top to bottom | output");
  for (const Row& row : allRows())
    if (row.info.number >= 0)
      page.row(row.info.mnemonic, row.info.pins.size() == 0 ? "none" : frontend::pinNames(row.info),
               row.info.output == frontend::Output::None ? "closes its rung" : "at least one coil");
}

std::string fieldText(const nc::pmc::WindowField& field) {
  if (field.meaning.empty()) return "-";
  if (field.max == nc::pmc::kNoLimit) return std::string(field.meaning);
  return fmt::format("{}, {} to {}", field.meaning, field.min, field.max);
}

std::string_view statusText(nc::pmc::WindowStatus status) {
  switch (status) {
  case nc::pmc::WindowStatus::Open: return "open";
  case nc::pmc::WindowStatus::ClosedInList: return "not open: end code 6 at once";
  case nc::pmc::WindowStatus::ClosedInSection: return "not open yet: the CNC decides";
  }
  return "";
}

void windowFunctions(ReferencePage& page) {
  page.section(
      "Window functions",
      fmt::format("Control block of WINDR and WINDW, words with the low byte first: +{} function, +{} end code, "
                  "+{} length L of the data (1, 2 or 4 bytes), +{} number M, +{} attribute N, +{} data "
                  "(signed). End codes: 0 done, 1 unknown function, 2 length, 3 number, 4 attribute, 5 data, 6 "
                  "not provided, 7 write-protected. Manual: l.8482-8945.",
                  nc::pmc::kWindowFunctionAt, nc::pmc::kWindowEndAt, nc::pmc::kWindowLengthAt, nc::pmc::kWindowNumberAt,
                  nc::pmc::kWindowAttributeAt, nc::pmc::kWindowDataAt),
      "code | function | access | speed | state | number M | attribute N | data | manual");
  for (const nc::pmc::WindowFunction& f : nc::gsk::windowFunctions()) {
    const std::string data =
        f.scale == 0 ? "-" : fmt::format("value x {}{}", f.scale, f.wholeOnly ? ", whole values only" : "");
    page.row(f.code, f.title, f.access == nc::pmc::WindowAccess::Read ? "WINDR" : "WINDW",
             f.speed == nc::pmc::WindowSpeed::High ? "high" : "low", statusText(f.status), fieldText(f.number),
             fieldText(f.attribute), data,
             fmt::format("l.{}{}", f.listLine, f.line == 0 ? "" : fmt::format(", {} (l.{})", f.section, f.line)));
  }
}

std::string fieldText(const nc::pmc::AxisField& field) {
  if (field.meaning.empty()) return "-";
  std::string text(field.meaning);
  if (!field.unit.empty()) text += fmt::format(", {}", field.unit);
  if (field.min != field.max) text += fmt::format(", {} to {}", field.min, field.max);
  return text;
}

std::string_view bufferingText(nc::pmc::AxisBuffering buffering) {
  switch (buffering) {
  case nc::pmc::AxisBuffering::Buffered: return "yes, unless EMCUF is 1";
  case nc::pmc::AxisBuffering::Alone: return "no";
  case nc::pmc::AxisBuffering::Immediate: return "no: takes effect at once, ends with ECLR";
  }
  return "";
}

void axisCommands(ReferencePage& page) {
  page.section(
      "PLC axis commands",
      fmt::format("Block of AXLCTL, {} bytes: +{} command code (bit 7 is EMSBK), +{} data 1 (2 bytes), +{} data "
                  "2 (4 bytes). Manual: l.3241-3393, 7566-8480.",
                  nc::pmc::kAxisBlockBytes, nc::pmc::kAxisCommandAt, nc::pmc::kAxisData1At, nc::pmc::kAxisData2At),
      "code | command | data 1 | data 2 | buffered | manual");
  for (const nc::pmc::AxisCommand& c : nc::gsk::axisCommands())
    page.row(fmt::format("{} (0x{:02X})", c.code, c.code), c.title, fieldText(c.data1), fieldText(c.data2),
             bufferingText(c.buffering), fmt::format("l.{}", c.line));
  page.section("", "", "group | number | control | block | status | strobes | M code | feed override");
  const auto in = [](char area, uint32_t byte) { return fmt::format("{}{}", area, byte); };
  uint32_t number = 0;
  for (const nc::pmc::AxisGroup& g : nc::gsk::axisGroups())
    page.row(g.letter, ++number, in('G', g.control), in('G', g.command) + " to " + in('G', g.command + 6),
             in('F', g.status), in('F', g.strobes), in('F', g.code),
             g.feedOverride == 0 ? "-" : in('G', g.feedOverride));
}

std::string machineText(std::string_view group) {
  return group == "mc" ? " (GSK25iMc only)" : group == "tc" ? " (GSK25iTc only)" : "";
}

std::string widthText(const nc::Signal& signal) {
  const uint32_t bytes = nc::elementBytes(signal.type);
  return bytes == 0 ? "" : bytes == 1 ? " (1 byte)" : fmt::format(" ({} bytes)", bytes);
}

std::vector<const nc::Signal*> signalsByAddress() {
  std::vector<const nc::Signal*> signals;
  for (const nc::Signal& signal : nc::gskSignals()) signals.push_back(&signal);
  std::ranges::stable_sort(signals, {}, [](const nc::Signal* signal) {
    const network::Address a = addressOf(kLanguage, *signal);
    return std::tuple(a.area, a.byte, a.isBit, a.bit);
  });
  return signals;
}

// One part per area, with one table per 16 bytes.
void signals(ReferencePage& page) {
  constexpr uint32_t kBytesOfBlock = 16;
  page.section(
      "Signals",
      fmt::format("{} names that need no declaration, in the order of their addresses. A name is written in an "
                  "operand as it is printed here, with `*` (active at 0), `+`, `-`, `.` and `~`, also where it "
                  "equals a command (`LD RST`). T00 to T31 are the exception: they are addresses of area T, so "
                  "these signals are written F26.0 to F29.7. A field of several bits is a byte operand. A "
                  "declared name goes before a signal. `rungc explain NAME` and `rungc explain F7.0` show one "
                  "entry.",
                  nc::gskSignals().size()));
  std::optional<network::Area> area;
  uint32_t block = 0;
  for (const nc::Signal* signal : signalsByAddress()) {
    const network::Address address = addressOf(kLanguage, *signal);
    const bool newArea = std::exchange(area, address.area) != address.area;
    if (newArea) page.part(fmt::format("Area {}: {}", signal->area, kLanguage.at(address.area).doc), "");
    const uint32_t first = address.byte - address.byte % kBytesOfBlock;
    if (std::exchange(block, first) != first || newArea)
      page.section(fmt::format("{0}{1} to {0}{2}", signal->area, first, first + kBytesOfBlock - 1), "",
                   "address | signal | meaning | manual", 4);
    page.row(textOf(kLanguage, address) + widthText(*signal), fmt::format("`{}`", signal->symbol),
             nc::meaningWithNote(*signal) + machineText(signal->group), fmt::format("l.{}", signal->manualLine));
  }
}

} // namespace

void addReference(ReferencePage& page) {
  addressAreas(page);
  limits(page);
  pins(page);
  frontend::addWarnings(page, {diag::ConditionIgnored, diag::DuplicateTimer, diag::DuplicateCounter,
                               diag::DuplicateEdgeNumber, diag::DoubleCoil, diag::MixedOutput, diag::SystemAreaWrite,
                               diag::LabelZero, diag::LabelUnused, diag::SubprogramUnused, diag::SignalOfOtherMachine});
  windowFunctions(page);
  axisCommands(page);
  signals(page);
}

} // namespace rung::frontend::gsk

// Sections of the reference page after the instructions.
#include "frontend/dialects/gsk/reference.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "frontend/dialects/gsk/read/address.h"
#include "frontend/dialects/gsk/read/context.h"
#include "frontend/dialects/gsk/read/signals.h"
#include "frontend/dialects/gsk/rows/instructions.h"
#include "frontend/table/markdown.h"
#include "ir/support/diagnostics.h"
#include "rtlib/nc/gsk/axis_commands.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/gsk/window_functions.h"

namespace rung::gsk {
namespace {

using frontend::cell;
using frontend::Page;

std::string_view accessOf(Area area) {
  if (area == Area::T) return "read; presets";
  if (area == Area::C) return "read; values written";
  return areaInfo(area).use == AreaUse::Input ? "read" : "read, written";
}

void areas(Page& page) {
  page.heading("## Address areas");
  page.line(
      "An address is a byte, `R10`, or a bit of one, `R10.3`; leading zeros are ignored. Data of 2 or 4 bytes begin "
      "at their low byte. R{} to R{} belong to the control: R{} has the flags of the arithmetic (bit 0 zero, 1 "
      "negative, 5 overflow), R{} to R{} DIVB's remainder; each level has its own. Manual: l.564-805.\n",
      kSystemRelays, areaInfo(Area::R).bytes - 1, kResultFlags, kRemainder, kResultFlags + kResultBytes - 1);
  page.table("| area | what | addresses | access | through power-off |");
  for (size_t i = 0; i < kAreaCount; ++i) {
    const AreaInfo& a = kAreas[i];
    page.line("| {0} | {1} | {0}0 to {0}{2} | {3} | {4} |", a.letter, a.doc, a.bytes - 1,
              accessOf(static_cast<Area>(i)),
              a.use == AreaUse::Input ? "input"
              : a.retained            ? "kept"
                                      : "cleared");
  }
}

void limits(Page& page) {
  page.heading("## Limits");
  page.table("| what | limit | manual |");
  page.line("| steps: commands, PRM and TABLE rows | {} | l.354 |", kMaxSteps);
  page.line("| Level 1 cycle | 8 ms | l.352 |");
  page.line("| labels | L1 to L9999, each once in the program | l.363, 3022 |");
  page.line("| subprograms | P1 to P512 | l.364 |");
  page.line("| calls inside calls | 8 | - |");
  page.line("| values in the stack register | 9 | - |");
  page.line("| TMR / TMRB / CTR numbers | 1 to 100 / 1 to 200 / 1 to 100 | l.359-360, 1148 |");
  page.line("| messages | 1 to 256 | l.361 |");
}

void pins(Page& page) {
  page.heading("## Pins of ladder boxes");
  page.line(
      "The first line of a box carries mnemonic and operands and is its first pin; each further line names its pin. A "
      "function without pins touches the left rail.\n");
  page.table("| box | pins from top to bottom | output |");
  for (const Row& row : allRows()) {
    if (row.info.number < 0) continue;
    std::string names;
    for (const auto& pin : row.info.pins.all()) (names += names.empty() ? "" : " ") += pin.name;
    page.line("| {} | {} | {} |", row.info.mnemonic, names.empty() ? "none" : names,
              row.info.output == frontend::Output::None ? "closes its rung" : "at least one coil");
  }
}

void warnings(Page& page) {
  page.heading("## Warnings");
  page.line("All diagnostics: [diagnostics.md](diagnostics.md).\n");
  page.table("| code | meaning |");
  for (const Diag id : {Diag::ConditionIgnored, Diag::DuplicateTimer, Diag::DuplicateCounter, Diag::DuplicateEdgeNumber,
                        Diag::DoubleCoil, Diag::MixedOutput, Diag::SystemAreaWrite, Diag::LabelZero, Diag::LabelUnused,
                        Diag::SubprogramUnused, Diag::SignalOfOtherMachine})
    page.line("| {} | {} |", diagInfo(id).code, cell(diagInfo(id).explanation));
}

std::string fieldText(const nc::gsk::WindowField& field) {
  if (field.meaning.empty()) return "-";
  if (field.max == nc::gsk::kNoLimit) return cell(field.meaning);
  return fmt::format("{}, {} to {}", cell(field.meaning), field.min, field.max);
}

std::string_view statusText(nc::gsk::WindowStatus status) {
  switch (status) {
  case nc::gsk::WindowStatus::Open: return "open";
  case nc::gsk::WindowStatus::ClosedInList: return "not open: end code 6 at once";
  case nc::gsk::WindowStatus::ClosedInSection: return "not open yet: the CNC decides";
  }
  return "";
}

void windowFunctions(Page& page) {
  page.heading("## Window functions");
  page.line("Control block of WINDR and WINDW, words with the low byte first: +{} function, +{} end code, +{} length L "
            "of the "
            "data (1, 2 or 4 bytes), +{} number M, +{} attribute N, +{} data (signed). End codes: 0 done, 1 unknown "
            "function, "
            "2 length, 3 number, 4 attribute, 5 data, 6 not provided, 7 write-protected. Manual: l.8482-8945.\n",
            nc::gsk::kWindowFunctionAt, nc::gsk::kWindowEndAt, nc::gsk::kWindowLengthAt, nc::gsk::kWindowNumberAt,
            nc::gsk::kWindowAttributeAt, nc::gsk::kWindowDataAt);
  page.table("| code | function | access | speed | state | number M | attribute N | data | manual |");
  for (const nc::gsk::WindowFunction& f : nc::gsk::windowFunctions()) {
    const std::string data =
        f.scale == 0 ? "-" : fmt::format("value x {}{}", f.scale, f.wholeOnly ? ", whole values only" : "");
    page.line("| {} | {} | {} | {} | {} | {} | {} | {} | l.{}{} |", f.code, cell(f.title),
              f.access == nc::gsk::WindowAccess::Read ? "WINDR" : "WINDW",
              f.speed == nc::gsk::WindowSpeed::High ? "high" : "low", statusText(f.status), fieldText(f.number),
              fieldText(f.attribute), data, f.listLine,
              f.line == 0 ? "" : fmt::format(", {} (l.{})", f.section, f.line));
  }
}

std::string fieldText(const nc::gsk::AxisField& field) {
  if (field.meaning.empty()) return "-";
  std::string text = cell(field.meaning);
  if (!field.unit.empty()) text += fmt::format(", {}", field.unit);
  if (field.min != field.max) text += fmt::format(", {} to {}", field.min, field.max);
  return text;
}

std::string_view bufferingText(nc::gsk::AxisBuffering buffering) {
  switch (buffering) {
  case nc::gsk::AxisBuffering::Buffered: return "yes, unless EMCUF is 1";
  case nc::gsk::AxisBuffering::Alone: return "no";
  case nc::gsk::AxisBuffering::Immediate: return "no: takes effect at once, ends with ECLR";
  }
  return "";
}

void axisCommands(Page& page) {
  page.heading("## PLC axis commands");
  page.line("Block of AXLCTL, {} bytes: +{} command code (bit 7 is EMSBK), +{} data 1 (2 bytes), +{} data 2 (4 bytes). "
            "Manual: "
            "l.3241-3393, 7566-8480.\n",
            nc::gsk::kAxisBlockBytes, nc::gsk::kAxisCommandAt, nc::gsk::kAxisData1At, nc::gsk::kAxisData2At);
  page.table("| code | command | data 1 | data 2 | buffered | manual |");
  for (const nc::gsk::AxisCommand& c : nc::gsk::axisCommands())
    page.line("| {} (0x{:02X}) | {} | {} | {} | {} | l.{} |", c.code, c.code, cell(c.title), fieldText(c.data1),
              fieldText(c.data2), bufferingText(c.buffering), c.line);
  page.line("");
  page.table("| group | number | control | block | status | strobes | M code | feed override |");
  uint32_t number = 0;
  for (const nc::gsk::AxisGroup& g : nc::gsk::axisGroups())
    page.line("| {} | {} | G{} | G{} to G{} | F{} | F{} | F{} | {} |", g.letter, ++number, g.control, g.command,
              g.command + 6, g.status, g.strobes, g.code,
              g.feedOverride == 0 ? std::string("-") : fmt::format("G{}", g.feedOverride));
}

std::string machineText(std::string_view group) {
  return group == "mc" ? " (GSK25iMc only)" : group == "tc" ? " (GSK25iTc only)" : "";
}

std::string widthText(const nc::Signal& signal) {
  const uint32_t bytes = nc::elementBytes(signal.type);
  return bytes == 0 ? "" : bytes == 1 ? " (1 byte)" : fmt::format(" ({} bytes)", bytes);
}

void signals(Page& page) {
  constexpr uint32_t kBytesOfBlock = 16;
  page.heading("## Signals");
  page.line(
      "{} names that need no declaration, in the order of their addresses. A name is written in an operand as it is "
      "printed "
      "here, with `*` (active at 0), `+`, `-`, `.` and `~`, also where it equals a command (`LD RST`). T00 to T31 are "
      "the exception: they are addresses of area T, so these signals are written F26.0 to F29.7. A field of several "
      "bits is a byte operand. A declared name goes before a signal. `rungc explain NAME` and `rungc explain F7.0` "
      "show "
      "one entry.",
      nc::gskSignals().size());
  std::vector<const nc::Signal*> rows;
  for (const nc::Signal& signal : nc::gskSignals()) rows.push_back(&signal);
  const auto place = [](const nc::Signal* s) {
    const Address a = signalAddress(*s);
    return std::tuple(a.area, a.byte, a.isBit, a.bit);
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const auto* a, const auto* b) { return place(a) < place(b); });
  std::optional<Area> area;
  uint32_t block = 0;
  for (const nc::Signal* signal : rows) {
    const Address address = signalAddress(*signal);
    const bool newArea = area != address.area;
    if (newArea) page.heading(fmt::format("### Area {}: {}", signal->area, areaInfo(address.area).doc));
    if (newArea || block != address.byte / kBytesOfBlock) {
      block = address.byte / kBytesOfBlock;
      page.line("{}#### {}{} to {}{}\n", newArea ? "" : "\n", signal->area, block * kBytesOfBlock, signal->area,
                block * kBytesOfBlock + kBytesOfBlock - 1);
      page.table("| address | signal | meaning | manual |");
    }
    area = address.area;
    page.line("| {}{} | `{}` | {}{} | l.{} |", textOf(address), widthText(*signal), signal->symbol,
              cell(signal->meaning), machineText(signal->group), signal->manualLine);
  }
}

} // namespace

std::string referenceSections() {
  Page page;
  areas(page);
  limits(page);
  pins(page);
  warnings(page);
  windowFunctions(page);
  axisCommands(page);
  signals(page);
  return page.take();
}

} // namespace rung::gsk

// A cross reference for people (see cross_reference.h).
#include <fmt/format.h>

#include "ir/support/put.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"

namespace rung::report {
namespace {

// "as D20 to D23", "as 7000, indexed": where the rung's access is not the entry's own place.
std::string formOf(const rung_program& program, const Entry& entry, const RungAccess& access) {
  const std::string_view indexed = access.indexed ? ", indexed" : "";
  if (access.as == bitsOf(entry.place)) return std::string(indexed);
  const rung_space& space = program.spaces[access.as.space.index];
  const auto addressAt = [&](uint32_t bit) {
    const uint32_t byte = bit / 8;
    if (access.as.count == 1) return nc::address(program, runtime::bitRef(access.as.space.index, byte, bit % 8));
    return nc::address(program, runtime::intRef(access.as.space.index, byte - byte % space.unit_bytes, 8));
  };
  const std::string from = addressAt(access.as.first);
  const std::string to = addressAt(access.as.first + access.as.count - 1);
  return fmt::format(", as {}{}{}", from, from == to ? "" : " to " + to, indexed);
}

void addAccesses(const rung_program& program, const Entry& entry, bool RungAccess::* kind, std::string_view title,
                 std::string_view otherwise, std::string& out) {
  bool any = false;
  for (const RungAccess& access : entry.accesses) {
    if (!(access.*kind)) continue;
    put(out, "  {:<8} {}{}\n", any ? "" : title, runtime::rungText(program, access.rung),
        formOf(program, entry, access));
    any = true;
  }
  if (!any) put(out, "  {:<8} {}\n", title, otherwise);
}

void addPerhaps(const CrossReference& reference, const Entry& entry, std::string& out) {
  for (const RungAccess& access : reference.perhaps(entry.place))
    put(out, "  perhaps  {} {}{}\n", access.reads ? access.writes ? "read and written by" : "read by" : "written by",
        runtime::rungText(reference.program(), access.rung), formOf(reference.program(), entry, access));
}

} // namespace

std::string shownAsText(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps) {
  const rung_program& program = reference.program();
  std::string out;
  for (const Entry& entry : entries) {
    if (!out.empty()) out += '\n';
    put(out, "{}{}{}\n", shownName(program, entry.place), entry.odd.empty() ? "" : ": ", entry.odd);
    addAccesses(program, entry, &RungAccess::writes, "written",
                entry.controlWrites ? "by the control or the machine" : "–", out);
    addAccesses(program, entry, &RungAccess::reads, "read", entry.controlReads ? "by the control or the machine" : "–",
                out);
    if (perhaps) addPerhaps(reference, entry, out);
  }
  return out;
}

} // namespace rung::report

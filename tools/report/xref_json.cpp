// A cross reference for other programs (see cross_reference.h).
#include <nlohmann/json.hpp>

#include "rtlib/nc/names/names.h"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"

namespace rung::report {
namespace {

using Json = nlohmann::ordered_json;

// With the length of a cell where only that says which of several places at one name it is.
std::string addressOf(const rung_program& program, const runtime::Ref& place) {
  return nc::hasAddresses(program) ? nc::address(program, place) : nc::cellAddress(program, place);
}

Json accessJson(const rung_program& program, const RungAccess& access) {
  const rung_rung_info& rung = program.rungs[access.rung];
  const bool added = rung.file == RUNG_NONE; // by the compiler
  Json json = {{"rung", rung.number}, {"file", added ? "" : program.files[rung.file]}, {"line", rung.first_line}};
  const uint32_t byte = access.as.first / 8;
  const uint32_t space = access.as.space.index;
  const bool bit = access.as.count == 1;
  json["address"] =
      nc::address(program, bit ? runtime::bitRef(space, byte, access.as.first % 8) : runtime::intRef(space, byte, 8));
  json["bits"] = access.as.count;
  if (access.indexed) json["indexed"] = true;
  return json;
}

Json accessesJson(const rung_program& program, const std::vector<RungAccess>& accesses, bool RungAccess::* kind) {
  Json list = Json::array();
  for (const RungAccess& access : accesses)
    if (access.*kind) list.push_back(accessJson(program, access));
  return list;
}

} // namespace

std::string shownAsJson(const CrossReference& reference, const std::vector<Entry>& entries, bool perhaps) {
  const rung_program& program = reference.program();
  Json list = Json::array();
  for (const Entry& entry : entries) {
    Json json = {{"name", symbolAt(program, entry.place)}, {"address", addressOf(program, entry.place)}};
    json["written"] = accessesJson(program, entry.accesses, &RungAccess::writes);
    json["read"] = accessesJson(program, entry.accesses, &RungAccess::reads);
    if (entry.controlWrites) json["control_writes"] = true;
    if (entry.controlReads) json["control_reads"] = true;
    if (!entry.odd.empty()) json["odd"] = entry.odd;
    if (perhaps) {
      const std::vector<RungAccess> others = reference.perhaps(entry.place);
      json["perhaps_written"] = accessesJson(program, others, &RungAccess::writes);
      json["perhaps_read"] = accessesJson(program, others, &RungAccess::reads);
    }
    list.push_back(std::move(json));
  }
  return list.dump(2) + "\n";
}

} // namespace rung::report

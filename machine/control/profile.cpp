// See profile.h.
#include "machine/control/profile.h"

#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/values.h"

namespace rung::control {
namespace {

using host::Command;
using nlohmann::json;

constexpr uint32_t kMostRungs = 10'000; // of an answer
constexpr uint32_t kAtOnce = 64;        // a step of the scan thread reads no more

struct Wanted {
  uint32_t top = kMostRungs;
  bool byLongest = false;
};

Wanted wantedOf(const json& request) {
  Wanted wanted;
  if (const auto top = request.find("top"); top != request.end()) {
    if (!top->is_number_unsigned() || *top == 0 || *top > kMostRungs)
      throw Refused("found " + top->dump() + " for \"top\", expected a number from 1 to " + std::to_string(kMostRungs));
    wanted.top = top->get<uint32_t>();
  }
  const json by = request.value("by", json("time"));
  if (by != "time" && by != "longest")
    throw Refused("found " + by.dump() + " for \"by\", expected \"time\" or \"longest\"");
  wanted.byLongest = by == "longest";
  return wanted;
}

// All rungs of the program's tables. Their counters are not those of one scan: the program continues meanwhile.
std::vector<rung_profile> countersOf(host::PlcHost& plc) {
  std::vector<rung_profile> all;
  int32_t status = RUNG_OK;
  while (status == RUNG_OK) {
    const auto first = static_cast<uint32_t>(all.size());
    all.resize(first + kAtOnce);
    host::Command order{
        .kind = host::Command::Kind::Profile, .index = first, .count = kAtOnce, .profiles = all.data() + first};
    const host::CommandResult answer = plc.post(order);
    if (!answer.ok()) throw Refused(answer.problem);
    all.resize(first + order.count);
    status = answer.status;
  }
  return all;
}

json rowOf(const rung_profile& rung) {
  return {{"rung", rung.rung},       {"file", rung.file},        {"line", rung.line},    {"title", rung.title},
          {"executions", rung.runs}, {"time_ns", rung.total_ns}, {"max_ns", rung.max_ns}};
}

} // namespace

json profileOf(host::PlcHost& plc, const json& request) {
  const Wanted wanted = wantedOf(request);
  std::vector<rung_profile> rungs = countersOf(plc);
  double time = 0;
  double outside = 0; // what the compiler made: in no drawing
  for (const rung_profile& rung : rungs) (rung.rung == 0 ? outside : time) += rung.total_ns;
  std::erase_if(rungs, [](const rung_profile& rung) { return rung.rung == 0; });
  const size_t count = rungs.size();
  std::erase_if(rungs, [](const rung_profile& rung) { return rung.runs == 0; });
  std::ranges::stable_sort(rungs, std::greater(), wanted.byLongest ? &rung_profile::max_ns : &rung_profile::total_ns);
  json rows = json::array();
  for (size_t i = 0; i < rungs.size() && i < wanted.top; ++i) rows.push_back(rowOf(rungs[i]));
  return {
      {"count", count}, {"ran", rungs.size()}, {"time_ns", time + outside}, {"outside_ns", outside}, {"rungs", rows}};
}

} // namespace rung::control

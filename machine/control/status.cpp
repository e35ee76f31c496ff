// See status.h.
#include "machine/control/status.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/values.h"
#include "machine/host/mapping_file.h"

namespace rung::control {

using nlohmann::json;

json Status::greeting() const {
  return {{"rung", "host"},
          {"protocol", kProtocol},
          {"host", host_},
          {"program", plc_.program().name},
          {"dialect", dialect_}};
}

// ---- state ---------------------------------------------------------------------------------------------------------

namespace {

constexpr double kNsInUs = 1e3;

json jsonOf(const host::FunctionState& functions, runtime::Clock& clock) {
  json list = json::array();
  for (uint32_t i = 0; i < std::min(functions.count, host::FunctionState::kMost); ++i) {
    const host::FunctionState::Function& function = functions.oldest[i];
    list.push_back({{"function", host::kFunctionKinds[function.kind]},
                    {"code", function.code},
                    {"channel", function.channel + 1},
                    {"begun", function.begun},
                    {"late", function.late}});
    addAge(list.back(), clock, function.ageNs);
  }
  return {{"count", functions.count}, {"lost", functions.lost}, {"oldest", list}};
}

} // namespace

json Status::status() {
  const rung_program_info program = plc_.program();
  json out = {{"host", host_}, {"program", program.name}, {"dialect", dialect_}};
  if (program.faulted != 0) out["fault_of"] = program.faulted_name;
  if (addToStatus_) addToStatus_(out);
  host::Command look{.kind = host::Command::Kind::State};
  const host::CommandResult answer = plc_.host().post(look);
  out["scanned"] = answer.ok();
  out["powered_off"] = plc_.host().ended();
  if (!answer.ok()) return out;
  const uint32_t flags = look.state.flags;
  out["scans"] = look.state.scans;
  out["missed"] = look.state.missed;
  out["restarts"] = plc_.host().restarts();
  out["functions"] = jsonOf(look.functions, plc_.host().clock());
  out["forced"] = plc_.activeForces().size();
  out["us"] = look.state.now_us;
  if (look.state.worst_ns != 0)
    out["scan"] = {{"last_us", static_cast<double>(look.state.last_ns) / kNsInUs},
                   {"longest_us", static_cast<double>(look.state.worst_ns) / kNsInUs}};
  out["stopped"] = (flags & RUNG_STATE_STOPPED) != 0;
  out["unsaved"] = (flags & RUNG_STATE_UNSAVED) != 0;
  out["faulted"] = (flags & RUNG_STATE_FAULTED) != 0;
  if (!plc_.host().restartProblem().empty()) out["restart_problem"] = plc_.host().restartProblem();
  const bool faulted = (flags & RUNG_STATE_FAULTED) != 0; // a fault after the command is not reported
  if (const std::optional<rung_fault_info> fault = faulted ? plc_.host().fault() : std::nullopt) {
    out["fault"] = fault->text;
    out["file"] = fault->file;
    out["line"] = fault->line;
  }
  return out;
}

// ---- pins ----------------------------------------------------------------------------------------------------------

namespace {

// The uses of a pin as the mapping file names them: "DOOR", "bit 3 of X0", "M3", "done of M3".
std::vector<std::string> usesOf(const host::File& map, uint32_t pin) {
  std::vector<std::string> uses;
  for (const host::Link& link : map.links) {
    const auto bit = std::ranges::find(link.bits, pin);
    if (bit != link.bits.end())
      uses.push_back("bit " + std::to_string(bit - link.bits.begin()) + " of " + link.name);
    else if (link.bits.empty() && link.pin == pin)
      uses.push_back(link.name);
  }
  for (const host::Send& send : map.sends) {
    const std::string kind(host::kFunctionKinds[send.kind]);
    const std::string function = send.codePin ? kind : kind + std::to_string(send.code);
    if (send.edge.pin == pin) uses.push_back(function);
    if (send.codePin == pin) uses.push_back("code of " + function);
    if (send.donePin == pin) uses.push_back("done of " + function);
  }
  for (const host::Edge& abort : map.aborts)
    if (abort.pin == pin) uses.emplace_back("abort");
  for (const host::Connection& connection : map.connections)
    if (connection.statusPin == pin) uses.push_back("status of " + connection.title());
  return uses;
}

json jsonOf(host::PinType type, const host::Value& value) {
  switch (type) {
  case host::PinType::Bit: return value.bit;
  case host::PinType::S32: return value.s32;
  case host::PinType::U32: return value.u32;
  case host::PinType::Float: return toJson(RUNG_TYPE_F64, {.real = value.real});
  }
  return nullptr;
}

} // namespace

Status::PinValues Status::pinValues() {
  const size_t count = plc_.host().pins().size();
  struct {
    const host::PlcHost& plc;
    PinValues pins;
  } looking{plc_.host(), {std::vector<host::Value>(count), std::make_unique<bool[]>(count)}};
  host::Command look{.kind = host::Command::Kind::Act,
                     .act =
                         [](void* actor) {
                           auto& what = *static_cast<decltype(looking)*>(actor);
                           what.plc.lookAtPins(what.pins.values);
                           what.plc.lookAtOverwritten({what.pins.overwritten.get(), what.pins.values.size()});
                         },
                     .actor = &looking};
  if (!plc_.host().post(look).ok()) return {};
  return std::move(looking.pins);
}

json Status::map(const Peer&, const json&) {
  const host::File& map = plc_.host().map();
  const PinValues now = pinValues();
  json pins = json::array();
  for (uint32_t i = 0; i < map.pins.size(); ++i) {
    const host::Pin& pin = map.pins[i];
    pins.push_back({{"name", pin.name},
                    {"type", host::pinTypeName(pin.type)},
                    {"table", host::tableName(pin.direction)},
                    {"uses", usesOf(map, i)},
                    {"file", map.paths[pin.at.file]},
                    {"line", pin.at.line}});
    if (now.values.empty()) continue;
    pins.back()["value"] = jsonOf(pin.type, now.values[i]);
    if (now.overwritten[i]) pins.back()["overwritten"] = true;
  }
  json permissions = json::array();
  for (size_t i = 0; i < std::size(host::kRemoteNames); ++i)
    if (map.permissions[i]) permissions.push_back(host::kRemoteNames[i]);
  json protectedNames = json::array();
  for (const host::Protected& cell : map.protectedCells) protectedNames.push_back(cell.name);
  return {{"files", map.paths}, {"pins", pins}, {"permissions", permissions}, {"protected", protectedNames}};
}

// ---- timers --------------------------------------------------------------------------------------------------------

// They are from different scans, as the program continues meanwhile.
std::vector<rung_timer_info> Status::runningTimers() {
  constexpr uint32_t kAtOnce = 64; // read in one step of the scan thread
  struct {
    rung_instance* plc;
    uint32_t next = 0;
    bool ended = false;
    std::array<rung_timer_info, kAtOnce> found{};
    uint32_t count = 0;
  } looking{.plc = plc_.instance()};
  host::Command look{.kind = host::Command::Kind::Act,
                     .act =
                         [](void* actor) {
                           auto& what = *static_cast<decltype(looking)*>(actor);
                           what.count = 0;
                           for (uint32_t i = 0; i < kAtOnce && !what.ended; ++i, ++what.next) {
                             rung_timer_info& timer = what.found[what.count];
                             timer.size = sizeof timer;
                             what.ended = rung_instance_timer(what.plc, what.next, &timer) != RUNG_OK;
                             if (!what.ended && timer.running != 0) ++what.count;
                           }
                         },
                     .actor = &looking};
  std::vector<rung_timer_info> all;
  while (!looking.ended) {
    const host::CommandResult result = plc_.host().post(look);
    if (!result.ok()) throw Refused(result.problem);
    all.insert(all.end(), looking.found.begin(), looking.found.begin() + looking.count);
  }
  return all;
}

json Status::timers(const Peer&, const json&) {
  json rows = json::array();
  for (const rung_timer_info& timer : runningTimers()) {
    rows.push_back({{"name", timer.name},
                    {"rung", timer.rung},
                    {"file", timer.file},
                    {"line", timer.line},
                    {"title", timer.title},
                    {"unit", timer.runs != 0 ? "runs" : "us"}});
    for (const auto& [key, value] :
         {std::pair("elapsed", timer.elapsed), {"remaining", timer.remaining}, {"preset", timer.preset}})
      if (value >= 0) rows.back()[key] = value;
  }
  return {{"timers", rows}};
}

// ---- profile -------------------------------------------------------------------------------------------------------

namespace {

constexpr uint32_t kMostRungs = 10'000; // largest number in an answer
constexpr uint32_t kAtOnce = 64;        // largest number read in one step of the scan thread

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

json rowOf(const rung_profile& rung) {
  return {{"rung", rung.rung},       {"file", rung.file},        {"line", rung.line},    {"title", rung.title},
          {"executions", rung.runs}, {"time_ns", rung.total_ns}, {"max_ns", rung.max_ns}};
}

} // namespace

// The counters of all rungs in the program's tables. They are from different scans, as the program continues meanwhile.
std::vector<rung_profile> Status::counters() {
  std::vector<rung_profile> all;
  int32_t status = RUNG_OK;
  while (status == RUNG_OK) {
    const auto first = static_cast<uint32_t>(all.size());
    all.resize(first + kAtOnce);
    host::Command look{
        .kind = host::Command::Kind::Profile, .index = first, .count = kAtOnce, .profiles = all.data() + first};
    const host::CommandResult result = plc_.host().post(look);
    if (!result.ok()) throw Refused(result.problem);
    all.resize(first + look.count);
    status = result.status;
  }
  return all;
}

json Status::profile(const Peer&, const json& request) {
  const Wanted wanted = wantedOf(request);
  std::vector<rung_profile> rungs = counters();
  double time = 0;
  double outside = 0; // time of code without a rung in a drawing
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

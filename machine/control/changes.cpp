// See changes.h.
#include "machine/control/changes.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>
#include <utility>

#include "machine/control/turn.h"
#include "machine/control/values.h"

namespace rung::control {

using nlohmann::json;

namespace {

constexpr size_t kMostChanges = 1000; // largest number in a report
constexpr uint32_t kMostShadowScans = 100'000;
constexpr uint32_t kShadowRoom = 256; // runs of tasks that wait to be compared
constexpr std::chrono::seconds kTakeOverTime(3);

std::string programOf(const json& request) {
  std::string path = textOf(request, "program");
  if (!path.starts_with('/')) throw Refused("found the path " + path + ", expected an absolute one");
  return path;
}

const char* changeName(uint32_t kind) {
  constexpr const char* kNames[] = {"new",     "removed",  "moved", "renamed",
                                    "retyped", "released", "cut"}; // enum rung_change_kind
  return kind < std::size(kNames) ? kNames[kind] : "changed";
}

bool losesState(uint32_t kind) {
  return kind == RUNG_CHANGE_REMOVED || kind == RUNG_CHANGE_RETYPED || kind == RUNG_CHANGE_CUT;
}

// What makes a replacement need the user's consent.
struct Losses {
  std::vector<std::string> state, outputs; // names; outputs that no rung writes any more

  std::string text() const {
    std::string said;
    if (!state.empty()) said = "the new program loses state: " + joined(state, ", ");
    if (!outputs.empty())
      said += (said.empty() ? "" : "; ") + ("no rung of the new program writes " + joined(outputs, ", ")) +
              (outputs.size() == 1 ? " any more: it becomes 0" : " any more: they become 0");
    return said;
  }
};

// A program that is not the machine's has nearly all names wrong.
std::string misfitsText(const std::vector<std::string>& mistakes) {
  constexpr size_t kShown = 10;
  if (mistakes.size() <= kShown) return joined(mistakes, "\n");
  return joined({mistakes.begin(), mistakes.begin() + kShown}, "\n") + "\nand " +
         std::to_string(mistakes.size() - kShown) + " more; is this the right program?";
}

// Report of the state that is lost or changed when the replacement's program takes over.
json reportOf(const rung_replacement* replacement, Losses& lost) {
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(replacement, &info));
  json changes = json::array();
  auto change = sized<rung_change>();
  for (uint32_t i = 0; i < kMostChanges && rung_replacement_change(replacement, i, &change) == RUNG_OK; ++i) {
    changes.push_back({{"kind", changeName(change.kind)},
                       {"name", change.name},
                       {"former", change.former},
                       {"state", change.is_state != 0}});
    if (losesState(change.kind)) lost.state.emplace_back(change.name);
    if (change.kind == RUNG_CHANGE_RELEASED) lost.outputs.emplace_back(change.name);
  }
  json rungs = json::array();
  auto rung = sized<rung_rung_change>();
  for (uint32_t i = 0; i < kMostChanges && rung_replacement_rung(replacement, i, &rung) == RUNG_OK; ++i)
    rungs.push_back({{"kind", rungChangeName(rung.kind)},
                     {"rung", rung.rung},
                     {"title", rung.title},
                     {"file", rung.file},
                     {"line", rung.line}});
  return {{"kept_cells", info.kept_cells},
          {"kept_states", info.kept_states},
          {"rungs", rungs},
          {"changes", changes},
          {"bound", info.bound}};
}

} // namespace

const char* rungChangeName(uint32_t kind) {
  constexpr const char* kNames[] = {"new", "removed", "changed", "moved"};
  return kind < std::size(kNames) ? kNames[kind] : "changed";
}

// The program in a file, or the one compiled for this client.
Changes::NextProgram Changes::nextProgram(const Peer& peer, const json& request) {
  NextProgram next;
  if (flagOf(request, "compiled")) {
    next.image = &compiler_.image(peer);
    next.text = std::string(next.image->program().name) + ", compiled here from sources";
  } else {
    next.text = programOf(request);
    next.opened = programs_.open(next.text);
  }
  return next;
}

// ---- reload and rollback -------------------------------------------------------------------------------------------

// Ends all forces; pending changes of forces are refused with the reason `why`.
json Changes::putInPlace(rung_replacement* replacement, const std::vector<rung_cell>& dead, json report,
                         const char* why) {
  const std::vector<std::string> ended = forces_.activeNames();
  const host::Command done =
      plc_.post({.kind = host::Command::Kind::Replace, .replacement = replacement, .dead = &dead}, kTakeOverTime);
  forces_.programChanged();
  forces_.refusePending(why);
  report["ended_forces"] = ended;
  report["stopped"] = (done.state.flags & RUNG_STATE_STOPPED) != 0; // by the operator, like the previous program
  if (plc_.host().running() && (done.state.flags & RUNG_STATE_STOPPED) == 0) waitForScan(done.state.scans);
  report["waits"] = !plc_.host().running(); // for a reset
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(replacement, &info));
  report["put_back"] = info.next == 0; // after an immediate fault
  return report;
}

// Waits for the first scan after number `scans`, or a fault: this shows whether the new program can run at all.
void Changes::waitForScan(uint64_t scans) {
  constexpr int64_t kMostNs = 300'000'000, kLookNs = 1'000'000;
  constexpr uint32_t kEnd = RUNG_STATE_FAULTED | RUNG_STATE_STOPPED;
  for (const int64_t end = plc_.host().clock().nowNs() + kMostNs; plc_.host().clock().nowNs() < end;
       plc_.host().clock().sleep(kLookNs)) {
    const std::optional<rung_state> now = plc_.state();
    if (!now || (now->flags & kEnd) != 0 || now->scans != scans) return;
  }
}

json Changes::reload(const Peer& peer, const json& request) {
  const NextProgram next = nextProgram(peer, request);
  const Image& image = next.get();
  programs_.serveForces(image);
  rung_replacement* made = nullptr;
  check(rung_replacement_new(plc_.instance(), image.handle(), nullptr, 0, &made));
  decltype(replacement_) replacement(made);
  const host::PlcHost::Losses pins = plc_.host().lossesBy(made, image.program());
  if (!pins.mistakes.empty())
    throw Refused("the mapping file does not fit the new program; nothing has changed:\n" + misfitsText(pins.mistakes));
  Losses losses;
  json report = reportOf(made, losses);
  const std::string lost = losses.text();
  report["program"] = next.text;
  report["pins"] = pins.moved;
  if ((!lost.empty() || !pins.moved.empty()) && !flagOf(request, "yes")) {
    report["ok"] = false;
    report["needs"] = "yes";
    report["error"] = (pins.moved.empty() ? "" : "pins lose or change their variables: " + joined(pins.moved, "; ")) +
                      (pins.moved.empty() || lost.empty() ? "" : "; ") + lost;
    return report;
  }
  if (flagOf(request, "late")) check(rung_replacement_allow_late(made));
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(made, &info));
  const uint32_t former = plc_.program().number;
  tables_.learn(image.program(), info.program);
  report = putInPlace(made, pins.dead, std::move(report),
                      "another program has taken over in the meantime; all forces have ended");
  replacement_ = std::move(replacement);
  tables_.forgetOthers(info.program, former);
  cells_.learn(image.program());
  plc_.logChange(peer, LogKind::Reload, "reload " + next.text + forces_.endedForces());
  return report;
}

json Changes::rollback(const Peer& peer, const json&) {
  if (replacement_ == nullptr)
    throw Refused("no program has been reloaded, so there is no former program to return to");
  Losses losses;
  const host::PlcHost::Losses pins = plc_.host().lossesBy(replacement_.get());
  json report = reportOf(replacement_.get(), losses);
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(replacement_.get(), &info));
  report["again"] = info.next == info.program; // the reloaded program, which a rollback had replaced
  report["pins"] = pins.moved;
  report = putInPlace(replacement_.get(), pins.dead, std::move(report),
                      "the former program has taken over in the meantime; all forces have ended");
  report["program"] = plc_.program().name;
  plc_.logChange(peer, LogKind::Rollback,
                 "rollback to " + report["program"].get<std::string>() + forces_.endedForces());
  return report;
}

// ---- shadow --------------------------------------------------------------------------------------------------------

// Ends the shadow by a command, because the scan thread writes to it.
void Changes::endShadow() {
  if (shadow_ == nullptr) return;
  plc_.post({.kind = host::Command::Kind::Shadow, .shadow = nullptr});
  shadow_.reset();
}

json Changes::shadow(const Peer& peer, const json& request) {
  const auto scans = request.find("scans");
  if (scans == request.end() || !scans->is_number_unsigned() || *scans == 0 || *scans > kMostShadowScans)
    throw Refused("found no number \"scans\" from 1 to 100000 in the request, expected one");
  if (shadow_ != nullptr && shadowsFor_ != peer.number)
    throw Refused("another client is running a shadow; try again when it has ended");
  if (const std::optional<rung_state> now = plc_.state(); now && (now->flags & RUNG_STATE_STOPPED) != 0)
    throw Refused("the operator has stopped the program, so there is nothing to compare; start it first");
  const NextProgram next = nextProgram(peer, request);
  endShadow();
  rung_shadow* made = nullptr;
  check(rung_shadow_new(plc_.instance(), next.get().handle(), scans->get<uint32_t>(), kShadowRoom, &made));
  shadow_.reset(made);
  shadowsFor_ = peer.number;
  compared_ = nullptr;
  plc_.post({.kind = host::Command::Kind::Shadow, .shadow = made}, kTakeOverTime);
  plc_.logChange(peer, LogKind::Shadow,
                 "shadow " + next.text + " for " + std::to_string(scans->get<uint32_t>()) + " scans");
  return json::object();
}

json Changes::compared(const Peer& peer, const json&) {
  if (shadow_ != nullptr && shadowsFor_ == peer.number) return shadowReport();
  if (compared_.is_null() || shadowsFor_ != peer.number) throw Refused("there is no shadow; \"shadow\" starts one");
  return compared_;
}

json Changes::shadowReport() {
  auto info = sized<rung_shadow_info>();
  check(rung_shadow_report(shadow_.get(), &info));
  constexpr const char* kStates[] = {"prepared", "running", "finished",
                                     "too-slow", "stopped", "faulted"}; // by rung_shadow_state
  json differences = json::array();
  auto difference = sized<rung_difference>();
  for (uint32_t i = 0; i < kMostChanges && rung_shadow_difference(shadow_.get(), i, &difference) == RUNG_OK; ++i) {
    json row = {{"name", difference.name}, {"runs", difference.runs}, {"first_us", difference.first_us}};
    if (difference.type != 0) { // otherwise a service that only the new program requests
      row["running"] = toJson(difference.type, difference.running);
      row["next"] = toJson(difference.type, difference.next);
    }
    differences.push_back(row);
  }
  return {{"state", info.state < std::size(kStates) ? kStates[info.state] : "unknown"},
          {"runs", info.runs},
          {"fault", info.fault},
          {"differences", differences}};
}

void Changes::compareShadow() {
  if (shadow_ == nullptr) return;
  for (int i = 0; i < turn::kMostShadowRuns; ++i)
    if (rung_shadow_work(shadow_.get()) != RUNG_OK) break;
  json report = shadowReport();
  if (report["state"] == "prepared" || report["state"] == "running") return;
  finishShadow(std::move(report));
}

// Keeps the report and ends the shadow.
void Changes::finishShadow(json report) {
  compared_ = std::move(report);
  endShadow();
}

void Changes::programStopped() {
  if (shadow_ == nullptr) return;
  json report = shadowReport();
  report["state"] = "stopped";
  finishShadow(std::move(report));
}

void Changes::gone(const Peer& peer) {
  if (shadow_ == nullptr || shadowsFor_ != peer.number) return;
  try {
    endShadow();
    // Without steps of the scan thread, the shadow ends later by itself.
    // NOLINTNEXTLINE(bugprone-empty-catch)
  } catch (const Refused&) {
  }
}

} // namespace rung::control

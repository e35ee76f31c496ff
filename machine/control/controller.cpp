// See controller.h.
#include "machine/control/controller.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/values.h"
#include "machine/host/mapping_file.h"

namespace rung::control {

using nlohmann::json;

// ---- requests ------------------------------------------------------------------------------------------------------

struct Controller::Request {
  const char* name = nullptr;
  std::optional<host::Remote> permission; // that the mapping file must grant
  json (*answer)(Controller&, const Peer&, const json&) = nullptr;

  // A request that is answered by a member function of one of the parts, or of the controller itself.
  template <auto part, auto function>
  static json by(Controller& c, const Peer& peer, const json& request) {
    return (c.*part.*function)(peer, request);
  }
  template <auto function>
  static json own(Controller& c, const Peer& peer, const json& request) {
    return (c.*function)(peer, request);
  }
};

const Controller::Request Controller::kRequests[] = {
    {"status", {}, Request::own<&Controller::status>},
    {"messages", {}, Request::by<&Controller::messages_, &Messages::messages>},
    {"acknowledge", host::Remote::Acknowledge, Request::by<&Controller::messages_, &Messages::acknowledge>},
    {"log", {}, Request::by<&Controller::messages_, &Messages::log>},
    {"get", {}, Request::by<&Controller::cells_, &Cells::get>},
    {"watch", {}, Request::by<&Controller::cells_, &Cells::watch>},
    {"map", {}, Request::by<&Controller::status_, &Status::map>},
    {"program", {}, Request::by<&Controller::tables_, &ProgramTables::program>},
    {"rungs", {}, Request::by<&Controller::tables_, &ProgramTables::rungs>},
    {"timers", {}, Request::by<&Controller::status_, &Status::timers>},
    {"profile", {}, Request::by<&Controller::status_, &Status::profile>},
    {"clear-profile", host::Remote::Profile, Request::own<&Controller::clearProfile>},
    {"set", host::Remote::Set, Request::by<&Controller::cells_, &Cells::set>},
    {"event", host::Remote::Set, Request::own<&Controller::event>},
    {"force", host::Remote::Force, Request::by<&Controller::forces_, &Forces::force>},
    {"unforce", host::Remote::Force, Request::by<&Controller::forces_, &Forces::unforce>},
    {"forced", {}, Request::by<&Controller::forces_, &Forces::forced>},
    {"sources", host::Remote::Reload, Request::by<&Controller::compiler_, &CompileService::sources>},
    {"compile", host::Remote::Reload, Request::by<&Controller::compiler_, &CompileService::compile>},
    {"compiled", host::Remote::Reload, Request::by<&Controller::compiler_, &CompileService::compiled>},
    {"reload", host::Remote::Reload, Request::by<&Controller::changes_, &Changes::reload>},
    {"shadow", host::Remote::Reload, Request::by<&Controller::changes_, &Changes::shadow>},
    {"compared", {}, Request::by<&Controller::changes_, &Changes::compared>},
    {"rollback", host::Remote::Reload, Request::by<&Controller::changes_, &Changes::rollback>},
    {"mark", {}, Request::own<&Controller::mark>},
    {"keep", {}, Request::own<&Controller::keep>},
    {"recording", {}, Request::own<&Controller::recording>},
    {"stop", host::Remote::Stop, Request::own<&Controller::stop>},
    {"start", host::Remote::Start, Request::own<&Controller::start>},
    {"reset", host::Remote::Reset, Request::own<&Controller::reset>},
    {"serve", host::Remote::Serve, Request::by<&Controller::services_, &Services::serve>},
    {"live", host::Remote::Serve, Request::by<&Controller::services_, &Services::live>},
    {"served", host::Remote::Serve, Request::by<&Controller::services_, &Services::served>},
};

// Throws Refused if the request is unknown or not permitted.
const Controller::Request& Controller::requestOf(const json& request) const {
  if (!request.is_object()) throw Refused("found " + std::string(request.type_name()) + ", expected an object");
  const std::string wanted = textOf(request, "do");
  const auto* found = std::ranges::find(kRequests, wanted, &Request::name);
  if (found == std::end(kRequests)) throw Refused("found \"" + wanted + "\", expected a command of this protocol");
  if (found->permission && !plc_.host().map().permissions[static_cast<size_t>(*found->permission)]) {
    const std::string right(host::kRemoteNames[static_cast<size_t>(*found->permission)]);
    throw Refused("\"" + right + "\" is not allowed here; for it the mapping file needs [rungctl] permissions = [\"" +
                  right + "\"]");
  }
  const bool changes = found->permission && *found->permission != host::Remote::Serve;
  if (changes && plc_.host().ending()) throw Refused("the program is being switched off");
  return *found;
}

json Controller::answer(const Peer& peer, const json& request) {
  json answer = json::object();
  try {
    const Request& wanted = requestOf(request);
    services_.heard(peer);
    answer = wanted.answer(*this, peer, request);
    if (answer.is_null()) return answer; // it follows later
    if (!answer.contains("ok")) answer["ok"] = true;
  } catch (const std::exception& problem) { // Refused, or out of memory
    answer = {{"ok", false}, {"error", problem.what()}};
  }
  if (request.is_object() && request.contains("id")) answer["id"] = request["id"];
  return answer;
}

// ---- its own -------------------------------------------------------------------------------------------------------

json Controller::simple(host::Command::Kind command, const Peer& peer, LogKind kind, const char* text) {
  plc_.post({.kind = command});
  plc_.logChange(peer, kind, text);
  return json::object();
}

json Controller::status(const Peer&, const json&) {
  json status = status_.status();
  status["requests"] = services_.waiting();
  return status;
}

json Controller::start(const Peer& peer, const json&) {
  return simple(host::Command::Kind::Start, peer, LogKind::Start, "start");
}

json Controller::reset(const Peer& peer, const json&) {
  return simple(host::Command::Kind::Restart, peer, LogKind::Reset, "reset");
}

json Controller::clearProfile(const Peer& peer, const json&) {
  return simple(host::Command::Kind::ClearProfile, peer, LogKind::Profile, "clear the profile");
}

json Controller::stop(const Peer& peer, const json&) {
  plc_.post({.kind = host::Command::Kind::Stop});
  changes_.programStopped();
  plc_.logChange(peer, LogKind::Stop, "stop" + forces_.endedForces());
  forces_.refusePending("the program has been stopped in the meantime; all forces have ended");
  return json::object();
}

namespace {

void checkRecorded(int32_t status) {
  if (status == RUNG_WRONG_STATE)
    throw Refused(
        "this host does not record its program; --retain FILE makes rung-run and rung_hal record, or [recording] "
        "folder = \"PATH\" in the mapping file");
  check(status);
}

} // namespace

json Controller::mark(const Peer& peer, const json& request) {
  constexpr size_t kMost = 400;
  const std::string text = textOf(request, "text");
  if (text.size() > kMost)
    throw Refused("found a text of " + std::to_string(text.size()) + " bytes, expected at most 400");
  checkRecorded(rung_instance_mark(plc_.instance(), text.c_str()));
  plc_.logChange(peer, LogKind::Mark, "mark " + text);
  return json::object();
}

json Controller::keep(const Peer& peer, const json&) {
  checkRecorded(rung_instance_keep_recording(plc_.instance()));
  plc_.logChange(peer, LogKind::Mark, "keep the recording");
  return json::object();
}

// `follow`: what is recorded is written more often for two seconds.
json Controller::recording(const Peer&, const json& request) {
  const json follow = request.value("follow", json(false));
  if (!follow.is_boolean()) throw Refused("found " + follow.dump() + " for \"follow\", expected true or false");
  if (follow.get<bool>()) checkRecorded(rung_instance_follow_recording(plc_.instance()));
  auto info = sized<rung_recording_info>();
  checkRecorded(rung_instance_recording(plc_.instance(), &info));
  json answer = {{"folder", info.folder}, {"file", info.file},       {"since", info.since_us / 1'000'000},
                 {"bytes", info.bytes},   {"written", info.written}, {"losses", info.losses}};
  if (*info.problem != 0) answer["problem"] = info.problem;
  return answer;
}

json Controller::event(const Peer& peer, const json& request) {
  if (!simulation_) throw Refused("this host does not simulate a control; use rung-run --simulate");
  const json keys = request.value("keys", json::object());
  if (!keys.is_object() || !std::ranges::all_of(keys, [](const json& v) { return v.is_string() || v.is_number(); }))
    throw Refused("found no object \"keys\" of texts and numbers in the request, expected one");
  struct {
    const Event& act;
    const std::string name;
    const json& keys;
    std::string problem;
  } doing{simulation_, textOf(request, "name"), keys, ""};
  plc_.post({.kind = host::Command::Kind::Act,
             .act =
                 [](void* actor) {
                   auto& what = *static_cast<decltype(doing)*>(actor);
                   what.problem = what.act(what.name, what.keys);
                 },
             .actor = &doing});
  if (!doing.problem.empty()) throw Refused(doing.problem);
  plc_.logChange(peer, LogKind::Event, "event " + doing.name + " " + keys.dump());
  return json::object();
}

// ---- turns ---------------------------------------------------------------------------------------------------------

Controller::Controller(std::string host, host::PlcHost& plc, const Image& image, Log& log,
                       std::unique_ptr<Programs> programs)
    : log_(log), plc_(plc, log), programs_(std::move(programs)),
      status_(plc_, std::move(host), image.program().dialect), messages_(plc, log), cells_(plc_), tables_(plc_, image),
      compiler_(plc_), forces_(plc_, cells_, *programs_),
      changes_(plc_, cells_, forces_, tables_, compiler_, *programs_), services_(plc) {
  programs_->serveForces(image);
  cells_.learn(image.program());
}

Controller::~Controller() {
  programs_->abandon();
  if (started_) log_.always("the host has ended");
}

void Controller::logStart() {
  log_.always("started with the program " + tables_.text());
  started_ = true;
}

void Controller::gone(const Peer& peer) {
  cells_.gone(peer);
  messages_.gone(peer);
  compiler_.gone(peer);
  services_.gone(peer);
  changes_.gone(peer);
  forces_.gone(peer);
}

void Controller::serveProgram(Sink* sink) {
  host::PlcHost& plc = plc_.host();
  std::vector<host::Report> reports;
  const bool isStopped = !plc.running(); // a restart is finished in this turn
  plc.serve(reports);
  if (std::exchange(restarts_, plc.restarts()) != plc.restarts()) messages_.programRestarted(sink);
  for (const host::Report& report : reports) messages_.report(report, sink);
  if (isStopped)
    if (const std::string names = forces_.takeEndedNames(); !names.empty())
      messages_.report("the forces of " + names + " have ended", sink);
  messages_.work(sink);
}

void Controller::serveClients(Sink& sink) {
  cells_.sendValues(sink);
  services_.work(sink);
  for (const std::string& text : services_.takeReports()) messages_.report(text, &sink);
  forces_.finishPending(sink);
  changes_.compareShadow();
}

} // namespace rung::control

// See controller.h.
#include "machine/control/controller.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/profile.h"
#include "machine/control/values.h"
#include "machine/host/mapping_file.h"
#include "rtlib/text/controls.h"
#include "rung/types.hpp"

namespace rung::control {

using nlohmann::json;

namespace {

constexpr size_t kMostNames = 256;  // of a watch
constexpr size_t kMostRecent = 200; // messages of an answer without the history
constexpr uint32_t kMostForces = 64;
constexpr size_t kMostChanges = 1000; // that a report lists
constexpr uint32_t kMostShadowPasses = 100'000;
constexpr uint32_t kShadowRoom = 256;  // runs of tasks that wait to be compared
constexpr uint32_t kPassesKept = 4096; // of a watch of all scans

std::string textOf(const json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_string())
    throw Refused(std::string("found no text \"") + key + "\" in the request, expected one");
  std::string text = found->get<std::string>();
  if (text::hasControls(text))
    throw Refused(std::string("found a control character in \"") + key + "\", expected none");
  return text;
}

bool flagOf(const json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end()) return false;
  if (!found->is_boolean())
    throw Refused(std::string("found no true or false for \"") + key + "\", expected one of them");
  return found->get<bool>();
}

std::vector<std::string> namesOf(const json& request) {
  const auto found = request.find("names");
  const bool good = found != request.end() && found->is_array() && !found->empty() && found->size() <= kMostNames &&
                    std::ranges::all_of(*found, &json::is_string);
  if (found != request.end() && found->is_array() && found->size() > kMostNames)
    throw Refused("found " + std::to_string(found->size()) + " names, expected at most " + std::to_string(kMostNames) +
                  ", because all come from one scan; ask for them in parts");
  if (!good) throw Refused("found no list \"names\" of 1 to 256 texts in the request, expected one");
  auto names = found->get<std::vector<std::string>>();
  if (std::ranges::any_of(names, [](const std::string& name) { return text::hasControls(name); }))
    throw Refused("found a control character in \"names\", expected none");
  return names;
}

std::string programOf(const json& request) {
  std::string path = textOf(request, "program");
  if (!path.starts_with('/')) throw Refused("found the path " + path + ", expected an absolute one");
  return path;
}

std::string shown(uint32_t type, rung_value value) { return toJson(type, value).dump(); }

const char* changeName(uint32_t kind) {
  constexpr const char* kNames[] = {"new",     "removed",  "moved", "renamed",
                                    "retyped", "released", "cut"}; // enum rung_change_kind
  return kind < std::size(kNames) ? kNames[kind] : "changed";
}

std::string joined(const std::vector<std::string>& texts, const char* between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

const char* rungChangeName(uint32_t kind) {
  constexpr const char* kNames[] = {"new", "removed", "changed", "moved"}; // enum rung_rung_change_kind
  return kind < std::size(kNames) ? kNames[kind] : "changed";
}

bool loses(uint32_t kind) {
  return kind == RUNG_CHANGE_REMOVED || kind == RUNG_CHANGE_RETYPED || kind == RUNG_CHANGE_RELEASED ||
         kind == RUNG_CHANGE_CUT;
}

} // namespace

// By name, as long as this exists.
struct Controller::FoundCells {
  explicit FoundCells(rung_instance* instance) : of(instance) {}
  ~FoundCells() {
    for (const rung_cell cell : cells) rung_instance_release(of, cell);
  }
  FoundCells(FoundCells&& other) noexcept
      : of(other.of), cells(std::exchange(other.cells, {})), infos(std::move(other.infos)) {}
  FoundCells& operator=(FoundCells&&) = delete;

  rung_instance* of;
  std::vector<rung_cell> cells;
  std::vector<rung_cell_info> infos;
};

struct Controller::Watching {
  Watching(rung_instance* instance, const FoundCells& found, bool everyPass)
      : of(instance), cells(found.cells), all(everyPass), gone(found.cells.size()), values(found.cells.size()),
        sent(found.cells.size()) {
    for (const rung_cell_info& info : found.infos) types.push_back(info.type);
    check(rung_watch_new(of, found.cells.data(), static_cast<uint32_t>(found.cells.size()), all ? kPassesKept : 0,
                         &watch));
  }
  ~Watching() { rung_watch_free(watch); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

  bool hasChanged(const rung_sample& sample) const {
    return sample.generation != generation ||
           std::memcmp(values.data(), sent.data(), values.size() * sizeof(rung_value)) != 0;
  }
  // Of a cell that the program no longer has, or has with another type than the client knows: null.
  json valueOf(size_t i) const { return gone[i] ? json() : toJson(types[i], values[i]); }
  json event(const rung_sample& sample) {
    if (sample.generation != generation) {
      generation = sample.generation;
      for (size_t i = 0; i < cells.size(); ++i) {
        auto info = sized<rung_cell_info>();
        gone[i] = rung_instance_cell(of, cells[i], &info) != RUNG_OK || info.type != types[i];
      }
    }
    json list = json::array();
    for (size_t i = 0; i < values.size(); ++i) list.push_back(valueOf(i));
    sent = values;
    begun = true;
    return {{"event", "values"}, {"scan", sample.pass}, {"us", sample.now_us}, {"lost", sample.lost}, {"values", list}};
  }

  rung_instance* of;
  std::vector<rung_cell> cells;
  rung_watch* watch = nullptr;
  std::vector<uint32_t> types;
  bool all;
  uint32_t generation = 0; // of what is known of the cells
  std::vector<bool> gone;
  bool begun = false;
  std::vector<rung_value> values, sent;
};

struct Controller::HeldCell {
  std::string name;
  std::string owner;
  rung_value value{};
  bool operator==(const HeldCell& other) const {
    return name == other.name && owner == other.owner && value.integer == other.value.integer;
  }
};

// Of the set of forces, as a client has requested it.
struct Controller::ForceChange {
  Peer peer;
  std::vector<HeldCell> before;
  std::vector<HeldCell> cells; // from then on
  std::string text;            // for the log
  json answer;                 // when it is done
  json id = json::object();    // of the request, where that has one
  std::string refused = {};    // why it will not be done any more
};

const Controller::Row Controller::kRows[] = {
    {"status", std::nullopt, &Controller::status},
    {"messages", std::nullopt, &Controller::messages},
    {"get", std::nullopt, &Controller::get},
    {"watch", std::nullopt, &Controller::watch},
    {"map", std::nullopt, &Controller::map},
    {"profile", std::nullopt, &Controller::profile},
    {"clear-profile", host::Remote::Profile, &Controller::clearProfile},
    {"set", host::Remote::Set, &Controller::set},
    {"event", host::Remote::Set, &Controller::event},
    {"force", host::Remote::Force, &Controller::force},
    {"unforce", host::Remote::Force, &Controller::unforce},
    {"forced", std::nullopt, &Controller::forced},
    {"sources", host::Remote::Reload, &Controller::sources},
    {"compile", host::Remote::Reload, &Controller::compile},
    {"compiled", host::Remote::Reload, &Controller::compiled},
    {"reload", host::Remote::Reload, &Controller::reload},
    {"shadow", host::Remote::Reload, &Controller::shadow},
    {"compared", std::nullopt, &Controller::compared},
    {"rollback", host::Remote::Reload, &Controller::rollback},
    {"stop", host::Remote::Stop, &Controller::stop},
    {"start", host::Remote::Start, &Controller::start},
    {"reset", host::Remote::Reset, &Controller::reset},
    {"serve", host::Remote::Serve, &Controller::serve},
    {"live", host::Remote::Serve, &Controller::live},
    {"served", host::Remote::Serve, &Controller::served},
};

Controller::Controller(std::string host, host::PlcHost& plc, const Image& image, Log& log,
                       std::unique_ptr<Programs> programs)
    : host_(std::move(host)), plc_(plc), services_(plc), dialect_(image.program().dialect), log_(log),
      programs_(std::move(programs)) {
  programs_->serveForces(image);
  learnSymbols(image.program());
}

Controller::~Controller() {
  programs_->abandon();
  history_.end(plc_.clock().dateS());
}

json Controller::greeting() {
  return {
      {"rung", "host"}, {"protocol", kProtocol}, {"host", host_}, {"program", running().name}, {"dialect", dialect_}};
}

json Controller::answer(const Peer& peer, const json& request) {
  json answer = json::object();
  try {
    if (!request.is_object()) throw Refused("found " + std::string(request.type_name()) + ", expected an object");
    const std::string wanted = textOf(request, "do");
    const auto* command = std::ranges::find(kRows, wanted, &Row::name);
    if (command == std::end(kRows)) throw Refused("found \"" + wanted + "\", expected a command of this protocol");
    if (command->permission && !plc_.map().permissions[static_cast<size_t>(*command->permission)]) {
      const std::string right(host::kRemoteNames[static_cast<size_t>(*command->permission)]);
      throw Refused("\"" + right + "\" is not allowed here; for it the mapping file needs [rungctl] permissions = [\"" +
                    right + "\"]");
    }
    const bool changes = command->permission && *command->permission != host::Remote::Serve;
    if (changes && plc_.ending()) throw Refused("the program is being switched off");
    services_.heard(peer);
    answer = (this->*command->run)(peer, request);
    if (answer.is_null()) {
      if (request.contains("id")) pending_->id["id"] = request["id"];
      return answer;
    }
    if (!answer.contains("ok")) answer["ok"] = true;
  } catch (const std::exception& problem) { // Refused, or no memory
    answer = {{"ok", false}, {"error", problem.what()}};
  }
  if (request.is_object() && request.contains("id")) answer["id"] = request["id"];
  return answer;
}

void Controller::gone(const Peer& peer) {
  watching_.erase(peer.number);
  std::erase(following_, peer.number);
  compiler_.gone(peer);
  services_.gone(peer);
  if (shadow_ != nullptr && shadowsFor_ == peer.number) {
    try {
      endShadow();
      // Without a step of the scan thread it ends when it is over. NOLINTNEXTLINE(bugprone-empty-catch)
    } catch (const Refused&) {
    }
  }
  if (pending_ == nullptr || pending_->peer.number != peer.number) return;
  programs_->abandon();
  pending_.reset();
}

// ---- looking -------------------------------------------------------------------------------------------------------

rung_program_info Controller::running() const {
  auto info = sized<rung_program_info>();
  check(rung_instance_program(plc_.instance(), &info));
  return info;
}

namespace {

json jsonOf(const host::FunctionState& functions) {
  json list = json::array();
  for (uint32_t i = 0; i < std::min(functions.count, host::FunctionState::kMost); ++i) {
    const host::FunctionState::Function& function = functions.oldest[i];
    list.push_back({{"function", host::kFunctionKinds[function.kind]},
                    {"code", function.code},
                    {"channel", function.channel + 1},
                    {"us", function.ageNs / 1000},
                    {"begun", function.begun},
                    {"late", function.late}});
  }
  return {{"count", functions.count}, {"lost", functions.lost}, {"oldest", list}};
}

} // namespace

json Controller::status(const Peer&, const json&) {
  const rung_program_info program = running();
  json out = {{"host", host_}, {"program", program.name}, {"dialect", dialect_}};
  if (program.faulted != 0) out["fault_of"] = program.faulted_name;
  if (addToStatus_) addToStatus_(out);
  host::Command order{.kind = host::Command::Kind::State};
  const host::CommandResult answer = plc_.post(order);
  out["scanned"] = answer.ok();
  out["powered_off"] = plc_.ended();
  if (!answer.ok()) return out;
  const uint32_t flags = order.state.flags;
  out["scans"] = order.state.passes;
  out["missed"] = order.state.missed;
  out["restarts"] = plc_.restarts();
  out["functions"] = jsonOf(order.functions);
  out["us"] = order.state.now_us;
  out["stopped"] = (flags & RUNG_STATE_STOPPED) != 0;
  out["unsaved"] = (flags & RUNG_STATE_UNSAVED) != 0;
  out["faulted"] = (flags & RUNG_STATE_FAULTED) != 0;
  if (!plc_.restartProblem().empty()) out["restart_problem"] = plc_.restartProblem();
  const bool faulted = (flags & RUNG_STATE_FAULTED) != 0; // a fault of after the order is of another moment
  if (const std::optional<rung_fault_info> fault = faulted ? plc_.fault() : std::nullopt) {
    out["fault"] = fault->text;
    out["file"] = fault->file;
    out["line"] = fault->line;
  }
  return out;
}

namespace {

json jsonOf(const History& history, const History::Entry& entry) {
  json out = {{"text", entry.text}, {"came", entry.cameS}, {"on", history.isOn(entry)}};
  out["kind"] = entry.key ? "message" : "event";
  if (entry.wentS) out["went"] = *entry.wentS;
  if (entry.times != 1) out["times"] = entry.times;
  if (entry.cut) out["cut"] = true;
  return out;
}

// The last ones, unless `all` are asked for; what is on is always among them.
std::vector<History::Entry> wantedOf(const History& history, bool all) {
  std::vector<History::Entry> wanted;
  size_t recent = 0;
  for (const History::Entry& entry : history.shown())
    if (history.entries().empty() || entry.number < history.entries().front().number) wanted.push_back(entry);
  for (const History::Entry& entry : history.entries()) recent += history.isNew(entry) ? 1 : 0;
  for (const History::Entry& entry : history.entries()) {
    const bool isRecent = history.isNew(entry) && recent-- <= kMostRecent;
    if (all || isRecent || history.isOn(entry)) wanted.push_back(entry);
  }
  return wanted;
}

std::string lineOf(int64_t seconds, const std::string& text) { return dateText(seconds) + " " + text; }

} // namespace

json Controller::messages(const Peer& peer, const json& request) {
  const bool all = flagOf(request, "history");
  if (flagOf(request, "follow") && std::ranges::find(following_, peer.number) == following_.end())
    following_.push_back(peer.number);
  json lines = json::array(), entries = json::array(), shown = json::array();
  for (const History::Entry& entry : wantedOf(history_, all)) {
    lines.push_back(lineOf(entry.cameS, entry.text));
    entries.push_back(jsonOf(history_, entry));
  }
  for (const History::Entry& entry : history_.shown()) shown.push_back(entry.text);
  return {{"messages", lines}, {"entries", entries}, {"shown", shown}};
}

void Controller::serveProgram(Sink* sink) {
  std::vector<std::string> reports;
  const bool isStopped = !plc_.running(); // a restart is done in this turn
  plc_.serve(reports);
  if (std::exchange(restarts_, plc_.restarts()) != plc_.restarts())
    for (const std::string& text : history_.goAll(plc_.clock().dateS())) tellFollowers(sink, "gone", text, false);
  for (const std::string& text : reports) report(text, sink);
  if (isStopped && !heldNames_.empty())
    report("the forces of " + joined(std::exchange(heldNames_, {}), ", ") + " have ended", sink);
  passMessages(sink);
  keepHistory(sink);
  log_.tick();
}

void Controller::keepHistory(Sink* sink) {
  const std::string problem = historyFile_ == nullptr ? "" : historyFile_->tick(plc_.clock().dateS());
  if (!problem.empty()) report(problem, sink);
}

// As many as fit into a turn: who waits for a restart or an answer does not wait for a program that never ends talking.
void Controller::passMessages(Sink* sink) {
  constexpr int kMostMessages = 64;
  rung_message_info message{};
  for (int i = 0; i < kMostMessages && plc_.nextMessage(message); ++i) pass(message, sink);
}

void Controller::pass(const rung_message_info& message, Sink* sink) {
  const History::Key key{message.number, message.channel, message.index};
  const int64_t now = plc_.clock().dateS();
  if (message.op == RUNG_MESSAGE_CLEAR) {
    if (const std::string text = history_.go(key, now); !text.empty()) tellFollowers(sink, "gone", text, false);
    return;
  }
  std::string text = std::string("message ") + message.text;
  while (text.ends_with(' ')) text.pop_back(); // of a number without a text
  const bool isNew = log_.line(text);
  const bool isLogged = message.op == RUNG_MESSAGE_LOG;
  if (!isLogged)
    history_.come(key, text, now, !isNew);
  else if (isNew)
    history_.happen(text, now);
  tellFollowers(sink, "message", text, isLogged);
}

void Controller::report(const std::string& text, Sink* sink) {
  if (log_.line(text)) history_.happen(text, plc_.clock().dateS());
  tellFollowers(sink, "message", text, false);
}

// `logged`: for the log alone, not for the operator.
void Controller::tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged) {
  if (sink == nullptr) return;
  const std::string line = lineOf(plc_.clock().dateS(), text);
  for (const uint32_t peer : following_) sink->send(peer, {{"event", event}, {"text", line}, {"logged", logged}});
}

rung_cell_info Controller::describe(const std::string& name, int32_t access) const {
  auto info = sized<rung_cell_info>();
  int64_t value = 0;
  const int32_t status = rung_instance_describe(plc_.instance(), nullptr, name.c_str(), access, &info, &value);
  if (status == RUNG_NOT_FOUND) {
    const std::string problem = rung_error_text(); // looking for the name that was meant makes others
    throw Refused(problem + text::didYouMean(meantBy(name)));
  }
  check(status);
  if (info.type == RUNG_TYPE_TEXT) throw Refused(name + " is a text, expected a bit or a number");
  return info;
}

// A name of the program that runs now; "" when none is close.
std::string Controller::meantBy(const std::string& name) const {
  for (const std::vector<std::string>& symbols : {symbols_, formerSymbols_})
    if (std::string meant = host::meantName(name, symbols);
        !meant.empty() && cellInfo(plc_.instance(), meant, RUNG_READ))
      return meant;
  return {};
}

// The program before may come back.
void Controller::learnSymbols(const rung_program& program) {
  formerSymbols_ = std::exchange(symbols_, {});
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count))
    if ((symbol.flags & RUNG_SYMBOL_HIDDEN) == 0) symbols_.emplace_back(symbol.name);
}

Controller::FoundCells Controller::find(const std::vector<std::string>& names, int32_t access) const {
  FoundCells all(plc_.instance());
  for (const std::string& name : names) {
    all.infos.push_back(describe(name, access));
    rung_cell cell = 0;
    check(rung_instance_find(plc_.instance(), name.c_str(), access, &cell));
    all.cells.push_back(cell);
  }
  return all;
}

json Controller::watch(const Peer& peer, const json& request) {
  const std::vector<std::string> names = namesOf(request);
  const FoundCells found = find(names, RUNG_READ);
  watching_[peer.number] = std::make_unique<Watching>(plc_.instance(), found, flagOf(request, "all"));
  json described = json::array();
  for (size_t i = 0; i < names.size(); ++i)
    described.push_back(
        {{"name", names[i]}, {"type", typeName(found.infos[i].type)}, {"address", found.infos[i].address}});
  return {{"names", described}};
}

std::string Controller::whyNoScanEnds() {
  const std::optional<rung_state> now = stateNow();
  if (!now) return "the scan thread does not run";
  if (const std::optional<rung_fault_info> fault = plc_.running() ? std::nullopt : plc_.fault())
    return std::string("the program has not finished a scan: it is stopped by a fault: ") + fault->text;
  if ((now->flags & RUNG_STATE_STOPPED) != 0)
    return "the program has not finished a scan since it was switched on: it is stopped by the operator";
  return "the program has not finished a scan within a second";
}

// The values at the end of a scan.
json Controller::get(const Peer&, const json& request) {
  const std::vector<std::string> names = namesOf(request);
  if (plc_.ended()) throw Refused("the program has been switched off");
  const FoundCells found = find(names, RUNG_READ);
  Watching once(plc_.instance(), found, false);
  auto sample = sized<rung_sample>();
  const int64_t end = plc_.clock().nowNs() + std::chrono::nanoseconds(host::PlcHost::kPatience).count();
  while (rung_watch_newest(once.watch, once.values.data(), &sample) != RUNG_OK) {
    if (plc_.clock().nowNs() >= end) throw Refused(whyNoScanEnds());
    host::Command look{.kind = host::Command::Kind::State}; // waits for a step of the scan thread
    plc_.post(look);
  }
  json values = json::object();
  for (size_t i = 0; i < names.size(); ++i) values[names[i]] = toJson(once.types[i], once.values[i]);
  return {{"scan", sample.pass}, {"us", sample.now_us}, {"values", values}};
}

void Controller::serveClients(Sink& sink) {
  sendValues(sink);
  services_.work(sink);
  for (const std::string& text : services_.takeReports()) report(text, &sink);
  finishPending(sink);
  compareShadow();
}

void Controller::sendValues(Sink& sink) {
  constexpr int kMostPasses = 500; // in a turn
  for (auto& [peer, watching] : watching_) {
    auto sample = sized<rung_sample>();
    if (watching->all) {
      for (int i = 0; i < kMostPasses; ++i) {
        if (rung_watch_next(watching->watch, watching->values.data(), &sample) != RUNG_OK) break;
        sink.send(peer, watching->event(sample));
      }
    } else if (rung_watch_newest(watching->watch, watching->values.data(), &sample) == RUNG_OK &&
               (!watching->begun || watching->hasChanged(sample))) {
      sink.send(peer, watching->event(sample));
    }
  }
}

namespace {

// What the program has a pin for, as the mapping file says it: "DOOR", "bit 3 of X0", "M3", "done of M3".
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

// Empty: no thread scans the program.
std::vector<host::Value> Controller::pinValues() {
  struct {
    const host::PlcHost& plc;
    std::vector<host::Value> values;
  } looking{plc_, std::vector<host::Value>(plc_.pins().size())};
  host::Command look{.kind = host::Command::Kind::Act,
                     .act =
                         [](void* actor) {
                           auto& what = *static_cast<decltype(looking)*>(actor);
                           what.plc.lookAtPins(what.values);
                         },
                     .actor = &looking};
  return plc_.post(look).ok() ? looking.values : std::vector<host::Value>();
}

json Controller::map(const Peer&, const json&) {
  const host::File& map = plc_.map();
  const std::vector<host::Value> values = pinValues();
  json pins = json::array();
  for (uint32_t i = 0; i < map.pins.size(); ++i) {
    const host::Pin& pin = map.pins[i];
    pins.push_back({{"name", pin.name},
                    {"type", host::pinTypeName(pin.type)},
                    {"table", host::tableName(pin.direction)},
                    {"uses", usesOf(map, i)},
                    {"file", map.paths[pin.at.file]},
                    {"line", pin.at.line}});
    if (!values.empty()) pins.back()["value"] = jsonOf(pin.type, values[i]);
  }
  json permissions = json::array();
  for (size_t i = 0; i < std::size(host::kRemoteNames); ++i)
    if (map.permissions[i]) permissions.push_back(host::kRemoteNames[i]);
  json protectedNames = json::array();
  for (const host::Protected& cell : map.protectedCells) protectedNames.push_back(cell.name);
  return {{"files", map.paths}, {"pins", pins}, {"permissions", permissions}, {"protected", protectedNames}};
}

json Controller::profile(const Peer&, const json& request) { return profileOf(plc_, request); }

json Controller::clearProfile(const Peer& peer, const json&) {
  return simple(host::Command::Kind::ClearProfile, peer, "clear the profile");
}

// ---- changing ------------------------------------------------------------------------------------------------------

void Controller::logChange(const Peer& peer, const std::string& text) {
  log_.always(peer.name + " (user " + std::to_string(peer.user) + ", process " + std::to_string(peer.process) +
              "): " + text);
}

// The place that the program reads, and the one that the machine writes.
std::vector<Controller::Range> Controller::rangesOf(const std::string& name) const {
  std::vector<Range> ranges;
  for (const int32_t access : {RUNG_READ, RUNG_WRITE}) {
    const std::optional<rung_cell_info> info = cellInfo(plc_.instance(), name, access);
    if (!info || info->space == RUNG_NONE) continue;
    constexpr uint64_t kBitsOfAByte = 8;
    ranges.push_back({info->space, info->byte * kBitsOfAByte + info->bit,
                      uint64_t{elementBits(info->type)} * std::max<uint32_t>(1, info->count)});
  }
  return ranges;
}

// By where the names are in the program that runs: a reload may have moved them.
void Controller::refuseProtected(const std::string& name) const {
  const std::vector<Range> wanted = rangesOf(name);
  for (const host::Protected& cell : plc_.map().protectedCells) {
    const std::vector<Range> kept = rangesOf(cell.name);
    if (kept.empty()) throw Refused("whether " + name + " is protected is not known: " + cell.name + " is not found");
    if (shareOf(cell.name, wanted) != Share::None)
      throw Refused(name + " is protected by the mapping file ([rungctl] protected)");
  }
}

// How much of what is wanted lies in the cell of this name.
Controller::Share Controller::shareOf(const std::string& name, const std::vector<Range>& wanted) const {
  const std::vector<Range> held = rangesOf(name);
  const auto meets = [&](const Range& range) {
    return std::ranges::any_of(held, [&](const Range& by) { return by.meets(range); });
  };
  const auto lies = [&](const Range& range) {
    return std::ranges::any_of(held, [&](const Range& by) { return by.covers(range); });
  };
  if (wanted.empty() || std::ranges::none_of(wanted, meets)) return Share::None;
  return std::ranges::all_of(wanted, lies) ? Share::All : Share::Part;
}

// Of the pins for the bits of a cell those that write what is wanted; all of them where none has a bit of it.
std::string Controller::writerOf(const host::PlcHost::Feed& feed, const std::vector<Range>& wanted) const {
  if (feed.bits.empty()) return feed.by;
  std::vector<std::string> pins;
  for (const Range& held : rangesOf(feed.name))
    for (uint64_t bit = 0; bit < feed.bits.size(); ++bit) {
      const Range place{held.space, held.first + bit, 1};
      const bool isWanted = std::ranges::any_of(wanted, [&](const Range& range) { return range.meets(place); });
      if (isWanted && std::ranges::find(pins, feed.bits[bit]) == pins.end()) pins.push_back(feed.bits[bit]);
    }
  if (pins.empty()) pins = feed.bits;
  return pins.size() == 1 ? "pin " + pins.front() : "pins " + pins.front() + " to " + pins.back();
}

// A value that would be gone before the program sees it, or of which a force keeps something. What is to be said of the
// others: a part of the cell is written by pins, or "".
std::string Controller::refuseWithoutEffect(const std::string& name) {
  const std::vector<Range> wanted = rangesOf(name);
  for (const rung_force_info& force : forcesInEffect())
    if (const Share share = shareOf(force.name, wanted); share != Share::None)
      throw Refused(name +
                    (share == Share::Part ? " has " + std::string(force.name) + ", which is forced to "
                     : name == force.name ? " is forced to "
                                          : " is forced as " + std::string(force.name) + " to ") +
                    shown(force.type, force.value) + ": it stays so");
  std::string kept;
  for (const host::PlcHost::Feed& feed : plc_.feeds()) {
    const Share share = shareOf(feed.name, wanted);
    if (share == Share::All)
      throw Refused(name + " is written before every slice by " + writerOf(feed, wanted) +
                    ": setting it has no effect, forcing it has (rungctl force " + name + " VALUE)");
    if (share == Share::Part) kept += (kept.empty() ? "" : ", ") + feed.name + " by " + writerOf(feed, wanted);
  }
  return kept.empty()
             ? ""
             : "part of " + name + " is written before every slice, so setting it has no effect there: " + kept;
}

host::Command Controller::give(host::Command order, std::chrono::milliseconds time) {
  const host::CommandResult answer = plc_.post(order, time);
  if (!answer.ok()) throw Refused(answer.problem);
  return order;
}

json Controller::set(const Peer& peer, const json& request) {
  const std::string name = textOf(request, "name");
  if (!request.contains("value")) throw Refused("found no \"value\" in the request, expected one");
  const FoundCells found = find({name}, RUNG_WRITE);
  const uint32_t type = found.infos.front().type;
  refuseProtected(name);
  std::string note = refuseWithoutEffect(name);
  const rung_value value = fromJson(type, request["value"], name);
  const host::Command done = give({.kind = host::Command::Kind::Write, .cell = found.cells.front(), .value = value});
  logChange(peer, "set " + name + " from " + shown(type, done.former) + " to " + shown(type, value));
  json answer = {{"name", name}, {"former", toJson(type, done.former)}, {"value", toJson(type, value)}};
  if ((done.state.flags & RUNG_STATE_FAULTED) != 0)
    note = "a fault has stopped the program: only inputs that are set now survive the reset";
  if (!note.empty()) answer["note"] = note;
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
  give({.kind = host::Command::Kind::Act,
        .act =
            [](void* actor) {
              auto& what = *static_cast<decltype(doing)*>(actor);
              what.problem = what.act(what.name, what.keys);
            },
        .actor = &doing});
  if (!doing.problem.empty()) throw Refused(doing.problem);
  logChange(peer, "event " + doing.name + " " + keys.dump());
  return json::object();
}

std::vector<rung_force_info> Controller::forcesInEffect() {
  std::vector<rung_force_info> list;
  for (uint32_t i = 0; i < kMostForces; ++i) {
    host::Command order{.kind = host::Command::Kind::Forced, .index = i};
    const host::CommandResult answer = plc_.post(order);
    if (!answer.ok()) throw Refused(answer.problem);
    if (answer.status == RUNG_EMPTY) break;
    list.push_back(order.force);
  }
  return list;
}

std::vector<Controller::HeldCell> Controller::heldCells() {
  std::vector<HeldCell> cells;
  for (const rung_force_info& force : forcesInEffect()) cells.push_back({force.name, force.owner, force.value});
  return cells;
}

void Controller::refuseWhilePending() const {
  if (pending_ != nullptr)
    throw Refused("another force is being compiled; try again later, or release all: unforce --all");
}

// Nothing: the compiler is at work on its code.
std::optional<Controller::Forces> Controller::prepared(const ForceChange& change) {
  if (change.cells.empty()) return Forces();
  std::vector<rung_forced_cell> cells;
  for (const HeldCell& cell : change.cells)
    cells.push_back({cell.name.c_str(), cell.owner.c_str(), cell.value, RUNG_READ, 0});
  rung_forces* made = nullptr;
  const int32_t status =
      check(rung_forces_new(plc_.instance(), nullptr, cells.data(), static_cast<uint32_t>(cells.size()), &made));
  return status == RUNG_LATER ? std::nullopt : std::optional<Forces>(made);
}

void Controller::putInEffect(const ForceChange& change, Forces forces) {
  give({.kind = host::Command::Kind::Force, .forces = forces.get()});
  forces_ = std::move(forces); // the former set has ended
  heldNames_.clear();
  for (const HeldCell& cell : change.cells) heldNames_.push_back(cell.name);
  logChange(change.peer, change.text);
}

// Its answer; null where that comes later.
json Controller::begin(ForceChange change) {
  if (std::optional<Forces> forces = prepared(change)) {
    putInEffect(change, std::move(*forces));
    return change.answer;
  }
  pending_ = std::make_unique<ForceChange>(std::move(change));
  return nullptr;
}

// What has happened meanwhile ends forces, too.
void Controller::refusePending(const std::string& why) {
  if (pending_ == nullptr) return;
  programs_->abandon();
  pending_->refused = why;
}

void Controller::finishPending(Sink& sink) {
  if (pending_ == nullptr) return;
  if (pending_->refused.empty() && !plc_.running())
    refusePending("the program has stopped in the meantime; all forces have ended");
  json answer = pending_->answer;
  try {
    if (!pending_->refused.empty()) throw Refused(pending_->refused);
    std::optional<Forces> forces = prepared(*pending_);
    if (!forces) return;
    if (heldCells() != pending_->before) throw Refused("forces have ended in the meantime and are not applied again");
    putInEffect(*pending_, std::move(*forces));
    answer["ok"] = true;
  } catch (const std::exception& problem) {
    answer = {{"ok", false}, {"error", problem.what()}};
  }
  answer.update(pending_->id);
  const uint32_t peer = pending_->peer.number;
  pending_.reset();
  sink.answer(peer, answer);
}

json Controller::force(const Peer& peer, const json& request) {
  const std::string name = textOf(request, "name");
  if (!request.contains("value")) throw Refused("found no \"value\" in the request, expected one");
  const uint32_t type = describe(name, RUNG_READ).type;
  refuseProtected(name);
  refuseWhilePending();
  if (!plc_.running()) throw Refused("a fault has stopped the program: a reset restarts it");
  const rung_value value = fromJson(type, request["value"], name);
  std::vector<HeldCell> before = heldCells();
  std::vector<HeldCell> cells = {{name, peer.name, value}};
  std::ranges::copy_if(before, std::back_inserter(cells), [&](const HeldCell& cell) { return cell.name != name; });
  if (cells.size() > kMostForces) throw Refused("64 variables are already forced; release one first");
  return begin({.peer = peer,
                .before = std::move(before),
                .cells = std::move(cells),
                .text = "force " + name + " to " + shown(type, value),
                .answer = {{"name", name}, {"value", toJson(type, value)}}});
}

json Controller::unforce(const Peer& peer, const json& request) {
  const bool all = flagOf(request, "all");
  const std::string name = all ? "" : textOf(request, "name");
  if (all)
    refusePending("all forces have been released in the meantime");
  else
    refuseWhilePending();
  std::vector<HeldCell> before = heldCells();
  std::vector<HeldCell> left;
  std::ranges::copy_if(before, std::back_inserter(left),
                       [&](const HeldCell& cell) { return !all && cell.name != name; });
  json ended = json::array();
  for (const HeldCell& cell : before)
    if (all || cell.name == name) ended.push_back(cell.name);
  if (!all && ended.empty()) throw Refused(name + " is not forced");
  json answer = {{"ended", ended.size()}, {"names", ended}};
  if (ended.empty()) return answer;
  return begin({.peer = peer,
                .before = std::move(before),
                .cells = std::move(left),
                .text = all ? "unforce all" : "unforce " + name,
                .answer = std::move(answer)});
}

json Controller::forced(const Peer&, const json&) {
  json list = json::array();
  for (const rung_force_info& force : forcesInEffect())
    list.push_back({{"name", force.name},
                    {"value", toJson(force.type, force.value)},
                    {"owner", force.owner},
                    {"since_us", force.since_us}});
  return {{"forced", list}};
}

json Controller::sources(const Peer& peer, const json& request) { return compiler_.sources(peer, request); }

json Controller::compile(const Peer& peer, const json& request) {
  json answer = compiler_.compile(peer, request);
  logChange(peer, "compile " + answer["bytes"].dump() + " bytes of sources");
  return answer;
}

json Controller::compiled(const Peer& peer, const json& request) { return compiler_.compiled(peer, request); }

// A file, or what has been compiled for this client.
Controller::NextProgram Controller::nextProgram(const Peer& peer, const json& request) {
  NextProgram next;
  if (flagOf(request, "compiled")) {
    next.image = &compiler_.image(peer);
    next.text = std::string(next.image->program().name) + ", compiled here from sources";
  } else {
    next.text = programOf(request);
    next.opened = programs_->open(next.text);
  }
  return next;
}

namespace {

// What becomes of the state when the replacement's program takes over.
json reportOf(const rung_replacement* replacement, std::string& lost) {
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(replacement, &info));
  json changes = json::array();
  auto change = sized<rung_change>();
  for (uint32_t i = 0; i < kMostChanges && rung_replacement_change(replacement, i, &change) == RUNG_OK; ++i) {
    changes.push_back({{"kind", changeName(change.kind)},
                       {"name", change.name},
                       {"former", change.former},
                       {"state", change.is_state != 0}});
    if (loses(change.kind)) lost += (lost.empty() ? "" : ", ") + std::string(change.name);
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

// For the log.
std::string Controller::endedForces() {
  if (heldNames_.empty()) return {};
  return ", which ends the forces of " + joined(std::exchange(heldNames_, {}), ", ");
}

// Ends forces; `why`: for those that are being made.
json Controller::putInPlace(rung_replacement* replacement, const std::vector<rung_cell>& dead, json report,
                            const char* why) {
  json ended = json::array();
  for (const HeldCell& cell : heldCells()) ended.push_back(cell.name);
  constexpr std::chrono::seconds kTime(3);
  const host::Command done =
      give({.kind = host::Command::Kind::Replace, .replacement = replacement, .dead = &dead}, kTime);
  forces_.reset();
  refusePending(why);
  report["ended_forces"] = ended;
  report["stopped"] = (done.state.flags & RUNG_STATE_STOPPED) != 0; // by the operator, as the program before
  if (plc_.running() && (done.state.flags & RUNG_STATE_STOPPED) == 0) waitForPass(done.state.passes);
  report["waits"] = !plc_.running(); // for a reset
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(replacement, &info));
  report["put_back"] = info.next == 0; // by a fault, already
  return report;
}

// The first one after so many, or its fault: then it is known whether the new program can run at all.
void Controller::waitForPass(uint64_t passes) {
  constexpr int64_t kMostNs = 300'000'000, kLookNs = 1'000'000;
  constexpr uint32_t kEnd = RUNG_STATE_FAULTED | RUNG_STATE_STOPPED;
  for (const int64_t end = plc_.clock().nowNs() + kMostNs; plc_.clock().nowNs() < end; plc_.clock().sleep(kLookNs)) {
    const std::optional<rung_state> now = stateNow();
    if (!now || (now->flags & kEnd) != 0 || now->passes != passes) return;
  }
}

json Controller::reload(const Peer& peer, const json& request) {
  const NextProgram next = nextProgram(peer, request);
  const Image& image = next.get();
  programs_->serveForces(image);
  rung_replacement* made = nullptr;
  check(rung_replacement_new(plc_.instance(), image.handle(), nullptr, 0, &made));
  std::unique_ptr<rung_replacement, EndReplacement> replacement(made);
  const host::PlcHost::Losses pins = plc_.lossesBy(made, image.program());
  if (!pins.mistakes.empty())
    throw Refused("the mapping file does not fit the new program:\n" + joined(pins.mistakes, "\n") +
                  "\nnothing has changed");
  std::string lost;
  json report = reportOf(made, lost);
  report["program"] = next.text;
  report["pins"] = pins.moved;
  if ((!lost.empty() || !pins.moved.empty()) && !flagOf(request, "yes")) {
    report["ok"] = false;
    report["needs"] = "yes";
    report["error"] = (pins.moved.empty() ? "" : "pins lose or change their variables: " + joined(pins.moved, "; ")) +
                      (pins.moved.empty() || lost.empty() ? "" : "; ") +
                      (lost.empty() ? "" : "the new program loses state: " + lost);
    return report;
  }
  if (flagOf(request, "late")) check(rung_replacement_allow_late(made));
  report = putInPlace(made, pins.dead, std::move(report),
                      "another program has taken over in the meantime; all forces have ended");
  replacement_ = std::move(replacement);
  learnSymbols(image.program());
  logChange(peer, "reload " + next.text + endedForces());
  return report;
}

// Its end is an order, too: the scan thread writes into it.
void Controller::endShadow() {
  if (shadow_ == nullptr) return;
  give({.kind = host::Command::Kind::Shadow, .shadow = nullptr});
  shadow_.reset();
}

json Controller::shadow(const Peer& peer, const json& request) {
  const auto passes = request.find("scans");
  if (passes == request.end() || !passes->is_number_unsigned() || *passes == 0 || *passes > kMostShadowPasses)
    throw Refused("found no number \"scans\" from 1 to 100000 in the request, expected one");
  if (shadow_ != nullptr && shadowsFor_ != peer.number)
    throw Refused("another client is running a shadow; try again when it has ended");
  if (const std::optional<rung_state> now = stateNow(); now && (now->flags & RUNG_STATE_STOPPED) != 0)
    throw Refused("the operator has stopped the program, so there is nothing to compare; start it first");
  const NextProgram next = nextProgram(peer, request);
  endShadow();
  rung_shadow* made = nullptr;
  check(rung_shadow_new(plc_.instance(), next.get().handle(), passes->get<uint32_t>(), kShadowRoom, &made));
  shadow_.reset(made);
  shadowsFor_ = peer.number;
  compared_ = nullptr;
  constexpr std::chrono::seconds kTime(3);
  give({.kind = host::Command::Kind::Shadow, .shadow = made}, kTime);
  logChange(peer, "shadow " + next.text + " for " + std::to_string(passes->get<uint32_t>()) + " scans");
  return json::object();
}

json Controller::compared(const Peer& peer, const json&) {
  if (shadow_ != nullptr && shadowsFor_ == peer.number) return shadowReport();
  if (compared_.is_null() || shadowsFor_ != peer.number) throw Refused("there is no shadow; \"shadow\" starts one");
  return compared_;
}

json Controller::shadowReport() {
  auto info = sized<rung_shadow_info>();
  check(rung_shadow_report(shadow_.get(), &info));
  constexpr const char* kStates[] = {"prepared", "running", "finished",
                                     "too-slow", "stopped", "faulted"}; // by rung_shadow_state
  json differences = json::array();
  auto difference = sized<rung_difference>();
  for (uint32_t i = 0; i < kMostChanges && rung_shadow_difference(shadow_.get(), i, &difference) == RUNG_OK; ++i) {
    json row = {{"name", difference.name}, {"runs", difference.runs}, {"first_us", difference.first_us}};
    if (difference.type != 0) { // else it is a service that the new program alone requests
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

void Controller::compareShadow() {
  constexpr int kMostRuns = 200;
  if (shadow_ == nullptr) return;
  for (int i = 0; i < kMostRuns; ++i)
    if (rung_shadow_work(shadow_.get()) != RUNG_OK) break;
  json report = shadowReport();
  if (report["state"] == "prepared" || report["state"] == "running") return;
  finishShadow(std::move(report));
}

// All of it that is still of use is the report.
void Controller::finishShadow(json report) {
  compared_ = std::move(report);
  endShadow();
}

// Nothing if no thread scans the program.
std::optional<rung_state> Controller::stateNow() {
  host::Command look{.kind = host::Command::Kind::State};
  return plc_.post(look).ok() ? std::optional(look.state) : std::nullopt;
}

json Controller::rollback(const Peer& peer, const json&) {
  if (replacement_ == nullptr)
    throw Refused("no program has been reloaded, so there is no former program to return to");
  std::string lost;
  const host::PlcHost::Losses pins = plc_.lossesBy(replacement_.get());
  json report = reportOf(replacement_.get(), lost);
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(replacement_.get(), &info));
  report["again"] = info.next == info.program; // the reloaded program, which a rollback has taken away
  report["pins"] = pins.moved;
  report = putInPlace(replacement_.get(), pins.dead, std::move(report),
                      "the former program has taken over in the meantime; all forces have ended");
  report["program"] = running().name;
  logChange(peer, "rollback to " + report["program"].get<std::string>() + endedForces());
  return report;
}

json Controller::simple(host::Command::Kind kind, const Peer& peer, const char* what) {
  give({.kind = kind});
  logChange(peer, what);
  return json::object();
}

json Controller::stop(const Peer& peer, const json&) {
  give({.kind = host::Command::Kind::Stop});
  if (shadow_ != nullptr) { // nothing more comes that could be compared
    json report = shadowReport();
    report["state"] = "stopped";
    finishShadow(std::move(report));
  }
  logChange(peer, "stop" + endedForces());
  refusePending("the program has been stopped in the meantime; all forces have ended");
  return json::object();
}
json Controller::start(const Peer& peer, const json&) { return simple(host::Command::Kind::Start, peer, "start"); }

json Controller::reset(const Peer& peer, const json&) { return simple(host::Command::Kind::Restart, peer, "reset"); }

json Controller::serve(const Peer& peer, const json& request) { return services_.serve(peer, request); }
json Controller::live(const Peer& peer, const json& request) { return services_.live(peer, request); }
json Controller::served(const Peer& peer, const json& request) { return services_.served(peer, request); }

} // namespace rung::control

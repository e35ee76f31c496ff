// See controller.h.
#include "tools/remote/controller.h"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "rung/types.hpp"
#include "tools/remote/profile.h"
#include "tools/remote/values.h"

namespace rung::remote {

using nlohmann::json;
using plc::Order;

namespace {

constexpr size_t kMostNames = 256;   // of a watch
constexpr size_t kMostReports = 200; // messages that are kept
constexpr uint32_t kMostForces = 64;
constexpr size_t kMostChanges = 1000; // that a report lists
constexpr uint32_t kMostShadowPasses = 100'000;
constexpr uint32_t kShadowRoom = 256;  // runs of tasks that wait to be compared
constexpr uint32_t kPassesKept = 4096; // of a watch of all passes

std::string timeNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

std::string textOf(const json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_string())
    throw Refused(std::string("found no text \"") + key + "\" in the request, expected one");
  return found->get<std::string>();
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
  if (!good) throw Refused("found no list \"names\" of 1 to 256 texts in the request, expected one");
  return found->get<std::vector<std::string>>();
}

std::string programOf(const json& request) {
  std::string path = textOf(request, "program");
  if (!path.starts_with('/')) throw Refused("found the path " + path + ", expected an absolute one");
  return path;
}

std::string shown(uint32_t type, rung_value value) { return toJson(type, value).dump(); }

const char* changeName(uint32_t kind) {
  constexpr const char* kNames[] = {"new",     "removed", "moved",
                                    "renamed", "retyped", "released"}; // enum rung_change_kind
  return kind < std::size(kNames) ? kNames[kind] : "changed";
}

bool loses(uint32_t kind) {
  return kind == RUNG_CHANGE_REMOVED || kind == RUNG_CHANGE_RETYPED || kind == RUNG_CHANGE_RELEASED;
}

} // namespace

struct Controller::Watching {
  Watching(rung_instance* instance, const FoundCells& found, bool everyPass)
      : all(everyPass), values(found.cells.size()), sent(found.cells.size()) {
    for (const rung_cell_info& info : found.infos) types.push_back(info.type);
    check(rung_watch_new(instance, found.cells.data(), static_cast<uint32_t>(found.cells.size()), all ? kPassesKept : 0,
                         &watch));
  }
  ~Watching() { rung_watch_free(watch); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

  bool hasChanged() const { return std::memcmp(values.data(), sent.data(), values.size() * sizeof(rung_value)) != 0; }
  json event(const rung_sample& sample) {
    json list = json::array();
    for (size_t i = 0; i < values.size(); ++i) list.push_back(toJson(types[i], values[i]));
    sent = values;
    begun = true;
    return {{"event", "values"}, {"pass", sample.pass}, {"us", sample.now_us}, {"lost", sample.lost}, {"values", list}};
  }

  rung_watch* watch = nullptr;
  std::vector<uint32_t> types;
  bool all;
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

// Of the set of forces, as somebody has asked for it.
struct Controller::ForceChange {
  Peer peer;
  std::vector<HeldCell> before;
  std::vector<HeldCell> cells; // from then on
  std::string text;            // for the log
  json answer;                 // when it is done
  json id = json::object();    // of the request, where that has one
  std::string refused = {};    // why it will not be done any more
};

const Controller::Command Controller::kCommands[] = {
    {"status", std::nullopt, &Controller::status},
    {"messages", std::nullopt, &Controller::messages},
    {"get", std::nullopt, &Controller::get},
    {"watch", std::nullopt, &Controller::watch},
    {"map", std::nullopt, &Controller::map},
    {"profile", std::nullopt, &Controller::profile},
    {"clear-profile", mapping::Remote::Profile, &Controller::clearProfile},
    {"set", mapping::Remote::Set, &Controller::set},
    {"event", mapping::Remote::Set, &Controller::event},
    {"force", mapping::Remote::Force, &Controller::force},
    {"unforce", mapping::Remote::Force, &Controller::unforce},
    {"forced", std::nullopt, &Controller::forced},
    {"sources", mapping::Remote::Reload, &Controller::sources},
    {"compile", mapping::Remote::Reload, &Controller::compile},
    {"compiled", mapping::Remote::Reload, &Controller::compiled},
    {"reload", mapping::Remote::Reload, &Controller::reload},
    {"shadow", mapping::Remote::Reload, &Controller::shadow},
    {"compared", std::nullopt, &Controller::compared},
    {"rollback", mapping::Remote::Reload, &Controller::rollback},
    {"stop", mapping::Remote::Stop, &Controller::stop},
    {"start", mapping::Remote::Start, &Controller::start},
    {"reset", mapping::Remote::Reset, &Controller::reset},
    {"serve", mapping::Remote::Serve, &Controller::serve},
    {"live", mapping::Remote::Serve, &Controller::live},
    {"served", mapping::Remote::Serve, &Controller::served},
};

Controller::Controller(std::string host, plc::Box& box, const Image& image, std::function<void(const std::string&)> log)
    : host_(std::move(host)), box_(box), services_(box), program_(image.program().name),
      dialect_(image.program().dialect), log_(std::move(log)), codeMaker_(sources::ForcedCodeMaker::make()) {
  codeMaker_->serve(image);
}

Controller::~Controller() { codeMaker_->abandon(); }

json Controller::greeting() {
  return {{"rung", "host"}, {"protocol", kProtocol}, {"host", host_}, {"program", program_}, {"dialect", dialect_}};
}

json Controller::answer(const Peer& peer, const json& request) {
  json answer = json::object();
  try {
    if (!request.is_object()) throw Refused("found " + std::string(request.type_name()) + ", expected an object");
    const std::string wanted = textOf(request, "do");
    const auto* command = std::ranges::find(kCommands, wanted, &Command::name);
    if (command == std::end(kCommands)) throw Refused("found \"" + wanted + "\", expected a command of this protocol");
    if (command->permission && !box_.map().allowed[static_cast<size_t>(*command->permission)]) {
      const std::string right(mapping::kRemoteNames[static_cast<size_t>(*command->permission)]);
      throw Refused("\"" + right + "\" is not allowed here; the mapping file allows it: [rungctl] allow = [\"" + right +
                    "\"]");
    }
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
  desk_.gone(peer);
  services_.gone(peer);
  if (pending_ == nullptr || pending_->peer.number != peer.number) return;
  codeMaker_->abandon();
  pending_.reset();
}

// ---- looking -------------------------------------------------------------------------------------------------------

json Controller::status(const Peer&, const json&) {
  json out = {{"host", host_}, {"program", program_}, {"dialect", dialect_}};
  if (addToStatus_) addToStatus_(out);
  Order order{.kind = Order::Kind::State};
  const plc::Answer answer = box_.order(order);
  out["scanned"] = answer.ok();
  if (!answer.ok()) return out;
  const uint32_t flags = order.state.flags;
  out["passes"] = order.state.passes;
  out["missed"] = order.state.missed;
  out["us"] = order.state.now_us;
  out["stopped"] = (flags & RUNG_STATE_STOPPED) != 0;
  out["unsaved"] = (flags & RUNG_STATE_UNSAVED) != 0;
  out["faulted"] = (flags & RUNG_STATE_FAULTED) != 0;
  if (const std::optional<rung_fault_info> fault = box_.running() ? std::nullopt : box_.fault()) {
    out["fault"] = fault->text;
    out["file"] = fault->file;
    out["line"] = fault->line;
  }
  return out;
}

json Controller::messages(const Peer& peer, const json& request) {
  if (flagOf(request, "follow") && std::ranges::find(following_, peer.number) == following_.end())
    following_.push_back(peer.number);
  return {{"messages", reports_}};
}

bool Controller::serveBox(Server* server, const Print& print) {
  std::vector<std::string> reports;
  const bool served = box_.serve(reports);
  for (const std::string& text : reports) {
    print(text);
    report(text, server);
  }
  return served;
}

void Controller::passMessages(Server* server, const Print& print) {
  rung_message_info message{};
  while (box_.nextMessage(message)) {
    if (message.op == RUNG_MESSAGE_CLEAR) continue;
    const std::string text = std::string("message ") + message.text;
    print(text);
    report(text, server, message.op == RUNG_MESSAGE_LOG);
  }
}

void Controller::report(const std::string& text, Server* server, bool logged) {
  reports_.push_back(timeNow() + " " + text);
  if (reports_.size() > kMostReports) reports_.pop_front();
  if (server == nullptr) return;
  for (const uint32_t peer : following_)
    server->send(peer, {{"event", "message"}, {"text", reports_.back()}, {"logged", logged}});
}

Controller::Found Controller::find(const std::string& name, int32_t access) const {
  Found found;
  found.info.size = sizeof found.info;
  check(rung_instance_find(box_.instance(), name.c_str(), access, &found.cell));
  check(rung_instance_cell(box_.instance(), found.cell, &found.info));
  if (found.info.type == RUNG_TYPE_TEXT) throw Refused(name + " is a text, expected a bit or a number");
  return found;
}

Controller::FoundCells Controller::findAll(const std::vector<std::string>& names) const {
  FoundCells all;
  for (const std::string& name : names) {
    const Found found = find(name, RUNG_READ);
    all.cells.push_back(found.cell);
    all.infos.push_back(found.info);
  }
  return all;
}

json Controller::watch(const Peer& peer, const json& request) {
  const std::vector<std::string> names = namesOf(request);
  const FoundCells found = findAll(names);
  watching_[peer.number] = std::make_unique<Watching>(box_.instance(), found, flagOf(request, "all"));
  json described = json::array();
  for (size_t i = 0; i < names.size(); ++i)
    described.push_back(
        {{"name", names[i]}, {"type", typeName(found.infos[i].type)}, {"address", found.infos[i].address}});
  return {{"names", described}};
}

// The values at the end of a pass.
json Controller::get(const Peer&, const json& request) {
  const std::vector<std::string> names = namesOf(request);
  const FoundCells found = findAll(names);
  Watching once(box_.instance(), found, false);
  auto sample = sized<rung_sample>();
  const auto end = std::chrono::steady_clock::now() + plc::Box::kPatience;
  while (rung_watch_newest(once.watch, once.values.data(), &sample) != RUNG_OK) {
    if (std::chrono::steady_clock::now() >= end) throw Refused("no pass of the program has ended within a second");
    Order look{.kind = Order::Kind::State}; // waits for a step of the scan thread
    box_.order(look);
  }
  json values = json::object();
  for (size_t i = 0; i < names.size(); ++i) values[names[i]] = toJson(once.types[i], once.values[i]);
  return {{"pass", sample.pass}, {"us", sample.now_us}, {"values", values}};
}

void Controller::sendEvents(Server& server) {
  constexpr int kMostPasses = 500; // in a turn
  for (auto& [peer, watching] : watching_) {
    auto sample = sized<rung_sample>();
    if (watching->all) {
      for (int i = 0; i < kMostPasses; ++i) {
        if (rung_watch_next(watching->watch, watching->values.data(), &sample) != RUNG_OK) break;
        server.send(peer, watching->event(sample));
      }
    } else if (rung_watch_newest(watching->watch, watching->values.data(), &sample) == RUNG_OK &&
               (!watching->begun || watching->hasChanged())) {
      server.send(peer, watching->event(sample));
    }
  }
  services_.work(server);
  finishPending(server);
}

json Controller::map(const Peer&, const json&) {
  const mapping::File& map = box_.map();
  json pins = json::array();
  for (const mapping::Pin& pin : map.pins)
    pins.push_back({{"name", pin.name},
                    {"type", mapping::pinTypeName(pin.type)},
                    {"table", mapping::tableName(pin.direction)},
                    {"file", map.paths[pin.at.file]},
                    {"line", pin.at.line}});
  json allowed = json::array();
  for (size_t i = 0; i < std::size(mapping::kRemoteNames); ++i)
    if (map.allowed[i]) allowed.push_back(mapping::kRemoteNames[i]);
  json never = json::array();
  for (const mapping::Protected& cell : map.never) never.push_back(cell.name);
  return {{"files", map.paths}, {"pins", pins}, {"allow", allowed}, {"never", never}};
}

json Controller::profile(const Peer&, const json& request) { return profileOf(box_, request); }

json Controller::clearProfile(const Peer& peer, const json&) {
  return simple(Order::Kind::ClearProfile, peer, "clear the profile");
}

// ---- changing ------------------------------------------------------------------------------------------------------

void Controller::logChange(const Peer& peer, const std::string& text) {
  log_(timeNow() + " " + peer.name + " (user " + std::to_string(peer.user) + ", process " +
       std::to_string(peer.process) + "): " + text);
}

// The place that the program reads, and the one that the machine writes.
std::vector<Controller::Range> Controller::rangesOf(const std::string& name) const {
  std::vector<Range> ranges;
  for (const int32_t access : {RUNG_READ, RUNG_WRITE}) {
    const std::optional<rung_cell_info> info = cellInfo(box_.instance(), name, access);
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
  const auto overlaps = [&](const Range& kept) {
    return std::ranges::any_of(wanted, [&](const Range& range) {
      return range.space == kept.space && range.first < kept.first + kept.count &&
             kept.first < range.first + range.count;
    });
  };
  for (const mapping::Protected& cell : box_.map().never)
    if (std::ranges::any_of(rangesOf(cell.name), overlaps))
      throw Refused(name + " is never set or forced here: the mapping file says so ([rungctl] never)");
}

Order Controller::give(Order order, std::chrono::milliseconds time) {
  const plc::Answer answer = box_.order(order, time);
  if (!answer.ok()) throw Refused(answer.problem);
  return order;
}

json Controller::set(const Peer& peer, const json& request) {
  const std::string name = textOf(request, "name");
  if (!request.contains("value")) throw Refused("found no \"value\" in the request, expected one");
  const Found found = find(name, RUNG_WRITE);
  refuseProtected(name);
  const rung_value value = fromJson(found.info.type, request["value"], name);
  const Order done = give({.kind = Order::Kind::Write, .cell = found.cell, .value = value});
  logChange(peer,
            "set " + name + " from " + shown(found.info.type, done.former) + " to " + shown(found.info.type, value));
  return {{"name", name}, {"former", toJson(found.info.type, done.former)}, {"value", toJson(found.info.type, value)}};
}

json Controller::event(const Peer& peer, const json& request) {
  if (!simulation_) throw Refused("no control is simulated here; rung-run --simulate does it");
  const json keys = request.value("keys", json::object());
  if (!keys.is_object() || !std::ranges::all_of(keys, [](const json& v) { return v.is_string() || v.is_number(); }))
    throw Refused("found no object \"keys\" of texts and numbers in the request, expected one");
  struct {
    const Event& act;
    const std::string name;
    const json& keys;
    std::string problem;
  } doing{simulation_, textOf(request, "name"), keys, ""};
  give({.kind = Order::Kind::Act,
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
    Order order{.kind = Order::Kind::Forced, .index = i};
    const plc::Answer answer = box_.order(order);
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
    throw Refused("the code for another force is being made; try again when it is done, or end all: unforce --all");
}

// Nothing: the compiler is at work on its code.
std::optional<Controller::Forces> Controller::prepared(const ForceChange& change) {
  if (change.cells.empty()) return Forces();
  std::vector<rung_forced_cell> cells;
  for (const HeldCell& cell : change.cells)
    cells.push_back({cell.name.c_str(), cell.owner.c_str(), cell.value, RUNG_READ, 0});
  rung_forces* made = nullptr;
  const int32_t status =
      check(rung_forces_new(box_.instance(), nullptr, cells.data(), static_cast<uint32_t>(cells.size()), &made));
  return status == RUNG_LATER ? std::nullopt : std::optional<Forces>(made);
}

void Controller::putInEffect(const ForceChange& change, Forces forces) {
  give({.kind = Order::Kind::Force, .forces = forces.get()});
  forces_ = std::move(forces); // the former set has ended
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
  codeMaker_->abandon();
  pending_->refused = why;
}

void Controller::finishPending(Server& server) {
  if (pending_ == nullptr) return;
  if (pending_->refused.empty() && !box_.running())
    refusePending("the program has stopped meanwhile: forces have ended");
  json answer = pending_->answer;
  try {
    if (!pending_->refused.empty()) throw Refused(pending_->refused);
    std::optional<Forces> forces = prepared(*pending_);
    if (!forces) return;
    if (heldCells() != pending_->before) throw Refused("forces have ended meanwhile, and are not put in effect again");
    putInEffect(*pending_, std::move(*forces));
    answer["ok"] = true;
  } catch (const std::exception& problem) {
    answer = {{"ok", false}, {"error", problem.what()}};
  }
  answer.update(pending_->id);
  const uint32_t peer = pending_->peer.number;
  pending_.reset();
  server.answer(peer, answer);
}

json Controller::force(const Peer& peer, const json& request) {
  const std::string name = textOf(request, "name");
  if (!request.contains("value")) throw Refused("found no \"value\" in the request, expected one");
  const Found found = find(name, RUNG_READ);
  refuseProtected(name);
  refuseWhilePending();
  const rung_value value = fromJson(found.info.type, request["value"], name);
  std::vector<HeldCell> before = heldCells();
  std::vector<HeldCell> cells = {{name, peer.name, value}};
  std::ranges::copy_if(before, std::back_inserter(cells), [&](const HeldCell& cell) { return cell.name != name; });
  if (cells.size() > kMostForces) throw Refused("64 cells are forced already; end a force first");
  return begin({.peer = peer,
                .before = std::move(before),
                .cells = std::move(cells),
                .text = "force " + name + " to " + shown(found.info.type, value),
                .answer = {{"name", name}, {"value", toJson(found.info.type, value)}}});
}

json Controller::unforce(const Peer& peer, const json& request) {
  const bool all = flagOf(request, "all");
  const std::string name = all ? "" : textOf(request, "name");
  if (all)
    refusePending("all forces have been ended meanwhile");
  else
    refuseWhilePending();
  std::vector<HeldCell> before = heldCells();
  std::vector<HeldCell> left;
  std::ranges::copy_if(before, std::back_inserter(left),
                       [&](const HeldCell& cell) { return !all && cell.name != name; });
  const size_t ended = before.size() - left.size();
  if (!all && ended == 0) throw Refused(name + " is not forced");
  json answer = {{"ended", ended}};
  if (ended == 0) return answer;
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

json Controller::sources(const Peer& peer, const json& request) { return desk_.sources(peer, request); }

json Controller::compile(const Peer& peer, const json& request) {
  json answer = desk_.compile(peer, request);
  logChange(peer, "compile " + answer["bytes"].dump() + " bytes of sources");
  return answer;
}

json Controller::compiled(const Peer& peer, const json& request) { return desk_.compiled(peer, request); }

// A file, or what has been compiled for this client.
Controller::NextProgram Controller::nextProgram(const Peer& peer, const json& request) const {
  NextProgram next;
  if (flagOf(request, "compiled")) {
    next.image = &desk_.image(peer);
    next.text = std::string(next.image->program().name) + ", compiled here from sources";
  } else {
    next.text = programOf(request);
    next.opened.emplace(next.text);
  }
  return next;
}

json Controller::reload(const Peer& peer, const json& request) {
  const NextProgram next = nextProgram(peer, request);
  const Image& image = next.get();
  codeMaker_->serve(image);
  rung_replacement* made = nullptr;
  check(rung_replacement_new(box_.instance(), image.handle(), nullptr, 0, &made));
  std::unique_ptr<rung_replacement, EndReplacement> replacement(made);
  auto info = sized<rung_replacement_info>();
  check(rung_replacement_report(made, &info));
  json changes = json::array();
  std::string lost;
  auto change = sized<rung_change>();
  for (uint32_t i = 0; i < kMostChanges && rung_replacement_change(made, i, &change) == RUNG_OK; ++i) {
    changes.push_back({{"kind", changeName(change.kind)},
                       {"name", change.name},
                       {"former", change.former},
                       {"state", change.is_state != 0}});
    if (loses(change.kind)) lost += (lost.empty() ? "" : ", ") + std::string(change.name);
  }
  json report = {{"program", next.text},
                 {"kept_cells", info.kept_cells},
                 {"kept_states", info.kept_states},
                 {"changes", changes},
                 {"bound", info.bound}};
  if (!lost.empty() && !flagOf(request, "yes")) {
    report["ok"] = false;
    report["needs"] = "yes";
    report["error"] = "the new program loses state: " + lost;
    return report;
  }
  if (flagOf(request, "late")) check(rung_replacement_allow_late(made));
  constexpr std::chrono::seconds kTime(3);
  give({.kind = Order::Kind::Replace, .replacement = made}, kTime);
  forces_.reset(); // they have ended
  refusePending("another program has taken over meanwhile: forces have ended");
  replacement_ = std::move(replacement);
  former_ = std::exchange(program_, image.program().name);
  logChange(peer, "reload " + next.text);
  return report;
}

// Its end is an order, too: the scan thread writes into it.
void Controller::endShadow() {
  if (shadow_ == nullptr) return;
  give({.kind = Order::Kind::Shadow, .shadow = nullptr});
  shadow_.reset();
}

json Controller::shadow(const Peer& peer, const json& request) {
  const auto passes = request.find("passes");
  if (passes == request.end() || !passes->is_number_unsigned() || *passes == 0 || *passes > kMostShadowPasses)
    throw Refused("found no number \"passes\" from 1 to 100000 in the request, expected one");
  const NextProgram next = nextProgram(peer, request);
  endShadow();
  rung_shadow* made = nullptr;
  check(rung_shadow_new(box_.instance(), next.get().handle(), passes->get<uint32_t>(), kShadowRoom, &made));
  shadow_.reset(made);
  constexpr std::chrono::seconds kTime(3);
  give({.kind = Order::Kind::Shadow, .shadow = made}, kTime);
  logChange(peer, "shadow " + next.text + " for " + std::to_string(passes->get<uint32_t>()) + " passes");
  return json::object();
}

json Controller::compared(const Peer&, const json&) {
  if (shadow_ == nullptr) throw Refused("no program runs beside this one; \"shadow\" begins one");
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

void Controller::work() {
  constexpr int kMostRuns = 200;
  for (int i = 0; shadow_ != nullptr && i < kMostRuns; ++i)
    if (rung_shadow_work(shadow_.get()) != RUNG_OK) return;
}

json Controller::rollback(const Peer& peer, const json&) {
  if (replacement_ == nullptr) throw Refused("no program has been reloaded, so there is none to go back to");
  constexpr std::chrono::seconds kTime(3);
  give({.kind = Order::Kind::Replace, .replacement = replacement_.get()}, kTime);
  forces_.reset();
  refusePending("the former program has taken over meanwhile: forces have ended");
  std::swap(former_, program_);
  logChange(peer, "rollback to " + program_);
  return {{"program", program_}};
}

json Controller::simple(Order::Kind kind, const Peer& peer, const char* what) {
  give({.kind = kind});
  logChange(peer, what);
  return json::object();
}

json Controller::stop(const Peer& peer, const json&) {
  json answer = simple(Order::Kind::Stop, peer, "stop");
  refusePending("the program has been stopped meanwhile: forces have ended");
  return answer;
}
json Controller::start(const Peer& peer, const json&) { return simple(Order::Kind::Start, peer, "start"); }

json Controller::reset(const Peer& peer, const json&) {
  if (box_.running()) throw Refused("the program runs; a reset restarts one that a fault has stopped");
  return simple(Order::Kind::Restart, peer, "reset");
}

json Controller::serve(const Peer& peer, const json&) { return services_.serve(peer); }
json Controller::live(const Peer& peer, const json& request) { return services_.live(peer, request); }
json Controller::served(const Peer& peer, const json& request) { return services_.served(peer, request); }

} // namespace rung::remote

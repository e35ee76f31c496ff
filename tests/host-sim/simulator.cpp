// Events, the model that says what is right, and the search for the shortest wrong list (see simulator.h).
#include "tests/host-sim/simulator.h"

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "tests/host-sim/world.h"

namespace rung::host_sim {
namespace {

using nlohmann::json;

// How often each comes, of all.
struct Kind {
  const char* what;
  int weight;
};
constexpr Kind kKinds[] = {
    {"scan", 30},       {"turn", 20},    {"pin", 14},     {"stuck", 2},     {"reset-pin", 4}, {"save", 6},
    {"full", 1},        {"room", 2},     {"off", 1},      {"cut", 1},       {"hang", 1},      {"goes-on", 2},
    {"status", 4},      {"get", 3},      {"set", 3},      {"force", 4},     {"unforce", 3},   {"unforce-all", 1},
    {"forced", 3},      {"reload", 5},   {"rollback", 3}, {"stop", 2},      {"start", 3},     {"reset", 3},
    {"shadow", 2},      {"compared", 2}, {"watch", 2},    {"leave", 1},     {"messages", 1},  {"torn", 1},
    {"link", 3},        {"far", 3},      {"serve", 3},    {"live", 4},      {"served", 4},    {"dead", 1},
    {"wait", 1},        {"mark", 2},     {"keep", 1},     {"recording", 1}, {"timers", 3},    {"log", 1},
    {"acknowledge", 1}, {"map", 1},
};
constexpr const char* kPins[] = {"go", "sets", "clears", "other", "ask", "wait", "m6", "abort"};
constexpr const char* kScans = "D100:4"; // SCANS as a whole
constexpr const char* kCells[] = {"LAMP", "LATCH", "R1.0", "WAIT", kScans, "FAR"};
constexpr const char* kPrograms[] = {"first", "above", "below", "plain", "wrong", "nowhere"};

template <size_t N>
std::string oneOf(const char* const (&list)[N], std::mt19937_64& random) {
  return list[random() % N];
}

// What is right.
class Model {
public:
  explicit Model(const Programs& programs) : programs_(programs), world_(programs) {}

  // The end; the result is the same for the recording.
  std::string finish() { return world_.finish(); }
  std::string happen(const Event& event) {
    if (!world_.isOn() && event.what != "room" && event.what != "off" && event.what != "cut") return "";
    wrong_.clear();
    begin();
    act(event);
    if (world_.isOn()) follow();
    if (wrong_.empty() && world_.isOn()) look();
    return wrong_;
  }

private:
  using Change = World::Change;

  void fail(const std::string& text) {
    if (wrong_.empty()) wrong_ = text;
  }
  void expect(bool good, const std::string& text) {
    if (!good) fail(text);
  }

  json ask(const Event& event, const json& request) { return ask(1 + static_cast<uint32_t>(event.value) / 4, request); }
  json ask(uint32_t client, const json& request);
  void begin();
  bool waits() { return forces_.contains("WAIT") ? forces_.at("WAIT") != 0 : world_.pin("wait"); }
  void act(const Event& event);
  void comesOn(const std::string& after, bool mayLose);
  void switchOff();
  void requestReload(const Event& event);
  void requestRollback(const Event& event);
  void requestStop(const Event& event);
  void requestOther(const Event& event);
  void lookAtTimers(const json& answer);
  void happenToService(const Event& event);
  void requestForce(const Event& event);
  void requestUnforce(const Event& event);

  // ---- what follows from what has happened
  void follow();
  void follow(const Change& change);
  void scansUpTo(uint64_t wholeScans);
  void remember();
  void forget() { edges_.reset(), wentOn_.reset(), waited_.reset(); }
  void countFrom(int64_t scans) { had_.insert(scans_ = scans); }
  void endForces(int64_t scans);
  void adopt(bool isKept); // a request has changed SCANS
  std::map<std::string, int64_t> listed();

  void look();
  void lookAtWho();
  void lookAtOutputs();
  void lookAtForces();
  void lookAtCounters();
  void lookAtWhatIsRemembered();
  void lookAtConnection();
  void lookAtRequest();

  const Programs& programs_;
  World world_;
  std::string wrong_;
  // ---- who runs
  size_t runs_ = 0;             // version
  std::optional<size_t> other_; // that the last reload has replaced, or that a rollback has taken out
  std::optional<size_t> next_;  // that a request puts in its place
  bool isReload_ = false;       // or a rollback
  bool newRuns_ = false;        // the last reload's
  bool spent_ = false;          // a fault of it has put the former one back
  bool faulted_ = false;
  uint32_t faultOf_ = 0;                           // number of the program that has faulted
  bool hasFaulted_ = false, hasRestarted_ = false; // in this event
  bool stopped_ = false;
  std::map<std::string, int64_t> forces_;
  uint64_t counted_ = 0;        // whole scans
  int64_t scans_ = 0;           // what SCANS is
  int64_t kept_ = 0;            // what it was at the end of the last whole scan
  std::set<int64_t> had_ = {0}; // what it has been at the end of a scan since the host started
  // ---- what its rungs remember; nothing: it is not known
  std::optional<int64_t> edges_; // EDGES
  std::optional<bool> wentOn_;   // GO in the last scan
  struct Count {
    uint64_t least = 0, most = 0;
  };
  std::optional<Count> waited_; // scans with WAIT, one after the other
  bool waits_ = false;          // before this event
  uint64_t begun_ = 0;          // whole scans before this event
  bool isQuiet_ = false;        // nothing has happened but scans
  // ---- the service
  static constexpr uint32_t kService = 3; // the client
  uint64_t answers_ = 0;
};

// ---- what follows
// ----------------------------------------------------------------------------------------------------

void Model::scansUpTo(uint64_t wholeScans) {
  const bool forced = forces_.contains(kScans);
  for (; counted_ < wholeScans; ++counted_) {
    countFrom(forced ? forces_.at(kScans) : scans_ + 1);
    kept_ = scans_;
    remember();
  }
}

// What one scan makes of the edges of GO and the time of WAIT: whatever program runs, if only it has those rungs.
void Model::remember() {
  if (!programs_.versions()[runs_].remembers) return;
  const bool go = world_.pin("go");
  if (!wentOn_) edges_.reset();
  if (edges_ && go && !*wentOn_) ++*edges_;
  wentOn_ = go;
  if (!waits_)
    waited_ = Count{};
  else if (waited_)
    waited_ = Count{waited_->least + 1, waited_->most + 1};
}

// A cell that counts goes on from where it was held.
void Model::endForces(int64_t scans) {
  if (forces_.contains(kScans)) countFrom(scans);
  if (forces_.contains("R1.0")) edges_.reset();
  forces_.clear();
}

void Model::adopt(bool isKept) {
  if (faulted_) return;
  countFrom(world_.cell("SCANS"));
  if (isKept) kept_ = scans_;
}

void Model::follow(const Change& change) {
  scansUpTo(change.wholeScans);
  switch (change.kind) {
  case Change::Kind::Replaced:
    expect(next_.has_value(), "another program has taken over, and nobody asked for it");
    if (!next_) return;
    other_ = std::exchange(runs_, *next_);
    next_.reset();
    if (!programs_.versions()[*other_].remembers) wentOn_ = false, waited_ = Count{}; // those rungs are new
    newRuns_ = isReload_ || !newRuns_;
    spent_ = spent_ && !isReload_;
    endForces(change.scans);
    return;
  case Change::Kind::Fault:
    faulted_ = hasFaulted_ = true;
    faultOf_ = change.number;
    endForces(change.scans);
    forget();
    if (!newRuns_ || !other_) return;
    std::swap(runs_, *other_);
    newRuns_ = false;
    spent_ = true;
    return;
  case Change::Kind::Restart:
    expect(faulted_, "a program that has not stopped was restarted");
    hasRestarted_ = true;
    faulted_ = stopped_ = false;
    endForces(change.scans);
    forget();
    expect(change.scans == kept_, "SCANS is " + std::to_string(change.scans) + " after a restart, was " +
                                      std::to_string(kept_) + " after the last whole scan");
    countFrom(change.scans);
    return;
  }
}

void Model::follow() {
  for (const Change& change : std::exchange(world_.changes, {})) follow(change);
  scansUpTo(world_.wholeScans);
}

// The host starts; what was not saved is lost.
void Model::comesOn(const std::string& after, bool mayLose) {
  world_.switchOn();
  counted_ = world_.wholeScans;
  if (!world_.isOn()) return;
  const int64_t due = faulted_ ? kept_ : scans_; // after a fault, of the last whole scan
  runs_ = 0;
  other_.reset();
  newRuns_ = spent_ = faulted_ = stopped_ = false;
  forces_.clear();
  forget();
  const int64_t now = world_.cell("SCANS");
  expect(mayLose ? had_.contains(now) : now == due,
         "SCANS is " + std::to_string(now) + " after " + after + ", was " + std::to_string(due));
  scans_ = kept_ = now;
  had_ = {now};
}

void Model::switchOff() {
  world_.switchOff();
  expect(!world_.lastEnd.ranAgain, "the program was restarted after its power-off");
  expect(world_.lastEnd.saysSo && world_.lastEnd.tookNs == 0, "a client is not told at once that the program is off");
}

// ---- requests
// ----------------------------------------------------------------------------------------------------------

// A client does not wait for what only the thread that answers it can do.
json Model::ask(uint32_t client, const json& request) {
  const int64_t begin = world_.nowNs();
  const json answer = world_.ask(client, request);
  const int64_t took = world_.nowNs() - begin;
  constexpr int64_t kMostNs = 200'000'000;
  if (world_.scans) expect(took <= kMostNs, "the answer took " + std::to_string(took / 1'000'000) + " ms");
  if (!answer.value("ok", false))
    expect(!answer.value("error", "").empty(), "a refusal without a sentence: " + answer.dump());
  return answer;
}

void Model::requestReload(const Event& event) {
  const bool was = faulted_;
  next_ = programs_.find(event.name);
  isReload_ = true;
  const json answer =
      ask(event, {{"do", "reload"}, {"program", "/programs/" + event.name}, {"yes", true}, {"late", true}});
  const bool done = answer.value("ok", false);
  expect(!done || next_, "a program that is not there was taken");
  follow();
  if (done && !hasFaulted_ && !was) expect(!answer.value("waits", false), "a program that runs waits for a reset");
  expect(!done || !next_, "no program has taken over");
  next_.reset();
}

void Model::requestRollback(const Event& event) {
  const bool may = other_ && !spent_;
  next_ = other_;
  isReload_ = false;
  const json answer = ask(event, {{"do", "rollback"}});
  const bool done = answer.value("ok", false);
  expect(!done || may, "a rollback to nothing");
  follow();
  expect(!done || !next_, "no program has taken over");
  next_.reset();
}

void Model::requestStop(const Event& event) {
  const std::string& what = event.what;
  const bool was = faulted_;
  const bool done = ask(event, {{"do", what}}).value("ok", false);
  follow();
  if (!done) return;
  expect(!was || hasRestarted_, "a faulted program was told to " + what);
  stopped_ = what == "stop" && !hasFaulted_;
  forget();
  if (what == "stop") endForces(world_.cell("SCANS"));
}

std::map<std::string, int64_t> Model::listed() {
  std::map<std::string, int64_t> forces;
  rung_force_info force{};
  force.size = sizeof force;
  for (uint32_t i = 0; rung_instance_forced(world_.instance(), i, &force) == RUNG_OK; ++i) {
    forces[force.name] = force.value.integer;
    force.size = sizeof force;
  }
  return forces;
}

void Model::requestForce(const Event& event) {
  const json value = event.name == kScans ? json(event.value % 4) : json(event.value % 2 != 0);
  const bool done = ask(event, {{"do", "force"}, {"name", event.name}, {"value", value}}).value("ok", false);
  if (!done) return;
  const uint64_t before = counted_;
  follow();
  if (event.name == kScans) adopt(counted_ != before); // it holds from some scan of the request on
  if (hasFaulted_)
    forces_ = listed(); // it came before or after that
  else
    forces_[event.name] = event.name == kScans ? event.value % 4 : event.value % 2;
}

void Model::requestUnforce(const Event& event) {
  const bool all = event.what == "unforce-all";
  json request = {{"do", "unforce"}};
  request[all ? "all" : "name"] = all ? json(true) : json(event.name);
  const bool done = ask(event, request).value("ok", false);
  if (!done) return;
  const bool counts = forces_.contains(kScans) && (all || event.name == kScans);
  follow();
  if (counts) adopt(true);
  if (all || event.name == "R1.0") edges_.reset();
  if (all) forces_.clear();
  forces_.erase(event.name);
}

void Model::act(const Event& event) {
  const std::string& what = event.what;
  hasFaulted_ = hasRestarted_ = false;
  if (what == "scan") {
    for (int64_t i = 0; i < event.value % 4; ++i) world_.pass(World::kPeriodNs);
  } else if (what == "pin" || what == "stuck") {
    world_.setPin(what == "stuck" ? what : event.name, event.value % 4 != 0);
  } else if (what == "reset-pin") {
    world_.reset = event.value % 4 != 0;
  } else if (what == "hang" || what == "goes-on") {
    world_.scans = what == "goes-on";
  } else if (what == "full") {
    world_.disk.full = true;
  } else if (what == "torn") {
    world_.disk.torn = true;
  } else if (what == "link") {
    world_.far.isThere = event.value % 4 != 0;
  } else if (what == "far") {
    world_.far.value = event.value % 2 != 0;
  } else if (what == "serve" || what == "live" || what == "served" || what == "dead") {
    happenToService(event);
  } else if (what == "wait") { // longer than anything takes
    for (int i = 0; i < 800; ++i) world_.pass(World::kPeriodNs);
    isQuiet_ = true;
  } else if (what == "room") {
    world_.disk.full = false;
    if (!world_.isOn()) comesOn("a full disk", true);
  } else if (what == "save") {
    world_.lookForSaving();
  } else if (what == "off" || what == "cut") {
    const bool regular = what == "off";
    const bool isBad = world_.disk.full || world_.disk.torn || !world_.isOn();
    if (world_.isOn() && regular) switchOff();
    follow(); // its last scans
    if (world_.isOn()) world_.cutPower();
    world_.scans = true;
    world_.reset = false;
    comesOn(regular ? "a power-off" : "a power cut", !regular || isBad);
  } else if (what == "turn") {
    const bool mayRestart = world_.host().restarting();
    world_.turn();
    expect(!mayRestart || !world_.host().restarting(), "a restart is not done in the turn that finds it");
  } else if (what == "leave") {
    world_.leave(1 + static_cast<uint32_t>(event.value) / 4);
  } else if (what == "reload") {
    requestReload(event);
  } else if (what == "rollback") {
    requestRollback(event);
  } else if (what == "stop" || what == "start") {
    requestStop(event);
  } else if (what == "force") {
    requestForce(event);
  } else if (what == "unforce" || what == "unforce-all") {
    requestUnforce(event);
  } else {
    requestOther(event);
  }
}

// LATE's timer is the only one, if the program has it.
void Model::lookAtTimers(const json& answer) {
  const json& timers = answer["timers"];
  expect(timers.size() <= (programs_.versions()[runs_].remembers ? 1 : 0), "timers: " + timers.dump());
  for (const json& timer : timers) {
    expect(timer["name"] == "TMRB 1" && timer["preset"] == 40'000, "timer: " + timer.dump());
    expect(timer["elapsed"] > 0 && timer["remaining"] > 0 &&
               timer["elapsed"].get<int64_t>() + timer["remaining"].get<int64_t>() == 40'000,
           "timer: " + timer.dump());
  }
}

void Model::requestOther(const Event& event) {
  const std::string& what = event.what;
  json request = {{"do", what}};
  if (what == "get" || what == "watch") request["names"] = {event.name};
  if (what == "set")
    request.update({{"name", event.name}, {"value", event.name == kScans ? json(7) : json(event.value % 2 != 0)}});
  if (what == "mark") request["text"] = event.name;
  if (what == "shadow") request.update({{"program", "/programs/" + event.name}, {"scans", 5}});
  const uint64_t before = counted_;
  const json answer = ask(event, request);
  const bool done = answer.value("ok", false);
  follow();
  if (what == "timers" && done) lookAtTimers(answer);
  if (what == "mark" || what == "keep" || what == "log") expect(done, what + " is refused: " + answer.dump());
  if (what == "reset" && done) expect(world_.host().running() || hasFaulted_, "restarted, and it does not run");
  if (what != "set" || event.name != kScans || !done) return;
  adopt(counted_ != before || stopped_); // a program that is stopped is kept, too
}

// Who serves says so, shows that it lives, answers the oldest question, or is gone.
void Model::happenToService(const Event& event) {
  if (event.what == "serve") {
    ask(kService, {{"do", "serve"}, {"alive_ms", 100}});
  } else if (event.what == "live") {
    ask(kService, {{"do", "live"}});
  } else if (event.what == "dead") {
    world_.leave(kService);
  } else {
    std::deque<json>& events = world_.clients.events[kService];
    while (!events.empty()) {
      const json question = events.front();
      events.pop_front();
      if (question.value("event", "") != "service") continue;
      ask(kService, {{"do", "served"}, {"ticket", question.at("ticket")}, {"outcome", "done"}, {"value", ++answers_}});
      return;
    }
  }
}

void Model::begin() {
  isQuiet_ = false;
  waits_ = world_.isOn() && waits();
  begun_ = counted_;
}

void Model::look() {
  lookAtWho();
  lookAtOutputs();
  lookAtForces();
  lookAtCounters();
  lookAtWhatIsRemembered();
  lookAtConnection();
  lookAtRequest();
}

void Model::lookAtWho() {
  expect(world_.host().running() == !faulted_, "the program runs, or not, and the model has it otherwise");
  rung_program_info info{};
  info.size = sizeof info;
  rung_instance_program(world_.instance(), &info);
  const std::string& expected = programs_.versions()[runs_].name;
  expect(info.name == expected, "runs " + std::string(info.name) + ", expected " + expected);
  const uint32_t faulted = faulted_ && info.number != faultOf_ ? faultOf_ : 0;
  expect(info.faulted == faulted, "it is not said whose fault it was");
}

void Model::lookAtOutputs() {
  if (!faulted_) return;
  for (const char* pin : {"lamp", "latch", "second", "beyond"})
    expect(!world_.pin(pin), std::string("output pin ") + pin + " is on while the program does not run");
}

void Model::lookAtForces() {
  if (faulted_ || !world_.scans) return;
  std::string found, expected;
  for (const auto& [name, value] : listed()) found += name + " ";
  for (const auto& [name, value] : forces_) expected += name + " ";
  expect(found == expected, "forced are " + found + ", expected " + expected);
}

void Model::lookAtCounters() {
  if (faulted_) return;
  const int64_t now = world_.cell("SCANS");
  if (forces_.contains(kScans)) return countFrom(now);
  expect(now == scans_, "SCANS is " + std::to_string(now) + ", expected " + std::to_string(scans_));
  countFrom(now);
}

void Model::lookAtWhatIsRemembered() {
  if (faulted_ || stopped_) return;
  if (forces_.contains("R1.0")) edges_.reset();
  const bool waitsNow = waits();
  if (waitsNow && !waits_ && waited_)
    waited_ = Count{0, counted_ - begun_}; // somewhere in it, and a scan has seen it off
  if (waits_ && !waitsNow) waited_.reset();
  const int64_t edges = world_.cell("EDGES");
  if (edges_ && !forces_.contains("R1.0"))
    expect(edges == *edges_, "EDGES is " + std::to_string(edges) + ", expected " + std::to_string(*edges_));
  edges_ = edges;
  constexpr uint64_t kLate = 6; // the first begins the time, and 40 ms are five periods
  if (!waited_ || !programs_.versions()[runs_].remembers) return;
  const bool late = world_.cell("LATE") != 0;
  expect(late || waited_->least < kLate, "LATE is off in scan " + std::to_string(waited_->least) + " with WAIT");
  expect(!late || waited_->most >= kLate, "LATE is on in scan " + std::to_string(waited_->most) + " with WAIT");
}

void Model::lookAtConnection() {
  const World::Far& far = world_.far;
  expect(far.lamp == world_.pin("lamp"), "the other side of the connection has another LAMP");
  if (world_.lastStepNs != world_.nowNs()) return;
  const bool isAlive = far.heardNs >= 0 && world_.lastStepNs - far.heardNs <= World::kFarTimeoutNs;
  expect(world_.pin("far-ok") == isAlive, "a connection counts as lost, or not, and the model has it otherwise");
  expect(isAlive || !world_.pin("far"), "an input of a lost connection is on");
}

// A request ends, whether or not it is served.
void Model::lookAtRequest() {
  if (!isQuiet_ || faulted_ || stopped_ || !world_.scans || hasFaulted_) return;
  if (!programs_.versions()[runs_].remembers || !world_.pin("ask")) return;
  expect(world_.cell("TOLD") != 0, "what the program asks of its CNC never ends");
}

} // namespace

std::string textOf(const Event& event) {
  return event.what + (event.name.empty() ? "" : " " + event.name) + " " + std::to_string(event.value);
}

std::vector<Event> eventsOf(uint64_t seed, size_t count) {
  std::mt19937_64 random(seed);
  int all = 0;
  for (const Kind& kind : kKinds) all += kind.weight;
  std::vector<Event> events;
  while (events.size() < count) {
    int at = static_cast<int>(random() % static_cast<uint64_t>(all));
    const Kind* kind = kKinds;
    while ((at -= kind->weight) >= 0) ++kind;
    Event event{.what = kind->what, .value = static_cast<int64_t>(random() % 8)};
    if (event.what == "pin") event.name = oneOf(kPins, random);
    if (event.what == "reload" || event.what == "shadow") event.name = oneOf(kPrograms, random);
    for (const char* of : {"get", "set", "force", "unforce", "watch"})
      if (event.what == of) event.name = oneOf(kCells, random);
    if (event.what == "mark") event.name = "mark " + std::to_string(events.size());
    events.push_back(event);
  }
  return events;
}

std::string run(const Programs& programs, const std::vector<Event>& events) {
  Model model(programs);
  for (size_t i = 0; i < events.size(); ++i)
    if (const std::string wrong = model.happen(events[i]); !wrong.empty())
      return "event " + std::to_string(i + 1) + ", " + textOf(events[i]) + ": " + wrong;
  return model.finish();
}

std::vector<Event> minimised(const Programs& programs, std::vector<Event> events) {
  for (size_t part = events.size() / 2; part > 0; part /= 2)
    for (size_t at = 0; at < events.size();) {
      std::vector<Event> less = events;
      const auto begin = less.begin() + static_cast<ptrdiff_t>(at);
      less.erase(begin, begin + static_cast<ptrdiff_t>(std::min(part, less.size() - at)));
      if (run(programs, less).empty())
        at += part;
      else
        events = std::move(less);
    }
  return events;
}

} // namespace rung::host_sim

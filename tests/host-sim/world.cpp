// One thread is all of them (see world.h).
#include "tests/host-sim/world.h"

#include <algorithm>
#include <utility>

#include "ir/support/check.h"
#include "rtlib/api/environment.h"
#include "rtlib/load/program_info.h"

namespace rung::host_sim {
namespace {

using nlohmann::json;

// Inputs by pins, and outputs whose safe values are 0.
constexpr const char* kMap = R"([in]
go = { type = "bit", name = "GO" }
stuck = { type = "bit", name = "STUCK" }
sets = { type = "bit", name = "SETS" }
clears = { type = "bit", name = "CLEARS" }
other = { type = "bit", name = "OTHER" }
wait = { type = "bit", name = "WAIT" }
ask = { type = "bit", name = "ASK" }
far = { type = "bit", name = "FAR" }
far-ok = { type = "bit", name = "X1.7" }
[out]
lamp = { type = "bit", name = "LAMP" }
latch = { type = "bit", name = "LATCH" }
second = { type = "bit", name = "Y0.3" }
beyond = { type = "bit", name = "BEYOND" }
[[send]]
pin = "m6"
edge = "rise"
function = "M"
code = 6
[[send]]
pin = "m6"
edge = "fall"
function = "M"
code = 7
[[abort]]
pin = "abort"
edge = "rise"
[shared-memory]
name = "sim"
timeout = 0.101
status = "far-ok"
pins = { far = 0, lamp = 0 }
[recording]
off = true
[rungctl]
permissions = ["set", "force", "reload", "start", "stop", "reset", "profile", "serve", "acknowledge"]
protected = ["OTHER"]
)";
constexpr const char* kRetained = "/disk/retained";

// Programs are made already; code with forced cells is made while it is asked for.
class Made final : public control::Programs {
public:
  explicit Made(const host_sim::Programs& programs) : programs_(programs) {}
  Image open(const std::string& path) override {
    const std::optional<size_t> version = programs_.find(path.substr(path.rfind('/') + 1));
    if (!version) throw Error(RUNG_REFUSED, ("cannot load " + path + ": there is no such file").c_str());
    return programs_.image(*version);
  }
  void serveForces(const Image&) override {}
  void abandon() override {}

private:
  const host_sim::Programs& programs_;
};

} // namespace

// ---- disk
// ------------------------------------------------------------------------------------------------------------

class MemoryDisk::Held final : public Lock {
public:
  Held(MemoryDisk& disk, std::string path) : disk_(disk), path_(std::move(path)) { disk_.locked_[path_] = true; }
  ~Held() override { disk_.locked_[path_] = false; }

private:
  MemoryDisk& disk_;
  std::string path_;
};

bool MemoryDisk::read(const std::string& path, size_t, std::string& bytes, std::string&) {
  const auto file = files_.find(path);
  if (file == files_.end()) return false;
  bytes = file->second;
  return true;
}

bool MemoryDisk::replace(const std::string& path, std::span<const uint8_t> bytes, std::string& error) {
  if (full) return error = "cannot write " + path + ": No space left on device", false;
  if (std::exchange(torn, false)) return error = "cannot write " + path + ": Input/output error", false;
  files_[path] = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return true;
}

std::unique_ptr<runtime::Disk::Lock> MemoryDisk::lock(const std::string& path, bool& made, std::string&) {
  made = !files_.contains(path);
  if (locked_[path]) return nullptr;
  files_[path] = "";
  return std::make_unique<Held>(*this, path);
}

// ---- the host
// --------------------------------------------------------------------------------------------------------

World::World(const Programs& programs) : programs_(programs) { switchOn(); }

World::~World() {
  if (isOn()) cutPower();
}

void World::switchOn() {
  std::vector<std::string> errors, warnings;
  image_ = programs_.image(0);
  const auto newInstance = [this](const Image& image, const rung_instance_options& options) {
    Instance made(image, &options);
    api::setOutside(*made.handle(), {.disk = &disk, .savePeriod = std::chrono::milliseconds(0)});
    recorded_.begin(*made.handle(), disk);
    return made;
  };
  try {
    host::File map = host::parseMap(kMap, "sim.map", errors);
    exchange_ = std::make_unique<io::Exchange>(map, map.connections.at(0));
    host_ = host::PlcHost::make(*image_, std::move(map),
                                {.retain = kRetained, .newInstance = newInstance, .clock = this}, errors, warnings);
  } catch (const Error& error) { // a full disk
    errors.emplace_back(error.what());
  }
  for (const std::string& text : warnings) log.push_back("warning: " + text);
  for (const std::string& text : errors) log.push_back("error: " + text);
  if (host_ == nullptr) return;
  pins_.clear();
  for (const host::Pin& pin : host_->pins()) pins_.push_back(pin.name);
  values_.assign(pins_.size(), {});
  cells_.clear();
  for (Value& value : values_) cells_.push_back({.any = &value});
  host_->connect(cells_.data());
  writeRequest();
  far.heardNs = -1;
  tellFar();
  log_ = std::make_unique<control::Log>(*this, [this](const std::string& line) { log.push_back(line); });
  controller_ = std::make_unique<control::Controller>("sim", *host_, *image_, *log_, std::make_unique<Made>(programs_));
  dueNs_ = nowNs_ + kPeriodNs;
  ran_ = true;
  faulted_ = 0;
  number_ = 1;
  changes.clear();
}

void World::tellFar() {
  exchange_->writeOutputs(cells_.data());
  far.lamp = exchange_->newestOutputs().at(0) != 0;
}

// What ASK asks for: variable 500, into D10:4.
void World::writeRequest() {
  constexpr std::pair<const char*, int64_t> kRequest[] = {{"D0:2", 9}, {"D4:2", 4}, {"D6:2", 500}};
  for (const auto& [name, number] : kRequest) {
    rung_cell cell = 0;
    const rung_value value{.integer = number};
    RUNG_CHECK(rung_instance_find(instance(), name, RUNG_WRITE, &cell) == RUNG_OK, "the cell is there");
    RUNG_CHECK(rung_instance_write(instance(), cell, 0, 1, &value) == RUNG_OK, "it can be written");
  }
}

void World::switchOff() {
  for (int turns = 0; !host_->powerOffDone(); ++turns) {
    RUNG_CHECK(turns < 1000, "the power-off never ends");
    turn();
    step();
  }
  scans = false; // its thread has ended
  const uint32_t restarts = host_->restarts();
  const int64_t begin = nowNs_;
  const nlohmann::json answer = ask(1, {{"do", "status"}});
  turn();
  lastEnd = {.ranAgain = host_->restarts() != restarts,
             .tookNs = nowNs_ - begin,
             .saysSo = answer.value("powered_off", false)};
  const std::string error = host_->close();
  if (!error.empty()) log.push_back("close: " + error);
  controller_.reset();
  log_.reset();
  host_.reset();
  clients = {};
}

void World::cutPower() {
  api::cutPower(*host_->instance());
  controller_.reset();
  log_.reset();
  host_.reset();
  clients = {};
}

// Orders are obeyed before the program runs.
void World::step() {
  noteChanges(wholeScans, cell("SCANS")); // a client that waits restarts the program
  const uint64_t before = host_->state().scans;
  const uint64_t scansBefore = wholeScans;
  const int64_t cellBefore = cell("SCANS");
  if (far.isThere) {
    const double value = far.value ? 1 : 0;
    exchange_->publish({&value, 1}, nowNs_);
    far.heardNs = nowNs_;
  }
  exchange_->readInputs(cells_.data(), nowNs_);
  const host::StepResult result = host_->step(kPeriodNs, reset);
  tellFar();
  ++steps;
  lastStepNs = nowNs_;
  const rung_state after = host_->state();
  if (result == host::StepResult::Ran && (after.flags & RUNG_STATE_STOPPED) == 0 && after.scans == before + 1)
    ++wholeScans;
  noteChanges(scansBefore, cellBefore);
}

void World::noteChanges(uint64_t scansBefore, int64_t cellBefore) {
  rung_program_info info{};
  info.size = sizeof info;
  rung_instance_program(instance(), &info);
  const bool runs = host_->running();
  const bool falls = ran_ && !runs;
  // A program may take over, fail and be put back within one step.
  const uint32_t ranLast = falls && info.faulted != 0 && info.faulted != faulted_ ? info.faulted : info.number;
  if (ranLast != number_)
    changes.push_back({.kind = Change::Kind::Replaced, .wholeScans = scansBefore, .scans = cellBefore});
  if (falls)
    changes.push_back(
        {.kind = Change::Kind::Fault, .wholeScans = wholeScans, .scans = cell("SCANS"), .number = ranLast});
  if (!ran_ && runs)
    changes.push_back({.kind = Change::Kind::Restart, .wholeScans = wholeScans, .scans = cell("SCANS")});
  number_ = info.number;
  faulted_ = info.faulted;
  ran_ = runs;
}

void World::pass(int64_t ns) {
  for (const int64_t end = nowNs_ + ns; nowNs_ < end;) {
    nowNs_ = std::min(end, dueNs_);
    if (nowNs_ < dueNs_) return;
    dueNs_ += kPeriodNs;
    if (scans && isOn()) step();
  }
}

std::string World::finish() {
  if (isOn()) cutPower();
  return recorded_.play();
}

void World::turn() {
  recorded_.look(*host_->instance());
  controller_->serveProgram(&clients);
  controller_->serveClients(clients);
  noteChanges(wholeScans, cell("SCANS"));
}

void World::lookForSaving() { api::lookForSaving(*host_->instance()); }

control::Peer World::peerOf(uint32_t number) const {
  return {.number = number, .user = 0, .process = 1, .name = "sim"};
}

json World::ask(uint32_t peer, const json& request) {
  json answer = controller_->answer(peerOf(peer), request);
  for (int turns = 0; answer.is_null(); ++turns) { // it comes later
    RUNG_CHECK(turns < 1000, "an answer never comes");
    turn();
    pass(kPeriodNs);
    std::deque<json>& waiting = clients.answers[peer];
    if (waiting.empty()) continue;
    answer = waiting.front();
    waiting.pop_front();
  }
  noteChanges(wholeScans, cell("SCANS"));
  return answer;
}

void World::leave(uint32_t peer) {
  controller_->gone(peerOf(peer));
  clients.events.erase(peer);
  clients.answers.erase(peer);
}

size_t World::numberOf(const std::string& pin) const {
  const auto found = std::ranges::find(pins_, pin);
  RUNG_CHECK(found != pins_.end(), "there is such a pin");
  return static_cast<size_t>(found - pins_.begin());
}

void World::setPin(const std::string& name, bool value) { values_[numberOf(name)].bit = value; }
bool World::pin(const std::string& name) const { return values_[numberOf(name)].bit; }

int64_t World::cell(const std::string& name) const {
  const runtime::Instance& inside = api::insideOf(*host_->instance());
  const rung_symbol* symbol = runtime::findSymbol(inside.program(), name);
  if (symbol == nullptr) return -1;
  runtime::Ref ref = runtime::refOf(*symbol);
  ref.width = symbol->type == RUNG_TYPE_BIT ? 1 : 32;
  return static_cast<int64_t>(inside.read(ref));
}

} // namespace rung::host_sim

// See forces.h.
#include "machine/control/forces.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/values.h"

namespace rung::control {

using nlohmann::json;

struct Forces::HeldCell {
  std::string name;
  std::string owner;
  rung_value value{};
  bool operator==(const HeldCell& other) const {
    return name == other.name && owner == other.owner && value.integer == other.value.integer;
  }
};

// A change of the set of forces, as a client requested it.
struct Forces::Change {
  Peer peer;
  std::vector<HeldCell> before;
  std::vector<HeldCell> cells; // after the change
  LogKind kind = LogKind::Force;
  std::string text;         // for the log
  json answer;              // once the change is done
  json id;                  // {"id": ID} if the request has an ID, otherwise {}
  std::string refused = {}; // why the change has been cancelled
};

namespace {

// The ID of a request, for a later answer.
json idOf(const json& request) { return request.contains("id") ? json{{"id", request["id"]}} : json::object(); }

} // namespace

Forces::Forces(PlcAccess& plc, const Cells& cells, Programs& programs)
    : plc_(plc), cells_(cells), programs_(programs) {}
Forces::~Forces() = default;

std::vector<Forces::HeldCell> Forces::heldCells() {
  std::vector<HeldCell> cells;
  for (const rung_force_info& force : plc_.activeForces()) cells.push_back({force.name, force.owner, force.value});
  return cells;
}

const Forces::HeldCell* Forces::forceOf(const std::vector<HeldCell>& held, const std::string& name) const {
  const std::optional<rung_cell_info> wanted = cellInfo(plc_.instance(), name, RUNG_READ);
  const auto isIt = [&](const HeldCell& cell) {
    const auto other = wanted ? cellInfo(plc_.instance(), cell.name, RUNG_READ) : std::nullopt;
    return cell.name == name || (other && host::isSamePlace(*wanted, *other));
  };
  const auto found = std::ranges::find_if(held, isIt);
  return found == held.end() ? nullptr : &*found;
}

std::vector<std::string> Forces::activeNames() {
  std::vector<std::string> names;
  for (const rung_force_info& force : plc_.activeForces()) names.emplace_back(force.name);
  return names;
}

std::string Forces::takeEndedNames() { return joined(std::exchange(heldNames_, {}), ", "); }

std::string Forces::endedForces() {
  const std::string names = takeEndedNames();
  return names.empty() ? "" : ", which ends the forces of " + names;
}

void Forces::refuseWhilePending() const {
  if (pending_ != nullptr)
    throw Refused("another force is being compiled; try again later, or release all: unforce --all");
}

// Returns nothing while the compiler is making the code.
std::optional<Forces::ForceSet> Forces::prepared(const Change& change) {
  if (change.cells.empty()) return ForceSet();
  std::vector<rung_forced_cell> cells;
  for (const HeldCell& cell : change.cells)
    cells.push_back({cell.name.c_str(), cell.owner.c_str(), cell.value, RUNG_READ, 0});
  rung_forces* made = nullptr;
  const int32_t status =
      check(rung_forces_new(plc_.instance(), nullptr, cells.data(), static_cast<uint32_t>(cells.size()), &made));
  return status == RUNG_LATER ? std::nullopt : std::optional<ForceSet>(made);
}

void Forces::putInEffect(const Change& change, ForceSet forces) {
  plc_.post({.kind = host::Command::Kind::Force, .forces = forces.get()});
  forces_ = std::move(forces); // the previous set has ended
  heldNames_.clear();
  for (const HeldCell& cell : change.cells) heldNames_.push_back(cell.name);
  plc_.logChange(change.peer, change.kind, change.text);
}

// Returns the answer; null if it follows later.
json Forces::begin(Change change) {
  if (std::optional<ForceSet> forces = prepared(change)) {
    putInEffect(change, std::move(*forces));
    return change.answer;
  }
  pending_ = std::make_unique<Change>(std::move(change));
  return nullptr;
}

void Forces::refusePending(const std::string& why) {
  if (pending_ == nullptr) return;
  programs_.abandon();
  pending_->refused = why;
}

void Forces::finishPending(Sink& sink) {
  if (pending_ == nullptr) return;
  if (pending_->refused.empty() && !plc_.host().running())
    refusePending("the program has stopped in the meantime; all forces have ended");
  json answer = pending_->answer;
  try {
    if (!pending_->refused.empty()) throw Refused(pending_->refused);
    std::optional<ForceSet> forces = prepared(*pending_);
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

void Forces::gone(const Peer& peer) {
  if (pending_ == nullptr || pending_->peer.number != peer.number) return;
  programs_.abandon();
  pending_.reset();
}

json Forces::force(const Peer& peer, const json& request) {
  const std::string name = textOf(request, "name");
  if (!request.contains("value")) throw Refused("found no \"value\" in the request, expected one");
  const uint32_t type = cells_.describe(name, RUNG_READ).type;
  cells_.refuseProtected(name);
  refuseWhilePending();
  if (!plc_.host().running()) throw Refused("a fault has stopped the program: a reset restarts it");
  const rung_value value = fromJson(type, request["value"], name);
  std::vector<HeldCell> before = heldCells();
  std::vector<HeldCell> cells = {{name, peer.name, value}};
  const HeldCell* former = forceOf(before, name);
  for (const HeldCell& cell : before)
    if (&cell != former) cells.push_back(cell);
  if (cells.size() > PlcAccess::kMostForces) throw Refused("64 variables are already forced; release one first");
  return begin({.peer = peer,
                .before = std::move(before),
                .cells = std::move(cells),
                .kind = LogKind::Force,
                .text = "force " + name + " to " + textOf(type, value),
                .answer = {{"name", name}, {"value", toJson(type, value)}},
                .id = idOf(request)});
}

json Forces::unforce(const Peer& peer, const json& request) {
  const bool all = flagOf(request, "all");
  const std::string name = all ? "" : textOf(request, "name");
  if (all)
    refusePending("all forces have been released in the meantime");
  else
    refuseWhilePending();
  std::vector<HeldCell> before = heldCells();
  const HeldCell* former = all ? nullptr : forceOf(before, name);
  if (!all && former == nullptr) throw Refused(name + " is not forced");
  std::vector<HeldCell> left;
  json ended = json::array();
  for (const HeldCell& cell : before)
    if (all || &cell == former)
      ended.push_back(cell.name);
    else
      left.push_back(cell);
  json answer = {{"ended", ended.size()}, {"names", ended}};
  if (ended.empty()) return answer;
  return begin({.peer = peer,
                .before = std::move(before),
                .cells = std::move(left),
                .kind = LogKind::Unforce,
                .text = all ? "unforce all" : "unforce " + name,
                .answer = std::move(answer),
                .id = idOf(request)});
}

json Forces::forced(const Peer&, const json&) {
  json list = json::array();
  for (const rung_force_info& force : plc_.activeForces())
    list.push_back({{"name", force.name},
                    {"value", toJson(force.type, force.value)},
                    {"owner", force.owner},
                    {"since_us", force.since_us}});
  return {{"forced", list}};
}

} // namespace rung::control

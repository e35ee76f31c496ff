// Checks bits with several coils. The value of a coil is lost if another OUT of the same bit, which has not read it,
// follows on every path through the scan. What counts as a read depends on who sees the bit:
// - outputs, and memory that the control displays, are seen from outside at the end of a slot: only the last OUT
//   counts, whatever contacts read before;
// - other bits are seen only by contacts and functions, so a relay may be computed again after it has been read. They
//   are followed through one unit; a call of a unit that uses the bit counts as a read.
// A network that reads the bit it drives extends the value and loses nothing.
#include <algorithm>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frontend/network/check/analyse.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::network {
namespace {

using Bit = uint32_t; // area, byte and bit; sorted in memory order
constexpr Bit keyOf(Area area, uint32_t byte, uint32_t bit) {
  return static_cast<uint32_t>(area) << 16 | byte << 3 | bit;
}
constexpr Bit keyOf(const Address& address) { return keyOf(address.area, address.byte, address.bit); }
constexpr bool drives(Coil kind) { return kind == Coil::Out || kind == Coil::OutInverted; }

struct Place {
  uint32_t unit = 0;
  uint32_t network = 0; // index in the unit being checked; for a coil in a subprogram, its call
  const CoilStep* coil = nullptr;
};

// The effect of a unit, with everything it calls, on one bit.
struct Effect {
  std::optional<Place> certain; // the first OUT that every run executes and that does not read the bit
  std::optional<Place> left;    // an OUT whose value may stay at the end
  std::optional<Place> latch;   // a SET or RST
  bool used = false;            // whether a contact, function or coil uses the bit
};
using Effects = std::map<Bit, Effect>;

// State of one bit during the walk through a unit.
struct State {
  std::vector<Place> live; // coils whose value has not been read yet
  Effect effect;
};

// Which networks of a unit a forward jump can skip.
class Flow {
public:
  explicit Flow(const Unit& unit) : cover_(unit.networks.size(), kNone) {
    std::priority_queue<std::pair<uint32_t, uint32_t>> jumps; // (network, target), the last jump on top
    for (uint32_t n = 0; n < unit.networks.size(); ++n) {
      while (!jumps.empty() && jumps.top().second <= n) jumps.pop();
      if (!jumps.empty()) cover_[n] = jumps.top().first;
      const Control control = controlOf(unit.networks[n]);
      const uint32_t target = unit.networks[n].target;
      if ((control == Control::Jmp || control == Control::Jmpb) && target != kNone && target > n)
        jumps.emplace(n, target);
    }
  }
  // Whether a jump can skip `network`.
  bool canPass(uint32_t network) const { return cover_[network] != kNone; }
  // Whether a jump after `from` can skip `network`.
  bool canPass(uint32_t from, uint32_t network) const { return canPass(network) && cover_[network] > from; }

private:
  std::vector<uint32_t> cover_; // per network, the last jump that can skip it
};

class CoilCheck {
public:
  CoilCheck(Context& context, const Program& program)
      : language_(context.language), diagnostics_(context.diagnostics), program_(program),
        effects_(program.units.size()) {}

  void run(const std::vector<uint32_t>& calleesFirst) {
    collect();
    if (bits_.empty()) return;
    for (uint32_t u : calleesFirst) walk(u);
    acrossLevels();
  }

private:
  template <class F>
  void eachUse(const Network& network, F f) const;
  void collect();
  void walk(uint32_t unit);
  bool endsKnowledge(const Network& network, uint32_t index) const;
  void call(uint32_t unit, uint32_t network, bool always);
  void coil(const Place& place, bool reads, bool passable);
  void overwrite(State& state, const Place& by, uint32_t network, bool called);
  void finish(uint32_t unit);
  void acrossLevels();
  void acrossLevels(const Effects& first, const Effects& second);
  void doubleCoil(const Place& here, const Place& other);
  void mixed(const std::optional<Place>& out, const std::optional<Place>& latch);
  std::string whereIs(const Place& other, const Place& here) const;
  bool seenOutside(Bit bit) const { return language_.at(static_cast<Area>(bit >> 16)).seenOutside(); }

  const Language& language_;
  Diagnostics& diagnostics_;
  const Program& program_;
  std::map<Bit, bool> bits_; // bits with several coils, one an OUT at least; value: whether anything reads the bit
  std::vector<Effects> effects_;
  std::map<Bit, State> states_; // of the unit being walked
  const Flow* flow_ = nullptr;
  std::set<const CoilStep*> reported_;
  std::set<Bit> doubles_;
  std::set<Bit> mixed_;
};

// Calls f with every bit of bits_ that the contacts or the function of a network use.
template <class F>
void CoilCheck::eachUse(const Network& network, F f) const {
  for (const LogicStep& step : network.logic)
    if (step.kind != Logic::OrBlock && step.kind != Logic::AndBlock && bits_.contains(keyOf(step.bit)))
      f(keyOf(step.bit));
  for (const Param& param : network.function.params) {
    if (!param.isAddress) continue;
    const Bit begin = keyOf(param.address.area, param.address.byte, 0);
    const Bit end = begin + 8 * param.bytes;
    for (auto at = bits_.lower_bound(begin); at != bits_.end() && at->first < end; ++at) f(at->first);
  }
}

void CoilCheck::collect() {
  std::map<Bit, std::pair<uint32_t, bool>> coils; // number of coils, whether one is an OUT
  for (const Unit& unit : program_.units)
    for (const Network& network : unit.networks)
      for (const CoilStep& coil : network.coils) {
        auto& [count, out] = coils[keyOf(coil.bit)];
        ++count;
        out = out || drives(coil.kind);
      }
  for (const auto& [bit, seen] : coils)
    if (seen.first > 1 && seen.second) bits_.emplace(bit, false);
  for (const Unit& unit : program_.units)
    for (const Network& network : unit.networks) eachUse(network, [&](Bit bit) { bits_[bit] = true; });
}

// Paths that are not followed: out of the unit, backwards, or to a target that does not exist.
bool CoilCheck::endsKnowledge(const Network& network, uint32_t index) const {
  switch (controlOf(network)) {
  case Control::Jmp:
  case Control::Jmpb: return network.target == kNone || network.target <= index;
  case Control::Jmpc: return true;
  case Control::Call:
  case Control::CallU: return network.callee == kNone || program_.units[network.callee].leaves;
  default: return false;
  }
}

void CoilCheck::walk(uint32_t u) {
  const Unit& unit = program_.units[u];
  const Flow flow(unit);
  flow_ = &flow;
  states_.clear();
  bool passable = false; // whether the run may have ended before this network
  for (uint32_t n = 0; n < unit.networks.size(); ++n) {
    const Network& network = unit.networks[n];
    std::set<Bit> reads;
    eachUse(network, [&](Bit bit) {
      reads.insert(bit);
      State& state = states_[bit];
      state.effect.used = true;
      if (!seenOutside(bit)) state.live.clear();
    });
    const Control control = controlOf(network);
    if ((control == Control::Call || control == Control::CallU) && network.callee != kNone)
      call(u, n, control == Control::CallU && !passable);
    if (endsKnowledge(network, n)) {
      passable = true;
      for (auto& [bit, state] : states_) state.live.clear();
    }
    for (const CoilStep& step : network.coils)
      if (bits_.contains(keyOf(step.bit))) coil({u, n, &step}, reads.contains(keyOf(step.bit)), passable);
  }
  finish(u);
}

// Reports the value that an OUT overwrites on every path from the earlier coil.
void CoilCheck::overwrite(State& state, const Place& by, uint32_t network, bool called) {
  const Place* lost = nullptr;
  for (const Place& earlier : state.live) {
    if (flow_->canPass(earlier.network, network)) continue;
    if (called && earlier.unit == by.unit) continue; // a subprogram that runs twice overwrites its own values
    if (lost == nullptr || drives(earlier.coil->kind) || !drives(lost->coil->kind)) lost = &earlier;
  }
  if (lost == nullptr) return;
  if (drives(lost->coil->kind))
    doubleCoil(by, *lost);
  else
    mixed(by, *lost);
}

void CoilCheck::coil(const Place& place, bool reads, bool passable) {
  const CoilStep& step = *place.coil;
  State& state = states_[keyOf(step.bit)];
  const bool outside = seenOutside(keyOf(step.bit));
  state.effect.used = true;
  if (!drives(step.kind)) {
    if (!state.effect.latch) state.effect.latch = place;
    if (!outside && bits_.at(keyOf(step.bit))) state.live.push_back(place);
    return;
  }
  if (!outside && !bits_.at(keyOf(step.bit))) return; // nothing reads the bit: its coils only complete their functions
  if (!reads) {
    overwrite(state, place, place.network, false);
    if (!state.effect.certain && !passable && !flow_->canPass(place.network)) state.effect.certain = place;
  }
  std::erase_if(state.live, [&](const Place& p) { return !flow_->canPass(p.network, place.network); });
  state.live.push_back(place);
}

void CoilCheck::call(uint32_t u, uint32_t n, bool always) {
  const uint32_t callee = program_.units[u].networks[n].callee;
  for (const auto& [bit, effect] : effects_[callee]) {
    State& state = states_[bit];
    state.effect.used = true;
    if (!seenOutside(bit)) {
      state.live.clear();
      continue;
    }
    if (!state.effect.latch) state.effect.latch = effect.latch;
    if (controlOf(program_.units[u].networks[n]) == Control::CallU && effect.certain) {
      overwrite(state, *effect.certain, n, true);
      std::erase_if(state.live, [&](const Place& p) { return !flow_->canPass(p.network, n); });
      if (!state.effect.certain && always && !flow_->canPass(n)) state.effect.certain = effect.certain;
    }
    if (effect.left) state.live.push_back({effect.left->unit, n, effect.left->coil});
  }
}

void CoilCheck::finish(uint32_t u) {
  for (auto& [bit, state] : states_) {
    Effect& effect = state.effect;
    if (seenOutside(bit)) {
      if (!state.live.empty()) effect.left = state.live.back();
      mixed(effect.certain, effect.latch);
    }
    effects_[u].emplace(bit, effect);
  }
}

// Compares the levels in pairs: all of them may run in one slot, and some run again in every slot.
void CoilCheck::acrossLevels() {
  for (uint32_t later = 1; later < language_.levels.size(); ++later)
    for (uint32_t level = 0; level < later; ++level) acrossLevels(effects_[level], effects_[later]);
}

void CoilCheck::acrossLevels(const Effects& first, const Effects& second) {
  for (const auto& [bit, one] : first) {
    const auto at = second.find(bit);
    if (at == second.end() || !seenOutside(bit)) continue;
    const Effect& two = at->second;
    mixed(one.certain, two.latch);
    mixed(two.certain, one.latch);
    if (doubles_.contains(bit) || !one.left || !two.left || one.left->unit == two.left->unit) continue;
    if (one.certain || two.certain) doubleCoil(*two.left, *one.left);
  }
}

std::string CoilCheck::whereIs(const Place& other, const Place& here) const {
  if (other.unit == here.unit) return "here";
  return "here, in " + nameOf(language_, program_.units[other.unit]);
}

void CoilCheck::doubleCoil(const Place& here, const Place& other) {
  if (!reported_.insert(here.coil).second) return;
  const Bit bit = keyOf(here.coil->bit);
  const bool isFirst = doubles_.insert(bit).second;
  if (!isFirst && language_.dummyCoils && !seenOutside(bit)) return;
  diagnostics_.report(diag::DoubleCoil, here.coil->range)
          .note(other.coil->range, "the other coil is " + whereIs(other, here))
      << textOf(language_, here.coil->bit);
}

// Reports a bit with both OUT and SET or RST, once per bit.
void CoilCheck::mixed(const std::optional<Place>& out, const std::optional<Place>& latch) {
  if (!out || !latch || !mixed_.insert(keyOf(out->coil->bit)).second) return;
  diagnostics_.report(diag::MixedOutput, out->coil->range)
          .note(latch->coil->range,
                fmt::format("{} is {}", language_.nameOf(commandOf(latch->coil->kind)), whereIs(*latch, *out)))
      << textOf(language_, out->coil->bit);
}

} // namespace

void checkCoils(Context& context, const Program& program, const std::vector<uint32_t>& calleesFirst) {
  CoilCheck(context, program).run(calleesFirst);
}

} // namespace rung::frontend::network

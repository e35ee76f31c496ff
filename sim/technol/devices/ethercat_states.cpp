// States of master and slaves (see ethercat_states.h).
#include "sim/technol/devices/ethercat_states.h"

namespace rung::sim::technol {
namespace {

using namespace io::ethercat;

// The state that one step leads to. Nothing: there is no such change.
std::optional<State> nextState(State from, State target) {
  if (from == target) return from;
  if (target == State::Bootstrap) return from == State::Init ? std::optional(target) : std::nullopt;
  if (from == State::Bootstrap) return target == State::Init ? std::optional(target) : std::nullopt;
  if (target < from) return target;
  if (from == State::Init) return State::PreOperational;
  return from == State::PreOperational ? State::SafeOperational : State::Operational;
}

} // namespace

void EthercatStates::powerOn() {
  master_ = target_ = State::Init;
  slave_.reset();
  stepMs_ = silentMs_ = 0;
  link_ = true;
}

void EthercatStates::start(State target) {
  begin(target, std::nullopt);
  for (Step made = step(); !made.isDone && !made.isRefused && !made.isSilent;) made = step();
}

void EthercatStates::begin(State target, std::optional<uint32_t> slave) {
  target_ = target;
  slave_ = slave;
  stepMs_ = silentMs_ = 0;
}

// ---- one step ----------------------------------------------------------------------------------------------------

EthercatStates::Step EthercatStates::stepOf(EthercatSlave& slave, State goal) {
  if (slave.state == goal) return {};
  if (slave.isSilent) return {.isSilent = true, .isDone = false};
  const std::optional<State> next = nextState(slave.state, goal);
  if (!next || *next == slave.refused) return {.isRefused = true, .isDone = false};
  slave.state = *next;
  return {.isDone = slave.state == goal};
}

// Slaves that go along are in the goal also where another refuses it: by their states it can be found.
EthercatStates::Step EthercatStates::allTo(State goal) {
  Step all;
  for (uint32_t i = 0; i < slaves_.count(); ++i) {
    const Step one = stepOf(slaves_[i], goal);
    all.isRefused |= one.isRefused;
    all.isSilent |= one.isSilent;
    all.isDone &= one.isDone;
  }
  return all;
}

EthercatStates::Step EthercatStates::step() {
  if (slave_) return stepOf(slaves_[*slave_], target_);
  const std::optional<State> goal = nextState(master_, target_);
  if (!goal) return {.isRefused = true, .isDone = false};
  Step made = allTo(*goal);
  if (made.isDone) master_ = *goal;
  made.isDone &= master_ == target_;
  return made;
}

// ---- changes -----------------------------------------------------------------------------------------------------

std::optional<uint32_t> EthercatStates::tick() {
  if (!link_) return kNoSlave;
  if (++stepMs_ < kStepMs) return std::nullopt;
  const Step made = step();
  if (made.isRefused) return kStateRefused;
  if (made.isDone) return kDone;
  silentMs_ = made.isSilent ? silentMs_ + stepMs_ : 0;
  stepMs_ = 0;
  return silentMs_ >= kTimeoutMs ? std::optional<uint32_t>(kTimedOut) : std::nullopt;
}

void EthercatStates::setLink(bool isUp) {
  link_ = isUp;
  if (isUp) return;
  master_ = State::Init;
  for (uint32_t i = 0; i < slaves_.count(); ++i) slaves_[i].state = State::Init;
}

bool EthercatStates::givesInputs(uint32_t slave) const {
  const auto exchanges = [](State state) { return state == State::SafeOperational || state == State::Operational; };
  return link_ && exchanges(master_) && exchanges(slaves_[slave].state) && !slaves_[slave].isSilent;
}

bool EthercatStates::takesOutputs(uint32_t slave) const {
  return givesInputs(slave) && master_ == State::Operational && slaves_[slave].state == State::Operational;
}

} // namespace rung::sim::technol

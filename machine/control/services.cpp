// See services.h.
#include "machine/control/services.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/turn.h"
#include "machine/control/values.h"

namespace rung::control {
namespace {

using host::Outcome;
using nlohmann::json;

constexpr uint32_t kHighestLine = 99'999'999;

uint32_t numberOf(const json& request, const char* key, uint32_t most) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_number_unsigned() || *found > most)
    throw Refused(std::string("found no number \"") + key + "\" from 0 to " + std::to_string(most) +
                  " in the request, expected one");
  return found->get<uint32_t>();
}

double realOf(const json& value, const char* key) {
  const bool good = value.is_number() && std::isfinite(value.get<double>());
  if (!good) throw Refused(std::string("found ") + value.dump() + " for \"" + key + "\", expected a number");
  return value.get<double>();
}

Outcome outcomeOf(const json& request) {
  const json word = request.value("outcome", json());
  const auto* known = word.is_string() ? std::ranges::find(host::kOutcomeNames, word.get<std::string>())
                                       : std::end(host::kOutcomeNames);
  if (known != std::end(host::kOutcomeNames)) return static_cast<Outcome>(known - host::kOutcomeNames);
  std::string names;
  for (const std::string_view name : host::kOutcomeNames) names += (names.empty() ? "" : ", ") + std::string(name);
  throw Refused("found " + word.dump() + " for \"outcome\", expected one of " + names);
}

std::vector<double> positionsOf(const json& request) {
  const auto found = request.find("machine");
  if (found == request.end() || !found->is_array() || found->size() > host::kMostAxes)
    throw Refused("found no list \"machine\" of at most " + std::to_string(host::kMostAxes) +
                  " numbers in the request, expected one");
  std::vector<double> positions;
  for (const json& position : *found) positions.push_back(realOf(position, "machine"));
  return positions;
}

json jsonOf(uint32_t ticket, const host::Operation& o) {
  json event = {{"ticket", ticket},
                {"quantity", host::kQuantityNames[static_cast<size_t>(o.quantity)]},
                {"channel", o.channel},
                {"number", o.number},
                {"axis", o.axis}};
  if (o.write) event["value"] = o.value;
  if (o.quantity == host::Quantity::AxisMove) {
    event["motion"] = host::kMotionNames[static_cast<size_t>(o.motion)];
    event["speed"] = o.speed;
    if (o.untilOver) event["until"] = "over";
  }
  return event;
}

} // namespace

json Services::serve(const Peer& peer, const json& request) {
  constexpr uint32_t kMostMs = 60'000;
  if (provider_ != 0 && provider_ != peer.number)
    throw Refused("another client already serves this program; end its connection first");
  aliveNs_ = request.contains("alive_ms") ? int64_t{numberOf(request, "alive_ms", kMostMs)} * 1'000'000 : 0;
  provider_ = peer.number;
  heard(peer);
  plc_.live().served.store(true, std::memory_order_release);
  if (isLost_) reports_.emplace_back("the program is served again");
  return {{"again", std::exchange(isLost_, false)}};
}

json Services::waiting() const {
  constexpr size_t kMost = 8;
  std::vector<const std::pair<const uint32_t, Waiting>*> oldest;
  for (const auto& entry : waiting_) oldest.push_back(&entry);
  std::ranges::sort(oldest, {}, [](const auto* entry) { return entry->second.sinceNs; });
  json list = json::array();
  for (size_t i = 0; i < oldest.size() && i < kMost; ++i) {
    json one = jsonOf(oldest[i]->first, oldest[i]->second.operation);
    addAge(one, plc_.clock(), plc_.clock().nowNs() - oldest[i]->second.sinceNs);
    list.push_back(one);
  }
  return {{"count", waiting_.size()}, {"oldest", list}};
}

void Services::heard(const Peer& peer) {
  if (peer.number == provider_) heardNs_ = plc_.clock().nowNs();
}

void Services::checkProvider(const Peer& peer) const {
  if (peer.number != provider_) throw Refused("this connection does not serve the program; \"serve\" begins it");
}

json Services::live(const Peer& peer, const json& request) {
  checkProvider(peer);
  const std::vector<double> positions = positionsOf(request);
  const uint32_t line = numberOf(request, "line", kHighestLine);
  host::Live& live = plc_.live();
  for (size_t i = 0; i < positions.size(); ++i) live.machine[i].store(positions[i], std::memory_order_relaxed);
  live.axes.store(static_cast<uint32_t>(positions.size()), std::memory_order_relaxed);
  live.line.store(line, std::memory_order_relaxed);
  live.known.store(true, std::memory_order_release);
  return json::object();
}

json Services::served(const Peer& peer, const json& request) {
  checkProvider(peer);
  const uint32_t ticket = numberOf(request, "ticket", UINT32_MAX);
  const auto found = waiting_.find(ticket);
  if (found == waiting_.end())
    throw Refused("no request with ticket " + std::to_string(ticket) + " waits: it is answered, or was too late");
  const Waiting& asked = found->second;
  host::NcAnswer answer{.outcome = outcomeOf(request)};
  if (answer.outcome == Outcome::Done && !asked.operation.write)
    answer.value = realOf(request.value("value", json()), "value");
  plc_.answer(plc_.translation().replyOf(asked.request, answer));
  waiting_.erase(found);
  return json::object();
}

// The provider of the waiting requests has disconnected.
void Services::gone(const Peer& peer) {
  if (peer.number == provider_) lose("the connection has ended");
}

void Services::lose(const std::string& why) {
  provider_ = 0;
  isLost_ = true;
  reports_.push_back("the program is no longer served: " + why);
  host::Live& live = plc_.live();
  live.served.store(false, std::memory_order_release);
  live.known.store(false, std::memory_order_release);
  for (const auto& [ticket, waiting] : waiting_) refuse(ticket);
  waiting_.clear();
}

void Services::work(Sink& sink) {
  if (provider_ != 0) checkService(sink);
  refuseLate();
  rung_request request{};
  for (int i = 0; i < turn::kMostServices && plc_.nextRequest(request); ++i) pass(sink, request);
}

// Informs a provider that no longer serves before anything moves again.
void Services::checkService(Sink& sink) {
  const int64_t silentNs = plc_.clock().nowNs() - heardNs_;
  if (!plc_.live().served.load(std::memory_order_acquire)) { // waiting requests are from an earlier run
    sink.send(std::exchange(provider_, 0), {{"event", "unserved"}});
    plc_.live().known.store(false, std::memory_order_release);
    waiting_.clear();
  } else if (aliveNs_ != 0 && silentNs > aliveNs_) {
    sink.send(provider_, {{"event", "unserved"}});
    lose("the client was silent for " + std::to_string(silentNs / 1'000'000) + " ms");
  }
}

void Services::pass(Sink& sink, const rung_request& request) {
  rung_reply refusal{.size = sizeof refusal, .ticket = request.ticket, .error = 1};
  const std::optional<host::Operation> operation = plc_.translation().operationOf(request, refusal);
  if (!operation) {
    plc_.answer(refusal);
    return;
  }
  if (!plc_.live().served.load(std::memory_order_relaxed))
    return refuse(request.ticket); // the provider has disconnected since the request
  const int64_t now = plc_.clock().nowNs();
  const int64_t end = now + std::chrono::nanoseconds(kPatience).count();
  waiting_[request.ticket] = {request, *operation, now,
                              operation->untilOver ? std::numeric_limits<int64_t>::max() : end};
  json event = jsonOf(request.ticket, *operation);
  event["event"] = "service";
  sink.send(provider_, event);
}

void Services::refuseLate() {
  const int64_t now = plc_.clock().nowNs();
  std::erase_if(waiting_, [&](const auto& entry) {
    const bool late = entry.second.endNs <= now;
    if (late) refuse(entry.first);
    return late;
  });
}

// The same answer as without a provider (rtlib/nc/control/control.h).
void Services::refuse(uint32_t ticket) { plc_.answer({.size = sizeof(rung_reply), .ticket = ticket, .error = 1}); }

} // namespace rung::control

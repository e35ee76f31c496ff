// See device_report.h.
#include "machine/io/device_report.h"

#include <algorithm>
#include <utility>

#include "rtlib/run/realtime.h"

namespace rung::io {
namespace {

constexpr int64_t kBetweenNs = 1'000'000'000;

std::string channelName(uint32_t channel) { return "CAN channel " + std::to_string(channel); }

std::string sentenceOf(BusState state) {
  switch (state) {
  case BusState::Inactive: return " is not there";
  case BusState::Active: return " works again";
  case BusState::BusOff: return " is off the bus after too many errors; restart the interface (ip link)";
  case BusState::Down: return ": its interface is not there, or switched off; it is opened when it comes";
  }
  return {};
}

} // namespace

std::vector<std::string> DeviceReport::next() {
  std::vector<std::string> lines;
  states(lines);
  orders(lines);
  ports(lines);
  const int64_t now = runtime::monotonicNs();
  messages(lines, now);
  if (now >= nextLossesNs_) {
    nextLossesNs_ = now + kBetweenNs;
    losses(lines);
  }
  if (std::string problem = devices_.tables.takeProblem(); !problem.empty())
    lines.push_back("a PLC table is not stored: " + problem);
  if (devices_.areasBroken && !std::exchange(areasReported_, true))
    lines.emplace_back("the file of the shared areas was written over or shortened; SA_READ and SA_WRITE give error 3");
  devices_.axes.report(lines);
  return lines;
}

void DeviceReport::states(std::vector<std::string>& lines) {
  for (uint32_t channel = 1; channel <= channels_.size(); ++channel) {
    const SocketCan* port = devices_.can.port(channel);
    if (port == nullptr) continue;
    const BusState now = port->state();
    if (now != std::exchange(channels_[channel - 1].state, now))
      lines.push_back(channelName(channel) + sentenceOf(now));
  }
}

void DeviceReport::orders(std::vector<std::string>& lines) {
  for (EndedOrder order; devices_.can.takeEnded(order);) lines.push_back(textOf(order));
}

template <class Message>
void DeviceReport::say(const Message& message, Said<Message>& said, int64_t now, std::vector<std::string>& lines) {
  if (message == said.message && now < said.untilNs) return;
  said = {.message = message, .untilNs = now + kBetweenNs};
  lines.push_back(textOf(message));
}

void DeviceReport::messages(std::vector<std::string>& lines, int64_t now) {
  for (DriveMessage message; devices_.can.takeMessage(message);)
    say(message, saidOfDrives_[message.drive - 1u], now, lines);
  for (UnitMessage message; devices_.can.takeMessage(message);)
    say(message, saidOfUnits_[message.group - 1u][message.board - 1u], now, lines);
}

void DeviceReport::losses(std::vector<std::string>& lines) {
  for (uint32_t channel = 1; channel <= channels_.size(); ++channel) {
    const SocketCan* port = devices_.can.port(channel);
    if (port == nullptr) continue;
    const SocketCan::Counts counts = port->counts();
    const uint64_t lost = counts.lost - std::exchange(channels_[channel - 1].lost, counts.lost);
    const bool isFull = counts.full != std::exchange(channels_[channel - 1].full, counts.full);
    const bool wasFull = std::exchange(channels_[channel - 1].isFull, isFull);
    const bool isUnheard = counts.timeouts != std::exchange(channels_[channel - 1].timeouts, counts.timeouts);
    const bool wasUnheard = std::exchange(channels_[channel - 1].isUnheard, isUnheard);
    if (lost > 0)
      lines.push_back(channelName(channel) + ": " + std::to_string(lost) +
                      " packets were lost, because they came too fast");
    if (isFull && !wasFull)
      lines.push_back(channelName(channel) + ": the queue of the interface is full, packets wait");
    if (isUnheard && !wasUnheard)
      lines.push_back(channelName(channel) + ": no device acknowledges packets; check connection, power and bit rate");
  }
  for (uint32_t port = 0; port < portLosses_.size(); ++port) {
    const uint32_t now = devices_.ports[port].lostBytes();
    const uint32_t lost = now - std::exchange(portLosses_[port], now);
    if (lost > 0)
      lines.push_back("the serial port " + std::to_string(port) + ": " + std::to_string(lost) +
                      " bytes were lost, because the program does not read them");
  }
}

// Reports problems of serial lines when they begin and when they end.
void DeviceReport::ports(std::vector<std::string>& lines) {
  std::vector<std::string> now = tty_.problems();
  for (const std::string& problem : now)
    if (std::ranges::find(portProblems_, problem) == portProblems_.end()) lines.push_back(problem);
  for (const std::string& former : portProblems_)
    if (std::ranges::find(now, former) == now.end())
      lines.push_back(former.substr(0, former.find(' ')) + " works again");
  portProblems_ = std::move(now);
}

} // namespace rung::io

// A host's socket as rungctl uses it: a request and its answer, and what the host sends by itself.
#pragma once
#include <chrono>
#include <deque>
#include <iosfwd>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "machine/control/server.h"

namespace rung::rungctl {

// A host, and the connection with it.
struct Reached {
  std::string host;
  control::Connection connection;
};

class Client {
public:
  // The host of this name, or the only one where it is empty. Throws std::runtime_error: there is no host, or not this
  // one, or it speaks another protocol.
  explicit Client(const std::string& host);

  const nlohmann::json& greeting() const { return greeting_; }
  static constexpr std::chrono::seconds kAnswer{15};
  // Waits for the answer. Throws std::runtime_error where the host has gone, or a signal ends the wait.
  nlohmann::json ask(const nlohmann::json& request, std::chrono::milliseconds patience = kAnswer);
  // The next event; waits for it, until `stop` is not 0. Throws std::runtime_error where the host has ended.
  std::optional<nlohmann::json> event(const volatile int& stop);
  // The same within that time.
  std::optional<nlohmann::json> event(std::chrono::milliseconds patience);

  // For lines that are passed on as they are.
  control::Connection& connection() { return connection_; }

private:
  explicit Client(Reached reached);
  std::optional<nlohmann::json> next(std::chrono::milliseconds wait);

  std::string host_;
  control::Connection connection_;
  nlohmann::json greeting_;
  std::deque<nlohmann::json> events_;
  bool interrupted_ = false; // the last wait, by a signal
};

// Lines of the protocol between another program and a host, as they are.

// From `in` to the host and from the host to `out`, until one of them ends or `stop` is not 0. Throws
// std::runtime_error where a line is longer than a request may be.
void relay(control::Connection& host, int in, std::ostream& out, const volatile int& stop);

} // namespace rung::rungctl

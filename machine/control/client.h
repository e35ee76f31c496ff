// The connection of a client to a host's socket: requests with their answers, and events.
#pragma once
#include <chrono>
#include <deque>
#include <iosfwd>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "machine/control/server.h"

namespace rung::control {

// A connection to a host.
struct Reached {
  std::string host;
  Connection connection;
};

class Client {
public:
  static constexpr std::chrono::seconds kAnswer{15};
  // Connects to the host with this name, or to the only host if the name is empty. Throws std::runtime_error if there
  // is no host, not this one, or more than one, if it uses another protocol, or if it does not answer for that long.
  explicit Client(const std::string& host, std::chrono::milliseconds patience = kAnswer);

  const nlohmann::json& greeting() const { return greeting_; }
  const std::string& host() const { return host_; }
  // Sends a request and waits for the answer. Throws std::runtime_error if the host has ended, or a signal ends the
  // wait.
  nlohmann::json ask(const nlohmann::json& request, std::chrono::milliseconds patience = kAnswer);
  // Waits for the next event, until `stop` is not 0. Throws std::runtime_error if the host has ended.
  std::optional<nlohmann::json> event(const volatile int& stop);
  // The same, for at most that time.
  std::optional<nlohmann::json> event(std::chrono::milliseconds patience);

  // For lines that are passed on unchanged.
  Connection& connection() { return connection_; }

private:
  Client(Reached reached, std::chrono::milliseconds patience);
  std::optional<nlohmann::json> next(std::chrono::milliseconds wait);

  std::string host_;
  Connection connection_;
  nlohmann::json greeting_;
  std::deque<nlohmann::json> events_;
  bool interrupted_ = false; // a signal ended the last wait
};

// Sends a request and returns the answer; throws std::runtime_error with the host's sentence if the answer is not ok.
nlohmann::json asked(Client& client, const nlohmann::json& request,
                     std::chrono::milliseconds patience = Client::kAnswer);

// Lets the host compile sources (compile::packed), which `reload` and `shadow` then use. The answer of `compiled`: its
// `state` is not "compiling", unless `stop` has become other than 0.
nlohmann::json compiledByHost(Client& client, const std::string& packed, const volatile int& stop);
// A sentence about the state of the program after a reload or a rollback. `program`: "new", "former".
std::string whetherItRuns(const nlohmann::json& answer, const char* program);

// A value for `set` and `force`, which is written as in scenarios; what JSON cannot represent stays a text, which the
// host accepts or refuses.
nlohmann::json writtenValue(const std::string& text);

// Relay of protocol lines between another program and a host.

// Passes lines from `in` to the host and from the host to `out`, until one of them ends or `stop` is not 0. Throws
// std::runtime_error if a line exceeds the length of a request.
void relay(Connection& host, int in, std::ostream& out, const volatile int& stop);

} // namespace rung::control

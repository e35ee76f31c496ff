// The connection of the page to the host of a machine: what state it is in, what people and the host have done, and
// what pages want written. A thread of its own asks, and connects again when the host was away.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ir/support/result.h"
#include "machine/control/client.h"
#include "tools/web/source.h"

namespace rung::web {

struct HostState {
  bool reached = false;
  std::string problem;  // why not; or why nothing is recorded
  std::string folder;   // of its recording
  bool stopped = false; // by the operator
  std::string fault;    // that has stopped the program
  std::string mayWrite; // "" or why not
  bool operator==(const HostState&) const = default;
};

// An entry of the host's log that no recording has.
struct HostEntry {
  int64_t wallUs = 0; // since 1970
  std::string kind, text;
};

class HostLink {
public:
  // `files`: the sources of its program, for `reload`; none: those that the program names.
  HostLink(std::string host, std::vector<std::string> files);
  ~HostLink();
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;

  // Any thread.
  HostState state();
  // Those since the last call.
  std::vector<HostEntry> takeEntries();
  // Waits for the answer of the host. What was done, in words.
  Result<std::string> write(const Order& order);

private:
  void run();
  void serve();
  void ask(control::Client& client);
  void takeLog(const nlohmann::json& entry);
  void lost(const std::string& why);
  Result<std::string> reload(control::Client& client) const;

  const std::string host_;
  const std::vector<std::string> files_;

  std::mutex mutex_; // of what follows
  std::condition_variable wake_;
  bool ends_ = false;
  HostState state_;
  std::vector<HostEntry> entries_;
  std::pair<int64_t, uint64_t> lastEntry_{0, 0}; // of the log: seconds and number

  std::mutex writing_; // of `writer_`
  std::unique_ptr<control::Client> writer_;

  std::thread thread_;
};

} // namespace rung::web

// What rungctl top knows of a host: the answers of one moment, and what has changed since the one before.
#pragma once
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/client.h"

namespace rung::rungctl {

using control::Client;

struct Look {
  struct Pin {
    std::string name;
    std::string value;
    std::string former;  // before its last change
    std::string uses;    // what of the program it is
    double changedS = 0; // seconds since its last change was seen; less than 0: none was
    uint64_t changes = 0;
  };
  nlohmann::json status;
  nlohmann::json profile;                         // null: the program does not count its rungs, or they are not wanted
  std::vector<nlohmann::json> timers;             // that run
  std::vector<nlohmann::json> messages;           // that are on, the oldest first
  std::optional<std::vector<nlohmann::json>> log; // the newest last; nothing: it was never asked for
  std::vector<Pin> pins;                          // in the order of the mapping file
};

// Asks a host again and again.
class Observer {
public:
  static constexpr unsigned kMostRungs = 200;
  static constexpr std::chrono::seconds kPatience{3}; // for each answer

  struct Wanted {
    std::string rungsBy = "time"; // or "longest"
    bool log = true;
  };
  // Asks for what is wanted; what is not stays. Throws std::runtime_error if the host does not answer.
  void look(Client& client, const Wanted& wanted, Look& look);

private:
  using Clock = std::chrono::steady_clock;
  struct Seen {
    std::string value;
    std::string former;
    Clock::time_point changed;
    uint64_t changes = 0;
  };
  std::vector<Look::Pin> pinsOf(const nlohmann::json& map, Clock::time_point now);

  std::map<std::string, Seen> pins_; // by name
};

} // namespace rung::rungctl

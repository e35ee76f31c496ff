// What rungctl top knows of a host: the answers of one moment, and what has changed since the one before.
#pragma once
#include <chrono>
#include <map>
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
  nlohmann::json profile;               // null: the program does not count its rungs, or they are not wanted
  std::vector<nlohmann::json> messages; // that are on, the oldest first
  std::vector<nlohmann::json> log;      // the newest last
  std::vector<Pin> pins;                // in the order of the mapping file
};

// Asks a host again and again.
class Observer {
public:
  static constexpr unsigned kMostRungs = 200;
  static constexpr std::chrono::seconds kPatience{3}; // for each answer

  // Throws std::runtime_error if the host does not answer. `by`: how rungs are sorted, "time" or "longest".
  Look look(Client& client, const std::string& by);

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

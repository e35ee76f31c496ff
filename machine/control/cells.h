// Cells of the program that runs, by their names: looked up, read, watched, and written where that has an effect.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "machine/control/plc_access.h"
#include "machine/control/server.h"

namespace rung::control {

// For the thread that serves the plc. What cannot be done throws Refused.
class Cells {
public:
  explicit Cells(PlcAccess& plc);
  ~Cells();
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;

  // Answers of docs/control-protocol.md.
  nlohmann::json get(const Peer& peer, const nlohmann::json& request);
  nlohmann::json watch(const Peer& peer, const nlohmann::json& request);
  nlohmann::json set(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // What has changed, to those who watch.
  void sendValues(Sink& sink);

  // The names of a program that runs from now on, for those who mistype one; those of the program before stay known, as
  // it may come back.
  void learnSymbols(const rung_program& program);
  // `access`: enum rung_access.
  rung_cell_info describe(const std::string& name, int32_t access) const;
  // By where the names are in the program that runs: a reload may have moved them.
  void refuseProtected(const std::string& name) const;

private:
  struct Found;
  struct Watching;
  struct Range { // of bits of a space
    uint32_t space = 0;
    uint64_t first = 0;
    uint64_t count = 0;
    bool meets(const Range& other) const {
      return space == other.space && first < other.first + other.count && other.first < first + count;
    }
    bool covers(const Range& other) const {
      return space == other.space && first <= other.first && other.first + other.count <= first + count;
    }
  };
  enum class Share : uint8_t { None, Part, All };

  Found find(const std::vector<std::string>& names, int32_t access) const;
  std::string meantBy(const std::string& name) const;
  std::string whyNoScanEnds();
  std::vector<Range> rangesOf(const std::string& name) const;
  Share shareOf(const std::string& name, const std::vector<Range>& wanted) const;
  std::string writerOf(const host::PlcHost::Feed& feed, const std::vector<Range>& wanted) const;
  std::string refuseWithoutEffect(const std::string& name);

  PlcAccess& plc_;
  std::vector<std::string> symbols_, formerSymbols_;       // of the last program, and of the one before
  std::map<uint32_t, std::unique_ptr<Watching>> watching_; // by peer
};

} // namespace rung::control

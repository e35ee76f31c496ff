// Cells of the running program by name: looks them up, reads them, watches them, and writes those whose new value has
// an effect.
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

// Service thread. Throws Refused for requests that cannot be executed.
class Cells {
public:
  explicit Cells(PlcAccess& plc);
  ~Cells();
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;

  // Requests of docs/control-protocol.md.
  nlohmann::json get(const Peer& peer, const nlohmann::json& request);
  nlohmann::json watch(const Peer& peer, const nlohmann::json& request);
  nlohmann::json set(const Peer& peer, const nlohmann::json& request);

  void gone(const Peer& peer);
  // Sends changed values to the clients that watch them.
  void sendValues(Sink& sink);

  // Learns the names of a program that runs from now on, for suggestions when a client mistypes one, and the bits that
  // its rungs write; the names of the previous program stay known, as a rollback may bring it back.
  void learn(const rung_program& program);
  // `access`: enum rung_access.
  rung_cell_info describe(const std::string& name, int32_t access) const;
  // Throws Refused if the cell shares bits with a protected cell of the running program: a reload may have moved
  // either.
  void refuseProtected(const std::string& name) const;

private:
  struct Found;
  struct Watching;
  struct Range { // bits of a space
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
  std::string noteOfRungs(const std::string& name) const;

  PlcAccess& plc_;
  std::vector<std::string> symbols_, formerSymbols_;       // of the running program, of the previous one
  std::vector<std::vector<uint8_t>> written_;              // masks of the bits that rungs write, by space and byte
  std::map<uint32_t, std::unique_ptr<Watching>> watching_; // by peer
};

} // namespace rung::control

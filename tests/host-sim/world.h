// A host without a machine: its program between pins, the thread that scans it, the one that serves it, its clients and
// its disk, on a clock that passes when one of them waits. Whatever happens, happens in the order of its calls.
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/controller.h"
#include "machine/control/log.h"
#include "machine/host/plc_host.h"
#include "machine/io/connections/connections.h"
#include "rtlib/load/file.h"
#include "rtlib/run/clock.h"
#include "tests/host-sim/programs.h"
#include "tests/host-sim/recorded.h"

namespace rung::host_sim {

// Files in memory. A write that fails leaves the file that was there.
class MemoryDisk final : public runtime::Disk {
public:
  bool read(const std::string& path, size_t most, std::string& bytes, std::string& problem) override;
  bool replace(const std::string& path, std::span<const uint8_t> bytes, std::string& error) override;
  std::unique_ptr<Lock> lock(const std::string& path, bool& made, std::string& error) override;

  bool full = false;
  bool torn = false; // the next file does not get there

private:
  class Held;
  std::map<std::string, std::string> files_;
  std::map<std::string, bool> locked_;
};

// What the clients get.
class Clients final : public control::Sink {
public:
  void send(uint32_t peer, const nlohmann::json& event) override { events[peer].push_back(event); }
  void answer(uint32_t peer, const nlohmann::json& answer) override { answers[peer].push_back(answer); }
  std::map<uint32_t, std::deque<nlohmann::json>> events, answers;
};

class World final : public runtime::Clock {
public:
  explicit World(const Programs& programs);
  ~World() override;

  // ---- clock: the scan thread runs while somebody waits
  int64_t nowNs() noexcept override { return nowNs_; }
  int64_t dateNs() noexcept override { return kBegin * 1'000'000'000 + nowNs_; }
  void sleep(int64_t ns) override { pass(ns); }

  // ---- what may happen
  bool isOn() const { return host_ != nullptr; }
  void switchOn();  // the host starts
  void switchOff(); // and ends regularly
  // What the serving thread and a client have made of the last end.
  struct End {
    bool ranAgain = false;
    int64_t tookNs = 0; // until the client had its answer
    bool saysSo = false;
  } lastEnd;
  void cutPower(); // it is gone at this moment
  void pass(int64_t ns);
  void turn(); // of the thread that serves
  void lookForSaving();
  // The end: what was recorded is played. Returns what went otherwise, or "".
  std::string finish();
  nlohmann::json ask(uint32_t peer, const nlohmann::json& request);
  void leave(uint32_t peer);
  void setPin(const std::string& name, bool value);
  // The other side of the connection: while it is there, FAR comes with each scan.
  struct Far {
    bool isThere = false;
    bool value = false;
    int64_t heardNs = -1; // never
    bool lamp = false;    // that it has been told of last
  } far;
  static constexpr int64_t kFarTimeoutNs = 101'000'000;
  bool pin(const std::string& name) const; // of a host that has ended: what it was then

  bool scans = true;  // the scan thread runs
  bool reset = false; // the pin
  MemoryDisk disk;
  Clients clients;
  host::PlcHost& host() { return *host_; }
  rung_instance* instance() { return host_->instance(); }
  // Of the program, whatever its state.
  int64_t cell(const std::string& name) const;
  // What has become of the program, in the order in which it has.
  struct Change {
    enum class Kind : uint8_t { Replaced, Fault, Restart };
    Kind kind = Kind::Replaced;
    uint64_t wholeScans = 0; // before it
    int64_t scans = 0;       // what SCANS was then
    uint32_t number = 0;     // of the program that ran
  };
  std::vector<Change> changes; // since somebody emptied it
  uint64_t steps = 0;
  int64_t lastStepNs = 0;
  uint64_t wholeScans = 0; // of the program, since the host was switched on first
  std::vector<std::string> log;

  static constexpr int64_t kPeriodNs = 8'000'000;

private:
  static constexpr int64_t kBegin = 1'800'000'000; // a date
  union Value {
    bool bit;
    double real = 0;
  };
  void step();
  void writeRequest();
  void tellFar();
  void noteChanges(uint64_t scansBefore, int64_t cellBefore);
  size_t numberOf(const std::string& pin) const;
  control::Peer peerOf(uint32_t number) const;

  const Programs& programs_;
  Recorded recorded_{programs_};
  int64_t nowNs_ = 1'000'000'000;
  int64_t dueNs_ = 0;
  std::vector<std::string> pins_; // their names
  std::vector<Value> values_;     // of each
  std::vector<host::PinCell> cells_;
  uint32_t number_ = 0; // of the program that ran last
  uint32_t faulted_ = 0;
  bool ran_ = false;
  std::optional<Image> image_;
  std::unique_ptr<host::PlcHost> host_;
  std::unique_ptr<io::Exchange> exchange_;
  std::unique_ptr<control::Log> log_;
  std::unique_ptr<control::Controller> controller_;
};

} // namespace rung::host_sim

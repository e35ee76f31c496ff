// What rungctl may ask of a program that runs between the pins of a host: docs/control-protocol.md lists it.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine/control/compile_service.h"
#include "machine/control/history.h"
#include "machine/control/log.h"
#include "machine/control/programs.h"
#include "machine/control/server.h"
#include "machine/control/services.h"
#include "machine/host/plc_host.h"
#include "rung/runtime.hpp"

namespace rung::control {

// For the thread that serves the plc; orders go to the scan thread, which it waits for.
class Controller final : public Handler {
public:
  static constexpr int kProtocol = 1;

  // `image` is what the host began with. `log`, which outlives this, gets what the program and its host report, and
  // every change that somebody has made.
  Controller(std::string host, host::PlcHost& plc, const Image& image, Log& log,
             std::unique_ptr<Programs> programs = programsOfMachine());
  ~Controller() override; // before the plc
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  // Messages are kept in this file, too. Before the first turn.
  void keepHistory(const std::string& path) { historyFile_ = std::make_unique<HistoryFile>(history_, path); }
  // What the host adds to its status. Before the first request.
  void addToStatus(std::function<void(nlohmann::json&)> add) { addToStatus_ = std::move(add); }

  // A simulated control around the program: `act` does an event of it, in the scan thread, and says what is wrong.
  // Before the first request.
  using Event = std::function<std::string(const std::string& name, const nlohmann::json& keys)>;
  void setSimulation(Event act) { simulation_ = std::move(act); }

  nlohmann::json greeting() override;
  nlohmann::json answer(const Peer& peer, const nlohmann::json& request) override;
  void gone(const Peer& peer) override;

  // In each turn of the thread, before the requests of clients: what the plc needs from time to time and reports then,
  // and what the program has shown. Each line goes to the log, is kept for those who ask later, and is sent to those
  // who follow. `sink`: null where there are no clients.
  void serveProgram(Sink* sink);
  // After them: sends what has changed to those who watch, the program's questions to the client that serves it, and
  // the answer to each client whose force is done; compares what a shadow has recorded, for a part of a turn.
  void serveClients(Sink& sink);

private:
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
  struct Row {
    const char* name = nullptr;
    std::optional<host::Remote> permission; // that the mapping file must give
    nlohmann::json (Controller::*run)(const Peer&, const nlohmann::json&) = nullptr;
  };
  static const Row kRows[];

  nlohmann::json status(const Peer& peer, const nlohmann::json& request);
  nlohmann::json messages(const Peer& peer, const nlohmann::json& request);
  nlohmann::json watch(const Peer& peer, const nlohmann::json& request);
  nlohmann::json get(const Peer& peer, const nlohmann::json& request);
  nlohmann::json set(const Peer& peer, const nlohmann::json& request);
  nlohmann::json force(const Peer& peer, const nlohmann::json& request);
  nlohmann::json unforce(const Peer& peer, const nlohmann::json& request);
  nlohmann::json forced(const Peer& peer, const nlohmann::json& request);
  nlohmann::json sources(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compiled(const Peer& peer, const nlohmann::json& request);
  nlohmann::json reload(const Peer& peer, const nlohmann::json& request);
  nlohmann::json shadow(const Peer& peer, const nlohmann::json& request);
  nlohmann::json compared(const Peer& peer, const nlohmann::json& request);
  nlohmann::json rollback(const Peer& peer, const nlohmann::json& request);
  nlohmann::json stop(const Peer& peer, const nlohmann::json& request);
  nlohmann::json start(const Peer& peer, const nlohmann::json& request);
  nlohmann::json reset(const Peer& peer, const nlohmann::json& request);
  nlohmann::json map(const Peer& peer, const nlohmann::json& request);
  nlohmann::json event(const Peer& peer, const nlohmann::json& request);
  nlohmann::json profile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json clearProfile(const Peer& peer, const nlohmann::json& request);
  nlohmann::json serve(const Peer& peer, const nlohmann::json& request);
  nlohmann::json live(const Peer& peer, const nlohmann::json& request);
  nlohmann::json served(const Peer& peer, const nlohmann::json& request);

  struct FoundCells;
  rung_cell_info describe(const std::string& name, int32_t access) const;
  FoundCells find(const std::vector<std::string>& names, int32_t access) const;
  std::string meantBy(const std::string& name) const;
  void learnSymbols(const rung_program& program);
  std::vector<Range> rangesOf(const std::string& name) const;
  void refuseProtected(const std::string& name) const;
  std::string refuseWithoutEffect(const std::string& name);
  std::string writerOf(const host::PlcHost::Feed& feed, const std::vector<Range>& wanted) const;
  std::string whyNoScanEnds();
  std::vector<host::Value> pinValues();
  std::string endedForces();
  std::optional<rung_state> stateNow();
  void finishShadow(nlohmann::json report);
  void waitForPass(uint64_t passes);
  Share shareOf(const std::string& name, const std::vector<Range>& wanted) const;
  host::Command give(host::Command order, std::chrono::milliseconds time = host::PlcHost::kPatience);
  struct NextProgram { // that a request names
    std::optional<Image> opened;
    const Image* image = nullptr;
    std::string text; // for people
    const Image& get() const { return opened ? *opened : *image; }
  };
  NextProgram nextProgram(const Peer& peer, const nlohmann::json& request);
  struct HeldCell;
  struct ForceChange;
  std::vector<rung_force_info> forcesInEffect();
  std::vector<HeldCell> heldCells();
  void refuseWhilePending() const;
  rung_program_info running() const;
  nlohmann::json putInPlace(rung_replacement* replacement, const std::vector<rung_cell>& dead, nlohmann::json report,
                            const char* why);
  struct EndForces {
    void operator()(rung_forces* forces) const noexcept { rung_forces_free(forces); }
  };
  using Forces = std::unique_ptr<rung_forces, EndForces>;
  std::optional<Forces> prepared(const ForceChange& change);
  void putInEffect(const ForceChange& change, Forces forces);
  nlohmann::json begin(ForceChange change);
  void refusePending(const std::string& why);
  void passMessages(Sink* sink);
  void pass(const rung_message_info& message, Sink* sink);
  void tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged);
  void keepHistory(Sink* sink);
  void sendValues(Sink& sink);
  void compareShadow();
  void finishPending(Sink& sink);
  void endShadow();
  nlohmann::json shadowReport();
  void report(const std::string& text, Sink* sink);
  nlohmann::json simple(host::Command::Kind kind, const Peer& peer, const char* what);
  void logChange(const Peer& peer, const std::string& text);

  std::string host_;
  host::PlcHost& plc_;
  Services services_;
  std::string dialect_;
  std::vector<std::string> symbols_, formerSymbols_; // of the last program that was given, and of the one before
  Log& log_;
  std::function<void(nlohmann::json&)> addToStatus_;
  Event simulation_;                   // empty: there is none
  std::vector<std::string> heldNames_; // cells that are forced, as far as this thread has heard
  History history_;
  std::unique_ptr<HistoryFile> historyFile_;               // null: it is in memory alone
  uint32_t restarts_ = 0;                                  // of the plc, when messages were noted
  std::map<uint32_t, std::unique_ptr<Watching>> watching_; // by peer
  std::vector<uint32_t> following_;                        // messages
  CompileService compiler_;
  std::unique_ptr<Programs> programs_;
  std::unique_ptr<ForceChange> pending_; // for whose code the compiler is at work
  Forces forces_;
  struct EndShadow {
    void operator()(rung_shadow* shadow) const noexcept { rung_shadow_free(shadow); }
  };
  std::unique_ptr<rung_shadow, EndShadow> shadow_;
  uint32_t shadowsFor_ = 0; // the peer that has begun the last one
  nlohmann::json compared_; // of the last one, once it is over; null before
  struct EndReplacement {
    void operator()(rung_replacement* replacement) const noexcept { rung_replacement_free(replacement); }
  };
  std::unique_ptr<rung_replacement, EndReplacement> replacement_; // the last reload
};

} // namespace rung::control

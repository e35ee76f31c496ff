// What rungctl may ask of a program that runs between the pins of a host: docs/control-protocol.md lists it.
#pragma once
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "rung/runtime.hpp"
#include "tools/plc/box.h"
#include "tools/remote/server.h"
#include "tools/remote/services.h"
#include "tools/remote/source_desk.h"
#include "tools/sources/forced_code_maker.h"

namespace rung::remote {

// For the thread that serves the box; orders go to the scan thread, which it waits for.
class Controller final : public Handler {
public:
  static constexpr int kProtocol = 1;

  // `image` is what the box began with. `log` takes a line for every change that somebody has made.
  Controller(std::string host, plc::Box& box, const Image& image, std::function<void(const std::string&)> log);
  ~Controller() override; // before the box
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  // What the host adds to its status. Before the first request.
  void addToStatus(std::function<void(nlohmann::json&)> add) { addToStatus_ = std::move(add); }

  // A simulated control around the program: `act` does an event of it, in the scan thread, and says what is wrong.
  // Before the first request.
  using Event = std::function<std::string(const std::string& name, const nlohmann::json& keys)>;
  void setSimulation(Event act) { simulation_ = std::move(act); }

  nlohmann::json greeting() override;
  nlohmann::json answer(const Peer& peer, const nlohmann::json& request) override;
  void gone(const Peer& peer) override;

  // What the box needs from time to time and reports then, and what the program has shown: each line goes to `print`,
  // is kept for those who ask later, and is sent to those who follow. `server` may be null. True: there was a report.
  using Print = std::function<void(const std::string&)>;
  bool serveBox(Server* server, const Print& print);
  void passMessages(Server* server, const Print& print);
  // Sends what has changed to those who watch, what the program asks to whoever serves it, and the answer to whoever
  // waits for their force.
  void sendEvents(Server& server);
  // Compares what a shadow has recorded, for a part of a turn.
  void work();

private:
  struct Watching;
  struct Range { // of bits of a space
    uint32_t space = 0;
    uint64_t first = 0;
    uint64_t count = 0;
  };
  struct Command {
    const char* name = nullptr;
    std::optional<mapping::Remote> permission; // that the mapping file must give
    nlohmann::json (Controller::*run)(const Peer&, const nlohmann::json&) = nullptr;
  };
  static const Command kCommands[];

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

  struct Found {
    rung_cell cell = 0;
    rung_cell_info info{};
  };
  struct FoundCells {
    std::vector<rung_cell> cells;
    std::vector<rung_cell_info> infos;
  };
  Found find(const std::string& name, int32_t access) const;
  FoundCells findAll(const std::vector<std::string>& names) const;
  std::vector<Range> rangesOf(const std::string& name) const;
  void refuseProtected(const std::string& name) const;
  plc::Order give(plc::Order order, std::chrono::milliseconds time = plc::Box::kPatience);
  struct NextProgram { // that a request names
    std::optional<Image> opened;
    const Image* image = nullptr;
    std::string text; // for people
    const Image& get() const { return opened ? *opened : *image; }
  };
  NextProgram nextProgram(const Peer& peer, const nlohmann::json& request) const;
  struct HeldCell;
  struct ForceChange;
  std::vector<rung_force_info> forcesInEffect();
  std::vector<HeldCell> heldCells();
  void refuseWhilePending() const;
  struct EndForces {
    void operator()(rung_forces* forces) const noexcept { rung_forces_free(forces); }
  };
  using Forces = std::unique_ptr<rung_forces, EndForces>;
  std::optional<Forces> prepared(const ForceChange& change);
  void putInEffect(const ForceChange& change, Forces forces);
  nlohmann::json begin(ForceChange change);
  void refusePending(const std::string& why);
  void finishPending(Server& server);
  void endShadow();
  // `logged`: for the log alone, not for the operator.
  void report(const std::string& text, Server* server, bool logged = false);
  nlohmann::json simple(plc::Order::Kind kind, const Peer& peer, const char* what);
  void logChange(const Peer& peer, const std::string& text);

  std::string host_;
  plc::Box& box_;
  Services services_;
  std::string program_; // the name of the one that runs
  std::string former_;  // of the one that `rollback` puts back
  std::string dialect_;
  std::function<void(const std::string&)> log_;
  std::function<void(nlohmann::json&)> addToStatus_;
  Event simulation_; // empty: there is none
  std::deque<std::string> reports_;
  std::map<uint32_t, std::unique_ptr<Watching>> watching_; // by peer
  std::vector<uint32_t> following_;                        // messages
  SourceDesk desk_;
  std::shared_ptr<sources::ForcedCodeMaker> codeMaker_;
  std::unique_ptr<ForceChange> pending_; // for whose code the compiler is at work
  Forces forces_;
  struct EndShadow {
    void operator()(rung_shadow* shadow) const noexcept { rung_shadow_free(shadow); }
  };
  std::unique_ptr<rung_shadow, EndShadow> shadow_;
  struct EndReplacement {
    void operator()(rung_replacement* replacement) const noexcept { rung_replacement_free(replacement); }
  };
  std::unique_ptr<rung_replacement, EndReplacement> replacement_; // has put program_ in the place of former_
};

} // namespace rung::remote

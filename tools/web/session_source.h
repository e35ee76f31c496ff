// A program on the interpreter in this process, with its simulated machine, as what the page shows.
#pragma once
#include <algorithm>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "tools/replay/flow.h"
#include "tools/replay/session_past.h"
#include "tools/scenario/session.h"
#include "tools/web/paced_source.h"

namespace rung::web {

// Before the session's start: its forces need no code of their own from then on, since every access of its rungs is
// observed; by this function until there is a SessionSource. The session's only engine is that of `engine`.
void observeForces(scenario::Session& session, replay::FlowEngine& engine);

class SessionSource final : public PacedSource {
public:
  // All arguments must outlive it. The session has started; observeForces was called with both.
  SessionSource(scenario::Session& session, replay::SessionPast& past, const Drawn& drawn, replay::FlowEngine& engine);

  bool isLive() const override { return true; }
  std::string mayWrite() const override { return {}; }

private:
  // A snapshot of the session.
  struct Moment {
    uint64_t scan = 0;
    int64_t us = 0;
    size_t statements = 0; // how many of done_ had been executed
    std::string name;      // of the snapshot
  };
  // What was done to the program after a scan.
  struct Done {
    uint64_t scan = 0;
    std::string line;
  };

  bool nextScan() override;
  int64_t nowUs() const override { return session_.nowUs(); }
  uint64_t shownScan() const override { return scan_; }
  uint64_t firstScan() const override { return moments_.empty() ? scan_ : std::min(moments_.front().scan + 1, last_); }
  uint64_t lastScan() const override { return last_; }
  const runtime::Instance& instance() const override { return session_.instance(); }
  const sim::SimulatedNc& nc() const override { return session_.nc(); }
  replay::FlowEngine& flowEngine() override { return engine_; }
  const replay::Flow* shownFlow() override { return &engine_.flow(); }
  Result<std::string> seek(uint64_t scan) override;
  std::string valueOf(const std::string& name) const override;
  Result<std::string> carryOut(const Order& order) override;
  Result<Why> explain(const std::string& name) override;
  void fill(Picture& picture, const std::set<std::string>& names) override;

  Result<std::string> write(const std::string& line, const char* kind);
  Result<std::string> step(int64_t scans);
  std::string statement(const std::string& line);
  bool advance();
  void oneScan();
  void repeat();
  void keepMoment();
  void logHere(std::string kind, std::string text) { log(std::move(kind), std::move(text), scan_, nowUs()); }
  std::vector<ForcedCell> forces();

  scenario::Session& session_;
  replay::SessionPast& past_;
  replay::FlowEngine& engine_;
  const Drawn drawn_;
  ElementStates states_;
  const NamePlaces places_;
  uint64_t scan_ = 0;          // the one that is shown
  uint64_t last_ = 0;          // the newest
  std::deque<Moment> moments_; // oldest first
  std::vector<Done> done_;     // oldest first
  size_t nextDone_ = 0;        // of done_: the first that has not been executed at this scan
};

} // namespace rung::web

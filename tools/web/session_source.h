// A program on the interpreter in this process, with its simulated machine, as what the page shows.
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "ir/core/memory_use.h"
#include "tools/scenario/explain.h"
#include "tools/scenario/session.h"
#include "tools/web/flow_observer.h"
#include "tools/web/shown_program.h"
#include "tools/web/source.h"

namespace rung::web {

// The thread that calls run() runs the program; all functions of Source hand over to it.
class SessionSource final : public Source {
public:
  // All arguments must outlive it. The session has started; its first engine is observed by `flow`.
  SessionSource(scenario::Session& session, const scenario::Explainer& explainer, const ShownProgram& program,
                FlowObserver& flow);

  // Runs at the pace of the program's clock until `ended`, which is asked often, returns true.
  void run(const std::function<bool()>& ended);

  std::shared_ptr<const Picture> picture(const std::string& page, const std::vector<std::string>& names, uint64_t after,
                                         std::chrono::milliseconds wait) override;
  Result<std::string> execute(const Order& order) override;
  std::vector<Event> events(uint64_t after) override;
  Result<std::string> why(const std::string& name) override;
  std::string mayWrite() const override { return {}; }

private:
  using Clock = std::chrono::steady_clock;
  struct Follower {
    std::vector<std::string> names;
    Clock::time_point asked;
  };
  // Something for the thread of run() to do.
  struct Task {
    std::function<Result<std::string>()> act;
    std::promise<Result<std::string>> done;
  };
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

  Result<std::string> hand(std::function<Result<std::string>()> act);
  bool takeTasks(std::unique_lock<std::mutex>& lock);
  Result<std::string> carryOut(const Order& order);
  Result<std::string> write(const std::string& line, const char* kind);
  Result<std::string> seek(uint64_t scan);
  std::string statement(const std::string& line);
  void oneScan();
  void repeat();
  void keepMoment();
  void log(std::string kind, std::string text);
  void compareMessages();
  void publish(const std::set<std::string>& names);
  std::set<std::string> followed();
  std::vector<ForcedCell> forces();

  // Of the thread of run().
  scenario::Session& session_;
  const scenario::Explainer& explainer_;
  FlowObserver& flow_;
  std::vector<std::pair<ir::BitRange, uint32_t>> places_; // of the names in the program's lists, NameRow::id
  uint64_t scan_ = 0;                                     // the one that is shown
  uint64_t last_ = 0;                                     // the newest
  std::deque<Moment> moments_;                            // oldest first
  std::vector<Done> done_;                                // oldest first
  size_t nextDone_ = 0;                                   // of done_: the first that has not been executed at this scan
  bool running_ = true;
  bool faulted_ = false;
  std::vector<nc::ShownMessage> messages_;

  std::mutex mutex_;             // protects what follows
  std::condition_variable news_; // for pages: a picture
  std::condition_variable work_; // for run(): tasks, a page that looks at something else
  std::shared_ptr<const Picture> picture_;
  std::map<std::string, Follower> followers_; // by page
  bool stale_ = true;                         // a page follows what the picture does not have
  std::deque<Task> tasks_;
  std::deque<Event> events_;
  uint64_t lastEvent_ = 0;
  bool ended_ = false;
};

} // namespace rung::web

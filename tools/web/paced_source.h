// What sources have in common that run a program, or play one, on a thread of this process: they run at the pace of the
// program's clock, make pictures, and do what pages ask for between two scans.
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ir/core/memory_use.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/run/instance.h"
#include "sim/simulated_nc.h"
#include "tools/replay/condition.h"
#include "tools/web/element_states.h"
#include "tools/web/shown_program.h"
#include "tools/web/source.h"

namespace rung::web {

// The bits of the names in a program's lists.
class NamePlaces {
public:
  // Also sets the contacts whose bits never change. `program` outlives it.
  NamePlaces(const ShownProgram& program, const runtime::Instance& instance, const sim::SimulatedNc& nc,
             ElementStates& states);
  // NameRow::id of the names that have bits of the place.
  std::vector<uint32_t> at(const ir::BitRange& place) const;
  // The named cells that are forced as a whole, without values; names within one are rows of it.
  std::vector<ForcedCell> forced(const runtime::Instance& instance) const;

private:
  struct Named {
    runtime::Ref place;
    ir::BitRange bits;
    const view::NameRow* row = nullptr;
  };
  std::vector<Named> names_; // the widest first
};

class PacedSource : public Source {
public:
  explicit PacedSource(Drawn first) : drawn_(std::move(first)) {}
  // Runs at the pace of the program's clock until `ended`, which is asked often, returns true.
  void run(const std::function<bool()>& ended);

  std::shared_ptr<const Picture> picture(const std::string& page, const std::vector<std::string>& names, uint64_t after,
                                         std::chrono::milliseconds wait) override;
  Drawn drawn() override;
  Result<std::string> execute(const Order& order) override;
  std::vector<Event> events(uint64_t after) override;
  Result<Why> why(const std::string& name) override;
  Result<ScanTrace> trace(const std::vector<std::string>& names, uint64_t scans, uint64_t last) override;
  Result<Shares> shares(uint64_t scans) override;
  Result<std::string> setTrigger(const std::string& condition) override;
  Result<std::string> acknowledge() override;

protected:
  // All of the following are called by the thread of run().

  // Looks for what has come from elsewhere; called again and again, at least after `lookEvery`. Whether there is
  // something new to show.
  virtual bool look() { return false; }
  virtual std::chrono::milliseconds lookEvery() const { return std::chrono::milliseconds(100); }
  // Continues by a scan. False: there is none, and the source pauses.
  virtual bool nextScan() = 0;
  virtual int64_t nowUs() const = 0;
  virtual uint64_t shownScan() const = 0;
  virtual uint64_t firstScan() const = 0; // how far back it can go
  virtual uint64_t lastScan() const = 0;  // the newest one
  virtual const runtime::Instance& instance() const = 0;
  virtual const sim::SimulatedNc& nc() const = 0;
  virtual replay::FlowEngine& flowEngine() = 0;
  virtual const replay::Flow* shownFlow() = 0; // of the scan that is shown; null: none
  // Shows another scan, between the first and the last one.
  virtual Result<std::string> seek(uint64_t scan) = 0;
  virtual std::string valueOf(const std::string& name) const = 0; // "": there is no such name
  virtual Result<std::string> carryOut(const Order& order) = 0;
  virtual Result<Why> explain(const std::string& name) = 0;
  // All but the revision, the number of the last event and the trigger.
  virtual void fill(Picture& picture, const std::set<std::string>& names) = 0;
  // Logs where the condition of the trigger has begun to hold, as far as that is known already.
  virtual void searchPast(replay::Condition& condition, const std::string& text) { (void)condition, (void)text; }

  void log(std::string kind, std::string text, uint64_t scan, int64_t us);
  // Logs which messages have come and gone since the last call. Whether there are any.
  bool compareMessages(const runtime::Instance& instance, const nc::Control& control, uint64_t scan);
  // Logs whether the condition of the trigger has begun to hold in the newest scan, which is shown.
  void checkTrigger();
  // Of the names of conditions.
  Result<runtime::Ref> locate(std::string_view name) const;
  // The forced cells, found by the bits of the program's memory that are held.
  std::vector<ForcedCell> forcedCells(const NamePlaces& places) const;

  bool running_ = true;

private:
  using Clock = std::chrono::steady_clock;
  struct Follower {
    std::vector<std::string> names;
    Clock::time_point asked;
  };
  // Something for the thread of run() to do. It is called with false if the program has ended.
  using Task = std::function<void(bool runs)>;
  template <class T>
  Result<T> hand(std::function<Result<T>()> act);
  template <class Visit>
  std::string visit(uint64_t first, uint64_t last, Visit visitor);
  uint64_t firstOf(uint64_t scans, uint64_t last) const;
  Result<ScanTrace> readTrace(const std::vector<std::string>& names, uint64_t scans, uint64_t last);
  Result<Shares> readShares(uint64_t scans);
  Result<std::string> trigger(const std::string& condition);
  bool triggerHolds();
  bool takeTasks(std::unique_lock<std::mutex>& lock);
  std::set<std::string> followed();
  void publish(const std::set<std::string>& names);

  // Of the thread of run().
  std::vector<nc::ShownMessage> messages_;
  std::optional<replay::Condition> trigger_;
  bool triggerHeld_ = false;
  const rung_program* triggerProgram_ = nullptr; // in which its names were looked up
  bool triggerKnown_ = false;                    // they are all there

  std::mutex mutex_;             // protects what follows
  std::condition_variable news_; // for pages: a picture
  std::condition_variable work_; // for run(): tasks, a page that looks at something else
  std::shared_ptr<const Picture> picture_;
  const Drawn drawn_;                         // until there is a picture
  std::map<std::string, Follower> followers_; // by page
  bool stale_ = true;                         // a page follows what the picture does not have
  std::deque<Task> tasks_;
  std::deque<Event> events_;
  uint64_t lastEvent_ = 0;
  std::string triggerText_;
  bool ended_ = false;
};

// The scan so many after `from`, or before it, but not before 0.
uint64_t scanFrom(uint64_t from, int64_t scans);

// The messages that the operator sees.
std::vector<ShownMessage> messagesOf(const runtime::Instance& instance, const nc::Control& control);

} // namespace rung::web

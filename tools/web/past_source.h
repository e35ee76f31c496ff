// A recording as what the page shows.
#pragma once
#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tools/replay/past.h"
#include "tools/replay/past_messages.h"
#include "tools/replay/why.h"
#include "tools/web/paced_source.h"

namespace rung::web {

class PastSource : public PacedSource {
public:
  // A program of the recording as the page shows it; the error says why it cannot be drawn.
  using Draw = std::function<Result<ShownProgram>(const compiler::Compiled&)>;
  // `past` outlives it; its position is where the page begins, and `program` the one there. `draw` is for others.
  PastSource(replay::Past& past, std::shared_ptr<const ShownProgram> program, Draw draw);

  bool isLive() const override { return false; }
  std::string mayWrite() const override { return "a recording cannot be changed"; }

protected:
  replay::Past& past() const { return *past_; }
  // Another recording is shown from now on.
  void show(replay::Past& past);
  // Plays what has not been heard yet, for a short time, and logs what has happened in it. Whether there was anything;
  // the position is then another one.
  bool listen();
  // Is logged when that scan is heard.
  void logLater(uint64_t scan, std::string kind, std::string text);
  virtual RunState state() const;

  bool look() override;
  Result<std::string> seek(uint64_t part) override;
  Result<std::string> carryOut(const Order& order) override;
  void fill(Picture& picture, const std::set<std::string>& names) override;

private:
  // A program of the recording.
  struct View {
    View(uint32_t number, std::shared_ptr<const ShownProgram> program, replay::Past& past, const sim::SimulatedNc& nc)
        : drawn{number, std::move(program)}, states(past.flowEngine(), *drawn.program),
          places(*drawn.program, past.instance(), nc, states) {}
    Drawn drawn;
    ElementStates states;
    NamePlaces places;
  };
  struct Heard {
    uint64_t scan = 0;
    std::vector<ShownMessage> messages; // from this scan on
  };
  struct Later {
    uint64_t scan = 0;
    std::string kind, text;
  };

  bool nextScan() override;
  int64_t nowUs() const override { return past_->instance().nowUs(); }
  uint64_t shownScan() const override { return past_->part(); }
  uint64_t firstScan() const override { return std::min(past_->firstPart() + 1, past_->contents().parts); }
  uint64_t lastScan() const override { return past_->contents().parts; }
  const runtime::Instance& instance() const override { return past_->instance(); }
  const sim::SimulatedNc& nc() const override { return *nc_; }
  replay::FlowEngine& flowEngine() override { return past_->flowEngine(); }
  const replay::Flow* shownFlow() override { return past_->flow(); }
  void searchPast(replay::Condition& condition, const std::string& text) override;
  std::string valueOf(const std::string& name) const override;
  Result<Why> explain(const std::string& name) override;

  View& view();
  void hear();
  void logLandmarks();
  void skipDamage();
  std::vector<uint8_t> elementsHere();
  void fillElements(Picture& picture);
  WhyCause causeOf(const replay::Reason& reason);
  void addSteps(const replay::Reason& reason, uint32_t depth, std::vector<WhyStep>& steps);

  replay::Past* past_;
  const Draw draw_;
  const std::unique_ptr<sim::SimulatedNc> nc_;      // for names; it drives nothing
  std::map<uint32_t, std::unique_ptr<View>> views_; // by program of the recording
  uint32_t lastNumber_ = 1;                         // of a view
  std::optional<replay::PastMessages> hears_;
  uint64_t heard_ = 0;        // scans that have been listened to
  uint64_t nextLandmark_ = 0; // counted with those that were dropped
  std::deque<Heard> messages_;
  std::deque<Later> later_; // ascending
  // The last part that ran before each stop by the operator, and whether the part that was heard last was stopped.
  std::vector<uint64_t> stops_;
  bool wasStopped_ = false;
  // The elements that are shown while the program is stopped: of this part, and of this view.
  std::vector<uint8_t> held_;
  uint64_t heldPart_ = 0;
  uint32_t heldNumber_ = 0; // 0: none
};

} // namespace rung::web

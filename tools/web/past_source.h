// A recording as what the page shows.
#pragma once
#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "tools/replay/past.h"
#include "tools/replay/why.h"
#include "tools/web/paced_source.h"

namespace rung::web {

class PastSource final : public PacedSource {
public:
  // Both must outlive it. `program`: the first one of the recording; the position is where the page begins.
  PastSource(replay::Past& past, const ShownProgram& program);

  bool isLive() const override { return false; }
  std::string mayWrite() const override { return "a recording cannot be changed"; }

private:
  bool nextScan() override;
  int64_t nowUs() const override { return past_.instance().nowUs(); }
  uint64_t shownScan() const override { return past_.part(); }
  uint64_t firstScan() const override { return std::min(past_.firstPart() + 1, past_.contents().parts); }
  uint64_t lastScan() const override { return past_.contents().parts; }
  const runtime::Instance& instance() const override { return past_.instance(); }
  const sim::SimulatedNc& nc() const override { return *nc_; }
  replay::FlowEngine& flowEngine() override { return past_.flowEngine(); }
  const replay::Flow* shownFlow() override { return past_.flow(); }
  void searchPast(replay::Condition& condition, const std::string& text) override;
  Result<std::string> seek(uint64_t part) override;
  std::string valueOf(const std::string& name) const override;
  Result<std::string> carryOut(const Order& order) override;
  Result<Why> explain(const std::string& name) override;
  void fill(Picture& picture, const std::set<std::string>& names) override;

  void readEvents();

  void addSteps(const replay::Reason& reason, uint32_t depth, std::vector<WhyStep>& steps);

  replay::Past& past_;
  const ShownProgram& program_;
  const std::unique_ptr<sim::SimulatedNc> nc_; // for names and texts; it drives nothing
  ElementStates states_;
  const NamePlaces places_;
};

} // namespace rung::web

// A machine that runs, as what the page shows: its recording, which is followed while it is written, and its host.
#pragma once
#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "tools/replay/followed.h"
#include "tools/web/host_link.h"
#include "tools/web/past_source.h"

namespace rung::web {

class MachineSource final : public PastSource {
public:
  // `link` outlives it. The position of `followed` is the newest scan, and `program` the one that runs there.
  MachineSource(HostLink& link, replay::Followed followed, std::shared_ptr<const ShownProgram> program, Draw draw);

  bool isLive() const override { return true; }
  bool isMachine() const override { return true; }
  std::string mayWrite() const override { return link_.state().mayWrite; }
  Result<std::string> execute(const Order& order) override;

private:
  bool look() override;
  std::chrono::milliseconds lookEvery() const override;
  Result<std::string> carryOut(const Order& order) override;
  RunState state() const override;
  void fill(Picture& picture, const std::set<std::string>& names) override;

  bool takeHost();
  void takeFolder();
  void goToNewest();
  std::string notice() const;

  HostLink& link_;
  replay::Followed followed_;
  std::string folder_; // of followed_
  HostState host_;
  bool follows_ = true;              // the newest scan is shown
  uint64_t unplayable_ = UINT64_MAX; // after the state of this scan
  std::string unplayed_;             // why
  size_t knownProblems_;             // of the recording, from before the page began
  std::chrono::steady_clock::time_point heardAt_{};
};

} // namespace rung::web

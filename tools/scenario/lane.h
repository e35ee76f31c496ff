// One engine's run of a program, with the NC beside it and what a scenario has yet to look at.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/host/engine.h"
#include "rtlib/host/instance.h"
#include "tools/scenario/replace_report.h"
#include "tools/scenario/requests.h"
#include "tools/sim/simulated_nc.h"

namespace rung::scenario {

// Lends the simulated NC's hooks to the instance and adds the scenario's prepared answers.
class Lane final : public host::ScheduleHooks {
public:
  // Files that the NC's configuration names lie in `folder`. The engine outlives the lane.
  Lane(host::Engine& engine, std::string folder);

  std::string_view engineName() const { return engine_->name(); }
  void* engineContext() { return engine_->context(); }
  host::Instance& instance() { return *instance_; }
  const host::Instance& instance() const { return *instance_; }
  sim::SimulatedNc& nc() { return *nc_; }
  const sim::SimulatedNc& nc() const { return *nc_; }
  Requests& requests() { return requests_; }
  std::vector<std::string>& unreadLog() { return unreadLog_; } // since the last expect_log

  // Switches the program on; what was to be looked at is dropped.
  void powerOn(nc::PowerOn kind);
  // Another program of the same dialect takes over from the running one. "" or why it cannot, and nothing has happened;
  // its engine outlives the lane.
  std::string replace(host::Engine& next, ReplaceReport& report);
  // Runs the NC and the program: a scan, a slot or the fast part.
  using Advance = void (sim::SimulatedNc::*)(host::Instance&);
  void advance(Advance how);
  // After a slice that was run beside `advance`.
  void takeMessages();
  // Nobody will look: requests are refused, and what the log holds is dropped.
  void ignore();

  void onHook(host::Instance& instance, uint32_t work) override { nc_->onHook(instance, work); }
  void onFault(host::Instance& instance) override { nc_->onFault(instance); }
  void onReplace(host::Instance& instance) override { nc_->onReplace(instance); }
  bool respond(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override {
    return requests_.respond(instance, request, reply) || nc_->respond(instance, request, reply);
  }

private:
  void takeLog();

  host::Engine* engine_;
  std::unique_ptr<sim::SimulatedNc> nc_;
  std::unique_ptr<host::Instance> instance_;
  Requests requests_;
  std::vector<std::string> unreadLog_;
};

} // namespace rung::scenario

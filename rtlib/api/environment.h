// What is around a program besides its host: the control of its dialect, or a simulated NC with that control in it. A
// simulation has its part in the schedule and writes where the NC writes, which no host of the library may: it is
// compiled into the process (newInstance) and sees the program from inside.
#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "rtlib/nc/control/control.h"
#include "rtlib/run/clock.h"
#include "rtlib/run/instance.h"
#include "rung/runtime.h"

namespace rung::api {

// Where nothing else is said, the control alone. Hooks, parts and messages are the scan thread's.
class Environment : public runtime::ScheduleHooks {
public:
  virtual nc::Control& control() = 0;
  virtual const nc::Control& control() const = 0;

  virtual void powerOn(runtime::Instance& instance, nc::PowerOn kind) { control().powerOn(instance, kind); }
  // Around what one call of the host runs: a slice, a slot, a scan or the fast task.
  virtual void beforePart(runtime::Instance& instance) { (void)instance; }
  virtual void afterPart(runtime::Instance& instance) { control().afterSlice(instance); }
  // A message that the program has sent.
  virtual void accept(const runtime::Instance& instance, const rung_message& message) {
    (void)instance;
    control().accept(message);
  }
  // Where the environment itself reads and writes in a program, as nc::Control has it for the control; null: they
  // look that up in programChanged, which is not real time then.
  virtual std::unique_ptr<nc::Places> locate(const rung_program& program) const { return (void)program, nullptr; }
  // Another program has taken over, whose places these are; they get those of the former one. Allocates nothing.
  virtual void exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept { (void)places; }
  // Another program has taken over from `former`, which still exists; its places are in use already.
  virtual void programChanged(runtime::Instance& instance, const rung_program& former) { (void)instance, (void)former; }

  // The place that a name is for whoever reads it, and the one that the NC or the machine writes.
  virtual std::optional<runtime::Ref> readPlace(const rung_program& program, std::string_view name) const {
    return control().readPlace(program, name);
  }
  virtual std::optional<runtime::Ref> writePlace(const rung_program& program, std::string_view name) const {
    return control().writePlace(program, name);
  }

  void onHook(runtime::Instance& instance, uint32_t work) override { control().onHook(instance, work); }
  void onFault(runtime::Instance& instance) override { control().onFault(instance); }
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    return control().respond(instance, request, reply);
  }
};

// By rung_program::dialect.
std::unique_ptr<Environment> controlAlone(std::string_view dialect);

// rung_instance_new with this environment; null: the control alone.
int32_t newInstance(rung_image* image, const rung_instance_options* options, std::unique_ptr<Environment> environment,
                    rung_instance** instance);

// The program as its environment sees it, as long as the handle is alive. Running, power, replacing and forcing are the
// library's alone.
runtime::Instance& insideOf(rung_instance& instance) noexcept;

// Before the instance is switched on first: where it keeps its retained memory, and whether a thread writes that.
void setOutside(rung_instance& instance, const runtime::Outside& outside);
// Where no thread does: writes what is to be written, or the power is gone and nothing is written any more.
void lookForSaving(rung_instance& instance) noexcept;
void cutPower(rung_instance& instance) noexcept;

// What an environment does of its own between two calls of the host may send messages: they are taken.
void takeMessages(rung_instance& instance) noexcept;

} // namespace rung::api

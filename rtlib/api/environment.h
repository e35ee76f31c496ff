// The environment of a program besides its host: the control of its dialect, or a simulated NC that contains this
// control. A simulation takes part in the schedule and writes where the NC writes, which hosts of the library may not
// do: it is compiled into the process (newInstance) and sees the program from inside.
#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "rtlib/nc/control/control.h"
#include "rtlib/run/clock.h"
#include "rtlib/run/instance.h"
#include "rung/runtime.h"

namespace rung::api {

// The defaults are those of the control alone. The scan thread calls hooks, parts and messages.
class Environment : public runtime::ScheduleHooks {
public:
  virtual nc::Control& control() = 0;
  virtual const nc::Control& control() const = 0;

  virtual void powerOn(runtime::Instance& instance, nc::PowerOn kind) { control().powerOn(instance, kind); }
  // The state beside that of the instance, as nc::Control has it. `load` is called when the instance has loaded its
  // own.
  virtual void save(core::Saver& saver) const noexcept { control().save(saver); }
  virtual void load(runtime::Instance& instance, core::Loader& loader) { (void)instance, control().load(loader); }
  // Called before and after the part that a call of the host runs: a slice, a slot, a scan or the fast task.
  virtual void beforePart(runtime::Instance& instance) { (void)instance; }
  virtual void afterPart(runtime::Instance& instance) { control().afterSlice(instance); }
  // Receives a message that the program has sent.
  virtual void accept(const runtime::Instance& instance, const rung_message& message) {
    (void)instance;
    control().accept(message);
  }
  // The places of a program that the environment itself reads and writes, as nc::Control has them for the control;
  // null: it looks them up in programChanged, which then is not real time.
  virtual std::unique_ptr<nc::Places> locate(const rung_program& program) const { return (void)program, nullptr; }
  // Called after another program has taken over: `places` are that program's, and receive those of the former one.
  // Allocates nothing.
  virtual void exchangePlaces(std::unique_ptr<nc::Places>& places) noexcept { (void)places; }
  // Called after another program has taken over from `former`, which still exists; the new places are in use already.
  virtual void programChanged(runtime::Instance& instance, const rung_program& former) { (void)instance, (void)former; }

  // The place where a name is read, and the one that the NC or the machine writes.
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

// The control of a dialect (rung_program::dialect) without a simulation.
std::unique_ptr<Environment> controlAlone(std::string_view dialect);

// rung_instance_new with this environment; null: the control alone.
int32_t newInstance(rung_image* image, const rung_instance_options* options, std::unique_ptr<Environment> environment,
                    rung_instance** instance);

// The program as its environment sees it, as long as the handle exists. Only the library runs it, switches its power,
// replaces it and forces cells.
runtime::Instance& insideOf(rung_instance& instance) noexcept;

// Sets, before the first power-on, where the instance stores its retained memory, and whether a thread writes it.
void setOutside(rung_instance& instance, const runtime::Outside& outside);
// For tests without a saver thread: lookForSaving writes the images that are due; cutPower simulates a power failure,
// after which nothing is written.
void lookForSaving(rung_instance& instance) noexcept;
void cutPower(rung_instance& instance) noexcept;

// Passes on messages that the environment itself has caused between two calls of the host.
void takeMessages(rung_instance& instance) noexcept;

} // namespace rung::api

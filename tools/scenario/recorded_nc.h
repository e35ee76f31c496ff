// The NC of a scenario that repeats a recording (`control recorded`): neither the control nor its machine does anything
// of its own. What they did is written in the scenario: between two parts of the program by `set` and `within 0`, at
// their turns within the next part (hooks of the schedule, in their order, and that of a fault) by `within N`.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/nc/control/control.h"
#include "sim/simulated_nc.h"

namespace rung::scenario {

class RecordedNc final : public sim::SimulatedNc {
public:
  explicit RecordedNc(std::string_view dialect) : control_(nc::makeControl(dialect)) {}

  // An action of a `within` statement, with its operands. "" or what is wrong.
  std::string take(runtime::Instance& instance, uint32_t turn, std::string_view action,
                   std::span<const std::string> operands);
  // What was to happen within the last part, and has not, because the program did something else; "": nothing.
  std::string takeUnused();
  // Requests since the start.
  uint32_t requestCount() const { return static_cast<uint32_t>(tickets_.size()); }

  // The configuration and the connections of the control have had their effects when it was recorded.
  std::string config(std::string_view, std::string_view) override { return {}; }
  std::string connect(std::string_view, std::string_view) override { return {}; }
  nc::Control& control() override { return *control_; }
  const nc::Control& control() const override { return *control_; }
  void powerOn(runtime::Instance& instance, nc::PowerOn kind) override;
  void beforePart(runtime::Instance&) override { turn_ = 0; }
  void afterPart(runtime::Instance&) override;
  uint32_t works() const override { return ~0u; }
  void onHook(runtime::Instance& instance, uint32_t) override { haveTurn(instance); }
  void onFault(runtime::Instance& instance) override { haveTurn(instance); }
  std::string plcCommand(runtime::Instance& instance, std::string_view command) override;
  void save(core::Saver& saver) const noexcept override;
  void load(runtime::Instance& instance, core::Loader& loader) override;

private:
  // Whatever an action does, in the form that its turn needs: nothing is looked up within a part.
  struct Act {
    enum class What : uint8_t { Write, State, Task, Request, Reply, Clock, Halt } what = What::Write;
    uint32_t turn = 0;
    runtime::Ref place;  // Write
    uint32_t number = 0; // State: the offset in the block; Task, Halt, Request: the number; Reply: that of the request
    uint32_t bytes = 0;  // State
    std::vector<int64_t> values;
    uint32_t state = 0; // Reply
  };

  bool serve(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;
  void haveTurn(runtime::Instance& instance);
  std::string execute(runtime::Instance& instance, const Act& act);
  std::string complete(runtime::Instance& instance, const Act& act) const;
  static std::string read(const rung_program& program, std::string_view action, std::span<const std::string> operands,
                          Act& act);

  std::unique_ptr<nc::Control> control_;
  std::vector<Act> acts_;         // of the next part
  std::vector<Act> answers_;      // to requests of the next part
  std::vector<uint32_t> tickets_; // of all requests since the start
  std::string problem_;           // of the last part
  uint32_t turn_ = 0;
  bool starting_ = false;
};

} // namespace rung::scenario

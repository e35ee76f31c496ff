// See environment.h.
#include "rtlib/api/environment.h"

#include "rtlib/api/instance.h"
#include "rtlib/api/running.h"

namespace rung::api {
namespace {

class ControlAlone final : public Environment {
public:
  explicit ControlAlone(std::string_view dialect) : control_(nc::makeControl(dialect)) {}
  nc::Control& control() override { return *control_; }
  const nc::Control& control() const override { return *control_; }
  uint32_t works() const override { return control_->works(); }
  void beforePart(runtime::Instance& instance) override { control_->beforeSlice(instance); }

private:
  std::unique_ptr<nc::Control> control_;
};

} // namespace

std::unique_ptr<Environment> controlAlone(std::string_view dialect) { return std::make_unique<ControlAlone>(dialect); }

runtime::Instance& insideOf(rung_instance& instance) noexcept { return instance.running; }

void setOutside(rung_instance& instance, const runtime::Outside& outside) { instance.outside = outside; }

void lookForSaving(rung_instance& instance) noexcept {
  if (instance.retention) instance.retention->look();
}

void cutPower(rung_instance& instance) noexcept {
  if (instance.retention) instance.retention->abandon();
}

void takeMessages(rung_instance& instance) noexcept {
  rung_message message;
  for (uint32_t i = 0; i < core::kMessageCapacity && instance.running.messages().pop(message); ++i) {
    instance.environment->accept(instance.running, message);
    say(instance, message);
  }
}

} // namespace rung::api

// Load and save (see retention.h).
#include "rtlib/nc/control/retention.h"

namespace rung::nc {

Retention::Retention(Control& control, runtime::Instance& instance, const std::string& file, runtime::RetainTake take,
                     const runtime::Outside& outside)
    : control_(&control), instance_(&instance),
      memory_(instance.program(), file,
              control.savesOnRequest() ? runtime::RetainWhen::OnRequest : runtime::RetainWhen::Always, take, outside) {
  control.setStored(true);
}

std::optional<PowerOn> Retention::load(std::string& report, std::string& error) {
  const bool found = memory_.load(*instance_, report, error);
  if (!error.empty()) return std::nullopt;
  if (memory_.lost()) control_->reportRetainedLost();
  return found ? PowerOn::Warm : PowerOn::Cold;
}

bool Retention::afterSlice() noexcept {
  const bool asked = control_->asksToSave(*instance_);
  const bool saved = memory_.offer(*instance_, asked);
  if (saved) control_->saved(*instance_);
  return saved || !asked;
}

} // namespace rung::nc

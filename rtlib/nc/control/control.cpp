// The common part of the controls of all dialects.
#include "rtlib/nc/control/control.h"

#include <algorithm>
#include <cstdio>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/nct/nct_control.h"
#include "rtlib/nc/control/pmc/pmc_control.h"
#include "rtlib/nc/control/technol/technol_control.h"
#include "rtlib/nc/fanuc/model.h"
#include "rtlib/nc/gsk/model.h"
#include "rtlib/nc/names/names.h"

namespace rung::nc {

void Control::prepare(runtime::Instance& instance, PowerOn kind) {
  if (kind == PowerOn::Cold)
    instance.coldStart();
  else
    instance.warmStart();
  Control::onReplace(instance);
}

void Control::exchangePlaces(runtime::Instance& instance, std::unique_ptr<Places>& places) noexcept {
  places_.swap(places);
  if (places_) usePlaces(instance, *places_);
}

void Control::onReplace(runtime::Instance& instance) {
  std::unique_ptr<Places> places = locate(instance.program());
  exchangePlaces(instance, places);
}

std::optional<runtime::Ref> Control::readPlace(const rung_program& program, std::string_view name) const {
  return resolve(program, name, [&](std::string_view unknown) { return signal(program, unknown); });
}

size_t putMessageNumber(uint32_t number, int32_t channel, int32_t index, std::span<char> out) noexcept {
  char text[kMessageNumber];
  const int length = channel == 0 && index == 0
                         ? std::snprintf(text, sizeof text, "%u", number)
                         : std::snprintf(text, sizeof text, "%u (channel %d, index %d)", number, channel, index);
  const size_t size = std::min(out.size(), static_cast<size_t>(length));
  std::copy_n(text, size, out.begin());
  return size;
}

size_t Control::describe(const rung_program& program, const rung_message& message, std::span<char> out) const noexcept {
  size_t size = putMessageNumber(message.number, message.channel, message.index, out);
  if (size < out.size()) out[size++] = ' ';
  const std::string_view text = runtime::messageText(program, message.number).substr(0, out.size() - size);
  std::ranges::copy(text, out.subspan(size).begin());
  return size + text.size();
}

std::string Control::text(const ShownMessage& message) const {
  char number[kMessageNumber];
  const size_t length = putMessageNumber(message.number, message.channel, message.index, number);
  std::string text = "message " + std::string(number, length);
  if (!message.text.empty()) text += " \"" + message.text + "\"";
  return text;
}

std::unique_ptr<Control> makeControl(std::string_view dialect) {
  if (dialect == "fanuc") return std::make_unique<PmcControl>(fanuc::model());
  if (dialect == "gsk") return std::make_unique<PmcControl>(gsk::model());
  if (dialect == "nct") return std::make_unique<NctControl>();
  if (dialect == "technol") return std::make_unique<TechnolControl>();
  return std::make_unique<Control>();
}

// Loading and saving retained memory.

Retention::Retention(Control& control, runtime::Instance& instance, const std::string& file, runtime::RetainTake take,
                     const runtime::Outside& outside)
    : control_(&control), instance_(&instance),
      memory_(instance.program(), file,
              control.savesOnRequest() ? runtime::RetainWhen::OnRequest : runtime::RetainWhen::Always, take, outside,
              naming(instance.program())) {
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

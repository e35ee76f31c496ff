// What the controls of all dialects have in common (see control.h).
#include "rtlib/nc/control/control.h"

#include <algorithm>
#include <charconv>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/control/gsk/gsk_control.h"
#include "rtlib/nc/control/nct/nct_control.h"
#include "rtlib/nc/control/refuse.h"
#include "rtlib/nc/control/technol/technol_control.h"
#include "rtlib/nc/names/names.h"

namespace rung::nc {

void Control::prepare(host::Instance& instance, PowerOn kind) {
  if (kind == PowerOn::Cold)
    instance.coldStart();
  else
    instance.warmStart();
  Control::onReplace(instance);
}

void Control::exchangePlaces(host::Instance& instance, std::unique_ptr<Places>& places) noexcept {
  places_.swap(places);
  if (places_) usePlaces(instance, *places_);
}

void Control::onReplace(host::Instance& instance) {
  std::unique_ptr<Places> places = locate(instance.program());
  exchangePlaces(instance, places);
}

bool Control::respond(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) {
  reply = refuse(instance.program(), request);
  return true;
}

std::optional<host::Ref> Control::readPlace(const rung_program& program, std::string_view name) const {
  return resolve(program, name, [&](std::string_view unknown) { return signal(program, unknown); });
}

size_t Control::describe(const rung_program& program, const rung_message& message, std::span<char> out) const noexcept {
  char head[16];
  char* end = std::to_chars(head, head + sizeof head, message.number).ptr;
  *end++ = ' ';
  const std::string_view number(head, end);
  const std::string_view text = host::messageText(program, message.number);
  const std::string_view shownNumber = number.substr(0, out.size());
  const std::string_view shownText = text.substr(0, out.size() - shownNumber.size());
  std::ranges::copy(shownText, std::ranges::copy(shownNumber, out.begin()).out);
  return shownNumber.size() + shownText.size();
}

std::string Control::text(const ShownMessage& message) const {
  std::string text = "message " + std::to_string(message.number);
  if (message.channel != 0 || message.index != 0)
    text += " (channel " + std::to_string(message.channel) + ", index " + std::to_string(message.index) + ")";
  if (!message.text.empty()) text += " \"" + message.text + "\"";
  return text;
}

std::unique_ptr<Control> makeControl(std::string_view dialect) {
  if (dialect == "gsk") return std::make_unique<GskControl>();
  if (dialect == "nct") return std::make_unique<NctControl>();
  if (dialect == "technol") return std::make_unique<TechnolControl>();
  return std::make_unique<Control>();
}

} // namespace rung::nc

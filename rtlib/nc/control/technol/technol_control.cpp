// Hooks of a TECHNOL program's schedule (see technol_control.h).
#include "rtlib/nc/control/technol/technol_control.h"

#include <cstdio>

#include "rtlib/nc/control/technol/cells.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/nc/technol/exchange.h"

namespace rung::nc {

namespace {

struct TechnolPlaces final : Places {
  explicit TechnolPlaces(const rung_program& program)
      : blocks(program), operation(program), functions(program), life(program),
        backup(technol::Backup::locate(program)) {}

  technol::Blocks::Places blocks;
  technol::Operation::Places operation;
  TechnolFunctions::Places functions;
  technol::ProgramLife::Places life;
  core::Place backup;
};

} // namespace

void TechnolControl::prepare(runtime::Instance& instance, PowerOn kind) {
  Control::prepare(instance, kind);
  messages_.clear();
  blocks_.reset();
  operation_.reset();
  functions_.reset();
}

std::unique_ptr<Places> TechnolControl::locate(const rung_program& program) const {
  return std::make_unique<TechnolPlaces>(program);
}

void TechnolControl::usePlaces(runtime::Instance& instance, Places& places) noexcept {
  const auto& of = static_cast<const TechnolPlaces&>(places);
  blocks_.use(of.blocks);
  operation_.use(of.operation);
  functions_.use(instance, of.functions);
  life_.use(of.life);
  backup_.use(of.backup);
}

void TechnolControl::onHook(runtime::Instance& instance, uint32_t work) {
  if (work == kHookAfterInput) blocks_.supervise(instance);
  if (work == kHookAfterMain) backup_.afterMain(instance);
}

uint32_t TechnolControl::works() const { return 1u << kHookAfterInput | 1u << kHookAfterMain; }

void TechnolControl::onFault(runtime::Instance& instance) { technol::runWith(instance, "HALT", 0, false); }

void TechnolControl::beforeSlice(runtime::Instance& instance) {
  driven_ = true;
  if (instance.atListStart() && !instance.stopped()) operation_.beforeScan(instance);
}

void TechnolControl::afterSlice(runtime::Instance& instance) {
  if (driven_) operation_.afterSlice(instance);
  if (instance.atListStart()) life_.afterScan(instance);
}

bool TechnolControl::define(const DefinedMessage& message) {
  messages_.define({.number = message.number,
                    .kind = message.loggedOnly ? technol::MessageKind::Event : technol::MessageKind::Err,
                    .validity = message.lasts ? technol::Validity::Persistent : technol::Validity::Transient,
                    .text = message.text});
  return true;
}

size_t TechnolControl::describe(const rung_program&, const rung_message& message, std::span<char> out) const noexcept {
  return messages_.describe(message, out);
}

std::string TechnolControl::text(const ShownMessage& message) const {
  char number[16];
  std::snprintf(number, sizeof number, "PLC%05u", message.number);
  std::string text = number;
  for (const int64_t value :
       {int64_t{static_cast<uint32_t>(message.index)}, message.value, int64_t{message.par2}, int64_t{message.par3}})
    text += " " + std::to_string(value);
  return message.text.empty() ? text : text + " " + message.text;
}

std::string TechnolControl::shownText(std::string_view inMemory) const { return nc::shownText(inMemory); }

std::string TechnolControl::memoryText(std::string_view shown, uint32_t bytes) const {
  return nc::memoryText(shown).substr(0, bytes - 1u);
}

std::optional<runtime::Ref> TechnolControl::signal(const rung_program& program, std::string_view name) const {
  return technol::signalPlace(program, name);
}

} // namespace rung::nc

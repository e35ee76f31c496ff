// Table look-ups (the check of the tables is in check_program.cpp).
#include "rtlib/load/program_info.h"

#include <algorithm>

#include "rtlib/core/runner.h"
#include "rtlib/text/number.h"
#include "rung/types.hpp"

namespace rung::runtime {

uint32_t findSpace(const rung_program& program, std::string_view name) {
  for (uint32_t i = 0; i < program.space_count; ++i)
    if (name == program.spaces[i].name) return i;
  return RUNG_NONE;
}

uint32_t findTask(const rung_program& program, std::string_view name) {
  for (uint32_t i = 0; i < program.task_count; ++i)
    if (name == program.tasks[i].name) return i;
  return RUNG_NONE;
}

uint32_t findService(const rung_program& program, std::string_view name) {
  for (uint32_t i = 0; i < program.service_count; ++i)
    if (name == program.services[i]) return i;
  return RUNG_NONE;
}

const rung_symbol* firstSymbolFrom(const rung_program& program, std::string_view name) {
  const rung_symbol* end = program.symbols + program.symbol_count;
  const rung_symbol* found = std::lower_bound(program.symbols, end, name, [](const rung_symbol& s, std::string_view n) {
    return std::string_view(s.name) < n;
  });
  return found == end ? nullptr : found;
}

const rung_symbol* findSymbol(const rung_program& program, std::string_view name) {
  const rung_symbol* symbol = firstSymbolFrom(program, name);
  return symbol != nullptr && name == symbol->name ? symbol : nullptr;
}

std::optional<LogicalByte> byteAt(const rung_program& program, uint32_t offset) {
  for (uint32_t s = 0; s < program.space_count; ++s)
    for (const rung_range& range : std::span(program.spaces[s].ranges, program.spaces[s].range_count)) {
      const uint32_t step = bytesPerByte(range.repr);
      if (offset >= range.offset && (offset - range.offset) / step < range.byte_count)
        return LogicalByte{s, range.first_byte + (offset - range.offset) / step};
    }
  return std::nullopt;
}

uint32_t slotBytes(const rung_slot& slot) { return std::max(1u, elementBits(slot.type) / 8); }

std::string_view serviceName(const rung_program& program, uint32_t service) {
  return service < program.service_count ? std::string_view(program.services[service]) : std::string_view();
}

std::string_view messageText(const rung_program& program, uint32_t number) {
  const std::span texts(program.texts, program.text_count);
  const auto found = std::ranges::lower_bound(texts, number, {}, &rung_message_text::number);
  return found != texts.end() && found->number == number ? std::string_view(found->text) : std::string_view();
}

uint64_t advanceUs(std::span<const rung_step> steps) {
  uint64_t sum = 0;
  for (const rung_step& step : steps) sum += step.op == RUNG_STEP_ADVANCE ? step.arg : 0;
  return sum;
}

uint64_t scanPeriodUs(const rung_program& program) {
  const uint64_t sum = advanceUs({program.scan, program.scan_count});
  if (sum != 0 || program.main_task >= program.task_count) return sum;
  return program.tasks[program.main_task].period_us;
}

std::string rungText(const rung_program& program, uint32_t rung, uint32_t line) {
  if (rung >= program.rung_count) return "unknown rung";
  const rung_info& info = program.rungs[rung];
  const char* routine = info.routine < program.routine_count ? program.routines[info.routine] : "?";
  std::string text = info.number != 0 ? "rung " + std::to_string(info.number) : routine; // not drawn
  if (info.title != nullptr && *info.title != '\0') text += " \"" + std::string(info.title) + "\"";
  if (info.file >= program.file_count) return text; // made by the compiler
  return text + ", " + program.files[info.file] + ":" + std::to_string(line != 0 ? line : info.first_line);
}

namespace {
constexpr std::string_view kMaxTimeText = "max-time: the slice took longer than the limit of its host";
} // namespace

std::string faultText(const rung_program& program, const rung_fault& fault) {
  if (fault.code == RUNG_NONE) return {};
  if (fault.code == core::kOverrunFault) return std::string(kOverrunText);
  std::string reason = fault.code < program.fault_count ? program.faults[fault.code] : "undescribed fault";
  if (fault.code == core::kMaxTimeFault) reason = kMaxTimeText;
  if (fault.task == RUNG_NONE) return reason; // the host stopped it
  return reason + " (" + rungText(program, fault.rung, fault.line) + ")";
}

} // namespace rung::runtime

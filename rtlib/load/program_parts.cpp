// See program_parts.h.
#include "rtlib/load/program_parts.h"

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>

namespace rung::runtime {
namespace {

// FNV-1a.
class Hash {
public:
  void add(std::unsigned_integral auto number) {
    for (size_t i = 0; i < sizeof number; ++i) addByte(static_cast<uint8_t>(uint64_t{number} >> 8 * i));
  }
  void add(std::string_view text) {
    add(uint64_t{text.size()});
    for (const char byte : text) addByte(static_cast<uint8_t>(byte));
  }
  uint64_t value() const { return hash_; }

private:
  void addByte(uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001B3; }
  uint64_t hash_ = 0xCBF29CE484222325;
};

uint64_t namesOf(const rung_program& program) {
  Hash hash;
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    hash.add(std::string_view(symbol.name));
    for (const uint32_t number : {symbol.space, symbol.byte, symbol.bit, symbol.type, symbol.count, symbol.flags})
      hash.add(number);
    hash.add(static_cast<uint64_t>(symbol.value));
  }
  return hash.value();
}

uint64_t contentsOf(const rung_program& program) {
  Hash hash;
  for (const rung_init& init : std::span(program.inits, program.init_count)) {
    hash.add(init.offset);
    hash.add(std::string_view(reinterpret_cast<const char*>(init.data), init.size));
  }
  return hash.value();
}

uint64_t messagesOf(const rung_program& program) {
  Hash hash;
  for (const rung_message_text& text : std::span(program.texts, program.text_count)) {
    hash.add(text.number);
    hash.add(std::string_view(text.text));
  }
  return hash.value();
}

uint64_t scheduleOf(const rung_program& program) {
  Hash hash;
  for (const rung_task& task : std::span(program.tasks, program.task_count)) {
    hash.add(std::string_view(task.name));
    for (const uint32_t number : {task.period_us, task.begin_count, task.end_count, task.part_count}) hash.add(number);
  }
  for (const std::span steps :
       {std::span(program.scan, program.scan_count), std::span(program.fast, program.fast_count),
        std::span(program.slices, program.slice_count)})
    for (const rung_step& step : steps)
      for (const uint32_t number : {step.op, step.task, step.arg}) hash.add(number);
  for (const rung_copy& copy : std::span(program.copies, program.copy_count))
    for (const uint32_t number : {copy.kind, copy.from, copy.to, copy.mask, copy.size}) hash.add(number);
  return hash.value();
}

} // namespace

ProgramParts partsOf(const rung_program& program) {
  return {.memory = program.layout_hash,
          .names = namesOf(program),
          .contents = contentsOf(program),
          .messages = messagesOf(program),
          .schedule = scheduleOf(program)};
}

} // namespace rung::runtime

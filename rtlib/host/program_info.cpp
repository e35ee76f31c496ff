// Table look-ups and the check of a program's tables.
#include "rtlib/host/program_info.h"

#include <charconv>
#include <cstring>

namespace rung::host {

namespace {

// What one table entry refers to, said in words when it is wrong.
class Checker {
public:
  explicit Checker(const rung_program& program) : p_(program) {}

  std::string run() {
    if (checkHead()) checkTables();
    return error_;
  }

private:
  void fail(std::string text) {
    if (error_.empty()) error_ = std::move(text);
  }
  void index(const char* what, uint32_t number, uint32_t value, uint32_t count) {
    if (value >= count) fail(std::string(what) + " of entry " + std::to_string(number) + " is out of range");
  }
  void block(const char* what, uint32_t number, uint32_t offset, uint64_t size) {
    if (offset > p_.memory_size || size > p_.memory_size - offset)
      fail(std::string(what) + " " + std::to_string(number) + " lies outside the memory block");
  }
  void present(const char* what, uint32_t count, const void* table) {
    if (count != 0 && table == nullptr) fail(std::string("the table of ") + what + " is missing");
  }

  bool checkHead() {
    if (p_.abi_version != RUNG_ABI_VERSION) {
      fail("the program has ABI version " + std::to_string(p_.abi_version) + ", this runtime has " +
           std::to_string(RUNG_ABI_VERSION));
    } else if (p_.size < sizeof(rung_program)) {
      fail("the program's description has " + std::to_string(p_.size) + " bytes, this runtime needs " +
           std::to_string(sizeof(rung_program)));
    } else if (p_.memory_align == 0 || (p_.memory_align & (p_.memory_align - 1)) != 0) {
      fail("the alignment of the memory block is not a power of two");
    } else if (p_.name == nullptr || p_.dialect == nullptr || p_.compiler == nullptr) {
      fail("a text of the program's description is missing");
    } else if (p_.chunk_count != 0 && p_.chunk_fns == nullptr && p_.run_chunk == nullptr) {
      fail("the program has no code");
    }
    if (error_.empty()) checkPresence();
    return error_.empty();
  }

  void checkPresence() {
    present("spaces", p_.space_count, p_.spaces);
    present("symbols", p_.symbol_count, p_.symbols);
    present("initial contents", p_.init_count, p_.inits);
    present("retained spans", p_.retain_count, p_.retains);
    present("safe spans", p_.safe_count, p_.safe_spans);
    present("copies", p_.copy_count, p_.copies);
    present("chunks", p_.chunk_count, p_.chunks);
    present("rungs", p_.rung_count, p_.rungs);
    present("routines", p_.routine_count, p_.routines);
    present("files", p_.file_count, p_.files);
    present("tasks", p_.task_count, p_.tasks);
    present("parts", p_.part_end_count, p_.part_ends);
    present("scan steps", p_.scan_count, p_.scan);
    present("fast steps", p_.fast_count, p_.fast);
    present("faults", p_.fault_count, p_.faults);
    present("services", p_.service_count, p_.services);
    present("texts", p_.text_count, p_.texts);
  }

  void checkTables() {
    for (uint32_t i = 0; i < p_.space_count; ++i) checkSpace(i);
    for (uint32_t i = 0; i < p_.symbol_count; ++i) checkSymbol(i);
    for (uint32_t i = 0; i < p_.init_count; ++i) block("initial contents", i, p_.inits[i].offset, p_.inits[i].size);
    for (uint32_t i = 0; i < p_.retain_count; ++i) block("retained span", i, p_.retains[i].offset, p_.retains[i].size);
    for (uint32_t i = 0; i < p_.safe_count; ++i) block("safe span", i, p_.safe_spans[i].offset, p_.safe_spans[i].size);
    for (uint32_t i = 0; i < p_.copy_count; ++i) checkCopy(i);
    for (uint32_t i = 0; i < p_.chunk_count; ++i) checkChunk(i);
    for (uint32_t i = 0; i < p_.rung_count; ++i) {
      if (p_.rungs[i].file != RUNG_NONE) index("the file of rung", i, p_.rungs[i].file, p_.file_count);
      index("the routine of rung", i, p_.rungs[i].routine, p_.routine_count);
    }
    for (uint32_t i = 0; i < p_.task_count; ++i) checkTask(i);
    for (uint32_t i = 0; i < p_.scan_count; ++i) checkStep("scan step", i, p_.scan[i]);
    for (uint32_t i = 0; i < p_.fast_count; ++i) checkStep("fast step", i, p_.fast[i]);
    if (p_.main_task != RUNG_NONE) index("the main task", 0, p_.main_task, p_.task_count);
    if (p_.fast_task != RUNG_NONE) index("the fast task", 0, p_.fast_task, p_.task_count);
    if (p_.text_count % 2 != 0) fail("the message texts are not pairs");
  }

  void checkSpace(uint32_t number) {
    const rung_space& s = p_.spaces[number];
    uint64_t next = 0;
    for (uint32_t r = 0; r < s.range_count; ++r) {
      const rung_range& range = s.ranges[r];
      if (range.first_byte != next || range.byte_count == 0 || range.repr > RUNG_REPR_BYTE_PER_BIT)
        fail("the ranges of space " + std::string(s.name) + " do not cover it");
      next += range.byte_count;
      const uint64_t each = range.repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1;
      block("space", number, range.offset, range.byte_count * each);
    }
    if (next != s.byte_count) fail("the ranges of space " + std::string(s.name) + " do not cover it");
    if (s.unit_bytes == 0 || s.unit_bytes > 8) fail("space " + std::string(s.name) + " has a bad unit");
  }

  void checkSymbol(uint32_t number) {
    const rung_symbol& s = p_.symbols[number];
    if (number > 0 && std::strcmp(p_.symbols[number - 1].name, s.name) > 0) fail("the symbols are not sorted");
    if ((s.flags & RUNG_SYMBOL_CONST) != 0) return;
    index("the space of symbol", number, s.space, p_.space_count);
    if (s.type < RUNG_TYPE_BIT || s.type > RUNG_TYPE_TEXT || s.bit > 7)
      fail("symbol " + std::string(s.name) + " has a bad type");
  }

  void checkCopy(uint32_t number) {
    const rung_copy& c = p_.copies[number];
    block("copy", number, c.from, c.size);
    block("copy", number, c.to, c.size);
    if (c.kind == RUNG_COPY_MASKED) block("copy", number, c.mask, c.size);
  }

  void checkChunk(uint32_t number) {
    const rung_chunk& c = p_.chunks[number];
    if (c.first_rung > p_.rung_count || c.rung_count > p_.rung_count - c.first_rung)
      fail("chunk " + std::to_string(number) + " has rungs that do not exist");
    if (p_.chunk_fns != nullptr && p_.chunk_fns[number] == nullptr)
      fail("chunk " + std::to_string(number) + " has no code");
  }

  void checkTask(uint32_t number) {
    const rung_task& t = p_.tasks[number];
    index("the entry of task", number, t.entry, p_.chunk_count);
    index("the budget fault of task", number, t.budget_fault, p_.fault_count);
    span("the begin copies of task", number, t.begin_first, t.begin_count, p_.copy_count);
    span("the end copies of task", number, t.end_first, t.end_count, p_.copy_count);
    span("the parts of task", number, t.part_first, t.part_count, p_.part_end_count);
  }
  void span(const char* what, uint32_t number, uint32_t first, uint32_t count, uint32_t all) {
    if (count != 0 && (first > all || count > all - first)) index(what, number, first, 0);
  }

  void checkStep(const char* what, uint32_t number, const rung_step& step) {
    if (step.op > RUNG_STEP_SLOT) fail(std::string(what) + " " + std::to_string(number) + " is unknown");
    if (step.op == RUNG_STEP_RUN || step.op == RUNG_STEP_PART) index(what, number, step.task, p_.task_count);
  }

  const rung_program& p_;
  std::string error_;
};

} // namespace

std::string checkProgram(const rung_program& program) { return Checker(program).run(); }

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

std::string_view serviceName(const rung_program& program, uint32_t service) {
  return service < program.service_count ? std::string_view(program.services[service]) : std::string_view();
}

std::string_view messageText(const rung_program& program, uint32_t number) {
  for (uint32_t i = 0; i + 1 < program.text_count; i += 2) {
    const std::string_view key = program.texts[i];
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), value);
    if (error == std::errc() && end == key.data() + key.size() && value == number) return program.texts[i + 1];
  }
  return {};
}

uint64_t scanPeriodUs(const rung_program& program) {
  uint64_t sum = 0;
  for (uint32_t i = 0; i < program.scan_count; ++i)
    if (program.scan[i].op == RUNG_STEP_ADVANCE) sum += program.scan[i].arg;
  if (sum != 0 || program.main_task >= program.task_count) return sum;
  return program.tasks[program.main_task].period_us;
}

std::string rungText(const rung_program& program, uint32_t rung, uint32_t line) {
  if (rung >= program.rung_count) return "unknown rung";
  const rung_rung_info& info = program.rungs[rung];
  const char* routine = info.routine < program.routine_count ? program.routines[info.routine] : "?";
  std::string text = info.number != 0 ? "rung " + std::to_string(info.number) : routine; // what is not drawn
  if (info.title != nullptr && *info.title != '\0') text += " \"" + std::string(info.title) + "\"";
  const char* file = info.file < program.file_count ? program.files[info.file] : "?";
  return text + ", " + file + ":" + std::to_string(line != 0 ? line : info.first_line);
}

std::string faultText(const rung_program& program, const rung_fault& fault) {
  if (fault.code == RUNG_NONE) return {};
  const std::string reason = fault.code < program.fault_count ? program.faults[fault.code] : "undescribed fault";
  if (fault.task == RUNG_NONE) return reason; // the host stopped it
  return reason + " (" + rungText(program, fault.rung, fault.line) + ")";
}

} // namespace rung::host

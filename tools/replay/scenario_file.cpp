// Writes scenarios (see scenario_file.h).
#include "tools/replay/scenario_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <vector>

#include "compiler/project.h"
#include "ir/support/put.h"
#include "rtlib/nc/names/names.h"
#include "tools/report/place_names.h"
#include "tools/scenario/words.h"

namespace rung::replay {
namespace {

// Sees the memory at the beginning of each part, when others have written.
class Inputs final : public runtime::OutsideWatch {
public:
  explicit Inputs(std::string& text) : text_(text) {}

  void know(const runtime::Instance& instance) { known_.assign(instance.block().begin(), instance.block().end()); }
  void begins(const runtime::Instance& instance, runtime::PartKind kind, uint32_t) noexcept override {
    if (depth_++ != 0) return;
    compare(instance);
    kind_ = kind;
  }
  void ended(const runtime::Instance& instance) noexcept override {
    if (--depth_ == 0) know(instance);
  }
  void withinBegins(const runtime::Instance&) noexcept override {}
  void withinEnded(const runtime::Instance&) noexcept override {}
  void requested(const runtime::Instance&, const core::ServiceRequest&, const core::ServiceReply*) noexcept override {}
  void replied(const runtime::Instance&, const core::ServiceReply&) noexcept override {}
  void written(const runtime::Instance&, uint32_t, uint32_t) noexcept override {}
  void surroundingsChanged(const runtime::Instance&) noexcept override {}
  void changedWhole(const runtime::Instance&) noexcept override {}

  // A part has run: counted, until something else is to be written.
  void count() {
    const std::string_view word = kind_ == runtime::PartKind::Slot   ? "slot"
                                  : kind_ == runtime::PartKind::Fast ? "fast"
                                                                     : "scan";
    if (word != word_) flush();
    word_ = word;
    ++count_;
  }
  void flush() {
    if (count_ != 0) rung::put(text_, "{} {}\n", word_, count_);
    count_ = 0;
  }

private:
  // The bits that are others than after the last part.
  void compare(const runtime::Instance& instance) {
    const rung_program& program = instance.program();
    const core::Memory before(program, known_.data());
    const core::Memory now = instance.memory();
    for (uint32_t s = 0; s < program.space_count; ++s) {
      const rung_space& space = program.spaces[s];
      if ((space.flags & RUNG_SPACE_HIDDEN) != 0) continue;
      for (uint32_t byte = 0; byte < space.byte_count; ++byte) {
        const uint8_t changed = before.readByte(s, byte) ^ now.readByte(s, byte);
        for (uint32_t bit = 0; changed != 0 && bit < 8; ++bit)
          if ((changed >> bit & 1) != 0) set(program, runtime::bitRef(s, byte, bit), now.readBit(s, byte, bit));
      }
    }
  }
  void set(const rung_program& program, const runtime::Ref& bit, bool value) {
    const std::string name = report::writtenName(program, bit);
    if (name.empty()) return;
    flush();
    rung::put(text_, "set {} {}\n", scenario::asWord(name), value ? 1 : 0);
  }

  std::string& text_;
  std::vector<uint8_t> known_;
  runtime::PartKind kind_ = runtime::PartKind::Scan;
  std::string_view word_;
  uint64_t count_ = 0;
  uint32_t depth_ = 0;
};

void putProgram(const Past& past, const std::string& path, std::string& text) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (compiler::findUpwards(folder.string())) return;
  text += "program";
  for (const std::string& file : past.compiled().shape->files)
    text += " " + scenario::asWord(std::filesystem::absolute(file).lexically_relative(folder).string());
  text += "\n";
}

// Bits of outputs with a name.
void putOutputs(const runtime::Instance& instance, std::string& text) {
  const rung_program& program = instance.program();
  for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    const runtime::Ref place = runtime::refOf(symbol);
    if (place.kind != runtime::RefKind::Bit || (symbol.flags & RUNG_SYMBOL_HIDDEN) != 0) continue;
    if ((program.spaces[place.space].flags & RUNG_SPACE_OUTPUT) == 0) continue;
    if ((program.spaces[place.space].flags & RUNG_SPACE_INPUT) != 0) continue;
    rung::put(text, "expect {} {}\n", scenario::asWord(symbol.name), instance.read(place));
  }
}

} // namespace

Result<std::string> scenarioOf(Past& past, const std::string& path, uint64_t from, uint64_t to) {
  if (std::string problem = past.goTo(from); !problem.empty()) return failure(problem);
  std::string text = fmt::format("# scans {} to {} of a recording\n", from + 1, to);
  putProgram(past, path, text);
  Inputs inputs(text);
  {
    FlowEngine& engine = past.flowEngine(); // whose new instance is as after a cold start
    const runtime::Instance cold(engine.engine());
    inputs.know(cold);
  }
  const uint32_t program = past.programNumber();
  past.watch(&inputs);
  while (past.part() < to && past.next() && past.programNumber() == program) inputs.count();
  past.watch(nullptr);
  inputs.flush();
  if (past.programNumber() != program) return failure("another program takes over in these scans");
  if (past.part() < to) return failure(past.problem().empty() ? "the recording ends before that" : past.problem());
  if (!past.instance().faulted()) putOutputs(past.instance(), text);
  return text;
}

} // namespace rung::replay

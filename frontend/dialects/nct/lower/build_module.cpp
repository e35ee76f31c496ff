// Builds the module (see build_module.h).
#include "frontend/dialects/nct/lower/build_module.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "frontend/dialects/nct/lower/lower_rungs.h"
#include "frontend/lower/module_items.h"
#include "ir/core/memory_use.h"
#include "rtlib/nc/faults.h"

namespace rung::frontend::nct {
namespace {

constexpr uint32_t kMainBudget = 1'000'000; // executed instructions (2.1, proposal)
constexpr uint32_t kInt0Budget = 100'000;

class ModuleBuilder {
public:
  ModuleBuilder(ir::Module& module, const Program& program, Symbols& symbols, const SourceManager& sources,
                const frontend::CompileOptions& options)
      : module_(module), program_(program), symbols_(symbols), config_(symbols.config()), sources_(sources),
        options_(options) {}

  void run(const Texts& texts, std::span<const FileId> files) {
    module_.name = "program";
    module_.dialect = "nct";
    module_.messages = texts.messages;
    module_.faults.emplace_back(nc::kNctTimeout); // l.540
    addSpaces();
    addSymbols();
    LoweringContext context{.module = module_,
                            .config = config_,
                            .spaces = spaces_,
                            .written = written_,
                            .sources = sources_,
                            .marks = options_.marks,
                            .given = options_.given,
                            .files = frontend::addFiles(module_, sources_, files)};
    const ir::RoutineId main = lowerModule(context, program_.main);
    const WrittenRange byMain = std::exchange(written_, {});
    const ir::RoutineId int0 = program_.int0.exists ? lowerModule(context, program_.int0) : ir::RoutineId{};
    addTasks({main, byMain}, {int0, written_});
    addSchedule();
  }

private:
  ir::SpaceId addSpace(ir::Space space) { return frontend::addSpace(module_, std::move(space)); }

  void addSpaces() {
    const uint32_t both = RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT;
    spaces_.m = addSpace({.name = "M", .unitBytes = 4, .units = kWords, .flags = both});
    spaces_.ts = addSpace({.name = "TS", .unitBytes = 4, .units = config_.plcNvram, .flags = both, .packedOnly = true});
    spaces_.written = addSpace({.name = "@W", .unitBytes = 4, .units = config_.plcNvram, .flags = RUNG_SPACE_HIDDEN});
    if (program_.int0.exists) flags_ = addSpace({.name = "@F", .unitBytes = 4, .units = 2, .flags = RUNG_SPACE_HIDDEN});
    if (usesScratch(program_.main) || usesScratch(program_.int0))
      spaces_.scratch = addSpace({.name = "@S", .unitBytes = 4, .units = kWords, .flags = RUNG_SPACE_HIDDEN});
    module_.retains.push_back({spaces_.m, config_.plcNvram * 4, (config_.plcRam - config_.plcNvram) * 4});
    addSafes();
  }

  static bool usesScratch(const TypedModule& module) {
    for (const TypedRung& rung : module.rungs)
      for (const TypedElement& element : rung.elements)
        if (element.row->usesScratch) return true;
    return false;
  }

  // The NC's outputs are safe spans: the words from the first to the last output signal.
  void addSafes() {
    const uint32_t first = config_.firstOutput * 4;
    uint32_t end = 0;
    for (const nc::Signal& signal : nc::nctSignals())
      if (signal.direction == nc::Direction::Out)
        end = std::max(end, signal.byteOffset + signal.count * signal.strideBytes);
    for (ir::SpaceId space : {spaces_.m, spaces_.ts}) module_.safeSpans.push_back({space, first, end - first});
  }

  void addSymbols() {
    for (const Symbol& symbol : symbols_.all()) {
      if (symbol.kind == SymbolKind::Bad) continue;
      ir::Symbol& added = module_.symbols.emplace_back();
      added.name = symbol.name;
      added.comment = symbol.comment;
      added.space = spaces_.m;
      added.byte = symbol.word * 4 + symbol.bit / 8;
      added.bit = symbol.bit % 8;
      if (symbol.signal != nullptr && symbol.signal->direction == nc::Direction::In)
        added.flags |= RUNG_SYMBOL_READONLY;
      if (symbol.isArea) added.flags |= RUNG_SYMBOL_AREA;
      setType(added, symbol);
    }
    frontend::settleSymbols(module_);
  }

  static void setType(ir::Symbol& added, const Symbol& symbol) {
    switch (symbol.kind) {
    case SymbolKind::Bad: return;
    case SymbolKind::Bit: added.type = RUNG_TYPE_BIT; return;
    case SymbolKind::Word:
      added.type = RUNG_TYPE_I32;
      if (symbol.signal == nullptr) return;
      added.count = symbol.signal->count;
      if (symbol.signal->type == nc::SignalType::Real) added.type = RUNG_TYPE_F64;
      return;
    case SymbolKind::Constant:
      added.flags |= RUNG_SYMBOL_CONST;
      added.space = {};
      added.byte = 0;
      const bool real = symbol.constant.kind == ConstantKind::Real;
      added.type = real ? RUNG_TYPE_F64 : RUNG_TYPE_I32;
      added.value = real ? std::bit_cast<int64_t>(symbol.constant.real) : symbol.constant.integer;
      return;
    }
  }

  ir::Copy copy(ir::SpaceId from, uint32_t fromByte, ir::SpaceId to, uint32_t toByte, uint32_t size) {
    ir::Copy copy;
    copy.from = {from, fromByte, size};
    copy.to = to;
    copy.toByte = toByte;
    return copy;
  }

  // Copies to the time-slice memory, restricted to the bits that were written.
  std::vector<ir::Copy> toTimeSlice(const WrittenRange& written) {
    const uint32_t first = written.first * 4;
    const uint32_t end = std::min(written.end * 4, synchronisedEnd_);
    if (written.first >= written.end || first >= end) return {};
    ir::Copy transfer = copy(spaces_.m, first, spaces_.ts, first, end - first);
    transfer.masked = true;
    transfer.mask = spaces_.written;
    transfer.maskByte = first;
    return {transfer};
  }

  // End of the part of the NC area that exists in both memories: words of signals, which the NC reads and writes, words
  // beyond them that a rung names, and words that it may reach by `!`. A word that the NC does not know, and that is
  // only reached by an index in the synchronised memory, exists once: the difference is not visible.
  uint32_t findSynchronisedEnd() const {
    const uint32_t nvram = config_.plcNvram * 4;
    uint32_t end = nc::areaBytes(nc::nctSignals(), "M");
    const auto take = [&](const ir::Use& use) {
      const uint32_t first = use.place.first / 32 * 4;
      const bool named = use.place.space == spaces_.ts || (use.place.space == spaces_.m && !use.computed);
      if (named && first < nvram) end = std::max(end, (use.place.first + use.place.count + 31) / 32 * 4);
    };
    for (const ir::Routine& routine : module_.routines)
      for (const ir::Rung& rung : routine.rungs)
        for (const ir::Op& op : rung.ops)
          if (const std::optional<ir::Use> use = ir::useOf(module_, op)) take(*use);
    return std::min(end, nvram);
  }

  // The lowered routine of a task, and the words it writes without `!`.
  struct Lowered {
    ir::RoutineId entry;
    WrittenRange written;
  };

  void addTasks(const Lowered& main, const Lowered& int0) {
    const ir::FaultId timeout{0};
    ir::Task task{.name = "MAIN",
                  .entry = main.entry,
                  .periodUs = config_.periodUs,
                  .budget = kMainBudget,
                  .budgetFault = timeout,
                  .begin = {},
                  .end = {},
                  .borders = {}};
    synchronisedEnd_ = findSynchronisedEnd();
    // Values that INT0 wrote without `!` since the last cycle must survive the synchronisation; no code reads the
    // time-slice memory between this point and the end of the run.
    task.begin = toTimeSlice(int0.written);
    // Everything but FLAGS; word 0001 of the time-slice memory is always 0, so writes to it are lost.
    task.begin.push_back(copy(spaces_.ts, 4, spaces_.m, 4, synchronisedEnd_ - 4));
    task.end = toTimeSlice(main.written);
    module_.mainTask = {0};
    module_.tasks.push_back(std::move(task));
    if (!int0.entry.valid()) return;
    // INT0 interrupts MAIN, so each has its own FLAGS (proposal 4): word 0 of @F keeps MAIN's, word 1 INT0's.
    ir::Task fast{.name = "INT0",
                  .entry = int0.entry,
                  .periodUs = config_.timesliceUs,
                  .budget = kInt0Budget,
                  .budgetFault = timeout,
                  .begin = {},
                  .end = {},
                  .borders = {}};
    fast.begin = {copy(spaces_.m, 0, flags_, 0, 4), copy(flags_, 4, spaces_.m, 0, 4)};
    fast.end = {copy(spaces_.m, 0, flags_, 4, 4), copy(flags_, 0, spaces_.m, 0, 4)};
    module_.fastTask = {1};
    module_.tasks.push_back(std::move(fast));
  }

  void addSchedule() {
    const auto advance = [&](uint32_t us) { return ir::Step{.op = RUNG_STEP_ADVANCE, .task = {}, .arg = us}; };
    const auto run = [&](ir::TaskId task) { return ir::Step{.op = RUNG_STEP_RUN, .task = task, .arg = 1}; };
    const uint32_t slices = config_.slices();
    const uint32_t slice = slices == 1 ? config_.periodUs : config_.timesliceUs;
    // Adds a time slice: its time passes, the NC writes its inputs and clocks, INT0 runs.
    const auto addSlice = [&](std::vector<ir::Step>& steps, uint32_t us) {
      steps.push_back(advance(us));
      steps.push_back({.op = RUNG_STEP_HOOK, .task = {}, .arg = 0});
      if (module_.fastTask.valid()) steps.push_back(run(module_.fastTask));
    };
    for (uint32_t i = 0; i < slices; ++i) {
      const bool last = i + 1 == slices;
      addSlice(module_.scan, last ? config_.periodUs - (slices - 1) * slice : slice);
    }
    module_.scan.push_back(run(module_.mainTask));
    addSlice(module_.fast, config_.timesliceUs);
  }

  ir::Module& module_;
  const Program& program_;
  Symbols& symbols_;
  const Config& config_;
  const SourceManager& sources_;
  const frontend::CompileOptions& options_;
  MemorySpaces spaces_;
  ir::SpaceId flags_;
  uint32_t synchronisedEnd_ = 0; // valid once the rungs are lowered
  WrittenRange written_;
};

} // namespace

std::unique_ptr<ir::Module> buildModule(const Program& program, Symbols& symbols, const Texts& texts,
                                        const SourceManager& sources, std::span<const FileId> files,
                                        const frontend::CompileOptions& options) {
  auto module = std::make_unique<ir::Module>();
  ModuleBuilder(*module, program, symbols, sources, options).run(texts, files);
  return module;
}

} // namespace rung::frontend::nct

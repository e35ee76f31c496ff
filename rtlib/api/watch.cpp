// Samples from the scan thread for other threads.
#include "rtlib/api/watch.h"

#include <algorithm>
#include <bit>
#include <fstream>

#include "rtlib/api/error.h"
#include "rtlib/api/instance.h"
#include "rtlib/api/values.h"
#include "rtlib/record/vcd.h"

namespace rung::api {

namespace {

rung_value valueOfWord(uint64_t word) noexcept { return std::bit_cast<rung_value>(word); }

// The value of a cell; 0 if the program no longer has it.
uint64_t wordOf(const rung_instance& instance, const core::Memory& memory, rung_cell number) noexcept {
  const LocatedCell& cell = *instance.now().cells.at(number);
  return cell.state == CellState::Good ? std::bit_cast<uint64_t>(firstValue(memory, cell)) : 0;
}

void show(const uint64_t* head, rung_sample& sample) noexcept {
  sample.generation = static_cast<uint32_t>(head[0]);
  sample.scan = head[1];
  sample.now_us = static_cast<int64_t>(head[2]);
}

} // namespace

bool Watches::add(rung_watch& watch) {
  const std::lock_guard lock(changes_);
  const auto free = std::ranges::find(watches_, nullptr, [](const auto& place) { return place.load(); });
  if (free == watches_.end()) return false;
  free->store(&watch);
  count_.fetch_add(1);
  return true;
}

void Watches::remove(rung_watch& watch) {
  const std::lock_guard lock(changes_);
  for (std::atomic<rung_watch*>& place : watches_) {
    if (place.load() != &watch) continue;
    place.store(nullptr);
    count_.fetch_sub(1);
  }
  sampling_.wait();
}

void Watches::sampleEach(const rung_instance& instance, bool onlyNew) noexcept {
  const uint64_t broken = instance.running.faulted() ? 1 : 0; // the scan that the fault has ended
  const SampleHead head{instance.running.generation(), instance.scans + broken,
                        static_cast<uint64_t>(instance.running.nowUs())};
  sampling_.enter();
  for (const std::atomic<rung_watch*>& place : watches_)
    if (rung_watch* watch = place.load(); watch != nullptr && (!onlyNew || watch->isNew())) watch->take(instance, head);
  sampling_.leave();
}

} // namespace rung::api

using namespace rung::api;

rung_watch::rung_watch(rung_instance& of, std::vector<rung_cell> watched, uint32_t depth)
    : instance(of), cells(std::move(watched)), scratch_(words()), newest_(words()), depth_(depth),
      kept_(depth * words()), ring_(depth) {
  for (const rung_cell cell : cells) instance.generations.names.hold(cell);
}

rung_watch::~rung_watch() {
  instance.watches.remove(*this);
  for (const rung_cell cell : cells) instance.generations.names.release(cell);
}

void rung_watch::take(const rung_instance& from, const SampleHead& head) noexcept {
  scratch_[0] = head.generation;
  scratch_[1] = head.scan;
  scratch_[2] = head.nowUs;
  const rung::core::Memory memory = from.running.memory();
  for (size_t i = 0; i < cells.size(); ++i) scratch_[kHeadWords + i] = wordOf(from, memory, cells[i]);

  newest_.publish(scratch_);
  if (depth_ == 0) return;
  const std::optional<size_t> slot = ring_.back();
  if (!slot) {
    lost_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  std::ranges::copy(scratch_, kept_.begin() + static_cast<ptrdiff_t>(*slot * words()));
  ring_.push();
}

int32_t rung_watch::newest(rung_value* values, rung_sample& sample) const noexcept {
  uint64_t head[kHeadWords];
  const rung::core::Looked looked = newest_.read([&](size_t i, uint64_t word) {
    if (i < kHeadWords)
      head[i] = word;
    else
      values[i - kHeadWords] = valueOfWord(word);
  });
  if (looked == rung::core::Looked::Empty) return RUNG_EMPTY;
  if (looked == rung::core::Looked::Interrupted)
    return fail(RUNG_LATER, "the thread was interrupted again and again while it read; try again");
  show(head, sample);
  sample.lost = lost_.load(std::memory_order_relaxed);
  return RUNG_OK;
}

int32_t rung_watch::next(rung_value* values, rung_sample& sample) noexcept {
  const std::optional<size_t> slot = ring_.front();
  if (!slot) return RUNG_EMPTY;
  const uint64_t* words = kept_.data() + *slot * this->words();
  show(words, sample);
  for (size_t i = 0; i < cells.size(); ++i) values[i] = valueOfWord(words[kHeadWords + i]);
  sample.lost = lost_.load(std::memory_order_relaxed);
  ring_.pop();
  return RUNG_OK;
}

namespace {

constexpr uint32_t kDeepest = 1'000'000;

rung_watch* watchOf(const rung_watch* handle) noexcept { return const_cast<rung_watch*>(checked(handle, kWatchMark)); }

template <class Take>
int32_t giveSample(const rung_watch* handle, rung_value* values, rung_sample* sample, Take take) noexcept {
  rung_watch* watch = watchOf(handle);
  if (watch == nullptr) return failHandle("a watch");
  if (values == nullptr || sample == nullptr || !hasSize(sample))
    return fail(RUNG_BAD_ARGUMENT, "a sample needs a place for its values, and the size of its struct");
  rung_sample out{};
  const int32_t status = take(*watch, out);
  return status == RUNG_OK ? giveStruct(sample, out) : status;
}

} // namespace

int32_t rung_watch_new(rung_instance* instance, const rung_cell* cells, uint32_t count, uint32_t depth,
                       rung_watch** watch) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  if (cells == nullptr || count == 0 || watch == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "a watch needs a cell at least, and a place for itself");
  if (depth > kDeepest) return fail(RUNG_BAD_ARGUMENT, "a watch keeps at most %u scans, not %u", kDeepest, depth);
  for (uint32_t i = 0; i < count; ++i) {
    const std::optional<rung_type> type = handle->generations.names.typeOf(cells[i]);
    if (!type) return fail(RUNG_BAD_ARGUMENT, "%u is not a cell of this instance", cells[i]);
    if (*type == RUNG_TYPE_TEXT) return fail(RUNG_WRONG_TYPE, "cell %u is a text: texts cannot be watched", cells[i]);
  }
  return contained([&] {
    auto made = std::make_unique<rung_watch>(*handle, std::vector<rung_cell>(cells, cells + count), depth);
    if (!handle->watches.add(*made))
      return fail(RUNG_WRONG_STATE, "an instance has at most %u watches", RUNG_MOST_WATCHES);
    *watch = made.release();
    return int32_t{RUNG_OK};
  });
}

int32_t rung_watch_free(rung_watch* watch) { return endHandle(watch, kWatchMark, "a watch"); }

int32_t rung_watch_newest(const rung_watch* watch, rung_value* values, rung_sample* sample) {
  return giveSample(watch, values, sample,
                    [&](rung_watch& from, rung_sample& out) { return from.newest(values, out); });
}

int32_t rung_watch_next(rung_watch* watch, rung_value* values, rung_sample* sample) {
  return giveSample(watch, values, sample, [&](rung_watch& from, rung_sample& out) { return from.next(values, out); });
}

using namespace rung;
using namespace rung::api;

namespace {

runtime::TracedName describe(rung_instance& instance, const Generation& program, rung_cell cell) {
  const LocatedCell& located = *program.cells.at(cell);
  const bool inMemory = located.state == CellState::Good && located.ref.kind != runtime::RefKind::Constant;
  runtime::TracedName name{.name = instance.generations.names.nameOf(cell)};
  name.scope = inMemory ? program.program().spaces[located.ref.space].name : "constants";
  if (located.type == RUNG_TYPE_F64) name.kind = runtime::TracedKind::Real;
  name.width = inMemory ? located.ref.width : 64;
  return name;
}

} // namespace

struct rung_trace {
  rung_trace(rung_watch& of, const char* path) : watch(of), out(path, std::ios::binary), vcd(out) {
    const std::shared_ptr<const Generation> program = watch.instance.generations.running();
    std::vector<runtime::TracedName> names;
    for (const rung_cell cell : watch.cells) names.push_back(describe(watch.instance, *program, cell));
    values.resize(names.size());
    shown.resize(names.size());
    vcd.begin(program->program().name, names);
  }

  bool writeNext() {
    rung_sample sample{};
    if (watch.next(values.data(), sample) != RUNG_OK) return false;
    for (size_t i = 0; i < values.size(); ++i)
      shown[i] = {.known = true, .integer = static_cast<uint64_t>(values[i].integer), .real = values[i].real};
    vcd.sample(sample.now_us, shown, sample.lost);
    return true;
  }

  uint32_t mark = kTraceMark;
  rung_watch& watch;
  std::ofstream out;
  runtime::VcdWriter vcd;
  std::vector<rung_value> values;
  std::vector<runtime::TracedValue> shown;
};

namespace {

int32_t failFile() { return fail(RUNG_FAILED, "the file of the trace cannot be written"); }

} // namespace

int32_t rung_trace_new(rung_watch* watch, const char* path, rung_trace** trace) {
  rung_watch* handle = checked(watch, kWatchMark);
  if (handle == nullptr) return failHandle("a watch");
  if (path == nullptr || trace == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "a trace needs the name of a file, and a place for itself");
  if (!handle->keepsScans()) return fail(RUNG_BAD_ARGUMENT, "the watch keeps no scans: make it with a depth above 0");
  return contained([&] {
    auto made = std::make_unique<rung_trace>(*handle, path);
    if (!made->out) return fail(RUNG_FAILED, "%s cannot be written", path);
    *trace = made.release();
    return int32_t{RUNG_OK};
  });
}

int32_t rung_trace_write(rung_trace* trace) {
  rung_trace* handle = checked(trace, kTraceMark);
  if (handle == nullptr) return failHandle("a trace");
  return contained([&] {
    if (!handle->writeNext()) return int32_t{RUNG_EMPTY};
    while (handle->writeNext()) {
    }
    handle->out.flush();
    return handle->out ? int32_t{RUNG_OK} : failFile();
  });
}

int32_t rung_trace_free(rung_trace* trace) {
  if (trace == nullptr) return RUNG_OK;
  rung_trace* handle = checked(trace, kTraceMark);
  if (handle == nullptr) return failHandle("a trace");
  return contained([&] {
    while (handle->writeNext()) {
    }
    handle->vcd.end();
    handle->out.close();
    const bool good = static_cast<bool>(handle->out);
    release(handle);
    return good ? int32_t{RUNG_OK} : failFile();
  });
}

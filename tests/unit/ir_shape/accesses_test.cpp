// What the tables say of reading: a run does the same whatever lies where its task does not read.
#include "ir/shape/accesses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "ir/interp/interp.h"
#include "rtlib/run/instance.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

class Marks {
public:
  explicit Marks(const rung_program& program) : program_(program), bytes_(program.memory_size, false) {}
  void addSpaces() {
    for (uint32_t s = 0; s < program_.space_count; ++s)
      for (uint32_t r = 0; r < program_.spaces[s].range_count; ++r) {
        const rung_range& range = program_.spaces[s].ranges[r];
        set({range.offset, range.byte_count * (range.repr == RUNG_REPR_PACKED ? 1 : 8)}, true);
      }
  }
  void removeReads(const rung_task& task) {
    for (uint32_t i = 0; i < task.read_count; ++i) set(program_.reads[task.read_first + i], false);
  }
  // What copies move is not the task's own.
  void removeCopies() {
    for (uint32_t i = 0; i < program_.copy_count; ++i) {
      const rung_copy& copy = program_.copies[i];
      set({copy.from, copy.size}, false);
      set({copy.to, copy.size}, false);
      if (copy.kind == RUNG_COPY_MASKED) set({copy.mask, copy.size}, false);
    }
  }
  void removeSafes() {
    for (uint32_t i = 0; i < program_.safe_count; ++i) set(program_.safe_spans[i], false);
  }
  // A store of a bit of a byte leaves the rest of it.
  void removeWrites() {
    for (uint32_t i = 0; i < program_.write_count; ++i)
      set({program_.writes[i].offset, program_.writes[i].size}, false);
  }
  bool at(uint32_t offset) const { return bytes_[offset]; }

private:
  void set(const rung_span& span, bool value) {
    for (uint32_t i = 0; i < span.size; ++i) bytes_[span.offset + i] = value;
  }
  const rung_program& program_;
  std::vector<bool> bytes_;
};

TEST(Accesses, ARunReadsNothingElse) {
  uint32_t changed = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Module module = randomModule(seed, {.rungs = 8, .ops = 10, .host = false});
    const Layout layout(module, {});
    for (uint32_t task = 0; task < module.tasks.size(); ++task) {
      InterpEngine engine(layout, 1);
      runtime::Instance plain(engine);
      runtime::Instance other(engine);
      Marks unread(plain.program());
      unread.addSpaces();
      unread.removeReads(plain.program().tasks[task]);
      unread.removeCopies();
      unread.removeWrites();
      unread.removeSafes();
      for (uint32_t i = 0; i < plain.program().memory_size; ++i) {
        if (!unread.at(i)) continue;
        other.block()[i] ^= 1;
        ++changed;
      }
      EXPECT_EQ(plain.runTask(task), other.runTask(task));
      for (uint32_t i = 0; i < plain.program().memory_size; ++i)
        ASSERT_EQ(plain.block()[i], other.block()[i] ^ (unread.at(i) ? 1 : 0)) << "task " << task << ", byte " << i;
    }
  }
  EXPECT_GT(changed, 1000u);
}

TEST(Accesses, SpansAreAscendingAndApart) {
  uint32_t most = 0;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Module module = randomModule(seed);
    const Layout layout(module, {});
    for (uint32_t task = 0; task < module.tasks.size(); ++task) {
      const std::vector<rung_span> spans = readBytes(layout.memory(), TaskId{task});
      for (size_t i = 1; i < spans.size(); ++i) ASSERT_GT(spans[i].offset, spans[i - 1].offset + spans[i - 1].size);
      most = std::max(most, static_cast<uint32_t>(spans.size()));
    }
  }
  EXPECT_GT(most, 3u);
}

// With it each run of a row is done by itself.
class Watch : public runtime::TaskWatch {
public:
  void begins(const runtime::Instance&, uint32_t) override {}
  void ended(const runtime::Instance&, uint32_t) override {}
};

// Each in the state after the others, at one time: the runner leaves out the rest of a row whose task changes nothing
// any more.
TEST(Accesses, ARowOfRunsIsWhatTheRunsAreOneByOne) {
  constexpr uint32_t kTimes = 6;
  Watch watch;
  uint32_t promised = 0;
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Module module = randomModule(seed, {.routines = 2, .rungs = 2, .ops = 5, .host = seed % 4 == 0});
    module.scan = {{.op = RUNG_STEP_ADVANCE, .task = {}, .arg = 1000},
                   {.op = RUNG_STEP_RUN, .task = module.mainTask, .arg = kTimes}};
    const Layout layout(module, {});
    InterpEngine engine(layout, 1);
    runtime::Instance row(engine);
    runtime::Instance single(engine);
    promised += row.program().tasks[module.mainTask.index].change_count != 0 ? 1 : 0;
    single.setTaskWatch(&watch);
    for (int scan = 0; scan < 3; ++scan) {
      row.scan();
      single.scan();
      for (uint32_t i = 0; i < row.program().memory_size; ++i)
        ASSERT_EQ(row.block()[i], single.block()[i]) << "scan " << scan << ", byte " << i;
      ASSERT_EQ(row.faulted(), single.faulted());
    }
  }
  EXPECT_GT(promised, 200u);
}

} // namespace
} // namespace rung::ir

// Tables of program files as somebody wrote them who can seal a file: they are refused with a reason, or the program
// can be switched on, scanned, and prepared to be replaced. RUNG_MUTATIONS=N tries N of each example, in processes of
// their own, which a fault of the host would end.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <random>
#include <span>

#include "ir/support/temporary_folder.h"
#include "rtlib/load/file.h"
#include "rtlib/load/program_info.h"
#include "rtlib/load/so_engine.h"
#include "rung/runtime.hpp"
#include "tests/fuzz/mutations.h"

namespace {

using namespace rung;

using Region = std::span<uint32_t>;

// Not the memory block's size and the code itself: those are a matter of who has made the code.
std::vector<Region> tablesOf(const rung_program& p) {
  std::vector<Region> regions;
  const auto add = [&](const auto* table, uint32_t count) {
    if (count != 0)
      regions.push_back(
          {reinterpret_cast<uint32_t*>(const_cast<std::remove_const_t<std::remove_pointer_t<decltype(table)>>*>(table)),
           count * sizeof *table / sizeof(uint32_t)});
  };
  const uint32_t* const counts = &p.space_count;
  add(counts, static_cast<uint32_t>(&p.change_count - counts) + 1);
  for (int weight = 0; weight < 3; ++weight) add(counts, static_cast<uint32_t>(&p.change_count - counts) + 1);
  add(p.spaces, p.space_count);
  for (uint32_t i = 0; i < p.space_count; ++i) add(p.spaces[i].ranges, p.spaces[i].range_count);
  add(p.symbols, p.symbol_count);
  add(p.slots, p.slot_count);
  add(p.continuations, p.continuation_count);
  add(p.timers, p.timer_count);
  add(p.inits, p.init_count);
  add(p.retains, p.retain_count);
  add(p.safe_spans, p.safe_count);
  add(p.copies, p.copy_count);
  add(p.chunks, p.chunk_count);
  add(p.rungs, p.rung_count);
  add(p.tasks, p.task_count);
  add(p.part_ends, p.part_end_count);
  add(p.scan, p.scan_count);
  add(p.fast, p.fast_count);
  add(p.slices, p.slice_count);
  add(p.writes, p.write_count);
  add(p.reads, p.read_count);
  add(p.changes, p.change_count);
  add(reinterpret_cast<const uint64_t*>(p.routines), p.routine_count);
  add(reinterpret_cast<const uint64_t*>(p.texts), p.text_count);
  return regions;
}

void makeWritable(Region region) {
  const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
  const uintptr_t begin = reinterpret_cast<uintptr_t>(region.data()) / page * page;
  const uintptr_t end = (reinterpret_cast<uintptr_t>(region.data() + region.size()) + page - 1) / page * page;
  ASSERT_EQ(mprotect(reinterpret_cast<void*>(begin), end - begin, PROT_READ | PROT_WRITE), 0) << std::strerror(errno);
}

uint32_t hostile(std::mt19937_64& random, uint32_t former) {
  switch (random() % 8) {
  case 0: return 0;
  case 1: return UINT32_MAX;
  case 2: return 1u << random() % 32;
  case 3: return former + 1;
  case 4: return former - 1;
  case 5: return former ^ 1u << random() % 32;
  case 6: return static_cast<uint32_t>(random() % 4096);
  default: return static_cast<uint32_t>(random());
  }
}

// What a host does with a program that has passed the check.
void use(const rung_program& program, runtime::Engine& engine) try {
  Instance plc(Image::adopt(program, engine.context()));
  plc.powerOn();
  for (int i = 0; i < 3; ++i) plc.scan();
  for (uint32_t i = 0; i < program.symbol_count; i += 1 + program.symbol_count / 8) {
    rung_cell cell = 0;
    (void)rung_instance_find(plc.handle(), program.symbols[i].name, RUNG_READ, &cell);
  }
  const Image next = Image::adopt(program, engine.context());
  rung_replacement* replacement = nullptr;
  if (rung_replacement_new(plc.handle(), next.handle(), nullptr, 0, &replacement) == RUNG_OK)
    (void)rung_instance_replace(plc.handle(), replacement);
  plc.scan();
  (void)rung_replacement_free(replacement);
} catch (const Error&) { // a reason
}

class HostileTables : public testing::TestWithParam<const char*> {};

TEST_P(HostileTables, AreRefusedOrHarmless) {
  const TemporaryFolder folder;
  const std::string path = (folder / "program.so").string();
  const std::string build = std::string(RUNG_TEST_RUNGC) + " build -q " + GetParam() + " -o " + path;
  ASSERT_EQ(std::system(build.c_str()), 0) << build;
  std::string error;
  const std::unique_ptr<runtime::SoEngine> engine = runtime::SoEngine::open(path, error);
  ASSERT_NE(engine, nullptr) << error;
  const rung_program& program = engine->program();
  Dl_info where{};
  ASSERT_NE(dladdr(&program, &where), 0);
  void* const library = dlopen(where.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  ASSERT_NE(library, nullptr) << dlerror();
  const runtime::MappedFile file(library);
  ASSERT_EQ(runtime::checkProgram(program, &file), "");
  const std::vector<Region> regions = tablesOf(program);
  for (const Region& region : regions) makeWritable(region);

  struct Shared {
    long number;
    long accepted;
  };
  auto* const shared =
      static_cast<Shared*>(mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(shared, MAP_FAILED);
  constexpr long kEach = 50; // in a process
  constexpr unsigned kMostSeconds = 120;
  const long count = fuzz::mutationsOfEach(200);
  for (long first = 0; first < count; first += kEach) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      alarm(kMostSeconds);
      for (shared->number = first; shared->number < first + kEach; ++shared->number) {
        std::mt19937_64 random(static_cast<uint64_t>(shared->number));
        std::vector<std::pair<uint32_t*, uint32_t>> former;
        for (size_t edits = 1 + random() % 3; edits > 0; --edits) {
          const Region region = regions[random() % regions.size()];
          uint32_t& word = region[random() % region.size()];
          former.emplace_back(&word, word);
          word = hostile(random, word);
        }
        if (runtime::checkProgram(program, &file).empty()) {
          ++shared->accepted;
          use(program, *engine);
        }
        for (auto edit = former.rbegin(); edit != former.rend(); ++edit) *edit->first = edit->second;
      }
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
        << "mutation " << shared->number << ": "
        << (WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "the host has ended");
  }
  EXPECT_GT(shared->accepted, 0) << "some do not matter";
  EXPECT_LT(shared->accepted, count);
  munmap(shared, sizeof(Shared));
  dlclose(library);
}

INSTANTIATE_TEST_SUITE_P(Examples, HostileTables,
                         testing::Values("examples/fanuc-vmc", "examples/gsk-mill", "examples/gsk-panel",
                                         "examples/nct-lathe", "examples/technol-magazine", "examples/technol-mill"),
                         [](const auto& tested) {
                           std::string name = std::string(tested.param).substr(9);
                           std::erase(name, '-');
                           return name;
                         });

} // namespace

// What of a program is touched before a scan, and that touching only reads.
#include "rtlib/run/footprint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <utility>
#include <vector>

#include "rtlib/load/so_engine.h"
#include "rtlib/run/realtime.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using namespace rung::runtime;
using rung::test::TestProgram;

constexpr int64_t kSecond = 1'000'000'000;

uint32_t done(uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; }

// Four spaces of `unit` bytes, and as much that is in none: the first is read, the second written, the third neither,
// the fourth copied to the first.
void build(TestProgram& program, uint32_t unit) {
  program.memorySize = 5 * unit;
  uint32_t offset = 0;
  for (const char* name : {"A", "B", "C", "D"}) program.addPacked(name, 1, unit, std::exchange(offset, offset + unit));
  program.addTask("MAIN", program.addChunk(&done));
  program.addReads(0, {{70, 1}});
  program.writes = {{unit + 1, 1, 255}, {unit + 130, 2, 255}};
  program.addBeginCopy(0, {RUNG_COPY_ALL, 3 * unit, 0, 0, 8});
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
}

std::vector<std::pair<uint32_t, uint32_t>> partsOf(const TestProgram& program) {
  std::vector<std::pair<uint32_t, uint32_t>> parts; // first byte, bytes
  const Footprint footprint(program.program, true);
  for (const rung_span& part : footprint.memory()) parts.emplace_back(part.offset, part.size);
  return parts;
}

TEST(Footprint, HasWholeLinesOfWhatTheProgramUses) {
  TestProgram program;
  build(program, 256);
  EXPECT_THAT(partsOf(program),
              testing::ElementsAre(std::pair(0, 128), // copied to, read
                                   std::pair(256, 64), std::pair(384, 64), std::pair(768, 64), std::pair(1024, 256)));
}

TEST(Footprint, HasBothSidesOfAnImageAndItsMask) {
  TestProgram program;
  program.memorySize = 1024;
  program.addPacked("A", 1, 1024, 0);
  program.addTask("MAIN", program.addChunk(&done));
  program.addEndCopy(0, {RUNG_COPY_MASKED, 128, 384, 640, 65});
  program.link();
  EXPECT_THAT(partsOf(program), testing::ElementsAre(std::pair(128, 128), std::pair(384, 128), std::pair(640, 128)));
}

TEST(Footprint, ExpandedBitsTakeAByteEach) {
  TestProgram program;
  program.memorySize = 512;
  program.addSpace("A", 1, {{0, 32, 0, RUNG_REPR_BYTE_PER_BIT}});
  program.addTask("MAIN", program.addChunk(&done));
  program.link();
  EXPECT_THAT(partsOf(program), testing::ElementsAre(std::pair(256, 256)));
}

TEST(Footprint, EndsWithTheBlock) {
  TestProgram program;
  program.memorySize = 100;
  program.addPacked("A", 1, 90, 0);
  program.addTask("MAIN", program.addChunk(&done));
  program.link();
  EXPECT_THAT(partsOf(program), testing::ElementsAre(std::pair(64, 36)));
}

// ---- touching ----

// A memory block of pages that nothing may be done to; a page that is touched can be read from then on.
class Pages {
public:
  explicit Pages(size_t count)
      : bytes_(static_cast<size_t>(sysconf(_SC_PAGESIZE)) * count),
        first_(static_cast<uint8_t*>(mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))) {
    here = this;
    struct sigaction action{};
    action.sa_sigaction = &touched;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGSEGV, &action, &before_);
  }
  ~Pages() {
    sigaction(SIGSEGV, &before_, nullptr);
    munmap(first_, bytes_);
    here = nullptr;
  }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  const uint8_t* block() const { return first_; }
  const std::vector<size_t>& touches() const { return touches_; }

private:
  static inline Pages* here = nullptr;
  static void touched(int, siginfo_t* info, void*) {
    const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
    const size_t at = static_cast<size_t>(static_cast<uint8_t*>(info->si_addr) - here->first_) / page;
    if (at >= here->bytes_ / page || here->touches_.size() == here->touches_.capacity()) _exit(99);
    here->touches_.push_back(at); // a second time where it was written
    mprotect(here->first_ + at * page, page, PROT_READ);
  }

  size_t bytes_;
  uint8_t* first_;
  std::vector<size_t> touches_ = [] {
    std::vector<size_t> room;
    room.reserve(16);
    return room;
  }();
  struct sigaction before_{};
};

TEST(Footprint, IsReadAndNeverWritten) {
  TestProgram program;
  build(program, static_cast<uint32_t>(sysconf(_SC_PAGESIZE)));
  const Footprint footprint(program.program, true);
  const Pages pages(5);
  footprint.prefetch(pages.block(), monotonicNs() + kSecond);
  EXPECT_THAT(pages.touches(), testing::ElementsAre(0, 1, 3, 4));
}

TEST(Footprint, IsLeftAloneWhereTheTimeIsOver) {
  TestProgram program;
  build(program, static_cast<uint32_t>(sysconf(_SC_PAGESIZE)));
  const Footprint footprint(program.program, true);
  const Pages pages(5);
  footprint.prefetch(pages.block(), monotonicNs());
  EXPECT_THAT(pages.touches(), testing::IsEmpty());
}

TEST(Footprint, MayBeginWithinALine) {
  TestProgram program;
  build(program, 256);
  std::vector<uint8_t> block(program.memorySize + 8, 7);
  const std::vector<uint8_t> before = block;
  for (size_t shift = 0; shift <= 8; ++shift)
    Footprint(program.program, false).prefetch(block.data() + shift, monotonicNs() + kSecond);
  EXPECT_EQ(block, before);
}

// ---- code ----

bool has(std::span<const uint8_t> code, rung_chunk_fn function) {
  const auto at = reinterpret_cast<uintptr_t>(function);
  const auto first = reinterpret_cast<uintptr_t>(code.data());
  return at >= first && at - first < code.size();
}

TEST(Footprint, HasTheCodeOfASharedObject) {
  std::string error;
  const auto engine = SoEngine::open(RUNG_TEST_SO_GOOD, error, {.mayLackSeal = true});
  ASSERT_NE(engine, nullptr) << error;
  const Footprint footprint(engine->program(), true);
  EXPECT_TRUE(has(footprint.code(), engine->program().chunk_fns[0]));
  EXPECT_FALSE(has(footprint.code(), &done));
  EXPECT_LT(footprint.code().size(), 65536u);
  std::array<uint8_t, 16> block{};
  footprint.prefetch(block.data(), monotonicNs() + kSecond);
  EXPECT_EQ(block, (std::array<uint8_t, 16>{}));
}

TEST(Footprint, HasNoCodeThatLiesInNoFile) {
  TestProgram program;
  alignas(16) static std::array<uint8_t, 16> made{}; // as a compiler in the process makes it
  program.addTask("MAIN", program.addChunk(reinterpret_cast<rung_chunk_fn>(made.data())));
  program.link();
  EXPECT_TRUE(Footprint(program.program, true).code().empty());
}

TEST(Footprint, HasNoCodeOfTheHost) {
  TestProgram program;
  program.addTask("MAIN", program.addChunk(&done));
  program.link();
  EXPECT_TRUE(Footprint(program.program, false).code().empty());
}

TEST(Footprint, OfAProgramWithoutChunks) {
  TestProgram program;
  program.link();
  const Footprint footprint(program.program, true);
  EXPECT_TRUE(footprint.code().empty());
  std::vector<uint8_t> block(program.memorySize);
  footprint.prefetch(block.data(), monotonicNs() + kSecond);
}

} // namespace

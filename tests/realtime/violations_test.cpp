// The guard notices what a program does in its scan, whichever host runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>

#include <cstdlib>
#include <mutex>

#include "ir/support/temporary_folder.h"
#include "tests/realtime/guard.h"
#include "tests/realtime/hosts.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::test {
namespace {

Offence asked = Offence::Allocation;
void* volatile block = nullptr; // else the compiler leaves the allocation out
std::mutex mutex;

// In its hundredth scan.
uint32_t offend(uint8_t* mem, rung_ctx*, uint32_t) {
  if (++mem[16] != 100) return RUNG_PC_DONE;
  switch (asked) {
  case Offence::Allocation: block = std::malloc(10); break;
  case Offence::Lock: mutex.lock(), mutex.unlock(); break;
  case Offence::SystemCall: static_cast<void>(::open("/dev/null", O_RDONLY)); break;
  }
  return RUNG_PC_DONE;
}

void build(TestProgram& program, rung_chunk_fn code) {
  program.dialect = "gsk";
  program.addSpace("X", 1, {{0, 16, 0, RUNG_REPR_PACKED}}, RUNG_SPACE_INPUT);
  program.addPacked("D", 1, 16, 16);
  program.addChunk(code);
  program.addTask("MAIN", 0);
  program.retains = {{16, 16}};
  program.scan = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
  program.link();
}

enum class Host { PlcHost, Bare, Clock };

Outcome run(Host host, const rung_program& program, const std::string& retain) {
  switch (host) {
  case Host::PlcHost: return runInBox(program, {}, retain);
  case Host::Bare: return runBare(program, retain);
  case Host::Clock: return runOnClock(program, retain);
  }
  return {};
}

// In a process of its own: the sanitizer ends it.
[[noreturn]] void runAndExit(Host host, rung_chunk_fn code) {
  TestProgram program;
  build(program, code);
  Outcome outcome;
  {
    const TemporaryFolder folder;
    outcome = run(host, program.program, (folder / "plc").string());
  }
  std::fprintf(stderr, "%s, %d slices, %d messages", outcome.problem.c_str(), static_cast<int>(outcome.slices),
               static_cast<int>(outcome.messages));
  std::exit(outcome.problem.empty() ? 0 : 1);
}

// How both guards say it.
const char* reportOf(Offence offence) {
  switch (offence) {
  case Offence::Allocation: return "slice [0-9]+: 1 calls of the heap|function `malloc`";
  case Offence::Lock: return "function `pthread_mutex_lock`";
  case Offence::SystemCall: return "slice [0-9]+: 1 system calls|function `open`";
  }
  return "";
}

class Noticed : public testing::TestWithParam<std::tuple<Host, Offence>> {};

TEST_P(Noticed, InAScan) {
  const auto [host, offence] = GetParam();
  asked = offence;
  EXPECT_EXIT(runAndExit(host, offend), [](int status) { return status != 0; }, reportOf(offence));
}

std::string hostName(Host host) { return host == Host::PlcHost ? "PlcHost" : host == Host::Bare ? "Bare" : "Clock"; }

INSTANTIATE_TEST_SUITE_P(Guard, Noticed,
                         testing::Combine(testing::Values(Host::PlcHost, Host::Bare, Host::Clock),
                                          testing::ValuesIn(Guard::seen())),
                         [](const auto& tested) {
                           return hostName(std::get<0>(tested.param)) + std::string(name(std::get<1>(tested.param)));
                         });

// Its messages are taken, too.
class Clean : public testing::TestWithParam<Host> {};

TEST_P(Clean, Program) {
  const auto harmless = [](uint8_t* mem, rung_ctx* ctx, uint32_t) {
    const rung_message message = {RUNG_MESSAGE_SHOW, 20, 0, 0, 0, 0, 0};
    if (++mem[16] % 10 == 0) ctx->host->message(ctx, &message);
    return RUNG_PC_DONE;
  };
  EXPECT_EXIT(runAndExit(GetParam(), harmless), testing::ExitedWithCode(0),
              "^, 1[0-2][0-9][0-9] slices, 1[0-3][0-9] messages");
}

INSTANTIATE_TEST_SUITE_P(Guard, Clean, testing::Values(Host::PlcHost, Host::Bare, Host::Clock),
                         [](const auto& tested) { return hostName(tested.param); });

} // namespace
} // namespace rung::test

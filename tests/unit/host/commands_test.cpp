// Orders between threads: done once by the scan thread, or withdrawn and never done.
#include "machine/host/commands.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace rung::host {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLong(10000);

CommandResult given(CommandSlot& slot, Command& command, milliseconds time) {
  return slot.give(command, time, runtime::systemClock(), [] {});
}

// A scan thread that takes commands again and again.
class Scanning {
public:
  template <class Execute>
  Scanning(CommandSlot& slot, Execute execute)
      : thread_([this, &slot, execute] {
          while (!end_) slot.take(execute);
        }) {}
  ~Scanning() {
    end_ = true;
    thread_.join();
  }

private:
  std::atomic<bool> end_{false};
  std::thread thread_;
};

TEST(Orders, AreDoneWithTheirResults) {
  CommandSlot slot;
  const Scanning scanning(slot, [](Command& command) {
    command.former.integer = command.value.integer - 1;
    return CommandSlot::Outcome{};
  });
  for (int i = 0; i < 20; ++i) {
    Command command{.kind = Command::Kind::Write, .cell = 7, .value = {.integer = i}};
    const CommandResult answer = given(slot, command, kLong);
    EXPECT_TRUE(answer.ok());
    EXPECT_EQ(answer.problem, "");
    EXPECT_EQ(command.former.integer, i - 1);
  }
}

TEST(Orders, WithoutAScanAreWithdrawn) {
  CommandSlot slot;
  Command command;
  const CommandResult answer = given(slot, command, milliseconds(5));
  EXPECT_EQ(answer.status, RUNG_FAILED);
  EXPECT_EQ(answer.problem, "the scan thread does not run");
  bool done = false;
  slot.take([&](Command&) { return done = true, CommandSlot::Outcome{}; });
  EXPECT_FALSE(done) << "it was withdrawn";
}

TEST(Orders, ThatCannotBeDoneNowAreTriedAgain) {
  CommandSlot slot;
  std::atomic<int> tries{0};
  const Scanning scanning(slot, [&](Command&) { return CommandSlot::Outcome{++tries < 100 ? RUNG_LATER : RUNG_OK}; });
  Command command{.kind = Command::Kind::Replace};
  EXPECT_TRUE(given(slot, command, kLong).ok());
  EXPECT_EQ(tries, 100);
}

TEST(Orders, ThatNeverCanBeDoneSayWhy) {
  CommandSlot slot;
  const Scanning scanning(slot,
                          [](Command&) { return CommandSlot::Outcome{RUNG_LATER, "the program is within a scan"}; });
  Command command{.kind = Command::Kind::Replace};
  const CommandResult answer = given(slot, command, milliseconds(20));
  EXPECT_EQ(answer.status, RUNG_LATER);
  EXPECT_EQ(answer.problem, "the program is within a scan");
}

TEST(Orders, OfSeveralThreadsWaitForEachOther) {
  CommandSlot slot;
  const Scanning scanning(slot, [](Command& command) {
    command.former = command.value;
    return CommandSlot::Outcome{};
  });
  std::thread others[3];
  std::atomic<int> wrong{0};
  for (std::thread& other : others)
    other = std::thread([&, number = &other - others] {
      for (int i = 0; i < 50; ++i) {
        Command command{.kind = Command::Kind::Write, .value = {.integer = number * 1000 + i}};
        if (!given(slot, command, kLong).ok() || command.former.integer != number * 1000 + i) ++wrong;
      }
    });
  for (std::thread& other : others) other.join();
  EXPECT_EQ(wrong, 0);
}

// Whichever comes first: a command is done and says so, or it is not done.
TEST(Orders, AreWithdrawnOrDone) {
  CommandSlot slot;
  std::atomic<int> done{0};
  int said = 0;
  {
    const Scanning scanning(slot, [&](Command&) { return ++done, CommandSlot::Outcome{}; });
    for (int i = 0; i < 300; ++i) {
      Command command;
      said += given(slot, command, milliseconds(0)).ok() ? 1 : 0;
    }
  }
  EXPECT_EQ(said, done);
}

} // namespace
} // namespace rung::host

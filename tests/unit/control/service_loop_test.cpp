// What the loop of the serving thread waits for: signals, and clients where the system has no file for another one.
#include "machine/control/service_loop.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace rung::control {
namespace {

// ---- signals: blocked for the thread that makes them, so that each test puts them back

class SignalsTest : public testing::Test {
protected:
  SignalsTest() { pthread_sigmask(SIG_SETMASK, nullptr, &before_); }
  ~SignalsTest() override { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

private:
  sigset_t before_{};
};

TEST_F(SignalsTest, ComeOnceAndForGood) {
  Signals signals({SIGHUP, SIGTERM});
  EXPECT_FALSE(signals.came());
  raise(SIGTERM);
  EXPECT_TRUE(signals.came());
  EXPECT_TRUE(signals.came());
}

TEST_F(SignalsTest, EndTheWaitingOfATurn) {
  Signals signals({SIGTERM});
  ServiceLoop loop([](const char*) {}, &signals);
  raise(SIGTERM);
  pollfd asked{signals.file(), POLLIN, 0};
  EXPECT_EQ(poll(&asked, 1, 0), 1);
  loop.turn();
  EXPECT_EQ(poll(&asked, 1, 0), 0) << "the next turn waits";
  EXPECT_TRUE(signals.came());
}

TEST(ServiceLoopTest, SaysWhatHasFailed) {
  std::vector<std::string> problems;
  const ServiceLoop loop([&](const char* problem) { problems.emplace_back(problem); });
  EXPECT_TRUE(loop.guarded([] {}));
  EXPECT_FALSE(loop.guarded([] { throw std::runtime_error("no memory"); }));
  EXPECT_EQ(problems, std::vector<std::string>{"no memory"});
}

// ---- clients

host::Socket bound(sockaddr_un& address, socklen_t& size) {
  host::Socket made(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  address.sun_family = AF_UNIX; // the system chooses an abstract name
  size = sizeof address;
  if (bind(made.number(), reinterpret_cast<sockaddr*>(&address), sizeof address.sun_family) != 0 ||
      getsockname(made.number(), reinterpret_cast<sockaddr*>(&address), &size) != 0 || listen(made.number(), 4) != 0)
    throw std::runtime_error(std::strerror(errno));
  return made;
}

TEST(ListenerTest, IsNotAskedForATurnWhereThereIsNoFile) {
  sockaddr_un address{};
  socklen_t size = 0;
  host::Listener listener(bound(address, size));
  EXPECT_GE(listener.awaited().fd, 0);
  EXPECT_LT(listener.accept().number(), 0); // nobody has come
  EXPECT_GE(listener.awaited().fd, 0) << "the next one is waited for";
  const host::Socket client(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  ASSERT_EQ(connect(client.number(), reinterpret_cast<sockaddr*>(&address), size), 0);
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{0, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  const int made = listener.accept().number();
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_LT(made, 0);
  EXPECT_LT(listener.awaited().fd, 0);
  EXPECT_GE(listener.awaited().fd, 0) << "for a turn";
  EXPECT_GE(listener.accept().number(), 0);
}

} // namespace
} // namespace rung::control

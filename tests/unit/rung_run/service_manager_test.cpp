// What a service manager hears of rung-run: a socket of the test in its place.
#include "machine/rung-run/service_manager.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace rung::rung_run {
namespace {

using testing::HasSubstr;

class Listening : public testing::Test {
protected:
  void SetUp() override {
    const std::string name = "rung-test-notify-" + std::to_string(getpid());
    sockaddr_un place{};
    place.sun_family = AF_UNIX;
    std::memcpy(place.sun_path + 1, name.data(), name.size()); // an abstract one
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ASSERT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&place), size), 0);
    setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
    setenv("WATCHDOG_USEC", "2000000", 1);
  }
  void TearDown() override {
    close(socket_);
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
  }

  // "" where nothing has come.
  std::string heard() const {
    char text[256] = {};
    const ssize_t size = recv(socket_, text, sizeof text, MSG_DONTWAIT);
    return size > 0 ? std::string(text, static_cast<size_t>(size)) : "";
  }

private:
  int socket_ = -1;
};

constexpr int64_t kSecond = 1'000'000'000;

TEST_F(Listening, HearsOfBeginAndEnd) {
  const ServiceManager manager;
  manager.ready();
  EXPECT_THAT(heard(), HasSubstr("READY=1"));
  manager.stopping();
  EXPECT_THAT(heard(), HasSubstr("STOPPING=1"));
}

TEST_F(Listening, StepsFeedTheWatchdog) {
  ServiceManager manager;
  manager.feed(100, 10 * kSecond);
  EXPECT_EQ(heard(), "WATCHDOG=1");
  manager.feed(200, 10 * kSecond + kSecond / 2);
  EXPECT_EQ(heard(), "") << "twice in its time are enough";
  manager.feed(300, 11 * kSecond);
  EXPECT_EQ(heard(), "WATCHDOG=1");
  manager.feed(300, 12 * kSecond);
  EXPECT_EQ(heard(), "") << "no step since";
}

TEST(Alone, NothingHappens) {
  ServiceManager manager;
  manager.ready();
  manager.feed(1, kSecond);
  manager.stopping();
}

} // namespace
} // namespace rung::rung_run

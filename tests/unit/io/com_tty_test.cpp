// Serial ports of this machine, on pseudo-terminals of which the test has both ends.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <vector>

#include "machine/io/com/tty_line.h"
#include "tests/support/patience.h"

namespace {

using namespace rung::io::com;
using rung::test::soon;
using namespace std::chrono_literals;
using Bytes = std::vector<uint8_t>;

// The far end, and the device of the near one.
class Terminal {
public:
  Terminal() {
    int near = -1;
    char name[128] = {};
    EXPECT_EQ(openpty(&far_, &near, name, nullptr, nullptr), 0);
    fcntl(far_, F_SETFL, O_NONBLOCK);
    path = name;
    near_ = near;
  }
  ~Terminal() { hangUp(); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int takeNear() { return std::exchange(near_, -1); }
  void hangUp() {
    if (const int number = takeNear(); number >= 0) close(number);
    if (far_ >= 0) close(far_);
    far_ = -1;
  }
  void write(const Bytes& bytes) const {
    EXPECT_EQ(::write(far_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  // What comes until there are so many.
  Bytes read(size_t count) const {
    Bytes all;
    soon([&] {
      uint8_t block[4096];
      while (all.size() < count) {
        const ssize_t got = ::read(far_, block, sizeof block);
        if (got <= 0) return false;
        all.insert(all.end(), block, block + got);
      }
      return true;
    });
    return all;
  }

  std::string path;

private:
  int far_ = -1, near_ = -1;
};

Settings activeSettings() {
  Settings settings;
  settings.isActive = true;
  return settings;
}

struct Tty : testing::Test {
  Tty() { port.configure(activeSettings()); }
  Bytes received() {
    Bytes all;
    while (const auto byte = port.receive()) all.push_back(*byte);
    return all;
  }
  Terminal terminal;
  Port port;
};

TEST(TtySettings, AreThoseOfTermios) {
  Settings settings;
  termios found{};
  found.c_cflag = CRTSCTS | PARODD;
  found.c_lflag = ICANON | ECHO | ISIG;
  found.c_iflag = ICRNL | IXON | IXOFF;
  found.c_oflag = OPOST;
  termios made = termiosOf(settings, found);
  constexpr tcflag_t kForm = CSIZE | CSTOPB | PARENB | PARODD | CMSPAR | CRTSCTS;
  EXPECT_EQ(made.c_cflag & kForm, tcflag_t{CS8 | CSTOPB}); // two stop bits if nothing else is said
  EXPECT_EQ(made.c_cflag & (CREAD | CLOCAL), tcflag_t{CREAD | CLOCAL});
  EXPECT_EQ(made.c_lflag & (ICANON | ECHO | ISIG), 0u);
  EXPECT_EQ(made.c_iflag & (ICRNL | IXON | IXOFF | INPCK), 0u);
  EXPECT_EQ(made.c_oflag & OPOST, 0u);
  EXPECT_EQ(made.c_cc[VMIN], 1);
  EXPECT_EQ(cfgetospeed(&made), speed_t{B115200});

  settings.dataBits = 7;
  settings.stopBits = 1;
  settings.speed = 300;
  const std::pair<Parity, tcflag_t> parities[] = {{Parity::None, 0},
                                                  {Parity::Odd, PARENB | PARODD},
                                                  {Parity::Even, PARENB},
                                                  {Parity::Mark, PARENB | CMSPAR | PARODD},
                                                  {Parity::Space, PARENB | CMSPAR}};
  for (const auto& [parity, flags] : parities) {
    settings.parity = parity;
    made = termiosOf(settings, found);
    EXPECT_EQ(made.c_cflag & kForm, CS7 | flags);
    EXPECT_EQ((made.c_iflag & INPCK) != 0, parity != Parity::None);
    EXPECT_EQ(cfgetispeed(&made), speed_t{B300});
  }
  EXPECT_TRUE(isStandardSpeed(19200));
  EXPECT_FALSE(isStandardSpeed(19201));
  EXPECT_EQ(devicePath(2), "/dev/ttyS1");
}

TEST_F(Tty, BytesGoBothWays) {
  TtyThread thread;
  ASSERT_EQ(thread.add(port, terminal.path), "");
  thread.start();
  Bytes all(256);
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<uint8_t>(i); // none is taken for a command
  ASSERT_TRUE(port.send(all));
  EXPECT_EQ(terminal.read(256), all);
  terminal.write(all);
  EXPECT_TRUE(soon([&] { return port.received() == 256u; }));
  EXPECT_EQ(received(), all);
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_TRUE(thread.problems().empty());
}

TEST_F(Tty, ADescriptorThatIsGiven) {
  Settings settings = activeSettings();
  settings.dataBits = 7;
  port.configure(settings);
  TtyLine line(port, terminal.takeNear());
  ASSERT_TRUE(port.send(Bytes{0xC1}));
  line.step(0);
  EXPECT_EQ(terminal.read(1), Bytes{0x41});
  terminal.write({0xFF}); // a pseudo-terminal has eight bits
  line.step(1);
  EXPECT_EQ(received(), Bytes{0x7F});
  terminal.hangUp();
  line.step(2);
  EXPECT_EQ(port.takeState(), kPortError);
  EXPECT_EQ(line.descriptor(), -1);
  EXPECT_THAT(line.problem(), testing::HasSubstr("has gone"));
  line.step(100'000); // there is no other
  EXPECT_EQ(port.takeState(), kPortError);
}

TEST_F(Tty, WhatFindsTheQueueFullIsLost) {
  TtyLine line(port, terminal.takeNear());
  terminal.write(Bytes(1024, 'a'));
  terminal.write(Bytes(6, 'b'));
  line.step(0);
  line.step(1);
  EXPECT_EQ(port.received(), 1024u);
  EXPECT_EQ(port.takeState(), kReceiveOverflow);
  EXPECT_EQ(received(), Bytes(1024, 'a'));
}

TEST_F(Tty, ASideThatDoesNotReadFillsTheQueue) {
  TtyLine line(port, terminal.takeNear());
  size_t taken = 0;
  for (int i = 0; i < 1000 && port.send(Bytes(1024, 'x')); ++i) {
    taken += 1024;
    line.step(i);
  }
  EXPECT_EQ(port.takeState(), kSendOverflow);
  EXPECT_TRUE(line.hasUnsent());
  Bytes got;
  for (int i = 0; i < 100 && got.size() < taken; ++i) {
    line.step(2000 + i);
    const Bytes more = terminal.read(1);
    got.insert(got.end(), more.begin(), more.end());
  }
  EXPECT_EQ(got, Bytes(taken, 'x'));
}

TEST_F(Tty, ADeviceThatGoesAndComesBack) {
  const std::filesystem::path link = std::filesystem::temp_directory_path() / ("rung_tty_" + std::to_string(getpid()));
  std::filesystem::remove(link);
  TtyLine line(port, link.string());
  line.step(0);
  EXPECT_EQ(port.takeState(), kPortError); // not there yet
  EXPECT_THAT(line.problem(), testing::HasSubstr("cannot be opened"));
  std::filesystem::create_symlink(terminal.path, link);
  line.step(999);
  EXPECT_EQ(port.takeState(), kPortError);
  line.step(1000);
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_EQ(line.problem(), "");
  terminal.write({'a'});
  line.step(1001);
  EXPECT_EQ(received(), Bytes{'a'});

  terminal.hangUp();
  line.step(1002);
  EXPECT_EQ(port.takeState(), kPortError);
  ASSERT_TRUE(port.send('b')); // waits in the queue
  line.step(1500);
  EXPECT_EQ(port.takeState(), kPortError);

  Terminal other;
  std::filesystem::remove(link);
  std::filesystem::create_symlink(other.path, link);
  line.step(2002);
  EXPECT_EQ(port.takeState(), 0u);
  EXPECT_EQ(other.read(1), Bytes{'b'});
  std::filesystem::remove(link);
}

TEST_F(Tty, WhatIsNotASerialPort) {
  TtyThread thread;
  Settings settings = activeSettings();
  settings.speed = 12345;
  port.configure(settings);
  EXPECT_THAT(thread.add(port, terminal.path), testing::HasSubstr("12345 bit/s"));
  TtyLine line(port, terminal.takeNear());
  EXPECT_THAT(line.problem(), testing::HasSubstr("this speed"));
  port.configure(activeSettings());
  ASSERT_EQ(thread.add(port, "/dev/null"), "");
  thread.start();
  EXPECT_TRUE(soon([&] { return !thread.problems().empty(); }));
  EXPECT_THAT(thread.problems().front(), testing::HasSubstr("/dev/null is not a serial port"));
  EXPECT_EQ(port.takeState(), kPortError);
}

TEST_F(Tty, WhatIsInTheQueueAtTheEndIsSent) {
  TtyThread thread;
  ASSERT_EQ(thread.add(port, terminal.path), "");
  thread.start();
  ASSERT_TRUE(soon([&] { return !port.hasError(); }));
  ASSERT_TRUE(port.send(Bytes(100, 'z')));
  thread.end();
  EXPECT_EQ(terminal.read(100), Bytes(100, 'z'));
}

// The scan and the thread at the same time; all blocks arrive whole and in their order.
TEST_F(Tty, ManyBlocksWhileTheThreadWorks) {
  TtyThread thread;
  ASSERT_EQ(thread.add(port, terminal.path), "");
  thread.start();
  Bytes sent, got;
  for (int block = 0; block < 200; ++block) {
    const Bytes bytes(static_cast<size_t>(1 + block % 97), static_cast<uint8_t>(block));
    ASSERT_TRUE(soon([&] { return port.send(bytes); }));
    sent.insert(sent.end(), bytes.begin(), bytes.end());
    const Bytes some = terminal.read(1);
    got.insert(got.end(), some.begin(), some.end());
  }
  const Bytes rest = terminal.read(sent.size() - got.size());
  got.insert(got.end(), rest.begin(), rest.end());
  EXPECT_EQ(got, sent);
}

} // namespace

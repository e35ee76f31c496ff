// See tty_line.h.
#include "machine/io/com/tty_line.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "rtlib/run/realtime.h"

namespace rung::io::com {

namespace {

struct Speed {
  uint32_t bitsPerSecond;
  speed_t code;
};
constexpr Speed kSpeeds[] = {
    {50, B50},           {75, B75},           {110, B110},         {134, B134},         {150, B150},
    {200, B200},         {300, B300},         {600, B600},         {1200, B1200},       {1800, B1800},
    {2400, B2400},       {4800, B4800},       {9600, B9600},       {19200, B19200},     {38400, B38400},
    {57600, B57600},     {115200, B115200},   {230400, B230400},   {460800, B460800},   {500000, B500000},
    {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000}, {1500000, B1500000},
    {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000}, {3500000, B3500000}, {4000000, B4000000}};

const Speed* findSpeed(uint32_t speed) {
  const auto* found = std::ranges::find(kSpeeds, speed, &Speed::bitsPerSecond);
  return found == std::end(kSpeeds) ? nullptr : found;
}

tcflag_t parityFlags(Parity parity) {
  switch (parity) {
  case Parity::None: return 0;
  case Parity::Odd: return PARENB | PARODD;
  case Parity::Even: return PARENB;
  case Parity::Mark: return PARENB | CMSPAR | PARODD;
  case Parity::Space: return PARENB | CMSPAR;
  }
  return 0;
}

bool isForLater(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

} // namespace

std::string devicePath(uint32_t physical) { return "/dev/ttyS" + std::to_string(physical - 1); }

bool isStandardSpeed(uint32_t speed) { return findSpeed(speed) != nullptr; }

// Bytes with parity or framing errors are dropped.
termios termiosOf(const Settings& settings, termios found) {
  cfmakeraw(&found);
  found.c_cflag &= ~static_cast<tcflag_t>(CSIZE | CSTOPB | PARENB | PARODD | CMSPAR | CRTSCTS);
  found.c_cflag |= CREAD | CLOCAL | (settings.dataBits == 7 ? CS7 : CS8) | (settings.stopBits == 2 ? CSTOPB : 0) |
                   parityFlags(settings.parity);
  found.c_iflag &= ~static_cast<tcflag_t>(INPCK | IXOFF | IXANY);
  found.c_iflag |= IGNBRK | IGNPAR | (settings.parity == Parity::None ? 0 : INPCK);
  found.c_cc[VMIN] = 1; // a read of 0 bytes then means a disconnection
  found.c_cc[VTIME] = 0;
  if (const Speed* speed = findSpeed(settings.speed)) cfsetspeed(&found, speed->code);
  return found;
}

TtyLine::TtyLine(Port& port, int descriptor) : port_(port) { adopt(descriptor); }

std::string TtyLine::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

// ---- open and closed ---------------------------------------------------------------------------------------------

void TtyLine::open() noexcept {
  if (path_.empty() || nowMs_ < openAtMs_) return;
  const int opened = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) return fail("cannot be opened", errno);
  adopt(opened);
}

void TtyLine::adopt(int descriptor) noexcept {
  descriptor_ = descriptor;
  termios found{};
  if (tcgetattr(descriptor, &found) != 0) return fail("is not a serial port", errno);
  const termios wanted = termiosOf(port_.settings(), found);
  if (!isStandardSpeed(port_.settings().speed)) return fail("does not have this speed", EINVAL);
  if (tcsetattr(descriptor, TCSANOW, &wanted) != 0) return fail("cannot be set", errno);
  if (fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK) != 0) return fail("cannot be set", errno);
  port_.setError(false);
  const std::lock_guard lock(mutex_);
  problem_.clear();
}

void TtyLine::close() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

void TtyLine::fail(const char* what, int error) noexcept {
  close();
  port_.setError(true);
  openAtMs_ = nowMs_ + kReopenMs;
  const std::lock_guard lock(mutex_);
  problem_ = (path_.empty() ? "the serial port" : path_) + " " + what + ": " + std::strerror(error);
}

// ---- bytes -------------------------------------------------------------------------------------------------------

void TtyLine::step(int64_t nowMs) noexcept {
  nowMs_ = nowMs;
  if (descriptor_ < 0) open();
  if (descriptor_ >= 0) read();
  if (descriptor_ >= 0) write();
}

// Reads at most one queue's length, so that a device that sends continuously does not delay the others.
void TtyLine::read() noexcept {
  std::array<uint8_t, kBlock> bytes{};
  for (size_t all = 0; all < Port::kQueueBytes;) {
    const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && isForLater(errno)) return;
    if (count <= 0) return fail("has gone", count == 0 ? EIO : errno);
    for (ssize_t i = 0; i < count; ++i) port_.deliver(bytes[static_cast<size_t>(i)]);
    all += static_cast<size_t>(count);
  }
}

bool TtyLine::fillUnsent() noexcept {
  if (hasUnsent()) return true;
  unsentAt_ = 0;
  unsentEnd_ = std::min<size_t>(port_.toSend(), kBlock);
  for (size_t i = 0; i < unsentEnd_; ++i) port_.takeToSend(unsent_[i]);
  return unsentEnd_ > 0;
}

void TtyLine::write() noexcept {
  for (size_t all = 0; all < size_t{2} * Port::kQueueBytes && fillUnsent();) {
    const ssize_t count = ::write(descriptor_, &unsent_[unsentAt_], unsentEnd_ - unsentAt_);
    if (count < 0 && isForLater(errno)) return;
    if (count < 0) return fail("has gone", errno);
    unsentAt_ += static_cast<size_t>(count);
    all += static_cast<size_t>(count);
  }
}

// The thread that serves the serial ports.

std::string TtyThread::add(Port& port, std::string path) {
  if (!isStandardSpeed(port.settings().speed))
    return path + ": no serial port has " + std::to_string(port.settings().speed) + " bit/s";
  lines_.emplace_back(port, std::move(path));
  return {};
}

void TtyThread::start() {
  if (!lines_.empty()) thread_ = std::thread([this] { run(); });
}

void TtyThread::end() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

std::vector<std::string> TtyThread::problems() const {
  std::vector<std::string> found;
  for (const TtyLine& line : lines_)
    if (std::string problem = line.problem(); !problem.empty()) found.push_back(std::move(problem));
  return found;
}

void TtyThread::run() noexcept {
  runtime::becomeHelper();
  std::vector<pollfd> waited(lines_.size());
  for (bool last = false; !last;) {
    last = ending_;
    auto* entry = waited.data();
    for (TtyLine& line : lines_) {
      line.step(runtime::monotonicNs() / 1'000'000);
      *entry++ = {line.descriptor(), static_cast<short>(line.hasUnsent() ? POLLIN | POLLOUT : POLLIN), 0};
    }
    if (!last) poll(waited.data(), waited.size(), kPauseMs);
  }
}

} // namespace rung::io::com

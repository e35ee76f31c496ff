// See service_loop.h.
#include "machine/control/service_loop.h"

#include <pthread.h>
#include <sys/signalfd.h>

#include <cerrno>
#include <csignal>
#include <span>
#include <system_error>

namespace rung::control {

Signals::Signals(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  file_ = host::Socket(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
  if (file_.number() < 0) throw std::system_error(errno, std::generic_category(), "cannot wait for signals");
}

bool Signals::came() noexcept {
  signalfd_siginfo one{};
  while (read(file_.number(), &one, sizeof one) == sizeof one) came_ = true;
  return came_;
}

void ServiceLoop::turn() noexcept {
  for (const Served& served : programs_) {
    guarded([&] { served.controller->serveProgram(served.server); });
    if (served.report) guarded(served.report);
  }
  if (!guarded([this] { wait(); })) return;
  for (const Served& served : programs_) {
    if (served.server != nullptr) guarded([&] { answer(served); });
    if (served.turnDone) guarded(served.turnDone);
  }
}

void ServiceLoop::wait() {
  std::chrono::milliseconds time = kTurn;
  awaited_.clear();
  for (Served& served : programs_) {
    served.first = awaited_.size();
    if (served.server != nullptr && served.server->awaits(awaited_)) time = std::chrono::milliseconds(0);
    served.end = awaited_.size();
  }
  if (signals_ != nullptr) awaited_.push_back({signals_->file(), POLLIN, 0});
  poll(awaited_.data(), awaited_.size(), static_cast<int>(time.count()));
  if (signals_ != nullptr) (void)signals_->came(); // reads the signal, so that the next turns wait again
}

void ServiceLoop::answer(const Served& served) const {
  served.server->serve(std::span(awaited_).subspan(served.first, served.end - served.first));
  served.controller->serveClients(*served.server);
}

} // namespace rung::control

// The service thread's loop, in rung-run and in LinuxCNC's component. In each turn it does the periodic work of all
// programs of the process, waits for clients, signals and time, and answers. It waits only in one poll, so that the
// component, in a process with root's rights, needs no library for it.
#pragma once
#include <chrono>
#include <exception>
#include <functional>
#include <initializer_list>
#include <vector>

#include "machine/control/controller.h"
#include "machine/control/server.h"
#include "machine/host/socket.h"

namespace rung::control {

// Signals of the process as a file to poll. They have no other effect from then on in this thread and in those that it
// starts; the object must be made before these threads and outlive them.
class Signals {
public:
  // Throws std::system_error.
  explicit Signals(std::initializer_list<int> signals);
  // Returns true once one of the signals has arrived.
  bool came() noexcept;
  int file() const noexcept { return file_.number(); }

private:
  host::Socket file_;
  bool came_ = false;
};

class ServiceLoop {
public:
  // The longest wait of a turn.
  static constexpr std::chrono::milliseconds kTurn{20};
  using Complain = std::function<void(const char* problem)>;

  struct Program {
    Controller* controller = nullptr;
    Server* server = nullptr;            // null: no client can connect
    std::function<void()> report = {};   // reports other than those of the controller
    std::function<void()> turnDone = {}; // called once all requests are answered, for a watchdog
  };

  // `complain` receives the reason when one item of work fails; the other items are still done. `signals`, which must
  // outlive the loop, end its wait; null: no signals.
  explicit ServiceLoop(Complain complain, Signals* signals = nullptr)
      : complain_(std::move(complain)), signals_(signals) {}
  // The objects of `program` must outlive the loop.
  void add(Program program) { programs_.push_back({std::move(program)}); }

  void turn() noexcept;
  // Returns false if the work has thrown, for example because memory is short.
  template <class Work>
  bool guarded(Work&& work) const noexcept {
    try {
      work();
      return true;
    } catch (const std::exception& problem) {
      complain_(problem.what());
    } catch (...) {
      complain_("unknown exception");
    }
    return false;
  }

private:
  struct Served : Program {
    size_t first = 0, end = 0; // range of its sockets in awaited_
  };
  void wait();
  void answer(const Served& served) const;

  Complain complain_;
  Signals* signals_;
  std::vector<Served> programs_;
  std::vector<pollfd> awaited_;
};

} // namespace rung::control

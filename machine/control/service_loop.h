// The loop of the thread that serves the programs of a process, in rung-run and in LinuxCNC's component: in each turn
// it does for all of them what they need from time to time, waits for their clients, signals and time, and answers. One
// poll is all that it waits in, so that the component, in a process with root's rights, needs no library for it.
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

// Signals that come to the process, as something to wait for. They do nothing else from then on, for this thread and
// those that it begins; made before these, it outlives them.
class Signals {
public:
  // Throws std::system_error.
  explicit Signals(std::initializer_list<int> signals);
  // Once one of them has come: true.
  bool came() noexcept;
  int file() const noexcept { return file_.number(); }

private:
  host::Socket file_;
  bool came_ = false;
};

class ServiceLoop {
public:
  // A turn waits no longer.
  static constexpr std::chrono::milliseconds kTurn{20};
  using Complain = std::function<void(const char* problem)>;

  struct Program {
    Controller* controller = nullptr;
    Server* server = nullptr;            // null: no client can reach it
    std::function<void()> report = {};   // what its host has to say besides
    std::function<void()> turnDone = {}; // once all is answered, for a watchdog
  };

  // `complain` gets what a piece of work has failed with; the others are done all the same. `signals`, which outlive
  // the loop, end its waiting; null: none do.
  explicit ServiceLoop(Complain complain, Signals* signals = nullptr)
      : complain_(std::move(complain)), signals_(signals) {}
  // What it has outlives the loop.
  void add(Program program) { programs_.push_back({std::move(program)}); }

  void turn() noexcept;
  // False: it has thrown, where memory is short.
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
    size_t first = 0, end = 0; // of its sockets
  };
  void wait();
  void answer(const Served& served) const;

  Complain complain_;
  Signals* signals_;
  std::vector<Served> programs_;
  std::vector<pollfd> awaited_;
};

} // namespace rung::control

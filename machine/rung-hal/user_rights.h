// The rights with which files are opened: LinuxCNC's real-time process has root's rights, whichever user has started
// it.
#pragma once
#include <sys/fsuid.h>
#include <unistd.h>

namespace rung::hal {

// While it exists, this thread, and each thread that it starts meanwhile, opens files as the user who has started the
// process. Changes nothing if that user is root.
class UserRights {
public:
  UserRights() noexcept {
    if (geteuid() != 0 || user() == 0) return;
    former_ = static_cast<uid_t>(setfsuid(user()));
    changed_ = true;
  }
  ~UserRights() {
    if (changed_) setfsuid(former_);
  }
  // The user who has started the process; the process may have moved the user's number from the real to the saved one.
  static uid_t user() noexcept {
    uid_t real = 0;
    uid_t effective = 0;
    uid_t saved = 0;
    getresuid(&real, &effective, &saved);
    return real != 0 ? real : saved;
  }
  UserRights(const UserRights&) = delete;
  UserRights& operator=(const UserRights&) = delete;

private:
  uid_t former_ = 0;
  bool changed_ = false;
};

} // namespace rung::hal

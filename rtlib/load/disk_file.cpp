// Opening, reading, replacing and locking (see disk_file.h).
#include "rtlib/load/disk_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace rung::runtime {

namespace {

constexpr int kNotRegular = EBADFD; // no call here gives it

std::string cannotWrite(const std::string& path, int code) { return "cannot write " + path + ": " + fileProblem(code); }

} // namespace

File openDiskFile(const std::string& path, int flags) {
  File file(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644));
  struct stat status{};
  if (!file.ok() || (::fstat(file.fd(), &status) == 0 && S_ISREG(status.st_mode))) return file;
  file.close();
  errno = kNotRegular;
  return file;
}

std::string fileProblem(int code) {
  if (code == ELOOP) return "it is a symbolic link";
  if (code == kNotRegular) return "it is not a regular file";
  return std::generic_category().message(code);
}

bool replaceDiskFile(const std::string& path, std::span<const uint8_t> bytes, std::string& error) {
  const std::string temporary = path + ".tmp";
  // A crash may have left it; whatever is there is not written through.
  if (::unlink(temporary.c_str()) != 0 && errno != ENOENT) {
    error = cannotWrite(temporary, errno);
    return false;
  }
  File file = openDiskFile(temporary, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.ok()) {
    error = cannotWrite(temporary, errno);
    return false;
  }
  const std::string wrong =
      finishReplacing(AT_FDCWD, std::move(file), temporary, path,
                      {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {.lasts = true});
  if (!wrong.empty()) error = "cannot write " + path + ": " + wrong;
  return wrong.empty();
}

// A file of its own, because a lock belongs to the file and not to its name: one on a file that is replaced would be
// gone with the first replacement. It is never removed, so all lock the same one.
DiskLock lockDiskFile(const std::string& path) {
  DiskLock lock;
  lock.file = openDiskFile(path, O_RDWR); // NFS locks only what may be written
  lock.made = !lock.file.ok() && errno == ENOENT;
  if (lock.made) lock.file = openDiskFile(path, O_RDWR | O_CREAT);
  if (!lock.file.ok()) {
    lock.error = cannotWrite(path, errno);
    return lock;
  }
  while (::flock(lock.file.fd(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) lock.error = "cannot lock " + path + ": " + fileProblem(errno);
    lock.file.close();
    break;
  }
  return lock;
}

namespace {

class SystemDisk final : public Disk {
public:
  bool read(const std::string& path, size_t most, std::string& bytes, std::string& problem) override {
    const File file = openDiskFile(path, O_RDONLY);
    if (!file.ok() && errno == ENOENT) return false;
    problem = file.ok() ? readAll(file.fd(), most, bytes) : fileProblem(errno);
    return true;
  }
  bool replace(const std::string& path, std::span<const uint8_t> bytes, std::string& error) override {
    return replaceDiskFile(path, bytes, error);
  }
  std::unique_ptr<Lock> lock(const std::string& path, bool& made, std::string& error) override {
    DiskLock lock = lockDiskFile(path);
    made = lock.made;
    error = std::move(lock.error);
    return lock.file.ok() ? std::make_unique<Held>(std::move(lock.file)) : nullptr;
  }

private:
  class Held final : public Lock {
  public:
    explicit Held(File file) : file_(std::move(file)) {}

  private:
    File file_;
  };
};

} // namespace

Disk& systemDisk() noexcept {
  static SystemDisk disk;
  return disk;
}

} // namespace rung::runtime

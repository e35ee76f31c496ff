// The shared areas of the PLC (man. l.15489-15631): two, of 32000 bytes, each with its own mutex. They are in the
// memory of the process, or in a file that other programs map as well, with the layout below and pthread_mutex_lock.
//
// Reading and writing never wait and allocate nothing; with a file, each asks the system once for its length. If
// another program has locked an area, the instruction must be repeated. A lock is released when its program ends. If
// another program has overwritten the head or the mutexes, or changed the length of the file, reading and writing
// return an error and move no bytes. It cannot be prevented that a program does so within the microsecond of an access;
// the file is therefore accessible only to its user.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <pthread.h>

#include "rtlib/load/file.h"

namespace rung::io {

enum class AreaResult : uint8_t {
  Done = 0,
  // Errors: values of DR after SA_*.
  NoArea = 1,
  Outside = 2, // offset + size > 32000 (l.15561)
  Broken = 3,  // another program has overwritten the file's head or mutex, or truncated it
  // No error: RLO and DR are 0, and the instruction must be repeated (l.15557).
  Locked,
};

class SharedAreas {
public:
  static constexpr uint32_t kAreas = 2; // l.15494
  static constexpr uint32_t kAreaBytes = 32000;
  static constexpr uint32_t kVersion = 1;

  // The contents of a file, with the layout of a C compiler for this machine and in native byte order.
  struct Head {
    std::array<char, 8> magic; // "RUNG-SA", written last
    uint32_t version;
    uint32_t fileBytes;  // sizeof(Layout)
    uint32_t areas;      // 2
    uint32_t areaBytes;  // 32000
    uint32_t mutexBytes; // sizeof(pthread_mutex_t)
    uint32_t areasAt;    // offset of the first area
    bool operator==(const Head&) const = default;
  };
  struct Area {
    alignas(64) std::array<uint8_t, kAreaBytes> bytes;
  };
  struct Layout {
    Head head;
    std::array<pthread_mutex_t, kAreas> mutexes; // process-shared, robust
    std::array<Area, kAreas> areas;
  };

  SharedAreas(); // in memory of the process, filled with 0
  ~SharedAreas();
  SharedAreas(const SharedAreas&) = delete;
  SharedAreas& operator=(const SharedAreas&) = delete;

  // Maps a file, to be called before the program runs. A missing file is created with mode 0600. This object holds a
  // shared flock on it during its lifetime; other programs that map it must do the same. If no other program holds one,
  // the areas are set to 0 and unlocked; otherwise they stay as they are. Returns "", or the error ("cannot use FILE:
  // ..."); the areas are then unchanged.
  std::string mapFile(const std::string& path);

  // SA_READ, SA_WRITE. With size 0, the result is Done or the error of the area or the offset, and no lock is needed.
  AreaResult read(uint32_t area, uint32_t offset, std::span<uint8_t> to) noexcept;
  AreaResult write(uint32_t area, uint32_t offset, std::span<const uint8_t> from) noexcept;

  // Simulates, for this object, that another program has locked the area (event SA_LOCK). Returns false if there is no
  // such area.
  bool hold(uint32_t area, bool on) noexcept;
  // Power-up of a simulated control: sets the areas to 0 and unlocks them.
  void clear() noexcept;

  // For tests, which access values besides the program: does not lock the mutex. Empty: there is no such area.
  std::span<uint8_t> bytes(uint32_t area) noexcept;

  // For areas in memory of the process.
  template <class Archive>
  void state(Archive& archive) {
    for (uint32_t area = 0; area < kAreas; ++area) {
      bool isHeld = held_[area];
      archive(isHeld);
      if constexpr (Archive::kLoads) held_[area] = isHeld;
      archive.bytes(bytes(area));
    }
  }

private:
  struct Unmap {
    bool mapped; // otherwise made by new
    void operator()(Layout* layout) const noexcept;
  };

  AreaResult move(uint32_t area, uint32_t offset, uint8_t* own, size_t size, bool toOwn) noexcept;
  AreaResult lock(uint32_t area) noexcept;
  bool isSound(uint32_t area) const noexcept;

  std::unique_ptr<Layout, Unmap> layout_;
  runtime::File file_; // not open: memory of the process
  std::array<std::atomic<bool>, kAreas> held_{};
};

// Initialization and checks of the memory of shared areas.

void makeMutex(pthread_mutex_t& mutex);
// Sets everything to 0 and unlocked. The head is written last, so that a program that finds it finds the rest as well.
void initialize(SharedAreas::Layout& layout);
bool isHead(const SharedAreas::Head& head) noexcept;
// Whether the head is one of ours, of any version, or one whose initialization was interrupted.
bool mayBeMadeAnew(const SharedAreas::Head& head) noexcept;

// Unlocks a mutex. `asLocked` is a copy of the mutex made after locking it. Broken: the mutex was overwritten since
// then, so another program may have locked it as well; it has been repaired.
AreaResult unlockArea(pthread_mutex_t& mutex, const pthread_mutex_t& asLocked) noexcept;

} // namespace rung::io

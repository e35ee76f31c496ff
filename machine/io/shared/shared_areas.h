// The shared areas of the PLC (man. l.15489-15631): two, of 32000 bytes, each with its own mutex. They are memory of
// the process, or of a file that other programs map as well; a program of theirs finds below what lies there, and uses
// the mutexes with pthread_mutex_lock.
//
// Reading and writing never wait and allocate nothing; of a file, each asks the system once how long it is. For an area
// that another program has locked the instruction has to be repeated. A program that ended while it had locked one
// loses it. What other programs write over the head, the mutexes, or the length of the file is an error of reading and
// writing, and no bytes are moved. No program can be kept from doing that within the microsecond of an access; so the
// file is the user's alone.
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
  // Errors, the values of DR after SA_*.
  NoArea = 1,
  Outside = 2, // offset + size > 32000 (l.15561)
  Broken = 3,  // another program has written over the file's head or mutex, or shortened it
  // No error: RLO and DR are 0, and the instruction is to be repeated (l.15557).
  Locked,
};

class SharedAreas {
public:
  static constexpr uint32_t kAreas = 2; // l.15494
  static constexpr uint32_t kAreaBytes = 32000;
  static constexpr uint32_t kVersion = 1;

  // What lies in a file, as a compiler of C for this machine lays it out; the numbers are of the machine's byte order.
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

  SharedAreas(); // in memory of the process, all 0
  ~SharedAreas();
  SharedAreas(const SharedAreas&) = delete;
  SharedAreas& operator=(const SharedAreas&) = delete;

  // Before the program runs: the areas are those of the file from then on. It is made where there is none, with mode
  // 0600, and holds a shared flock on it as long as the areas live; other programs that map it must hold one as well.
  // The first program begins with areas that are 0 and unlocked; later ones find them as the others have them. "" or
  // why not ("cannot use FILE: ..."); the areas are then as before.
  std::string mapFile(const std::string& path);

  // SA_READ, SA_WRITE. A size of 0 is done, or the error of the area or the offset; it needs no lock.
  AreaResult read(uint32_t area, uint32_t offset, std::span<uint8_t> to) noexcept;
  AreaResult write(uint32_t area, uint32_t offset, std::span<const uint8_t> from) noexcept;

  // Another program holds the mutex, for this object (event SA_LOCK). False: there is no such area.
  bool hold(uint32_t area, bool on) noexcept;
  // A power-up of a simulated control: the areas are 0, and not locked.
  void clear() noexcept;

  // For tests, which set and read values beside the program: without the mutex, whichever thread holds it. Empty: there
  // is no such area.
  std::span<uint8_t> bytes(uint32_t area) noexcept;

private:
  struct Unmap {
    bool mapped; // else made by new
    void operator()(Layout* layout) const noexcept;
  };

  AreaResult move(uint32_t area, uint32_t offset, uint8_t* own, size_t size, bool toOwn) noexcept;
  AreaResult lock(uint32_t area) noexcept;
  bool isSound(uint32_t area) const noexcept;

  std::unique_ptr<Layout, Unmap> layout_;
  runtime::File file_; // not open: memory of the process
  std::array<std::atomic<bool>, kAreas> held_{};
};

// What lies in the memory of shared areas, as they are made.

void makeMutex(pthread_mutex_t& mutex);
// All 0 and unlocked; the head is written last, so that who finds it finds the rest.
void initialize(SharedAreas::Layout& layout);
bool isHead(const SharedAreas::Head& head) noexcept;
// Ours, whatever the version, or one whose making was interrupted.
bool mayBeMadeAnew(const SharedAreas::Head& head) noexcept;

// `asLocked` is a copy of the mutex from when it was locked. Broken: it was written over since, so that another program
// may have locked it as well; it is then sound again.
AreaResult unlockArea(pthread_mutex_t& mutex, const pthread_mutex_t& asLocked) noexcept;

} // namespace rung::io

// What lies in the memory of shared areas, as they are made.
#pragma once
#include "machine/io/shared/shared_areas.h"

namespace rung::io {

void makeMutex(pthread_mutex_t& mutex);
// All 0 and unlocked; the head is written last, so that who finds it finds the rest.
void initialize(SharedAreas::Layout& layout);
bool isHead(const SharedAreas::Head& head) noexcept;
// Ours, whatever the version, or one whose making was interrupted.
bool mayBeMadeAnew(const SharedAreas::Head& head) noexcept;

// `asLocked` is a copy of the mutex from when it was locked. Broken: it was written over since, so that somebody else
// may have locked it as well; it is then sound again.
AreaResult unlockArea(pthread_mutex_t& mutex, const pthread_mutex_t& asLocked) noexcept;

} // namespace rung::io

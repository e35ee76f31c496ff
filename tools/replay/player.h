// Plays either kind of recording (runtime::RecordingMode).
#pragma once
#include <memory>

#include "rtlib/load/engine.h"
#include "rtlib/record/player.h"
#include "rtlib/record/recording_file.h"

namespace rung::replay {

// Both arguments outlive the player.
std::unique_ptr<runtime::Player> makePlayer(runtime::RecordingMode mode, runtime::Engine& engine,
                                            runtime::PlayerOwner& owner);

} // namespace rung::replay

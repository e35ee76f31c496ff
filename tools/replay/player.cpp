// See player.h.
#include "tools/replay/player.h"

#include "rtlib/api/host_player.h"
#include "rtlib/record/bytes_player.h"
#include "rung/runtime.hpp"

namespace rung::replay {
namespace {

// What the players need is made before them.
struct OwnInstance {
  explicit OwnInstance(runtime::Engine& engine) : own(engine) {}
  runtime::Instance own;
};
struct OwnImage {
  explicit OwnImage(runtime::Engine& engine) : image(rung::Image::adopt(engine.program(), engine.context())) {}
  rung::Image image;
};

struct OfBytes final : private OwnInstance, public runtime::BytesPlayer {
  OfBytes(runtime::Engine& engine, runtime::PlayerOwner& owner) : OwnInstance(engine), BytesPlayer(own, owner) {}
};
struct OfHost final : private OwnImage, public api::HostPlayer {
  OfHost(runtime::Engine& engine, runtime::PlayerOwner& owner) : OwnImage(engine), HostPlayer(image.handle(), owner) {}
};

} // namespace

std::unique_ptr<runtime::Player> makePlayer(runtime::RecordingMode mode, runtime::Engine& engine,
                                            runtime::PlayerOwner& owner) {
  if (mode == runtime::RecordingMode::Control) return std::make_unique<OfHost>(engine, owner);
  return std::make_unique<OfBytes>(engine, owner);
}

} // namespace rung::replay

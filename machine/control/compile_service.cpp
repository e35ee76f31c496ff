// See compile_service.h.
#include "machine/control/compile_service.h"

#include <nlohmann/json.hpp>

#include "machine/compile/forced_code_maker.h"
#include "machine/compile/sources.h"
#include "machine/control/values.h"

namespace rung::control {

using compile::Compilation;
using nlohmann::json;

namespace {

class OfMachine final : public Programs {
public:
  ~OfMachine() override { maker_->abandon(); }
  Image open(const std::string& path) override { return Image(path); }
  void serveForces(const Image& image) override { maker_->serve(image); }
  void abandon() override { maker_->abandon(); }

private:
  std::shared_ptr<compile::ForcedCodeMaker> maker_ = compile::ForcedCodeMaker::make();
};

constexpr std::chrono::seconds kIdle(30); // after this time another client may take the place

const char* nameOf(Compilation::State state) {
  constexpr const char* kNames[] = {"compiling", "compiled", "errors", "failed"}; // indexed by State
  return kNames[static_cast<size_t>(state)];
}

std::string pieceOf(const json& request) {
  const auto found = request.find("piece");
  if (found == request.end() || !found->is_string())
    throw Refused("found no text \"piece\" in the request, expected one");
  std::optional<std::string> bytes = fromBase64(found->get_ref<const std::string&>());
  if (!bytes) throw Refused("found a \"piece\" that is not in base64, expected that");
  return std::move(*bytes);
}

} // namespace

std::unique_ptr<Programs> programsOfMachine() { return std::make_unique<OfMachine>(); }

void CompileService::begin(uint32_t owner) {
  compilation_.reset(); // ends its process
  image_.reset();
  refused_.clear();
  packed_.clear();
  packed_.shrink_to_fit();
  owner_ = owner;
}

void CompileService::takePlace(const Peer& peer) {
  const bool busy = compilation_ != nullptr && compilation_->state() == Compilation::State::Running;
  if (owner_ != 0 && owner_ != peer.number && (busy || Clock::now() < lastUse_ + kIdle))
    throw Refused("another client is compiling a program here; try again when it has ended");
  begin(peer.number);
}

void CompileService::require(const Peer& peer) const {
  if (owner_ != peer.number) throw Refused("no sources have been sent before; \"sources\" sends them");
}

json CompileService::sources(const Peer& peer, const json& request) {
  const std::string piece = pieceOf(request);
  if (request.value("first", json(false)) == true)
    takePlace(peer);
  else
    require(peer);
  if (compilation_ != nullptr) throw Refused("the sources are already being compiled; \"first\": true starts again");
  if (packed_.size() + piece.size() > compile::kMostBytes) {
    begin(0);
    throw Refused("the sources have more than " + std::to_string(compile::kMostBytes) + " bytes, expected no more");
  }
  packed_ += piece;
  lastUse_ = Clock::now();
  return {{"bytes", packed_.size()}};
}

json CompileService::compile(const Peer& peer, const json&) {
  require(peer);
  if (compilation_ != nullptr) throw Refused("the sources are already being compiled");
  const size_t bytes = packed_.size();
  compilation_ = std::make_unique<Compilation>(std::exchange(packed_, {}));
  lastUse_ = Clock::now();
  plc_.logChange(peer, LogKind::Compile, "compile " + std::to_string(bytes) + " bytes of sources");
  return {{"bytes", bytes}};
}

void CompileService::load() try {
  image_ = Image::ofMemory(compilation_->image(), "the program that was compiled");
} catch (const Error& error) {
  refused_ = error.what();
}

json CompileService::compiled(const Peer& peer, const json&) {
  require(peer);
  if (compilation_ == nullptr) throw Refused("the sources have not been compiled; \"compile\" does that");
  lastUse_ = Clock::now();
  const Compilation::State state = compilation_->state();
  if (state == Compilation::State::Running) return {{"state", nameOf(state)}};
  if (state == Compilation::State::Compiled && !image_ && refused_.empty()) load();
  if (!refused_.empty()) return {{"state", nameOf(Compilation::State::Failed)}, {"report", refused_}};
  return {{"state", nameOf(state)}, {"report", compilation_->report()}};
}

const Image& CompileService::image(const Peer& peer) const {
  require(peer);
  if (!image_) throw Refused("no program has been compiled from the sources; \"compiled\" says why");
  return *image_;
}

void CompileService::gone(const Peer& peer) {
  if (owner_ == peer.number) begin(0);
}

} // namespace rung::control

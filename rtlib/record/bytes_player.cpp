// See bytes_player.h.
#include "rtlib/record/bytes_player.h"

namespace rung::runtime {

BytesPlayer::BytesPlayer(Instance& instance, PlayerOwner& owner)
    : Player(owner), instance_(instance), written_(writtenBytes(instance.program())) {
  beginWith(instance.program());
  instance_.setHooks(this);
}

BytesPlayer::~BytesPlayer() { instance_.setHooks(nullptr); }

LoadResult BytesPlayer::load(core::Loader& loader) {
  const LoadResult result = instance_.load(loader);
  if (result == LoadResult::Loaded && outputs_) outputsHash_ = outputs_->hash(instance_.block().data());
  return result;
}

void BytesPlayer::putBeforeState(EventWriter& writer) const {
  const Surroundings of = instance_.surroundings();
  writer.put(Event::Surroundings, surroundings_.works, of.latches, of.neededOnly);
}

// ---- before a part -----------------------------------------------------------------------------------------------

bool BytesPlayer::takeOther(Event event) {
  switch (event) {
  case Event::Surroundings: return takeSurroundings();
  case Event::Outputs: outputs_ = WatchedBytes::fromList(instance_.program(), reader_); return outputs_.has_value();
  case Event::Stopped: instance_.setStopped(reader_.takeNumber() != 0); return reader_.good();
  case Event::Request: return takeRequest();
  default: return false;
  }
}

bool BytesPlayer::takeSurroundings() {
  surroundings_.works = reader_.takeNumber32();
  surroundings_.latches = reader_.takeNumber() != 0;
  surroundings_.neededOnly = reader_.takeNumber() != 0;
  if (!reader_.good()) return false;
  instance_.worksChanged();
  instance_.setLatching(surroundings_.latches);
  instance_.setNeededCopiesOnly(surroundings_.neededOnly);
  return true;
}

bool BytesPlayer::takeRequest() {
  const uint32_t service = reader_.takeNumber32(), count = reader_.takeNumber32();
  int64_t args[RUNG_MAX_SERVICE_ARGS] = {};
  if (!takeList(args, count)) return false;
  (void)instance_.services().request(service, args, count);
  return true;
}

// ---- parts -------------------------------------------------------------------------------------------------------

// What the program sends is dropped.
void BytesPlayer::run() {
  within_ = 0;
  switch (kind_) {
  case PartKind::Scan: instance_.scan(); break;
  case PartKind::Slot: instance_.slot(); break;
  case PartKind::Slice: instance_.slice(); break;
  case PartKind::Fast: instance_.fast(); break;
  case PartKind::SliceToFast: instance_.sliceToFast(); break;
  case PartKind::Task: (void)instance_.runTask(number_); break;
  case PartKind::Halt: (void)instance_.halt(number_); break;
  case PartKind::PowerOff: break; // mayRun
  }
  core::ServiceRequest request;
  while (instance_.services().take(request)) {
  }
}

void BytesPlayer::compare(bool compares) {
  if (compares && !compares_ && outputs_) outputsHash_ = outputs_->hash(instance_.block().data());
  compares_ = compares;
}

void BytesPlayer::compareOutcome() {
  const bool compares = outputs_ && compares_;
  const uint32_t hash = compares ? outputs_->hash(instance_.block().data()) : 0;
  if (isNext(Event::Hash)) {
    (void)reader_.takeEvent();
    outputsHash_ = reader_.takeNumber32();
  }
  if (compares && hash != outputsHash_) differs(PlayedDifference::Kind::Outputs);
  if (compares) outputsHash_ = hash;
}

// A hook or a latch of the part; after a run of a task the rest of the hook is another one.
void BytesPlayer::within() {
  for (bool ranTask = true; ranTask && !failed_;) {
    ranTask = false;
    const uint32_t number = within_++;
    EventReader after = reader_;
    if (!isNext(Event::Within) || (after.takeEvent(), after.takeNumber32()) != number) return;
    reader_ = after;
    while (!ranTask && takeWithin(ranTask)) {
    }
  }
}

// False: no event of a hook follows.
bool BytesPlayer::takeWithin(bool& ranTask) {
  if (failed_ || reader_.atEnd()) return false;
  const EventReader before = reader_;
  const Event event = reader_.takeEvent();
  if (isRun(event)) return failed_ = !takeWritten(event), true;
  switch (event) {
  case Event::Request: failed_ = !takeRequest(); return true;
  case Event::Task: (void)instance_.runTask(reader_.takeNumber32()); return ranTask = true;
  case Event::Reply:
    reader_ = before;
    failed_ = !takeReplies();
    instance_.services().deliver();
    return true;
  default: reader_ = before; return false;
  }
}

bool BytesPlayer::respond(Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) {
  if (!isNext(Event::Answer)) return false;
  const EventReader before = reader_;
  (void)reader_.takeEvent();
  const std::optional<core::ServiceReply> answer = takeReply();
  if (!answer || answer->ticket != request.ticket) {
    reader_ = before;
    failed_ = failed_ || !answer;
    return false;
  }
  reply = *answer;
  return true;
}

} // namespace rung::runtime

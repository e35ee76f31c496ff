// See recording_writer.h.
#include "rtlib/record/recording_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

namespace rung::runtime {

namespace {

constexpr size_t kMostProgram = size_t{1} << 30;
constexpr size_t kMostPending = 256 * 1024; // bytes of events of a block, after which it is written at once
constexpr std::chrono::milliseconds kTurn{80}, kFollowed{33};
constexpr int64_t kFollowUs = 2'000'000;
constexpr int kLevel = 6; // of zlib

int64_t wallUs() {
  using namespace std::chrono;
  return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

uint64_t randomNumber() {
  std::random_device device;
  return uint64_t{device()} << 32 | device();
}

std::span<const uint8_t> bytesOf(const auto& object) {
  return {reinterpret_cast<const uint8_t*>(&object), sizeof object};
}

class DiskFile final : public AppendedFile {
public:
  DiskFile(File file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}
  bool append(std::span<const uint8_t> bytes, std::string& error) override {
    if (writeAll(file_.fd(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
      size_ += static_cast<off_t>(bytes.size());
      return true;
    }
    error = "cannot write " + path_ + ": " + fileProblem(errno);
    (void)!ftruncate(file_.fd(), size_);
    (void)lseek(file_.fd(), size_, SEEK_SET);
    return false;
  }

private:
  File file_;
  std::string path_;
  off_t size_ = 0;
};

} // namespace

std::unique_ptr<AppendedFile> openAppended(const std::string& path, std::string& error) {
  File file = openDiskFile(path, O_WRONLY | O_CREAT | O_EXCL);
  if (file.ok()) return std::make_unique<DiskFile>(std::move(file), path);
  error = "cannot make " + path + ": " + fileProblem(errno);
  return nullptr;
}

// Packed bytes of the block are at its end; the stream continues in the next one.
struct RecordingWriter::Deflate {
  Deflate() {
    constexpr int kRaw = -15, kMemory = 8; // no header of zlib; its own default
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::runtime_error("there is no memory to pack a recording");
  }
  ~Deflate() { (void)deflateEnd(&stream); }
  Deflate(const Deflate&) = delete;
  Deflate& operator=(const Deflate&) = delete;

  void begin() { (void)deflateReset(&stream); }
  void pack(std::span<const uint8_t> events, std::vector<uint8_t>& to) {
    constexpr size_t kRest = 64; // of the flush
    const size_t before = to.size();
    to.resize(before + deflateBound(&stream, static_cast<uLong>(events.size())) + kRest);
    stream.next_in = const_cast<Bytef*>(events.data());
    stream.avail_in = static_cast<uInt>(events.size());
    stream.next_out = to.data() + before;
    stream.avail_out = static_cast<uInt>(to.size() - before);
    (void)deflate(&stream, Z_SYNC_FLUSH);
    to.resize(to.size() - stream.avail_out);
  }

  z_stream stream{};
};

RecordingWriter::RecordingWriter(PartStream& stream, RecordingMode mode, const RecordingOptions& options,
                                 const OpenFile& open)
    : stream_(stream), mode_(mode), options_(options), open_(open), run_(randomNumber()) {
  if (const std::string problem = useFolder(); !problem.empty()) throw std::runtime_error(problem);
  deflate_ = std::make_unique<Deflate>();
  if (const std::vector<SegmentFile> old = segmentsIn(options_.folder); !old.empty()) number_ = old.back().number;
}

RecordingWriter::FolderId RecordingWriter::idOf(const std::string& folder) noexcept {
  struct stat found{};
  return stat(folder.c_str(), &found) == 0 ? FolderId{found.st_dev, found.st_ino} : FolderId{};
}

// Makes and locks it. "" or why that is impossible.
std::string RecordingWriter::useFolder() {
  std::error_code problem;
  std::filesystem::create_directory(options_.folder, problem);
  if (problem) return "cannot make the folder " + options_.folder + ": " + problem.message();
  DiskLock lock = lockDiskFile(options_.folder + "/lock");
  if (!lock.file.ok()) return lock.error.empty() ? "another process records into " + options_.folder : lock.error;
  lock_ = std::move(lock);
  folder_ = idOf(options_.folder);
  return {};
}

// A folder that was moved or deleted has taken the files that are open with it: the recording continues in a new one,
// with the next state.
void RecordingWriter::lookForFolder() {
  if (idOf(options_.folder) == folder_) return;
  if (folder_ != FolderId{}) {
    moved_ = "the folder " + options_.folder + " was moved or deleted while it was written";
    failed(moved_);
    folder_ = {};
  }
  if (const std::string problem = useFolder(); !problem.empty()) {
    problem_ = moved_ + ", and there is no new one: " + problem;
    return;
  }
  moved_ += "; the recording continues in a new one";
  movedUs_ = wallUs();
  problem_.clear();
  for (const auto& [hash, file] : programs_) {
    std::string bytes;
    if (file.ok() && lseek(file.fd(), 0, SEEK_SET) == 0 && readAll(file.fd(), kMostProgram, bytes).empty())
      writeProgram(hash, bytes);
  }
}

RecordingWriter::~RecordingWriter() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  const std::lock_guard lock(mutex_);
  turn();
  if (file_ != nullptr) writeBlock(BlockKind::End);
}

// Signals are for the host's own threads.
void RecordingWriter::start() {
  sigset_t all, before;
  sigfillset(&all);
  (void)pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  (void)pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void RecordingWriter::run() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    turn();
    wake_.wait_for(lock, wallUs() < followUntilUs_ ? kFollowed : kTurn, [this] { return ends_; });
  }
}

void RecordingWriter::look() {
  const std::lock_guard lock(mutex_);
  turn();
}

void RecordingWriter::turn() {
  lookForFolder();
  for (std::span<const uint8_t> record = stream_.ring().front(); !record.empty(); record = stream_.ring().front()) {
    take(record);
    stream_.ring().pop();
  }
  takeMarks();
  if (!pending_.empty()) writeBlock(beginsState_ ? BlockKind::State : BlockKind::Events);
  const bool isNewFault = std::exchange(seenFaults_, stream_.faults()) != stream_.faults();
  if (std::exchange(keeps_, false) || isNewFault) keepNow();
  stream_.want();
}

void RecordingWriter::take(std::span<const uint8_t> record) {
  EventReader reader(record);
  if (reader.next() == Event::Program) {
    (void)reader.takeEvent();
    beginState(reader.takeNumber());
  }
  if (dropped_) return;
  pending_.insert(pending_.end(), record.begin(), record.end());
  if (pending_.size() >= kMostPending) writeBlock(beginsState_ ? BlockKind::State : BlockKind::Events);
}

// Each state begins a stream of its own, so that a reader can begin there.
void RecordingWriter::beginState(uint64_t program) {
  if (!pending_.empty()) writeBlock(beginsState_ ? BlockKind::State : BlockKind::Events);
  if (folder_ == FolderId{}) { // it is made again first
    dropped_ = true;
    return;
  }
  const bool isFull = segmentBytes_ >= options_.segmentBytes || wallUs() - segmentUs_ >= options_.segmentUs;
  if (file_ == nullptr || program != program_ || isFull) dropped_ = !beginSegment(program);
  if (dropped_) return;
  beginsState_ = true;
  if (std::exchange(gap_, false)) pending_.push_back(static_cast<uint8_t>(Event::Lost));
}

bool RecordingWriter::beginSegment(uint64_t program) {
  file_.reset();
  makeRoom();
  ++number_;
  const std::string path = options_.folder + "/" + segmentName(number_, false);
  SegmentHead head{.mode = mode_, .program = program, .number = number_, .run = run_, .wallUs = wallUs()};
  head.checksum = head.sum();
  std::string error;
  std::unique_ptr<AppendedFile> made = open_(path, error);
  if (made == nullptr || !made->append(bytesOf(head), error)) {
    std::error_code none;
    if (made != nullptr) std::filesystem::remove(path, none);
    failed(error);
    return false;
  }
  file_ = std::move(made);
  program_ = program;
  programs_.try_emplace(program);
  segmentBytes_ = sizeof head;
  segmentUs_ = head.wallUs;
  problem_.clear();
  return true;
}

void RecordingWriter::writeBlock(BlockKind kind) {
  if (file_ == nullptr) return pending_.clear();
  BlockHead head{.kind = kind, .raw = static_cast<uint32_t>(pending_.size()), .wallUs = wallUs()};
  std::vector<uint8_t> bytes(sizeof head);
  if (kind == BlockKind::State) deflate_->begin();
  if (!pending_.empty()) deflate_->pack(pending_, bytes);
  const std::span<const uint8_t> packed = std::span(bytes).subspan(sizeof head);
  head.size = static_cast<uint32_t>(packed.size());
  head.checksum = head.sum(packed);
  std::ranges::copy(bytesOf(head), bytes.begin());
  raw_ += pending_.size();
  pending_.clear();
  beginsState_ = false;
  std::string error;
  if (!file_->append(bytes, error)) return failed(error);
  segmentBytes_ += bytes.size();
  written_ += bytes.size();
}

// Nothing more is written before the next state, which begins another segment.
void RecordingWriter::failed(const std::string& why) {
  problem_ = why;
  file_.reset();
  pending_.clear();
  dropped_ = gap_ = true;
  beginsState_ = false;
  ++lostBlocks_;
}

// Between two records the program is between two parts.
void RecordingWriter::takeMarks() {
  if (file_ == nullptr || marks_.empty()) return;
  for (const std::string& text : marks_) {
    const size_t room = pending_.size() + text.size() + 16;
    const size_t before = pending_.size();
    pending_.resize(room);
    EventWriter writer{std::span(pending_).subspan(before)};
    writer.put(Event::Mark, text.size());
    writer.putBytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
    pending_.resize(before + writer.size());
  }
  marks_.clear();
  keeps_ = true;
}

// The present segment, and the one before.
void RecordingWriter::keepNow() {
  std::error_code none;
  const uint64_t first = std::max<uint64_t>(number_, 1) - 1;
  for (uint64_t number = first; number <= number_; ++number) {
    const std::string from = options_.folder + "/" + segmentName(number, false);
    if (std::filesystem::exists(from, none))
      std::filesystem::rename(from, options_.folder + "/" + segmentName(number, true), none);
  }
}

// Before a segment begins. The oldest ones go.
void RecordingWriter::makeRoom() {
  const std::vector<SegmentFile> all = segmentsIn(options_.folder);
  for (const bool kept : {false, true}) {
    const uint64_t limit =
        kept ? options_.keptBytes : options_.limitBytes - std::min(options_.limitBytes, options_.segmentBytes);
    uint64_t bytes = 0;
    for (const SegmentFile& file : all) bytes += file.kept == kept ? file.bytes : 0;
    std::error_code none;
    for (const SegmentFile& file : all) {
      if (bytes <= limit) break;
      if (file.kept != kept) continue;
      std::filesystem::remove(options_.folder + "/" + file.name, none);
      bytes -= file.bytes;
    }
  }
  deletePrograms();
}

void RecordingWriter::deletePrograms() {
  std::set<uint64_t> used;
  for (const auto& [hash, file] : programs_) used.insert(hash);
  std::string problem;
  for (const SegmentFile& file : segmentsIn(options_.folder))
    if (const auto head = readSegmentHead(options_.folder + "/" + file.name, problem)) used.insert(head->program);
  std::error_code none;
  std::vector<std::filesystem::path> unused;
  for (const auto& entry : std::filesystem::directory_iterator(options_.folder, none)) {
    const std::optional<uint64_t> hash = programOfName(entry.path().filename().string());
    if (hash && !used.contains(*hash)) unused.push_back(entry.path());
  }
  for (const std::filesystem::path& path : unused) std::filesystem::remove(path, none);
}

// ---- any thread --------------------------------------------------------------------------------------------------

void RecordingWriter::mark(std::string_view text) {
  constexpr size_t kMost = 400;
  const std::lock_guard lock(mutex_);
  marks_.emplace_back(text.substr(0, kMost));
}

void RecordingWriter::keep() {
  const std::lock_guard lock(mutex_);
  keeps_ = true;
}

void RecordingWriter::follow() {
  const std::lock_guard lock(mutex_);
  followUntilUs_ = wallUs() + kFollowUs;
}

void RecordingWriter::addProgram(uint64_t hash, std::span<const uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  writeProgram(hash, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void RecordingWriter::writeProgram(uint64_t hash, std::string_view bytes) {
  const std::string path = options_.folder + "/" + programName(hash);
  std::error_code none;
  if (!std::filesystem::exists(path, none)) programProblem_ = replaceFile(path, bytes, {.mode = 0644});
  File& file = programs_[hash];
  if (!file.ok()) file = File(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

RecordingState RecordingWriter::state() const {
  const std::lock_guard lock(mutex_);
  RecordingState state{.folder = options_.folder,
                       .written = written_,
                       .raw = raw_,
                       .losses = stream_.losses() + lostBlocks_,
                       .problem = problem_.empty() ? programProblem_ : problem_};
  constexpr int64_t kShownUs = 10'000'000; // longer than a host looks away
  if (state.problem.empty() && !moved_.empty() && wallUs() - movedUs_ < kShownUs) state.problem = moved_;
  std::string problem;
  const std::vector<SegmentFile> all = segmentsIn(options_.folder);
  for (const SegmentFile& file : all) state.bytes += file.bytes;
  if (file_ != nullptr && !all.empty()) state.file = options_.folder + "/" + all.back().name;
  if (!all.empty())
    if (const auto head = readSegmentHead(options_.folder + "/" + all.front().name, problem))
      state.sinceUs = head->wallUs;
  return state;
}

} // namespace rung::runtime

// See recording_reader.h.
#include "rtlib/record/recording_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace rung::runtime {

struct SegmentReader::Inflate {
  Inflate() {
    constexpr int kRaw = -15;
    if (inflateInit2(&stream, kRaw) != Z_OK) throw std::runtime_error("there is no memory to unpack a recording");
  }
  ~Inflate() { (void)inflateEnd(&stream); }
  Inflate(const Inflate&) = delete;
  Inflate& operator=(const Inflate&) = delete;
  z_stream stream{};
};

std::optional<SegmentReader> SegmentReader::open(const std::string& path, std::string& problem) {
  const std::optional<SegmentHead> head = readSegmentHead(path, problem);
  if (!head) return std::nullopt;
  File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.ok()) {
    problem = path + " cannot be read: " + fileProblem(errno);
    return std::nullopt;
  }
  return SegmentReader(std::move(file), path, *head);
}

SegmentReader::SegmentReader(File file, std::string path, const SegmentHead& head)
    : file_(std::move(file)), path_(std::move(path)), head_(head), inflate_(std::make_unique<Inflate>()) {}
SegmentReader::SegmentReader(SegmentReader&&) noexcept = default;
SegmentReader& SegmentReader::operator=(SegmentReader&&) noexcept = default;
SegmentReader::~SegmentReader() = default;

bool SegmentReader::read(uint64_t offset, void* to, size_t size) const {
  auto* bytes = static_cast<char*>(to);
  while (size != 0) {
    const ssize_t got = pread(file_.fd(), bytes, size, static_cast<off_t>(offset));
    if (got <= 0) return false;
    bytes += got;
    offset += static_cast<uint64_t>(got);
    size -= static_cast<size_t>(got);
  }
  return true;
}

uint64_t SegmentReader::size() const {
  struct stat file{};
  return fstat(file_.fd(), &file) == 0 ? static_cast<uint64_t>(file.st_size) : 0;
}

uint64_t SegmentReader::rest() const { return size() - std::min(size(), at_); }

// A block that is there as a whole.
std::optional<BlockHead> SegmentReader::blockAt(uint64_t offset, std::vector<uint8_t>& packed) const {
  BlockHead head;
  if (!read(offset, &head, sizeof head) || !head.isPossible()) return std::nullopt;
  if (head.size > size() - std::min(size(), offset + sizeof head)) return std::nullopt;
  packed.resize(head.size);
  if (!read(offset + sizeof head, packed.data(), packed.size()) || head.checksum != head.sum(packed))
    return std::nullopt;
  return head;
}

std::optional<uint64_t> SegmentReader::stateAfter(uint64_t offset) const {
  std::vector<uint8_t> packed, bytes(size() - std::min(size(), offset));
  if (!read(offset, bytes.data(), bytes.size())) return std::nullopt;
  const auto magic = std::bit_cast<std::array<uint8_t, sizeof BlockHead::kMagic>>(BlockHead::kMagic);
  for (auto at = bytes.begin(); (at = std::search(at, bytes.end(), magic.begin(), magic.end())) != bytes.end(); ++at) {
    const uint64_t place = offset + static_cast<uint64_t>(at - bytes.begin());
    const std::optional<BlockHead> head = blockAt(place, packed);
    if (head && head->kind == BlockKind::State) return place;
  }
  return std::nullopt;
}

// False: there is no state after it yet; this may be the block that is being written.
bool SegmentReader::skipDamage(uint64_t from) {
  const std::optional<uint64_t> next = stateAfter(from + 1);
  if (!next) return false;
  problems_.push_back(path_ + " is damaged from byte " + std::to_string(from) + " to byte " + std::to_string(*next));
  at_ = *next;
  gap_ = true;
  return true;
}

bool SegmentReader::unpack(const BlockHead& head, const std::vector<uint8_t>& packed, RecordedBlock& block) {
  z_stream& stream = inflate_->stream;
  if (head.kind == BlockKind::State) (void)inflateReset(&stream);
  block.events.resize(head.raw);
  stream.next_in = const_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = block.events.data();
  stream.avail_out = static_cast<uInt>(block.events.size());
  const int result = head.raw == 0 ? Z_OK : inflate(&stream, Z_SYNC_FLUSH);
  return result == Z_OK && stream.avail_out == 0;
}

bool SegmentReader::next(RecordedBlock& block) {
  std::vector<uint8_t> packed;
  while (!ended_) {
    const std::optional<BlockHead> head = blockAt(at_, packed);
    const bool isUsable = head && (!gap_ || head->kind == BlockKind::State);
    if (!isUsable || !unpack(*head, packed, block)) {
      if (at_ >= size() || !skipDamage(at_)) return false;
      continue;
    }
    block.kind = head->kind;
    block.offset = at_;
    block.wallUs = head->wallUs;
    block.afterGap = std::exchange(gap_, false);
    at_ += sizeof *head + head->size;
    ended_ = head->kind == BlockKind::End;
    return true;
  }
  return false;
}

void SegmentReader::seek(uint64_t offset) {
  at_ = offset;
  ended_ = false;
  gap_ = false;
}

std::vector<RecordedBlock> SegmentReader::states() {
  std::vector<RecordedBlock> found;
  BlockHead head;
  for (uint64_t at = at_; read(at, &head, sizeof head) && head.isPossible(); at += sizeof head + head.size)
    if (head.kind == BlockKind::State) found.push_back({.kind = head.kind, .offset = at, .wallUs = head.wallUs});
  return found;
}

// ---- a folder ----------------------------------------------------------------------------------------------------

std::optional<RecordingReader> RecordingReader::open(const std::string& path, std::string& problem) {
  RecordingReader recording;
  std::error_code none;
  const bool isFolder = std::filesystem::is_directory(path, none);
  recording.folder_ = isFolder ? path : folderOf(path);
  if (!isFolder) recording.only_ = std::filesystem::path(path).filename().string();
  recording.refresh();
  if (!recording.segments_.empty()) return recording;
  problem = recording.problems_.empty() ? path + " has no segments of a recording, which are files NUMBER.rec"
                                        : recording.problems_.front();
  return std::nullopt;
}

void RecordingReader::refresh() {
  segments_.clear();
  problems_.clear();
  for (SegmentFile& file : segmentsIn(folder_)) {
    if (!only_.empty() && file.name != only_) continue;
    std::string problem;
    const std::optional<SegmentHead> head = readSegmentHead(folder_ + "/" + file.name, problem);
    if (head && head->number != file.number)
      problems_.push_back(folder_ + "/" + file.name + " is segment " + std::to_string(head->number) +
                          ": it was renamed or belongs to another recording");
    if (head)
      segments_.push_back(std::move(file));
    else
      problems_.push_back(problem);
  }
}

std::optional<std::vector<uint8_t>> RecordingReader::program(uint64_t hash, std::string& problem) const {
  constexpr size_t kMost = size_t{1} << 30;
  const std::string path = folder_ + "/" + programName(hash);
  const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::string bytes;
  problem = file.ok() ? readAll(file.fd(), kMost, bytes) : fileProblem(errno);
  if (problem.empty()) return std::vector<uint8_t>(bytes.begin(), bytes.end());
  problem = "the program of the recording, " + path + ", cannot be read: " + problem;
  return std::nullopt;
}

} // namespace rung::runtime

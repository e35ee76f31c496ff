// libFuzzer target: any bytes as the two files of a retained image. What is loaded is one whole image of theirs, the
// newest that is intact, or nothing, with the reason; and what is saved after that is loaded next.
//
// The input: a byte of flags, the length of .a in two bytes (low first), .a, .b. Flags 1 and 2: the checksum of .a or
// .b is made right, so that what it covers is judged on its own; 4: .b is not there.
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ir/support/check.h"
#include "ir/support/temporary_folder.h"
#include "rtlib/retain/retain.h"
#include "rtlib/retain/retained_memory.h"

namespace {

using Bytes = std::vector<uint8_t>;

constexpr uint64_t kLayout = 0x1122334455667788;
constexpr uint32_t kSize = 8;
constexpr size_t kHeaderSize = 32;
constexpr size_t kCrcAt = 28;

uint64_t number(const Bytes& file, size_t at, size_t size) {
  uint64_t value = 0;
  for (size_t i = size; i > 0; --i) value = value << 8 | file[at + i - 1];
  return value;
}

uint32_t checksum(const Bytes& file) {
  const uLong head = crc32(0, file.data(), kCrcAt);
  const auto length = static_cast<uInt>(file.size() - kHeaderSize);
  return static_cast<uint32_t>(length == 0 ? head : crc32(head, file.data() + kHeaderSize, length));
}

void makeChecksumRight(Bytes& file) {
  if (file.size() < kHeaderSize) return;
  const uint32_t sum = checksum(file);
  for (size_t i = 0; i < 4; ++i) file[kCrcAt + i] = static_cast<uint8_t>(sum >> (8 * i));
}

// By the description of the format in retain.cpp.
bool intact(const Bytes& file) {
  return file.size() >= kHeaderSize && std::memcmp(file.data(), "RUNGRET1", 8) == 0 &&
         number(file, 24, 4) <= file.size() - kHeaderSize && number(file, kCrcAt, 4) == checksum(file) &&
         number(file, 16, 8) != std::numeric_limits<uint64_t>::max();
}

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// The newest intact file; null: there is none.
const Bytes* newestOf(const Bytes& a, const std::optional<Bytes>& b) {
  const bool aGood = intact(a);
  const bool bGood = b && intact(*b);
  if (!aGood && !bGood) return nullptr;
  if (aGood && bGood) return number(*b, 16, 8) > number(a, 16, 8) ? &*b : &a;
  return aGood ? &a : &*b;
}

// Of a program that keeps kSize bytes of a space D.
const std::string& ownDescription() {
  static const std::string description = [] {
    const rung_range range = {0, kSize, 0, RUNG_REPR_PACKED};
    const rung_space space = {"D", 1, kSize, 0, 1, &range};
    const rung_symbol symbol = {"COUNT", "", 0, 2, 0, RUNG_TYPE_I16, 1, 0, 0};
    rung_program program{};
    program.dialect = "test";
    program.space_count = program.symbol_count = 1;
    program.spaces = &space;
    program.symbols = &symbol;
    const rung::runtime::RetainRun run = {0, 0, kSize};
    return rung::runtime::retainLayoutOf(program, {&run, 1}).description;
  }();
  return description;
}

void checkLoad(const rung::runtime::RetainImage& image, const Bytes& a, const std::optional<Bytes>& b) {
  const Bytes* newest = newestOf(a, b);
  const bool fits = newest != nullptr && number(*newest, 8, 8) == kLayout && number(*newest, 24, 4) == kSize;
  RUNG_CHECK(image.found == fits, "an intact image of this layout is found, and no other");
  if (fits) {
    RUNG_CHECK(std::equal(image.bytes.begin(), image.bytes.end(), newest->begin() + kHeaderSize,
                          newest->begin() + kHeaderSize + kSize),
               "it is the whole image");
    RUNG_CHECK(image.generation == number(*newest, 16, 8), "it has its generation");
  } else {
    RUNG_CHECK(image.bytes.empty() || !image.description.empty(), "nothing of an image that nobody can use");
    const std::vector<uint8_t> initial(kSize);
    const std::vector<uint8_t> taken =
        rung::runtime::takeRetained(ownDescription(), image.description, image.bytes, initial).image;
    RUNG_CHECK(taken.empty() || taken.size() == kSize, "what is taken is an image of this layout");
  }
  const bool damaged = !intact(a) || (b && !intact(*b));
  RUNG_CHECK(image.report.empty() == (fits && !damaged), "what is wrong is reported, and nothing else");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 3) return 0;
  const uint8_t flags = data[0];
  const std::span<const uint8_t> rest(data + 3, size - 3);
  const size_t length = std::min<size_t>(static_cast<size_t>(data[1] | data[2] << 8), rest.size());
  Bytes a(rest.begin(), rest.begin() + static_cast<ptrdiff_t>(length));
  std::optional<Bytes> b(std::in_place, rest.begin() + static_cast<ptrdiff_t>(length), rest.end());
  if ((flags & 1) != 0) makeChecksumRight(a);
  if ((flags & 2) != 0) makeChecksumRight(*b);
  if ((flags & 4) != 0) b.reset();

  static const rung::TemporaryFolder folder;
  RUNG_CHECK(folder.ok(), "a temporary folder can be made");
  const std::string base = (folder / "plc").string();
  std::filesystem::remove(base + ".b");
  write(base + ".a", a);
  if (b) write(base + ".b", *b);
  rung::runtime::RetainStore store(base, kLayout, kSize);
  checkLoad(store.load(), a, b);

  const Bytes next = {1, 2, 3, 4, 5, 6, 7, 8};
  std::string error;
  RUNG_CHECK(store.save(next, error), "a new image can be saved");
  RUNG_CHECK(rung::runtime::RetainStore(base, kLayout, kSize).load().bytes == next,
             "what was saved last is loaded next");
  return 0;
}

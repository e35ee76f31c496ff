// See encoding.h.
#include "ir/support/encoding.h"

#include <algorithm>
#include <cerrno>
#include <iconv.h>

#include "ir/support/utf8.h"
#include "rtlib/text/letters.h"

namespace rung {
namespace {

class Converter {
public:
  Converter(const std::string& to, const std::string& from) : handle_(iconv_open(to.c_str(), from.c_str())) {}
  ~Converter() {
    if (isOpen()) iconv_close(handle_);
  }
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;

  // NOLINTNEXTLINE(performance-no-int-to-ptr): iconv says so that it knows no such encoding
  bool isOpen() const { return handle_ != reinterpret_cast<iconv_t>(-1); }

  // Returns the number of bytes converted; an incomplete character at the end remains.
  size_t convert(std::string_view bytes, std::string& out) {
    std::string input(bytes); // iconv takes a non-const buffer
    char* from = input.data();
    size_t left = input.size();
    if (put(&from, &left, out)) put(nullptr, nullptr, out); // flushes the shift state
    return input.size() - left;
  }

private:
  // False: at a byte that does not begin a character, or at a character that the other encoding lacks.
  bool put(char** from, size_t* left, std::string& out) {
    char buffer[4096];
    for (;;) {
      char* to = buffer;
      size_t room = sizeof buffer;
      const size_t replaced = iconv(handle_, from, left, &to, &room);
      out.append(buffer, sizeof buffer - room);
      if (replaced != static_cast<size_t>(-1)) return true;
      if (errno != E2BIG) return false;
    }
  }

  iconv_t handle_;
};

constexpr char kUtf8[] = "UTF-8";

bool isNameCharacter(char c) {
  return text::isLetter(c) || text::isDigit(c) || c == '-' || c == '_' || c == '.' || c == ':';
}

bool isOfText(unsigned unit) { return unit >= ' ' || unit == '\t' || unit == '\r' || unit == '\n'; }

// Whether this is the beginning of a text in UTF-16LE: an ASCII character, and a first line that has another one, such
// as its end, and no control characters.
bool beginsWideText(std::string_view bytes) {
  const auto unitAt = [&](size_t at) {
    const unsigned high = static_cast<unsigned char>(bytes[at + 1]);
    return high << 8 | static_cast<unsigned char>(bytes[at]);
  };
  if (bytes.size() < 4 || bytes[1] != 0 || !isOfText(unitAt(0))) return false;
  bool hasAnother = false;
  for (size_t at = 2; at + 1 < bytes.size(); at += 2) {
    const unsigned unit = unitAt(at);
    if (!isOfText(unit)) return false;
    hasAnother |= unit < 0x80;
    if (unit == '\n') break;
  }
  return hasAnother;
}

} // namespace

bool knowsEncoding(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, isNameCharacter) && Converter(kUtf8, name).isOpen();
}

Decoded decoded(std::string_view bytes, const std::string& encoding) {
  Decoded out;
  const size_t done = Converter(kUtf8, encoding).convert(bytes, out.text);
  if (done != bytes.size()) out.wrong = done;
  return out;
}

std::optional<std::string> encoded(std::string_view text, const std::string& encoding) {
  std::string out;
  if (Converter(encoding, kUtf8).convert(text, out) != text.size()) return std::nullopt;
  return out;
}

std::string shownEncoding(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return "UTF-16";
  return beginsWideText(bytes) ? "UTF-16LE" : "";
}

std::string guessedEncoding(std::string_view bytes) {
  if (std::string shown = shownEncoding(bytes); !shown.empty()) return shown;
  return findInvalidUtf8(bytes) == std::string_view::npos ? kUtf8 : "ISO-8859-1";
}

std::optional<EncodingLine> encodingLine(std::string_view bytes) {
  constexpr std::string_view kBlanks = " \t\r";
  std::string_view left = bytes;
  if (left.starts_with(kByteOrderMark)) left.remove_prefix(kByteOrderMark.size());
  for (int number = 1; number <= 2; ++number) {
    const size_t end = left.find('\n');
    std::string_view line = left.substr(0, end);
    const auto skipBlanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size())); };
    skipBlanks();
    bool says = text::takePrefixIgnoringCase(line, ";");
    skipBlanks();
    says = says && text::takePrefixIgnoringCase(line, "encoding:");
    skipBlanks();
    line = line.substr(0, line.find_last_not_of(kBlanks) + 1);
    if (says && !line.empty() && std::ranges::all_of(line, isNameCharacter))
      return EncodingLine{std::string(line), static_cast<size_t>(line.data() - bytes.data())};
    if (end == std::string_view::npos) break;
    left.remove_prefix(end + 1);
  }
  return std::nullopt;
}

} // namespace rung

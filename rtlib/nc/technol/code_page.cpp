// The character sets of Czech sources (see code_page.h).
#include "rtlib/nc/technol/code_page.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "rtlib/text/utf8.h"

namespace rung::nc {
namespace {

// Unicode of the bytes 0x80 to 0xFF, eight to a line.
// clang-format off
constexpr uint16_t kWindows1250[128] = {
    0x20AC, 0x0081, 0x201A, 0x0083, 0x201E, 0x2026, 0x2020, 0x2021,
    0x0088, 0x2030, 0x0160, 0x2039, 0x015A, 0x0164, 0x017D, 0x0179,
    0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
    0x0098, 0x2122, 0x0161, 0x203A, 0x015B, 0x0165, 0x017E, 0x017A,
    0x00A0, 0x02C7, 0x02D8, 0x0141, 0x00A4, 0x0104, 0x00A6, 0x00A7,
    0x00A8, 0x00A9, 0x015E, 0x00AB, 0x00AC, 0x00AD, 0x00AE, 0x017B,
    0x00B0, 0x00B1, 0x02DB, 0x0142, 0x00B4, 0x00B5, 0x00B6, 0x00B7,
    0x00B8, 0x0105, 0x015F, 0x00BB, 0x013D, 0x02DD, 0x013E, 0x017C,
    0x0154, 0x00C1, 0x00C2, 0x0102, 0x00C4, 0x0139, 0x0106, 0x00C7,
    0x010C, 0x00C9, 0x0118, 0x00CB, 0x011A, 0x00CD, 0x00CE, 0x010E,
    0x0110, 0x0143, 0x0147, 0x00D3, 0x00D4, 0x0150, 0x00D6, 0x00D7,
    0x0158, 0x016E, 0x00DA, 0x0170, 0x00DC, 0x00DD, 0x0162, 0x00DF,
    0x0155, 0x00E1, 0x00E2, 0x0103, 0x00E4, 0x013A, 0x0107, 0x00E7,
    0x010D, 0x00E9, 0x0119, 0x00EB, 0x011B, 0x00ED, 0x00EE, 0x010F,
    0x0111, 0x0144, 0x0148, 0x00F3, 0x00F4, 0x0151, 0x00F6, 0x00F7,
    0x0159, 0x016F, 0x00FA, 0x0171, 0x00FC, 0x00FD, 0x0163, 0x02D9,
};
constexpr uint16_t kCp852[128] = {
    0x00C7, 0x00FC, 0x00E9, 0x00E2, 0x00E4, 0x016F, 0x0107, 0x00E7,
    0x0142, 0x00EB, 0x0150, 0x0151, 0x00EE, 0x0179, 0x00C4, 0x0106,
    0x00C9, 0x0139, 0x013A, 0x00F4, 0x00F6, 0x013D, 0x013E, 0x015A,
    0x015B, 0x00D6, 0x00DC, 0x0164, 0x0165, 0x0141, 0x00D7, 0x010D,
    0x00E1, 0x00ED, 0x00F3, 0x00FA, 0x0104, 0x0105, 0x017D, 0x017E,
    0x0118, 0x0119, 0x00AC, 0x017A, 0x010C, 0x015F, 0x00AB, 0x00BB,
    0x2591, 0x2592, 0x2593, 0x2502, 0x2524, 0x00C1, 0x00C2, 0x011A,
    0x015E, 0x2563, 0x2551, 0x2557, 0x255D, 0x017B, 0x017C, 0x2510,
    0x2514, 0x2534, 0x252C, 0x251C, 0x2500, 0x253C, 0x0102, 0x0103,
    0x255A, 0x2554, 0x2569, 0x2566, 0x2560, 0x2550, 0x256C, 0x00A4,
    0x0111, 0x0110, 0x010E, 0x00CB, 0x010F, 0x0147, 0x00CD, 0x00CE,
    0x011B, 0x2518, 0x250C, 0x2588, 0x2584, 0x0162, 0x016E, 0x2580,
    0x00D3, 0x00DF, 0x00D4, 0x0143, 0x0144, 0x0148, 0x0160, 0x0161,
    0x0154, 0x00DA, 0x0155, 0x0170, 0x00FD, 0x00DD, 0x0163, 0x00B4,
    0x00AD, 0x02DD, 0x02DB, 0x02C7, 0x02D8, 0x00A7, 0x00F7, 0x00B8,
    0x00B0, 0x00A8, 0x02D9, 0x0171, 0x0158, 0x0159, 0x25A0, 0x00A0,
};
// clang-format on

constexpr std::u16string_view kSmall =
    u"\u00E1\u010D\u010F\u00E9\u011B\u00ED\u0148\u00F3\u0159\u0161\u0165\u00FA\u016F\u00FD\u017E";
constexpr std::u16string_view kCapital =
    u"\u00C1\u010C\u010E\u00C9\u011A\u00CD\u0147\u00D3\u0158\u0160\u0164\u00DA\u016E\u00DD\u017D";

constexpr const uint16_t* tableOf(CodePage page) { return page == CodePage::Cp852 ? kCp852 : kWindows1250; }

// The weight of a character in favour of its code page: Czech letters count, small ones most.
constexpr int weightOf(uint16_t character) {
  if (kSmall.find(static_cast<char16_t>(character)) != std::u16string_view::npos) return 3;
  if (kCapital.find(static_cast<char16_t>(character)) != std::u16string_view::npos) return 1;
  return -2;
}

constexpr std::array<int, 128> weightsOf(CodePage page) {
  std::array<int, 128> weights{};
  for (size_t i = 0; i < weights.size(); ++i) weights[i] = weightOf(tableOf(page)[i]);
  return weights;
}

void append(std::string& out, uint32_t c) {
  if (c < 0x80) {
    out.push_back(static_cast<char>(c));
  } else if (c < 0x800) {
    out.push_back(static_cast<char>(0xC0 | c >> 6));
    out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
  } else {
    out.push_back(static_cast<char>(0xE0 | c >> 12));
    out.push_back(static_cast<char>(0x80 | (c >> 6 & 0x3F)));
    out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
  }
}

// The character at `at`, which is moved past it. A byte that does not begin a character is returned unchanged.
uint32_t nextCharacter(std::string_view from, size_t& at) {
  const auto first = static_cast<unsigned char>(from[at++]);
  const size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
  uint32_t value = more == 0 ? first : first & (0x3Fu >> more);
  for (size_t i = 0; i < more && at < from.size() && text::isUtf8Continuation(from[at]); ++i)
    value = value << 6 | (static_cast<unsigned char>(from[at++]) & 0x3Fu);
  return value;
}

} // namespace

CodePage guessCodePage(std::string_view text) {
  static constexpr auto kOf1250 = weightsOf(CodePage::Windows1250), kOf852 = weightsOf(CodePage::Cp852);
  int64_t balance = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) balance += kOf852[byte - 0x80u] - kOf1250[byte - 0x80u];
  }
  return balance > 0 ? CodePage::Cp852 : CodePage::Windows1250;
}

uint32_t unicodeOf(CodePage page, uint8_t byte) { return byte < 0x80 ? byte : tableOf(page)[byte - 0x80u]; }

std::string utf8From(CodePage page, std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size());
  for (const char c : bytes) append(out, unicodeOf(page, static_cast<uint8_t>(c)));
  return out;
}

std::optional<uint8_t> windows1250Of(uint32_t codePoint) {
  if (codePoint < 0x80) return static_cast<uint8_t>(codePoint);
  const auto* found = std::find(std::begin(kWindows1250), std::end(kWindows1250), codePoint);
  if (found == std::end(kWindows1250)) return std::nullopt;
  return static_cast<uint8_t>(0x80 + (found - std::begin(kWindows1250)));
}

std::string memoryText(std::string_view utf8) {
  std::string out;
  out.reserve(utf8.size());
  for (size_t at = 0; at < utf8.size();)
    out.push_back(static_cast<char>(windows1250Of(nextCharacter(utf8, at)).value_or('?')));
  return out;
}

} // namespace rung::nc

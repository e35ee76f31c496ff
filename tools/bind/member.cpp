// See member.h.
#include "tools/bind/member.h"

#include <fmt/format.h>

#include "ir/support/hash.h"
#include "rtlib/text/number.h"
#include "rtlib/text/similar.h"

namespace rung::bind {

namespace {

using codegen::HostLayout;
using codegen::HostMember;
using codegen::HostRecord;
using codegen::MemberKind;

// Finds a member of the record, or of an anonymous struct or union in it.
bool findIn(const HostLayout& layout, const HostRecord& record, std::string_view name, uint64_t begin, Member& found) {
  for (const HostMember& member : record.members) {
    if (member.name == name) {
      found = {&member, begin + member.bit, member.lengths};
      return true;
    }
    const bool anonymous = member.name.empty() && member.kind == MemberKind::Record;
    if (anonymous && findIn(layout, layout.records[member.record], name, begin + member.bit, found)) return true;
  }
  return false;
}

void offerNames(const HostLayout& layout, const HostRecord& record, text::Similar& similar) {
  for (const HostMember& member : record.members) {
    if (!member.name.empty())
      similar.offer(member.name);
    else if (member.kind == MemberKind::Record)
      offerNames(layout, layout.records[member.record], similar);
  }
}

class Path {
public:
  Path(const HostLayout& layout, std::string_view text) : layout_(layout), text_(text), rest_(text) {}

  std::variant<Member, std::string> find() {
    uint32_t record = 0;
    for (;;) {
      if (!takeName(record) || !takeIndices()) return problem_;
      if (rest_.empty()) return at_;
      rest_.remove_prefix(1); // the dot
      if (at_.is->kind != MemberKind::Record || !at_.lengths.empty())
        return fmt::format("found a member of {}, which is {}, expected one of a struct; remove what follows", done(),
                           at_.lengths.empty() ? at_.is->type : "an array");
      record = at_.is->record;
    }
  }

private:
  std::string done() const { return std::string(text_.substr(0, text_.size() - rest_.size() - 1)); }

  bool takeName(uint32_t record) {
    const std::string where = at_.is == nullptr ? layout_.type : done();
    const size_t end = std::min(rest_.find_first_of(".["), rest_.size());
    const std::string_view name = rest_.substr(0, end);
    rest_.remove_prefix(end);
    const HostRecord& in = layout_.records[record];
    if (!name.empty() && findIn(layout_, in, name, at_.bit, at_)) return true;
    text::Similar similar(name);
    offerNames(layout_, in, similar);
    problem_ = fmt::format("found an unknown member {}, expected one of {}{}", name, where,
                           similar.best().empty() ? "; --template lists them" : text::didYouMean(similar.best()));
    return false;
  }

  bool takeIndices() {
    while (rest_.starts_with('[')) {
      const size_t end = std::min(rest_.find(']'), rest_.size() - 1);
      const auto index = text::numberIn<uint64_t>(rest_.substr(1, end - 1));
      if (at_.lengths.empty() || !index || *index >= at_.lengths.front()) {
        problem_ =
            at_.lengths.empty()
                ? fmt::format("found an index of {}, which is not an array, expected none; remove it", at_.is->name)
                : fmt::format("found the index {}, expected 0 to {}; write for example {}[0]", rest_.substr(0, end + 1),
                              at_.lengths.front() - 1, at_.is->name);
        return false;
      }
      at_.lengths.erase(at_.lengths.begin());
      at_.bit += 8 * *index * at_.bytes();
      rest_.remove_prefix(end + 1);
    }
    return true;
  }

  const HostLayout& layout_;
  std::string_view text_, rest_;
  Member at_;
  std::string problem_;
};

class Walk {
public:
  Walk(const HostLayout& layout, const std::function<void(const std::string&, const Member&)>& see)
      : layout_(layout), see_(see) {}

  void record(uint32_t number, const std::string& before, uint64_t begin) {
    for (const HostMember& member : layout_.records[number].members) {
      const Member at{&member, begin + member.bit, member.lengths};
      if (member.kind == MemberKind::Record)
        elements(member, before + member.name, at.bit, member.lengths);
      else if (member.kind != MemberKind::Other)
        see_(before + member.name, at);
    }
  }

private:
  void elements(const HostMember& member, const std::string& path, uint64_t begin, std::vector<uint64_t> lengths) {
    if (lengths.empty()) return record(member.record, member.name.empty() ? path : path + ".", begin);
    const uint64_t count = lengths.front();
    lengths.erase(lengths.begin());
    uint64_t size = 8 * member.bytes;
    for (const uint64_t length : lengths) size *= length;
    for (uint64_t i = 0; i < count; ++i) elements(member, fmt::format("{}[{}]", path, i), begin + i * size, lengths);
  }

  const HostLayout& layout_;
  const std::function<void(const std::string&, const Member&)>& see_;
};

} // namespace

uint64_t Member::elements() const {
  uint64_t count = 1;
  for (const uint64_t length : lengths) count *= length;
  return count;
}

std::variant<Member, std::string> findMember(const HostLayout& layout, std::string_view path) {
  return Path(layout, path).find();
}

void forEachNumber(const HostLayout& layout, const std::function<void(const std::string&, const Member&)>& see) {
  Walk(layout, see).record(0, "", 0);
}

namespace {

constexpr std::string_view kBegin = "/* rung-binding 1 ";
constexpr std::string_view kLine = " *   ";
constexpr std::string_view kEnd = " */";

std::string headOf(std::string_view name, uint64_t hash) { return fmt::format("{}{} {:016x}\n", kBegin, name, hash); }

} // namespace

uint64_t hashOf(std::string_view text) { return hashBytes(text); }

std::string claimText(std::string_view name, std::string_view text) {
  std::string out = headOf(name, hashOf(text));
  while (!text.empty()) {
    const size_t end = text.find('\n') + 1;
    out += fmt::format("{}{}", kLine, text.substr(0, end));
    text.remove_prefix(end);
  }
  return fmt::format("{}{}\n", out, kEnd);
}

Result<Claim> claimIn(std::string_view file) {
  const size_t begin = file.find(kBegin);
  if (begin == std::string_view::npos) return failure("it is not a file that rungc bind has made");
  std::string_view rest = file.substr(begin);
  const size_t nameEnd = rest.find(' ', kBegin.size());
  const size_t headEnd = rest.find('\n');
  Claim claim;
  if (nameEnd < headEnd && headEnd != std::string_view::npos) {
    claim.name = rest.substr(kBegin.size(), nameEnd - kBegin.size());
    const std::string_view head = rest.substr(0, headEnd + 1);
    rest.remove_prefix(headEnd + 1);
    while (rest.starts_with(kLine)) {
      const size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
      claim.text += rest.substr(kLine.size(), end - kLine.size());
      rest.remove_prefix(end);
    }
    if (rest.starts_with(kEnd) && head == headOf(claim.name, hashOf(claim.text))) return claim;
  }
  return failure("it was changed after rungc bind has made it; run rungc bind again");
}

} // namespace rung::bind

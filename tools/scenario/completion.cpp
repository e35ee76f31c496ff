// Completion of words (see completion.h).
#include "tools/scenario/completion.h"

#include <algorithm>
#include <filesystem>

#include "rtlib/load/program_info.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/utf8.h"
#include "tools/scenario/names.h"
#include "tools/scenario/services.h"

namespace rung::scenario {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> beginning(std::string_view word, const std::vector<std::string>& candidates) {
  std::vector<std::string> found;
  std::ranges::copy_if(candidates, std::back_inserter(found),
                       [&](const std::string& candidate) { return text::startsWithIgnoringCase(candidate, word); });
  return found;
}

std::vector<std::string> services(const rung_program& program) {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < program.service_count; ++i)
    names.push_back(ServiceSignature(runtime::serviceName(program, i)).name());
  return names;
}

// Those of the folder that the word names so far; folders end in a slash.
std::vector<std::string> files(std::string_view word) {
  const fs::path folder = fs::path(word).parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code none;
    names.push_back((folder / at->path().filename()).string() + (at->is_directory(none) ? "/" : ""));
  }
  return names;
}

std::string_view withoutQuote(std::string_view word) { return word.starts_with('"') ? word.substr(1) : word; }

// Names with blanks, as a statement takes them.
std::vector<std::string> inQuotes(std::vector<std::string> names) {
  for (std::string& name : names)
    if (name.find(' ') != std::string::npos) name = '"' + name + '"';
  return names;
}

} // namespace

const std::vector<std::string>& Completion::values() {
  const runtime::Instance& instance = session_.instance();
  if (values_.empty() || generation_ != instance.generation()) values_ = namesOf(instance.program(), session_.nc());
  generation_ = instance.generation();
  return values_;
}

std::vector<std::string> Completion::of(Names names, std::string_view word) {
  std::vector<std::string> found;
  switch (names) {
  case Names::None: return {};
  case Names::Values: found = beginning(word, values()); break;
  case Names::Services: found = beginning(word, services(session_.instance().program())); break;
  case Names::Statements: found = beginning(word, statements_); break;
  case Names::Files: found = inQuotes(beginning(withoutQuote(word), files(withoutQuote(word)))); break;
  case Names::PlcCommands: found = beginning(word, {"clear", "start", "stop"}); break;
  case Names::BlockCommands: found = beginning(word, {"done", "start"}); break;
  }
  std::ranges::sort(found);
  return found;
}

std::string commonStart(const std::vector<std::string>& words) {
  std::string common = words.empty() ? std::string() : words[0];
  for (const std::string& word : words) {
    size_t same = static_cast<size_t>(std::ranges::mismatch(common, word).in1 - common.begin());
    while (same > 0 && same < word.size() && text::isUtf8Continuation(word[same])) --same; // not within a character
    common.resize(same);
  }
  return common;
}

} // namespace rung::scenario

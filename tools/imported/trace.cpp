// A signal trace as LADDER-III saves it: lines about the trace, then the line `Data,X8.4,Y0.1` with the addresses, then
// a line `-3,1,0` for each frame, of which number 0 is the trigger.
//
// A scenario sets the inputs of a frame when the frame's time has come and then runs to the next one. The machine's
// inputs changed at some time since the frame before, and its cycle began at another time than that of the scenario, so
// its outputs may change up to `tolerance` frames earlier or later: an output is expected in a frame only if the trace
// has the same value in all frames so near.
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/imported/imported.h"
#include "tools/imported/lines.h"
#include "tools/imported/slots.h"

namespace rung::imported {
namespace {

constexpr size_t kMostQuotedLines = 40; // before the data

enum class Role : uint8_t { Input, Output, System };

struct Signal {
  std::string name;
  Role role = Role::Input;
  text::Position at;
};

struct Frame {
  int64_t number = 0;
  std::vector<bool> values; // of the signals
};

struct Trace {
  std::vector<std::string> before; // lines before the data
  std::vector<Signal> signals;
  std::vector<Frame> frames;
};

// Relays of the control itself: clocks, and the results of the operation before.
bool isSystem(const PmcAddress& address) {
  return address.area == 'Z' || (address.area == 'R' && address.number >= 9000) ||
         (address.area == 'A' && address.number >= 9000);
}

Role roleOf(const PmcAddress& address) {
  constexpr std::string_view kInputs = "XFM";
  if (isSystem(address)) return Role::System;
  return kInputs.find(address.area) != std::string_view::npos ? Role::Input : Role::Output;
}

class Reader {
public:
  explicit Reader(std::vector<Remark>& remarks) : remarks_(remarks) {}

  Trace read(std::string_view text) {
    for (const Line& line : linesOf(text)) {
      if (isBlank(line)) continue;
      std::vector<Field> fields = fieldsOf(line);
      while (fields.size() > 1 && fields.back().text.empty()) fields.pop_back(); // of a spreadsheet
      if (!trace_.signals.empty())
        readFrame(line, fields);
      else if (text::equalsIgnoringCase(fields[0].text, "Data"))
        readSignals(fields);
      else if (trace_.before.size() < kMostQuotedLines)
        trace_.before.push_back(asShown(line.text));
    }
    return std::move(trace_);
  }

private:
  void wrong(text::Position at, std::string text) { remarks_.push_back({at, std::move(text), true}); }

  void readSignals(const std::vector<Field>& fields) {
    for (size_t i = 1; i < fields.size(); ++i) {
      const std::optional<PmcAddress> address = pmcAddress(fields[i].text);
      if (!address || !address->bit || address->pmc != 1)
        wrong(fields[i].at,
              fmt::format("found '{}', expected the address of a bit of PMC 1, such as X8.4", inBrief(fields[i].text)));
      const Signal signal = address ? Signal{nameOf(*address), roleOf(*address), fields[i].at} : Signal{};
      if (address && std::ranges::find(trace_.signals, signal.name, &Signal::name) != trace_.signals.end())
        wrong(fields[i].at, fmt::format("{} has a column already", signal.name));
      trace_.signals.push_back(signal);
    }
    if (trace_.signals.empty()) wrong(fields[0].at, "found no address after Data");
  }

  void readFrame(const Line& line, const std::vector<Field>& fields) {
    const auto number = text::wholeIn<int64_t>(fields[0].text);
    if (!number || *number > kMostFrames || *number < -kMostFrames)
      return wrong(fields[0].at, fmt::format("found '{}', expected the number of a frame", inBrief(fields[0].text)));
    const int64_t before = std::exchange(last_, *number).value_or(*number - 1);
    if (*number != before + 1)
      return wrong(fields[0].at, fmt::format("the first column must be the number of the frame, one more in each line; "
                                             "found {} after {}",
                                             *number, before));
    if (fields.size() != trace_.signals.size() + 1)
      return wrong(positionOf(line, 0),
                   fmt::format("values of the frame: found {}, expected {}", fields.size() - 1, trace_.signals.size()));
    Frame frame{.number = *number, .values = {}};
    for (size_t i = 1; i < fields.size(); ++i) {
      if (fields[i].text != "0" && fields[i].text != "1")
        return wrong(fields[i].at, fmt::format("found '{}', expected 0 or 1", inBrief(fields[i].text)));
      frame.values.push_back(fields[i].text == "1");
    }
    trace_.frames.push_back(std::move(frame));
  }

  static constexpr int64_t kMostFrames = 1'000'000'000;

  std::vector<Remark>& remarks_;
  Trace trace_;
  std::optional<int64_t> last_; // number of the line before
};

class Writer {
public:
  Writer(std::vector<Remark>& remarks, const Trace& trace, const Sampling& sampling)
      : remarks_(remarks), trace_(trace), sampling_(sampling), expected_(trace.signals.size(), 0) {}

  std::string write(const Source& source) {
    writeFirst();
    for (size_t i = 1; i < trace_.frames.size(); ++i) writeFrame(i);
    remarkSampling();
    for (size_t i = 0; i < trace_.signals.size(); ++i) remarkSignal(i);
    return headOf(source) + text_;
  }

private:
  std::string headOf(const Source& source) const {
    std::string text = fmt::format("# Made by rungc import from {}: a signal trace of {} frames, one in {} ms.\n"
                                   "# An input is set when the first frame with its new value begins; it changed at "
                                   "some time since the frame before.\n"
                                   "# An output is expected in a frame if the trace has the same value {} frame{} "
                                   "before and after it. What changed and\n"
                                   "# changed back between two frames is not in a trace.\n"
                                   "# The program starts cold: what the machine had remembered before the first frame, "
                                   "and retained values, must be set\n"
                                   "# before it (include FILE) if the outputs depend on them.\n",
                                   asShown(source.name), trace_.frames.size(), static_cast<double>(sampling_.us) / 1000,
                                   sampling_.tolerance, sampling_.tolerance == 1 ? "" : "s");
    for (const std::string& line : trace_.before) text += "#   " + line + '\n';
    return text;
  }

  void set(const Signal& signal, bool value) { text_ += fmt::format("set {} {}\n", signal.name, value ? 1 : 0); }

  // All signals, so that an output that holds itself does so.
  void writeFirst() {
    text_ += fmt::format("\n# frame {}\n", trace_.frames[0].number);
    for (size_t i = 0; i < trace_.signals.size(); ++i)
      if (trace_.signals[i].role != Role::System) set(trace_.signals[i], trace_.frames[0].values[i]);
    text_ += slotsText(slotsOf(sampling_.settleUs));
  }

  // Slots from the first frame to this one.
  int64_t slotsTo(size_t frame) const { return (static_cast<int64_t>(frame) * sampling_.us + kSlotUs / 2) / kSlotUs; }

  void writeFrame(size_t frame) {
    const int64_t slots = slotsTo(frame) - slotsTo(frame - 1);
    text_ += slotsText(slots) + fmt::format("\n# frame {}\n", trace_.frames[frame].number);
    for (size_t i = 0; slots > 0 && i < trace_.signals.size(); ++i)
      if (trace_.signals[i].role == Role::Output && isSteady(i, frame)) expect(i, frame);
    for (size_t i = 0; i < trace_.signals.size(); ++i)
      if (trace_.signals[i].role == Role::Input && valueOf(i, frame) != valueOf(i, frame - 1))
        set(trace_.signals[i], valueOf(i, frame));
  }

  bool valueOf(size_t signal, size_t frame) const { return trace_.frames[frame].values[signal]; }

  // Whether the trace has all frames within the tolerance, and the same value in them.
  bool isSteady(size_t signal, size_t frame) const {
    if (frame < sampling_.tolerance || frame + sampling_.tolerance >= trace_.frames.size()) return false;
    for (size_t other = frame - sampling_.tolerance; other <= frame + sampling_.tolerance; ++other)
      if (valueOf(signal, other) != valueOf(signal, frame)) return false;
    return true;
  }

  void expect(size_t signal, size_t frame) {
    text_ += fmt::format("expect {} {}\n", trace_.signals[signal].name, valueOf(signal, frame) ? 1 : 0);
    ++expected_[signal];
  }

  void remarkSampling() {
    const text::Position at = trace_.signals[0].at;
    if (sampling_.us < kSlotUs)
      remarks_.push_back({at, "the sampling is shorter than a slot of 8 ms: frames of one slot are set together"});
    if (std::ranges::find(trace_.signals, Role::Output, &Signal::role) == trace_.signals.end())
      remarks_.push_back({at, "the trace has no output of the program: the scenario expects nothing"});
  }

  void remarkSignal(size_t number) {
    const Signal& signal = trace_.signals[number];
    const size_t all = trace_.frames.size();
    if (signal.role == Role::System)
      remarks_.push_back(
          {signal.at, fmt::format("{} is a relay of the control itself, neither set nor expected", signal.name)});
    else if (signal.role == Role::Output)
      remarks_.push_back({signal.at, fmt::format("{} is expected in {} of {} frames; the others are within {} frame{} "
                                                 "of a change or of an end of the trace",
                                                 signal.name, expected_[number], all, sampling_.tolerance,
                                                 sampling_.tolerance == 1 ? "" : "s")});
  }

  std::vector<Remark>& remarks_;
  const Trace& trace_;
  Sampling sampling_;
  std::vector<size_t> expected_; // of each signal
  std::string text_;
};

} // namespace

Imported scenarioOfTrace(const Source& source, const Sampling& sampling) {
  Imported made;
  const Trace trace = Reader(made.remarks).read(source.text);
  if (made.isUsable() && trace.frames.size() < 2)
    made.remarks.push_back(
        {{},
         "found no frames, expected a line Data,X8.4,Y0.1 with addresses, and a line such as 0,1,0 for each frame",
         true});
  if (made.isUsable()) made.text = Writer(made.remarks, trace, sampling).write(source);
  return made;
}

} // namespace rung::imported

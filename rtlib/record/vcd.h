// Writes value change dumps for wave viewers (IEEE 1364, clause 18). Texts use an extension that GTKWave supports.
#pragma once
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rung::runtime {

enum class TracedKind : uint8_t { Integer, Real, Text };

struct TracedName {
  std::string name;
  std::string scope; // a group of names
  TracedKind kind = TracedKind::Integer;
  uint32_t width = 1; // of an integer, in bits
};

struct TracedValue {
  bool known = false;   // the program has the name now
  uint64_t integer = 0; // its lowest bits
  double real = 0;
  std::string_view text;
};

class VcdWriter {
public:
  explicit VcdWriter(std::ostream& out) : out_(out) {}
  // To be called once, before the samples.
  void begin(std::string_view program, std::span<const TracedName> names);
  // Writes the values of all names; `us` must not decrease. `lost`: the number of scans so far without a sample.
  void sample(int64_t us, std::span<const TracedValue> values, uint64_t lost = 0);
  // Ends the file at the time of the last sample, even if nothing changed in it.
  void end();

private:
  void writeScope(const std::string& scope);
  void stamp(int64_t us);

  std::ostream& out_;
  std::vector<TracedName> names_;
  std::vector<std::string> last_;
  std::optional<int64_t> time_;
  int64_t end_ = 0;
  uint64_t lost_ = 0;
};

} // namespace rung::runtime

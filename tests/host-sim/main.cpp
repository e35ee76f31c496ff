// rung_host_sim: simulated hosts, one a seed. A seed that goes wrong is shown with the shortest list of events that
// does.
#include <optional>

#include <fmt/core.h>

#include "machine/command-line/command_line.h"
#include "tests/host-sim/simulator.h"

int main(int argc, char** argv) {
  using namespace rung;
  using namespace rung::host_sim;
  cli::CommandLine app({.name = "rung_host_sim",
                        .description = "Simulates hosts to which everything happens in an order of their own",
                        .exitStatus = "0 nothing wrong, 1 a seed goes wrong, 2 wrong usage",
                        .guide = "",
                        .seeAlso = {}});
  std::optional<uint64_t> seed, count, events;
  app.root().option("--seed", seed, "The first one; without it 1");
  app.root().option("--count", count, "So many seeds; without it 1000, with --seed alone 1");
  app.root().option("--events", events, "Events of each; without it 120. A seed is repeated with the same number");
  const std::optional<int> decided = app.run(argc, argv, [](const cli::WrongWords& words) {
    fmt::print(stderr, "rung_host_sim: {}\n", words.text);
    return 2;
  });
  if (decided) return *decided;
  const uint64_t first = seed.value_or(1);
  const uint64_t seeds = count.value_or(seed ? 1 : 1000);
  const uint64_t length = events.value_or(120);
  const Programs programs;
  for (uint64_t i = 0; i < seeds; ++i) {
    const std::vector<Event> list = eventsOf(first + i, length);
    if (run(programs, list).empty()) continue;
    const std::vector<Event> less = minimised(programs, list);
    fmt::print("seed {}: {}\n", first + i, run(programs, less));
    for (const Event& event : less) fmt::print("  {}\n", textOf(event));
    return 1;
  }
  fmt::print("{} seeds from {} on, {} events each: nothing wrong\n", seeds, first, length);
  return 0;
}

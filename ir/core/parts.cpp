// Partitions a run into parts (see parts.h).
#include "ir/core/parts.h"

#include <algorithm>

namespace rung::ir {
namespace {

bool sameSource(const Rung& a, const Rung& b) {
  return a.begin.file.valid() && a.begin.file == b.begin.file && a.begin.line == b.begin.line &&
         a.begin.column == b.begin.column;
}

// Weights of routines with everything that they call, counted once per call.
class Weights {
public:
  explicit Weights(const Module& module) : module_(module), known_(module.routines.size()) {}

  std::vector<PartPiece> pieces(RoutineId routine) {
    std::vector<PartPiece> result;
    const std::vector<Rung>& rungs = module_.at(routine).rungs;
    uint64_t own = 0; // the largest weight among rungs of one position, which is that of the source's rung
    for (uint32_t i = 0; i < rungs.size(); ++i) {
      const bool joins = i > 0 && sameSource(rungs[i - 1], rungs[i]);
      const bool closes = i > 0 && i + 1 == rungs.size() && rungs[i].ops.empty();
      if (!joins) own = 0;
      if (!joins && !closes) result.push_back({i, 0});
      if (rungs[i].weight > own) {
        result.back().weight += rungs[i].weight - own;
        own = rungs[i].weight;
      }
      if (rungs[i].transfer.kind == TransferKind::Call) result.back().weight += called(rungs[i].transfer.callee);
    }
    return result;
  }

private:
  uint64_t called(RoutineId routine) {
    if (known_[routine.index]) return weights_[routine.index];
    weights_.resize(known_.size());
    known_[routine.index] = true; // a recursive call has no weight
    uint64_t sum = 0;
    for (const PartPiece& piece : pieces(routine)) sum += piece.weight;
    return weights_[routine.index] = std::min<uint64_t>(sum, UINT32_MAX);
  }

  const Module& module_;
  std::vector<bool> known_;
  std::vector<uint64_t> weights_;
};

// Prefix sums: [i] is the weight of all pieces before piece i.
std::vector<uint64_t> sumsOf(const std::vector<PartPiece>& pieces) {
  std::vector<uint64_t> sums{0};
  for (const PartPiece& piece : pieces) sums.push_back(sums.back() + piece.weight);
  return sums;
}

// The last border at which a part from `first` of weight at most `most` can end; at least one piece.
uint32_t reach(const std::vector<uint64_t>& sums, uint32_t first, uint64_t most) {
  const auto end = std::upper_bound(sums.begin() + first, sums.end(), sums[first] + most);
  return std::max(first + 1, static_cast<uint32_t>(end - sums.begin()) - 1);
}

uint32_t countParts(const std::vector<uint64_t>& sums, uint64_t most) {
  uint32_t count = 0;
  for (uint32_t at = 0; at + 1 < sums.size(); at = reach(sums, at, most)) ++count;
  return count;
}

// The smallest possible weight of the longest part.
uint64_t leastLongest(const std::vector<PartPiece>& pieces, const std::vector<uint64_t>& sums, uint32_t parts) {
  uint64_t low = 0;
  for (const PartPiece& piece : pieces) low = std::max(low, piece.weight);
  uint64_t high = std::max(low, sums.back());
  while (low < high) {
    const uint64_t middle = low + (high - low) / 2;
    if (countParts(sums, middle) <= parts)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// For every border the first position from which the later parts can hold the rest.
std::vector<uint32_t> earliestBorders(const std::vector<uint64_t>& sums, uint32_t parts, uint64_t most) {
  std::vector<uint32_t> earliest(parts - 1);
  auto end = static_cast<uint32_t>(sums.size()) - 1;
  for (uint32_t k = parts - 1; k-- > 0;) {
    const uint64_t from = sums[end] > most ? sums[end] - most : 0;
    const auto first = static_cast<uint32_t>(std::lower_bound(sums.begin(), sums.end(), from) - sums.begin());
    end = earliest[k] = std::max(first, k + 1); // a piece for every earlier part
  }
  return earliest;
}

} // namespace

std::vector<PartPiece> partPieces(const Module& module, RoutineId routine) { return Weights(module).pieces(routine); }

std::vector<uint32_t> cutParts(const std::vector<PartPiece>& pieces, uint32_t parts) {
  const auto count = static_cast<uint32_t>(pieces.size());
  parts = std::min(parts, count);
  std::vector<uint32_t> borders;
  if (parts < 2) return borders;
  const std::vector<uint64_t> sums = sumsOf(pieces);
  const uint64_t most = leastLongest(pieces, sums, parts);
  const std::vector<uint32_t> earliest = earliestBorders(sums, parts, most);
  uint32_t begin = 0;
  for (uint32_t k = 1; k < parts; ++k) {
    const uint32_t last = std::min(reach(sums, begin, most), count - (parts - k)); // a piece for every later part
    uint32_t border = std::max(earliest[k - 1], begin + 1);
    const auto distance = [&](uint32_t b) { // to the border's share, times `parts`
      const uint64_t here = sums[b] * parts;
      const uint64_t share = sums.back() * k;
      return here > share ? here - share : share - here;
    };
    while (border < last && distance(border + 1) <= distance(border)) ++border;
    borders.push_back(border);
    begin = border;
  }
  return borders;
}

void cutTask(const Module& module, Task& task, uint32_t parts) {
  task.parts = parts;
  task.borders.clear();
  const std::vector<PartPiece> pieces = partPieces(module, task.entry);
  for (const uint32_t piece : cutParts(pieces, parts)) task.borders.push_back(pieces[piece].firstRung);
}

uint64_t longestPart(const std::vector<PartPiece>& pieces, uint32_t parts) {
  return leastLongest(pieces, sumsOf(pieces), std::max(parts, 1u));
}

uint32_t partsNeeded(const std::vector<PartPiece>& pieces, uint64_t most) {
  for (const PartPiece& piece : pieces)
    if (piece.weight > most) return 0;
  return countParts(sumsOf(pieces), most);
}

} // namespace rung::ir

// A generated program as another vendor's compiler made it, compared with Rung and the straight-line forms.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "ir/support/result.h"
#include "tools/bench/generated/side.h"

namespace rung::bench {

// The places that a peer's shared object names: BIT(0) BIT(1)… WORD(0)… ENTRY(table, index)… REAL(0)…, one a line, for
// macros of the sources in tools/bench/peers.
std::string peerPlaces(const Work& work);

// The rungs as macros for ClassicLadder's data, in the same way: LOGIC(parallel, bit, negated, bit, negated, bit,
// negated, coil). Fails if the work has other elements.
Result<std::string> peerRungs(const Work& work);

// A shared object made from tools/bench/peers. It exports
//   void peer_begin(void)    the program as at its start
//   void peer_scan(int ms)   one scan, `ms` after the one before
//   void* peer_places[]      in the order of peerPlaces: a bit is a byte of 0 or 1, words have 32 bits, reals 64
class Peer final : public Side {
public:
  // Fails if the shared object cannot be loaded.
  static Result<std::unique_ptr<Peer>> load(const std::string& path, const Work& work, int msAScan);
  void begin(const Machine& machine) override;
  void apply(const Change& change) override;
  void scan() noexcept override { scan_(msAScan_); }
  Values values() const override;

private:
  using Begin = void (*)();
  using Scan = void (*)(int);
  Peer(Begin begin, Scan scan, void* const* places, const Work& work, int msAScan);
  uint8_t& bit(uint32_t number) const { return *static_cast<uint8_t*>(bits_[number]); }

  Begin begin_;
  Scan scan_;
  void* const* bits_;
  void* const* words_;
  void* const* tables_;
  void* const* reals_;
  const Work& work_;
  int msAScan_;
};

} // namespace rung::bench

// See peer.h.
#include "tools/bench/generated/peer.h"

#include <cstring>
#include <dlfcn.h>

#include "ir/support/put.h"

namespace rung::bench {
namespace {

uint32_t entries(const Work& work) { return work.hasTables ? kTables * kEntries : 0; }

template <class T>
T read(const void* place) {
  T value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

} // namespace

std::string peerPlaces(const Work& work) {
  std::string out;
  for (uint32_t i = 0; i < work.bits(); ++i) put(out, "BIT({})\n", i);
  for (uint32_t i = 0; i < work.words(); ++i) put(out, "WORD({})\n", i);
  for (uint32_t i = 0; i < entries(work); ++i) put(out, "ENTRY({}, {})\n", i / kEntries, i % kEntries);
  for (uint32_t i = 0; i < work.reals(); ++i) put(out, "REAL({})\n", i);
  return out;
}

Result<std::string> peerRungs(const Work& work) {
  std::string out;
  for (const Element& e : work.elements) {
    if (e.op != Op::Logic) return failure("only bit logic is written as rungs");
    put(out, "LOGIC({:d}", e.parallel);
    for (const Contact& c : {e.first, e.second, e.third}) put(out, ", {}, {:d}", c.bit, c.negated);
    put(out, ", {})\n", e.coil);
  }
  return out;
}

Peer::Peer(Begin begin, Scan scan, void* const* places, const Work& work, int msAScan)
    : begin_(begin), scan_(scan), bits_(places), words_(bits_ + work.bits()), tables_(words_ + work.words()),
      reals_(tables_ + entries(work)), work_(work), msAScan_(msAScan) {}

Result<std::unique_ptr<Peer>> Peer::load(const std::string& path, const Work& work, int msAScan) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); // stays loaded: profilers look names up at exit
  if (library == nullptr) return failure(dlerror());
  void* found[3];
  for (size_t i = 0; const char* name : {"peer_begin", "peer_scan", "peer_places"}) {
    found[i] = dlsym(library, name);
    if (found[i++] == nullptr) return failure(dlerror());
  }
  return std::unique_ptr<Peer>(new Peer(reinterpret_cast<Begin>(found[0]), reinterpret_cast<Scan>(found[1]),
                                        static_cast<void* const*>(found[2]), work, msAScan));
}

void Peer::begin(const Machine& machine) {
  begin_();
  for (size_t i = 0; i < machine.inputs().size(); ++i) bit(static_cast<uint32_t>(i)) = machine.inputs()[i] ? 1 : 0;
  for (size_t i = 0; i < machine.words().size(); ++i) std::memcpy(words_[i], &machine.words()[i], sizeof(uint32_t));
  for (size_t i = 0; i < machine.reals().size(); ++i) std::memcpy(reals_[i], &machine.reals()[i], sizeof(double));
}

void Peer::apply(const Change& change) {
  for (uint32_t i = 0; i < change.bitCount; ++i) bit(change.bits[i]) ^= 1;
  if (change.hasWords)
    for (size_t i = 0; i < change.words.size(); ++i)
      std::memcpy(words_[change.words[i]], &change.wordValues[i], sizeof(uint32_t));
  if (change.hasReal) std::memcpy(reals_[change.real], &change.realValue, sizeof(double));
}

Values Peer::values() const {
  Values values;
  for (uint32_t i = 0; i < work_.bits(); ++i) values.bits.push_back(bit(i) != 0);
  for (uint32_t i = 0; i < work_.words(); ++i) values.words.push_back(read<uint32_t>(words_[i]));
  for (uint32_t i = 0; i < entries(work_); ++i) values.tables.push_back(read<uint32_t>(tables_[i]));
  for (uint32_t i = 0; i < work_.reals(); ++i) values.reals.push_back(read<uint64_t>(reals_[i]));
  return values;
}

} // namespace rung::bench

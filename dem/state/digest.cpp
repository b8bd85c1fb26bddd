#include "dem/state/digest.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <bit>

#include "dem/state/hex_digest.hpp"

namespace isostat {

static_assert(std::endian::native == std::endian::little, "digests are defined on little-endian bytes");

struct Digest::Stream {
  XXH3_state_t* state = XXH3_createState();
  Stream() { XXH3_128bits_reset(state); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { XXH3_freeState(state); }
};

Digest::Digest() : stream_(std::make_unique<Stream>()) {}
Digest::~Digest() = default;

void Digest::bytes(const void* data, std::size_t size) { XXH3_128bits_update(stream_->state, data, size); }

void Digest::add(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  bytes(text.data(), text.size());
}

std::string Digest::hex() const {
  const XXH128_hash_t h = XXH3_128bits_digest(stream_->state);
  return hex_digest(h.high64, h.low64);
}

void add_surroundings(Digest& digest, double gravity, const Surroundings& surroundings) {
  if (gravity != 0) digest.add(std::string_view("gravity")), digest.add(gravity);
  if (surroundings == Surroundings{}) return;
  const auto& [start_offset, start_angle, open, grains_left, mass_left, last_left] = surroundings;
  digest.add(std::string_view("surroundings"));
  digest.add(start_offset), digest.add(start_angle);
  digest.add(std::int64_t{open}), digest.add(grains_left);
  digest.add(mass_left), digest.add(last_left);
}

}  // namespace isostat

#include "scree/model/random.hpp"

#include <cmath>
#include <numbers>

#include "scree/model/philox.hpp"

namespace scree {
namespace {

/// FNV-1a, to turn the name of a stream into a part of its key.
std::uint64_t hash_name(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name) : key_{hash_name(name)} {
  // The seed is mixed in by one Philox block, so that neighbouring seeds give unrelated keys.
  const auto block = philox4x32({static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), 0, 0},
                                {static_cast<std::uint32_t>(key_), static_cast<std::uint32_t>(key_ >> 32)});
  key_ = (std::uint64_t{block[1]} << 32) | block[0];
}

std::uint64_t RandomStream::operator()() {
  const auto block =
      philox4x32({static_cast<std::uint32_t>(counter_), static_cast<std::uint32_t>(counter_ >> 32), 1, 0},
                 {static_cast<std::uint32_t>(key_), static_cast<std::uint32_t>(key_ >> 32)});
  ++counter_;
  return (std::uint64_t{block[1]} << 32) | block[0];
}

double RandomStream::uniform() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }

double RandomStream::uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

double RandomStream::normal() {
  const double u = 1.0 - uniform();  // in (0, 1], so that the logarithm is finite
  const double v = uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

Quat RandomStream::orientation() {
  const double u = uniform();
  const double a = 2.0 * std::numbers::pi * uniform();
  const double b = 2.0 * std::numbers::pi * uniform();
  const double s = std::sqrt(1.0 - u);
  const double t = std::sqrt(u);
  return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
}

}  // namespace scree

#include "core/base/random.hpp"

#include <cmath>

namespace beadwork {

namespace {

// Steele, Lea and Flood 2014: neighbouring seeds and streams give unrelated states.
std::uint64_t splitmix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// The logarithm from + - * / alone, since the C library picks a variant for the processor that it finds:
// ln m = 2 artanh s with s = (m - 1)/(m + 1), |s| < .18, where 11 terms of the series reach the last bit.
double fixed_log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1), square = s * s;
  double sum = 0;
  for (int n = 21; n >= 1; n -= 2) sum = sum * square + 1.0 / n;
  return 2 * s * sum + exponent * 0.69314718055994531;
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : engine_(splitmix(splitmix(seed) ^ (stream * 0xD1342543DE82EF95u))) {}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u, v, square;
  do {
    u = uniform(-1, 1);
    v = uniform(-1, 1);
    square = u * u + v * v;
  } while (square >= 1 || square == 0);
  const double factor = std::sqrt(-2 * fixed_log(square) / square);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

std::uint64_t stream_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

}  // namespace beadwork

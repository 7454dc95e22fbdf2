#include "math/hash.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <vector>

namespace packbed {
namespace {

std::uint64_t hash_of(const std::vector<unsigned char>& bytes) {
  Hash hash;
  hash.add(std::as_bytes(std::span<const unsigned char>(bytes)));
  return hash.value();
}

TEST(Hash, TellsEveryOneByteChangeApart) {
  std::vector<unsigned char> bytes(61);
  std::set<std::uint64_t> seen{hash_of(bytes)};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<unsigned char>(1 << bit);
      seen.insert(hash_of(bytes));
      bytes[i] = 0;
    }
  EXPECT_EQ(seen.size(), 1 + 61 * 8);
}

TEST(Hash, TellsLengthsOfZerosApart) {
  std::set<std::uint64_t> seen;
  for (std::size_t n = 0; n < 100; ++n) seen.insert(hash_of(std::vector<unsigned char>(n)));
  EXPECT_EQ(seen.size(), 100);
}

TEST(Hash, TellsOrderApart) {
  Hash ab, ba;
  ab.add(1.0);
  ab.add(2.0);
  ba.add(2.0);
  ba.add(1.0);
  EXPECT_NE(ab.value(), ba.value());
}

TEST(Hash, SpreadsOneBitOverHalfOfTheValue) {
  double flipped = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Hash a, b;
    a.add(i);
    b.add(i ^ (1ULL << (i % 64)));
    a.add(0.0);  // what follows mixes on
    b.add(0.0);
    flipped += std::popcount(a.value() ^ b.value()) / 1000.0;
  }
  EXPECT_NEAR(flipped, 32, 8);
}

TEST(Hash, PrintsSixteenDigits) {
  Hash hash;
  EXPECT_EQ(hash.hex().size(), 16);
  EXPECT_EQ(std::stoull(hash.hex(), nullptr, 16), hash.value());
}

}  // namespace
}  // namespace packbed

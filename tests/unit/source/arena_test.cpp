#include "compiler/source/arena.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace stc {
namespace {

struct Piece {
  std::byte *at;
  size_t size;
  std::byte mark;
};

/// Pieces of all sizes and alignments, each filled with a mark of its own, until `least` bytes are
/// given out.
void fill(Arena &arena, size_t least, std::vector<Piece> &pieces) {
  size_t sum = 0;
  for (size_t i = pieces.size(); sum < least; ++i) {
    const size_t size = i % 977 == 3 ? 3'000'001 : i % 89 == 5 ? 70'001 : 1 + i * 37 % 4001;
    const size_t align = size_t{1} << (i % 5);
    auto *at = static_cast<std::byte *>(arena.allocate(size, align));
    ASSERT_EQ(reinterpret_cast<uintptr_t>(at) % align, 0U);
    pieces.push_back({at, size, static_cast<std::byte>(i * 7 % 251)});
    std::memset(at, static_cast<int>(pieces.back().mark), size);
    sum += size;
  }
}

size_t damaged(const std::vector<Piece> &pieces) {
  size_t found = 0;
  for (const Piece &piece : pieces)
    for (size_t i = 0; i < piece.size; ++i)
      found += piece.at[i] != piece.mark ? 1U : 0U;
  return found;
}

TEST(Arena, PiecesDoNotOverlapInSmallAndLargeBlocks) {
  Arena arena;
  std::vector<Piece> pieces;
  fill(arena, 12'000'000, pieces);
  EXPECT_EQ(damaged(pieces), 0U);
}

TEST(Arena, TakesLittleForASmallProgram) {
  Arena arena;
  static_cast<void>(arena.allocate(1, 1));
  EXPECT_EQ(arena.bytes(), 65536U);
}

TEST(Arena, KeepsWhatItAdopts) {
  std::vector<Piece> pieces;
  Arena arena;
  fill(arena, 5'000'000, pieces);
  {
    Arena other;
    fill(other, 5'000'000, pieces);
    const size_t both = arena.bytes() + other.bytes();
    arena.adopt(std::move(other));
    EXPECT_EQ(arena.bytes(), both);
  }
  fill(arena, 5'000'000, pieces);
  EXPECT_EQ(damaged(pieces), 0U);
}

} // namespace
} // namespace stc

// Sources that are nearly Structured Text: real ones with tokens swapped, deleted, doubled, nested,
// exchanged with those of other sources. Most of them get past the parser's first error, which
// mutated bytes seldom do.
#ifndef STRIDE_TESTS_FUZZ_TOKEN_MUTATOR_HPP
#define STRIDE_TESTS_FUZZ_TOKEN_MUTATOR_HPP

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace stride::fuzz {

/// What a piece of a source looks like; blanks and comments are pieces, too.
enum class PieceKind : uint8_t { Blank, Comment, Word, Number, Text, Sign };

struct Piece {
  PieceKind kind = PieceKind::Blank;
  std::string_view text;
};

/// Cuts any bytes into pieces whose texts make up the whole again. Knows nothing of the compiler's
/// scanner, so that a defect there does not hide itself.
[[nodiscard]] std::vector<Piece> cutIntoPieces(std::string_view source);

/// The `.st` files below the folders, sorted by path, those up to `mostBytes` long.
[[nodiscard]] std::vector<std::string>
readSources(const std::vector<std::filesystem::path> &folders, size_t mostBytes);

/// The projects directly in the folders, each as one text: a line of `mark` and the name in front
/// of each of its files (stride.toml, sources, cam files).
[[nodiscard]] std::vector<std::string>
readProjects(const std::vector<std::filesystem::path> &folders, std::string_view mark,
             size_t mostBytes);

/// Changes sources. The same seed and source give the same result.
class TokenMutator {
public:
  /// `corpus`: the sources that pieces are taken from.
  explicit TokenMutator(std::vector<std::string> corpus);

  [[nodiscard]] const std::vector<std::string> &corpus() const { return corpus_; }
  /// `source` with one to eight changes, cut off after `mostBytes`.
  [[nodiscard]] std::string mutate(std::string_view source, uint64_t seed, size_t mostBytes) const;
  /// The beginning of one source and the end of another, each cut between two pieces.
  [[nodiscard]] std::string cross(std::string_view first, std::string_view second, uint64_t seed,
                                  size_t mostBytes) const;

private:
  std::vector<std::string> corpus_;
  std::vector<Piece> pieces_; ///< of all sources, in order; into corpus_
  std::vector<std::string_view> byKind_[6];
};

} // namespace stride::fuzz

#endif // STRIDE_TESTS_FUZZ_TOKEN_MUTATOR_HPP

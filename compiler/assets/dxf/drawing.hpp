#ifndef STRIDE_COMPILER_ASSETS_DXF_DRAWING_HPP
#define STRIDE_COMPILER_ASSETS_DXF_DRAWING_HPP
// A DXF drawing as the entities that it has, and then as chains of pieces.

#include "compiler/assets/dxf/curves.hpp"
#include "compiler/assets/dxf/pairs.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace stc::dxf {

/// Where an entity stands in the text.
struct Entity {
  std::string_view type;
  size_t begin = 0; ///< Its groups after the one with its type.
  size_t end = 0;
  Span span; ///< Of its type.
};

struct Block {
  std::vector<Entity> entities;
  Point base;
};

struct Layer {
  bool hidden = false; ///< Frozen or off.
};

/// Names count without regard to case.
struct NoCase {
  bool operator()(std::string_view a, std::string_view b) const;
};

/// What a file has.
struct Drawing {
  std::vector<Entity> entities;
  std::map<std::string, Block, NoCase> blocks;
  std::map<std::string, Layer, NoCase> layers;
  int32_t unit = 0; ///< $INSUNITS
};

/// Entities of a file at most, blocks that are inserted, pieces that they become.
inline constexpr size_t kMostEntities = 1'000'000;
inline constexpr size_t kMostInserts = 1'000'000;
inline constexpr size_t kMostPieces = 1'000'000;
/// Blocks within blocks at most.
inline constexpr int kMostBlockDepth = 16;

/// Reads the sections of a file. What is wrong is in `faults` then.
[[nodiscard]] Drawing readDrawing(const SourceFile &file, Faults &faults);

/// Pieces that follow each other, of one entity.
struct Chain {
  std::vector<Piece> pieces;
  std::string layer;
};

/// What an entity is left out for, and how many were.
struct LeftOut {
  size_t count = 0;
  Span first;
};

/// What all entities come to.
struct Chains {
  std::vector<Chain> chains;
  std::map<std::string, LeftOut> leftOut; ///< By the reason.
  std::set<std::string, NoCase> used;     ///< Layers with entities, also those left out.
};

/// How entities become pieces.
struct Flattening {
  Affine scale;                         ///< From the drawing to the program.
  double tolerance = 0.001;             ///< Of splines. [u]
  double least = 1e-6;                  ///< Shorter pieces are left out. [u]
  std::set<std::string, NoCase> layers; ///< Only these; none: all that are not hidden.
};

/// Makes pieces of all entities, blocks inserted.
[[nodiscard]] Chains chainsOf(const SourceFile &file, const Drawing &drawing, const Flattening &how,
                              Faults &faults);

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_DRAWING_HPP

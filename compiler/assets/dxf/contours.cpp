#include "compiler/assets/dxf/contours.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

namespace stc::dxf {

namespace {

bool isClosed(const std::vector<Piece> &pieces, double epsilon) {
  if (pieces.size() == 1)
    return isFull(pieces[0]) ||
           (pieces[0].kind == Piece::Kind::Arc && std::abs(pieces[0].sweep) > M_PI &&
            norm(pieces[0].end - pieces[0].start) == 0);
  if (!(norm(pieces.back().end - pieces.front().start) <= epsilon))
    return false;
  double length = 0;
  for (size_t i = 0; i < pieces.size() && length <= 4 * epsilon; ++i)
    length += lengthOf(pieces[i]);
  return length > 4 * epsilon;
}

/// The end of a chain: twice its index, and 1 more for its last one.
using End = uint32_t;

/// Ends of chains that have not been joined yet, by place.
class Ends {
public:
  Ends(const std::vector<Chain> &chains, double epsilon) : chains_(chains), epsilon_(epsilon) {
    for (End end = 0; end < 2 * chains.size(); ++end)
      if (!isClosed(chains[end / 2].pieces, epsilon))
        cells_[cellOf(placeOf(end))].insert(end);
  }

  [[nodiscard]] Point placeOf(End end) const {
    const std::vector<Piece> &pieces = chains_[end / 2].pieces;
    return end % 2 == 0 ? pieces.front().start : pieces.back().end;
  }
  /// The direction away from the chain's end, into it.
  [[nodiscard]] Point inward(End end) const {
    const std::vector<Piece> &pieces = chains_[end / 2].pieces;
    return end % 2 == 0 ? directionAt(pieces.front(), 0) : directionAt(pieces.back(), 1) * -1;
  }

  void remove(End end) { cells_[cellOf(placeOf(end))].erase(end); }

  /// Of the ends near a place that which goes on straightest from a direction; nothing: none is
  /// near enough.
  [[nodiscard]] std::optional<End> next(Point place, Point direction) const {
    std::optional<End> best;
    double bestRank = 0;
    const auto [x, y] = cellOf(place);
    for (int64_t column = x - 1; column <= x + 1; ++column)
      for (int64_t row = y - 1; row <= y + 1; ++row) {
        const auto cell = cells_.find({column, row});
        if (cell == cells_.end())
          continue;
        size_t seen = 0;
        for (const End end : cell->second) {
          const double away = norm(placeOf(end) - place);
          const double rank = dot(inward(end), direction) - 1e-3 * away / epsilon_;
          if (away <= epsilon_ && (!best || rank > bestRank)) {
            best = end;
            bestRank = rank;
          }
          if (++seen == kMostSeen)
            break;
        }
      }
    return best;
  }

private:
  static constexpr size_t kMostSeen = 64;

  using Cell = std::pair<int64_t, int64_t>;
  struct Hash {
    size_t operator()(const Cell &cell) const {
      return static_cast<size_t>(cell.first) * 0x9E3779B97F4A7C15 ^
             static_cast<size_t>(cell.second) * 0x632BE59BD9B4E019;
    }
  };

  [[nodiscard]] Cell cellOf(Point place) const {
    return {static_cast<int64_t>(std::floor(place.x / epsilon_)),
            static_cast<int64_t>(std::floor(place.y / epsilon_))};
  }

  const std::vector<Chain> &chains_;
  double epsilon_;
  std::unordered_map<Cell, std::set<End>, Hash> cells_;
};

/// Puts a chain behind others, its end `end` first.
void append(const std::vector<Piece> &chain, bool turned, std::vector<Piece> &pieces) {
  if (!turned) {
    pieces.insert(pieces.end(), chain.begin(), chain.end());
    return;
  }
  for (auto piece = chain.rbegin(); piece != chain.rend(); ++piece)
    pieces.push_back(reversed(*piece));
}

void turnRound(std::vector<Piece> &pieces) {
  std::reverse(pieces.begin(), pieces.end());
  for (Piece &piece : pieces)
    piece = reversed(piece);
}

/// Whether the start of an arc may be put so far away: its centre then moves, since its ends stay
/// equally far from it.
bool canMove(const Piece &arc, Point to, double epsilon) {
  const double radius = norm(arc.first);
  const double chord = norm(arc.end - to);
  const double ratio = norm(arc.second) / radius;
  const double off = norm(arc.start - to) / ratio;
  return chord > 0 &&
         off * std::max(1.0, 2 * radius / chord) <= std::min(epsilon / 4, 1e-3 * radius);
}

/// Closes the gap before pieces[at], perhaps by a line; gives the index of the piece.
size_t closeGap(std::vector<Piece> &pieces, size_t before, size_t at, double epsilon) {
  Piece &last = pieces[before];
  Piece &next = pieces[at];
  if (last.end.x == next.start.x && last.end.y == next.start.y)
    return at;
  if (last.kind != Piece::Kind::Arc)
    last.end = next.start;
  else if (next.kind != Piece::Kind::Arc || canMove(next, last.end, epsilon))
    next.start = last.end;
  else {
    pieces.insert(pieces.begin() + static_cast<ptrdiff_t>(before) + 1,
                  lineOf(last.end, next.start));
    return at + 1;
  }
  return at;
}

void closeGaps(Contour &contour, double epsilon) {
  for (size_t i = 1; i < contour.pieces.size(); ++i)
    i = closeGap(contour.pieces, i - 1, i, epsilon);
  if (contour.closed)
    (void)closeGap(contour.pieces, contour.pieces.size() - 1, 0, epsilon);
  // Lines that have become nothing.
  const auto isNothing = [](const Piece &piece) {
    return piece.kind == Piece::Kind::Line && piece.start.x == piece.end.x &&
           piece.start.y == piece.end.y;
  };
  if (!std::all_of(contour.pieces.begin(), contour.pieces.end(), isNothing))
    std::erase_if(contour.pieces, isNothing);
}

} // namespace

std::vector<Contour> contoursOf(std::vector<Chain> chains, double epsilon) {
  std::vector<Contour> contours;
  std::vector<bool> used(chains.size(), false);
  Ends ends(chains, epsilon);
  const auto take = [&](size_t chain) {
    used[chain] = true;
    ends.remove(static_cast<End>(2 * chain));
    ends.remove(static_cast<End>(2 * chain + 1));
  };
  for (size_t i = 0; i < chains.size(); ++i) {
    if (used[i])
      continue;
    Contour contour;
    contour.layer = chains[i].layer;
    contour.pieces = chains[i].pieces;
    take(i);
    bool turned = false;
    while (!(contour.closed = isClosed(contour.pieces, epsilon))) {
      const Piece &last = contour.pieces.back();
      if (const auto next = ends.next(last.end, directionAt(last, 1))) {
        append(chains[*next / 2].pieces, *next % 2 == 1, contour.pieces);
        take(*next / 2);
      } else if (!turned) { // what leads to its start
        turnRound(contour.pieces);
        turned = true;
      } else {
        break;
      }
    }
    if (turned)
      turnRound(contour.pieces);
    closeGaps(contour, epsilon);
    contours.push_back(std::move(contour));
  }
  return contours;
}

Contour reversed(const Contour &contour) {
  Contour result = contour;
  turnRound(result.pieces);
  return result;
}

Contour startingAt(const Contour &contour, size_t piece, double part) {
  Contour result = contour;
  std::rotate(result.pieces.begin(), result.pieces.begin() + static_cast<ptrdiff_t>(piece),
              result.pieces.end());
  if (part == 0)
    return result;
  const Piece first = result.pieces.front();
  if (first.kind == Piece::Kind::Parabola)
    return result;
  if (isFull(first)) {
    Piece &only = result.pieces.front();
    only.from += part * only.sweep;
    only.start = only.end = placeAt(only, 0);
    return result;
  }
  result.pieces.front() = between(first, part, 1);
  result.pieces.push_back(between(first, 0, part));
  return result;
}

} // namespace stc::dxf

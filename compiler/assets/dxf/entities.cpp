// Entities of a DXF drawing as pieces.
#include "compiler/assets/dxf/groups.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc::dxf {

namespace {

constexpr double kDegree = M_PI / 180;

/// Where entities stand: within which blocks, and how these are inserted.
struct Place {
  Affine affine;
  std::string layer; ///< What the layer 0 of a block means; empty: itself.
  bool hidden = false;
  std::vector<const Block *> blocks;
};

/// A vertex of a polyline.
struct Vertex {
  Point place;
  double bulge = 0;
};

/// Whether a piece has numbers that a program can have.
bool isPossible(const Piece &piece) {
  for (const Point place : {piece.start, piece.end, piece.centre})
    if (!(std::abs(place.x) <= kMostNumber && std::abs(place.y) <= kMostNumber))
      return false;
  constexpr double kFlat = 1e-6;
  const double size = norm(piece.first);
  return piece.kind != Piece::Kind::Arc ||
         (size > 0 && size <= kMostNumber * 1e3 && norm(piece.second) > kFlat * size);
}

class Flattener {
public:
  Flattener(const SourceFile &file, const Drawing &drawing, const Flattening &how, Faults &faults)
      : file_(file), drawing_(drawing), how_(how), faults_(faults) {}

  Chains run() {
    Place place;
    place.affine = how_.scale;
    list(drawing_.entities, place);
    return std::move(result_);
  }

private:
  void leaveOut(const std::string &why, const Entity &entity) {
    LeftOut &out = result_.leftOut[why];
    if (out.count++ == 0)
      out.first = entity.span;
  }

  void list(const std::vector<Entity> &entities, const Place &place) {
    for (size_t i = 0; i < entities.size() && !faults_.any(); ++i)
      if (entities[i].type == "POLYLINE")
        i = polyline(entities, i, place);
      else
        entity(entities[i], place);
  }

  [[nodiscard]] std::string layerOf(const Groups &groups, const Place &place) const {
    const std::string own = groups.text(8);
    return (own == "0" || own.empty()) && !place.layer.empty() ? place.layer
           : own.empty()                                       ? "0"
                                                               : own;
  }

  [[nodiscard]] bool isHidden(const std::string &layer) const {
    const auto known = drawing_.layers.find(layer);
    return known != drawing_.layers.end() && known->second.hidden;
  }

  /// Whether an entity is seen, by itself and by its layer.
  bool isTaken(const Groups &groups, const Entity &entity, const std::string &layer) {
    if (groups.integer(67) == 1) {
      leaveOut("on paper", entity);
      return false;
    }
    result_.used.insert(layer);
    if (groups.integer(60) == 1) {
      leaveOut("invisible", entity);
      return false;
    }
    if (how_.layers.empty() ? isHidden(layer) : !how_.layers.contains(layer)) {
      if (how_.layers.empty())
        leaveOut(fmt::format("in layer {}, which is off or frozen", layer), entity);
      return false;
    }
    return true;
  }

  /// From the entity's own coordinates to the drawing's; false where they lie in another plane.
  bool ownSystem(const Groups &groups, const Entity &entity, Affine &affine, bool &flipped) {
    const double z = groups.number(230, 1);
    const double across = std::hypot(groups.number(210, 0), groups.number(220, 0));
    constexpr double kFlat = 1e-9;
    if (!(across <= kFlat * std::abs(z))) {
      leaveOut("in a plane that is not that of X and Y", entity);
      return false;
    }
    flipped = z < 0;
    affine = flipped ? Affine{{-1, 0}, {0, 1}, {}} : Affine{};
    return true;
  }

  /// Reports Z that is not 0: programs are in the plane.
  void noteHeight(const Groups &groups, const Entity &entity, std::initializer_list<int> codes) {
    for (const int code : codes)
      if (groups.number(code, 0) != 0) {
        leaveOut("Z", entity);
        return;
      }
  }

  void add(std::vector<Piece> pieces, const Entity &entity, const std::string &layer) {
    if (!std::all_of(pieces.begin(), pieces.end(), isPossible)) {
      faults_.report(entity.span, "this entity becomes too large, or an arc of it flat",
                     "after all scales", kCorrectDrawing);
      return;
    }
    std::erase_if(pieces, [&](const Piece &piece) { return !(lengthOf(piece) > how_.least); });
    if (pieces.empty()) {
      leaveOut("without length", entity);
      return;
    }
    count_ += pieces.size();
    if (count_ > kMostPieces)
      faults_.report(entity.span, fmt::format("this drawing has more than {} pieces", kMostPieces),
                     "here", "divide it");
    else
      result_.chains.push_back({std::move(pieces), layer});
  }

  void entity(const Entity &entity, const Place &place) {
    static const std::map<std::string_view,
                          void (Flattener::*)(const Groups &, const Entity &, const Place &)>
        kEntities = {{"LINE", &Flattener::line},       {"ARC", &Flattener::arc},
                     {"CIRCLE", &Flattener::arc},      {"LWPOLYLINE", &Flattener::lightPolyline},
                     {"ELLIPSE", &Flattener::ellipse}, {"SPLINE", &Flattener::spline},
                     {"INSERT", &Flattener::insert}};
    // What belongs to entities before.
    if (entity.type == "VERTEX" || entity.type == "SEQEND" || entity.type == "ATTRIB")
      return;
    const Groups groups(file_, entity, faults_);
    const std::string layer = layerOf(groups, place);
    const auto known = kEntities.find(entity.type);
    const bool isInsert = entity.type == "INSERT";
    if (faults_.any() || (!isInsert && !isTaken(groups, entity, layer)))
      return;
    if (known == kEntities.end())
      leaveOut(fmt::format("{}", entity.type.substr(0, 40)), entity);
    else
      (this->*known->second)(groups, entity, place);
  }

  void line(const Groups &groups, const Entity &entity, const Place &place) {
    const Point start = groups.place(10);
    const Point end = groups.place(11);
    noteHeight(groups, entity, {30, 31});
    if (!faults_.any())
      add({lineOf(place.affine(start), place.affine(end))}, entity, layerOf(groups, place));
  }

  void addArc(const Affine &affine, Point centre, Point first, Point second, double from,
              double sweep, const Entity &entity, const std::string &layer) {
    add({arcOf(affine(centre), affine.turned(first), affine.turned(second), from, sweep)}, entity,
        layer);
  }

  void arc(const Groups &groups, const Entity &entity, const Place &place) {
    const Point centre = groups.place(10);
    const double radius = groups.number(40);
    Affine own;
    bool flipped = false;
    if (faults_.any() || !ownSystem(groups, entity, own, flipped))
      return;
    if (!(radius > 0)) {
      groups.fail(fmt::format("the radius {:g} of this {} is not positive", radius, entity.type),
                  "here");
      return;
    }
    double from = 0;
    double sweep = 360;
    if (entity.type == "ARC") {
      from = groups.number(50);
      sweep = std::fmod(groups.number(51) - from, 360);
      if (sweep <= 0)
        sweep += 360;
    }
    noteHeight(groups, entity, {30});
    if (!faults_.any())
      addArc(place.affine.after(own), centre, {radius, 0}, {0, radius}, from * kDegree,
             sweep * kDegree, entity, layerOf(groups, place));
  }

  void ellipse(const Groups &groups, const Entity &entity, const Place &place) {
    const Point centre = groups.place(10);
    const Point first = groups.place(11);
    const double ratio = groups.number(40);
    const double from = groups.number(41, 0);
    double sweep = groups.number(42, 2 * M_PI) - from;
    Affine own;
    bool flipped = false;
    if (faults_.any() || !ownSystem(groups, entity, own, flipped))
      return;
    if (!(norm(first) > 0) || !(ratio > 1e-6) || ratio > 1 + 1e-9) {
      groups.fail("an axis of this ellipse has no length, or the second is longer than the first",
                  "here");
      return;
    }
    sweep = std::abs(sweep) >= 2 * M_PI - 1e-9 ? 2 * M_PI : std::fmod(sweep, 2 * M_PI);
    if (sweep <= 0)
      sweep += 2 * M_PI;
    noteHeight(groups, entity, {30, 31});
    // Places are the drawing's own whatever the plane; its normal says which way round it goes.
    const Point left = Point{-first.y, first.x} * (flipped ? -ratio : ratio);
    addArc(place.affine, centre, first, left, from, sweep, entity, layerOf(groups, place));
  }

  void lightPolyline(const Groups &groups, const Entity &entity, const Place &place) {
    std::vector<Vertex> vertices;
    for (const Pair &pair : groups.all()) {
      if (pair.code == 10)
        vertices.push_back({{numberOf(pair, faults_), 0}, 0});
      else if (pair.code == 20 && !vertices.empty())
        vertices.back().place.y = numberOf(pair, faults_);
      else if (pair.code == 42 && !vertices.empty())
        vertices.back().bulge = numberOf(pair, faults_);
    }
    if (const int32_t said = groups.integer(90, static_cast<int32_t>(vertices.size()));
        said != static_cast<int32_t>(vertices.size()) && !faults_.any()) {
      groups.fail(fmt::format("this polyline says that it has {} vertices, and has {}", said,
                              vertices.size()),
                  "group code 90");
      return;
    }
    noteHeight(groups, entity, {38});
    path(groups, entity, place, vertices, (groups.integer(70) & 1) != 0);
  }

  /// POLYLINE, its VERTEXes and SEQEND; gives the last one's index.
  size_t polyline(const std::vector<Entity> &entities, size_t at, const Place &place) {
    const Entity &entity = entities[at];
    const Groups groups(file_, entity, faults_);
    std::vector<Vertex> vertices;
    size_t i = at + 1;
    for (; i < entities.size() && entities[i].type == "VERTEX" && !faults_.any(); ++i) {
      const Groups vertex(file_, entities[i], faults_);
      constexpr int32_t kControl = 16; // of a spline: not on the curve
      if ((vertex.integer(70) & kControl) == 0)
        vertices.push_back({vertex.place(10), vertex.number(42, 0)});
    }
    if (!faults_.any() && (i == entities.size() || entities[i].type != "SEQEND"))
      groups.fail("this POLYLINE does not end with SEQEND", "here");
    if (faults_.any() || !isTaken(groups, entity, layerOf(groups, place)))
      return i;
    constexpr int32_t kInSpace = 8;
    constexpr int32_t kMesh = 16 | 64;
    const int32_t flags = groups.integer(70);
    if ((flags & kMesh) != 0) {
      leaveOut("POLYLINE that is a mesh", entity);
      return i;
    }
    if ((flags & kInSpace) != 0)
      leaveOut("Z", entity);
    else
      noteHeight(groups, entity, {30});
    path(groups, entity, place, vertices, (flags & 1) != 0);
    return i;
  }

  void path(const Groups &groups, const Entity &entity, const Place &place,
            const std::vector<Vertex> &vertices, bool closed) {
    Affine own;
    bool flipped = false;
    if (faults_.any() || !ownSystem(groups, entity, own, flipped))
      return;
    const Affine affine = place.affine.after(own);
    std::vector<Piece> pieces;
    for (size_t i = 0; i + (closed ? 0 : 1) < vertices.size(); ++i) {
      const Point start = vertices[i].place;
      const Point end = vertices[(i + 1) % vertices.size()].place;
      const Point half = (end - start) * 0.5;
      const double bulge = vertices[i].bulge;
      // An arc that is no further from its chord than numbers are exact is none.
      if (std::abs(bulge) * norm(half) * norm(affine.x) <= 1e-9) {
        pieces.push_back(lineOf(affine(start), affine(end)));
        continue;
      }
      // The centre is left of the middle by half * (1 - b²) / 2b; b = tan(sweep / 4).
      const Point centre =
          start + half + Point{-half.y, half.x} * ((1 - bulge * bulge) / (2 * bulge));
      const Point radius = start - centre;
      Piece piece = arcOf(affine(centre), affine.turned(radius),
                          affine.turned({-radius.y, radius.x}), 0, 4 * std::atan(bulge));
      piece.start = affine(start);
      piece.end = affine(end);
      pieces.push_back(piece);
    }
    add(std::move(pieces), entity, layerOf(groups, place));
  }

  /// Whether the numbers of a spline go together.
  bool checkSpline(const Groups &groups, const Spline &spline) {
    const size_t n = spline.control.size();
    const auto degree = static_cast<size_t>(spline.degree);
    const auto fail = [&](const std::string &message) {
      groups.fail(message, "here");
      return false;
    };
    if (spline.degree < 1 || spline.degree > kMostDegree)
      return fail(fmt::format("the degree {} of this spline is none from 1 to {}", spline.degree,
                              kMostDegree));
    if (n < degree + 1)
      return fail(fmt::format("a spline of degree {} has {} control points at least, this one {}",
                              degree, degree + 1, n));
    if (spline.knots.size() != n + degree + 1)
      return fail(fmt::format("a spline of degree {} with {} control points has {} knots, this one "
                              "{}",
                              degree, n, n + degree + 1, spline.knots.size()));
    if (!std::is_sorted(spline.knots.begin(), spline.knots.end()) ||
        !(spline.knots[n] > spline.knots[degree]))
      return fail("the knots of this spline do not rise");
    if (!spline.weights.empty() && spline.weights.size() != n)
      return fail(fmt::format("this spline has {} control points and {} weights", n,
                              spline.weights.size()));
    for (const double weight : spline.weights)
      if (!(weight > 1e-9))
        return fail(fmt::format("the weight {:g} of a control point is not positive", weight));
    return true;
  }

  void spline(const Groups &groups, const Entity &entity, const Place &place) {
    Spline spline;
    spline.degree = groups.integer(71, 3);
    spline.knots = groups.numbers(40);
    spline.weights = groups.numbers(41);
    const std::vector<double> x = groups.numbers(10);
    const std::vector<double> y = groups.numbers(20);
    const std::vector<double> z = groups.numbers(30);
    if (faults_.any())
      return;
    if (x.empty() && groups.find(11) != nullptr) {
      leaveOut("SPLINE with fit points only", entity);
      return;
    }
    if (x.size() != y.size()) {
      groups.fail(fmt::format("this spline has {} X and {} Y", x.size(), y.size()), "here");
      return;
    }
    for (size_t i = 0; i < x.size(); ++i)
      spline.control.push_back(place.affine({x[i], y[i]}));
    if (std::any_of(z.begin(), z.end(), [](double height) { return height != 0; }))
      leaveOut("Z", entity);
    if (!checkSpline(groups, spline))
      return;
    std::vector<Piece> pieces;
    if (!appendSpline(spline, how_.tolerance, kMostPieces, pieces))
      faults_.report(entity.span,
                     fmt::format("this spline becomes more than {} pieces", kMostPieces), "here",
                     "choose a greater --tolerance");
    else
      add(std::move(pieces), entity, layerOf(groups, place));
  }

  /// The block that an INSERT names; null: an error, or it is left out.
  const Block *blockOf(const Groups &groups, const Place &place) {
    const std::string name = groups.text(2);
    const auto found = drawing_.blocks.find(name);
    if (found == drawing_.blocks.end()) {
      groups.fail(fmt::format("there is no block `{}`", name), "it is inserted here");
      return nullptr;
    }
    const Block *block = &found->second;
    if (std::find(place.blocks.begin(), place.blocks.end(), block) != place.blocks.end()) {
      groups.fail(fmt::format("the block `{}` is inserted within itself", name), "here");
      return nullptr;
    }
    if (place.blocks.size() >= kMostBlockDepth) {
      groups.fail(fmt::format("more than {} blocks stand within each other", kMostBlockDepth),
                  "here");
      return nullptr;
    }
    return faults_.any() || groups.integer(67) == 1 || groups.integer(60) == 1 ? nullptr : block;
  }

  void insert(const Groups &groups, const Entity &entity, const Place &place) {
    const Block *block = blockOf(groups, place);
    Affine own;
    bool flipped = false;
    if (block == nullptr || !ownSystem(groups, entity, own, flipped))
      return;
    const Point at = groups.place(10);
    const double turn = groups.number(50, 0) * kDegree;
    const double sx = groups.number(41, 1);
    const double sy = groups.number(42, 1);
    const int32_t columns = std::max(1, groups.integer(70, 1));
    const int32_t rows = std::max(1, groups.integer(71, 1));
    const Point step{groups.number(44, 0), groups.number(45, 0)};
    noteHeight(groups, entity, {30});
    if (faults_.any())
      return;
    constexpr double kLeastScale = 1e-9;
    if (!(std::abs(sx) > kLeastScale) || !(std::abs(sy) > kLeastScale)) {
      groups.fail("a block is inserted with the scale 0", "here");
      return;
    }
    const Point right{std::cos(turn), std::sin(turn)};
    const Point up{-right.y, right.x};
    Place inner = place;
    inner.layer = layerOf(groups, place);
    inner.blocks.push_back(block);
    for (int32_t row = 0; row < rows; ++row)
      for (int32_t column = 0; column < columns && !faults_.any(); ++column) {
        if (++inserts_ > kMostInserts) {
          faults_.report(entity.span, fmt::format("more than {} blocks are inserted", kMostInserts),
                         "here", "divide the drawing");
          return;
        }
        Affine put{right * sx, up * sy, at + right * (step.x * column) + up * (step.y * row)};
        put.shift = put.shift - put.turned(block->base);
        inner.affine = place.affine.after(own.after(put));
        list(block->entities, inner);
      }
  }

  const SourceFile &file_;
  const Drawing &drawing_;
  const Flattening &how_;
  Faults &faults_;
  Chains result_;
  size_t count_ = 0;
  size_t inserts_ = 0;
};

} // namespace

Chains chainsOf(const SourceFile &file, const Drawing &drawing, const Flattening &how,
                Faults &faults) {
  return Flattener(file, drawing, how, faults).run();
}

} // namespace stc::dxf

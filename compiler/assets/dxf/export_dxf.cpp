// The path of a program becomes a drawing.
#include "compiler/assets/dxf/dxf.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cnc;
using stride::numeric::dot;
using stride::numeric::norm;

constexpr double kHalfTurn = M_PI / 180;
constexpr double kFullTurn = 360 - 1e-9;
/// So much an object may leave its plane and still lie in it. [u]
constexpr double kFlatPath = 1e-12;

/// The groups of a drawing. Objects have handles, numbers that none has twice.
class DxfText {
public:
  void pair(int code, std::string_view value) { text_ += fmt::format("{:3}\n{}\n", code, value); }
  void pair(int code, double value) { pair(code, fmt::format("{}", value == 0 ? 0.0 : value)); }
  void pair(int code, int value) { pair(code, fmt::format("{}", value)); }
  void place(int code, const Vector3 &place) {
    pair(code, place.x);
    pair(code + 10, place.y);
    pair(code + 20, place.z);
  }
  /// A new object. What owns it has to be known; 0: nothing.
  int begin(std::string_view type, int owner) {
    pair(0, type);
    pair(5, handle(++handles_));
    if (owner != 0)
      pair(330, handle(owner));
    return handles_;
  }
  void section(std::string_view name) {
    pair(0, "SECTION");
    pair(2, name);
  }
  void endSection() { pair(0, "ENDSEC"); }
  static std::string handle(int number) { return fmt::format("{:X}", number); }

  std::string text_;

private:
  int handles_ = 0x100; ///< Smaller ones are for those that are named beforehand.
};

constexpr int kModelSpace = 0x20;
constexpr int kPaperSpace = 0x21;

class Drawer {
public:
  Drawer(const DxfExport &how) : how_(how) {}

  void draw(const PathObject &object) {
    const bool rapid = object.moveType == MoveType::Positioning;
    if (!isMotion(object) || (rapid && !how_.rapid))
      return;
    ObjectShape shape{};
    if (shapeOf(object, shape) != ShapeError::None || !(shape.shape.length > 0))
      return;
    layer_ = rapid ? "RAPID" : "PATH";
    const double climb = dot(object.normal, placeOf(object.end) - placeOf(object.start));
    const bool flat = std::abs(climb) <= kFlatPath;
    if (!isCurve(object.moveType))
      line(placeOf(object.start), placeOf(object.end));
    else if (object.moveType == MoveType::Spline3d)
      polynomial(object, 5);
    else if (!flat)
      lines(shape);
    else if (object.moveType == MoveType::Spline)
      polynomial(object, 3);
    else
      arc(object);
  }

  [[nodiscard]] const std::string &text() const { return entities_.text_; }

private:
  void begin(std::string_view type, std::string_view subclass) {
    (void)entities_.begin(type, kModelSpace);
    entities_.pair(100, "AcDbEntity");
    entities_.pair(8, layer_);
    entities_.pair(100, subclass);
  }

  void line(const Vector3 &start, const Vector3 &end) {
    begin("LINE", "AcDbLine");
    entities_.place(10, start);
    entities_.place(11, end);
  }

  /// What no entity is, by lines.
  void lines(const ObjectShape &shape) {
    constexpr int kMost = 1 << 14;
    const auto at = [&](double part) {
      const double u = stride::path::parameterAt(shape.shape, part * shape.shape.length);
      return stride::path::overParameter(shape.shape, u).p;
    };
    const auto off = [&](int count) {
      double most = 0;
      for (int i = 0; i < count; ++i) {
        const Vector3 middle = (at(1.0 * i / count) + at((i + 1.0) / count)) * 0.5;
        most = std::max(most, norm(middle - at((i + 0.5) / count)));
      }
      return most;
    };
    int count = 8;
    while (count < kMost && off(count) > how_.tolerance)
      count *= 2;
    for (int i = 0; i < count; ++i)
      line(at(1.0 * i / count), at((i + 1.0) / count));
  }

  void arc(const PathObject &object) {
    const bool clockwise =
        object.moveType == MoveType::Clockwise || object.moveType == MoveType::EllipseClockwise;
    const double sweep = std::abs(object.parameterRange[1]);
    // Drawings go counterclockwise.
    const double from = object.parameterRange[0] - (clockwise ? sweep : 0);
    const double *shape = object.shape;
    const double height = dot(object.normal, placeOf(object.start));
    const Vector3 centre =
        object.planeX * shape[0] + object.planeY * shape[1] + object.normal * height;
    const bool circle = isCircle(object.moveType);
    if (circle && object.normal.z == 1 && object.planeX.x == 1) {
      begin(sweep >= kFullTurn ? "CIRCLE" : "ARC", "AcDbCircle");
      entities_.place(10, centre);
      entities_.pair(40, shape[2]);
      if (sweep < kFullTurn) {
        entities_.pair(100, "AcDbArc");
        entities_.pair(50, turn(from));
        entities_.pair(51, turn(from + sweep));
      }
      return;
    }
    const double size = circle ? shape[2] : shape[4];
    const Vector3 main =
        circle ? object.planeX : object.planeX * shape[2] + object.planeY * shape[3];
    begin("ELLIPSE", "AcDbEllipse");
    entities_.place(10, centre);
    entities_.place(11, main * size);
    entities_.place(210, object.normal);
    entities_.pair(40, circle ? 1.0 : shape[5] / shape[4]);
    const double begins = turn(from) * kHalfTurn;
    entities_.pair(41, sweep >= kFullTurn ? 0.0 : begins);
    entities_.pair(42, sweep >= kFullTurn ? 2 * M_PI : begins + sweep * kHalfTurn);
  }

  /// From 0 to 360.
  static double turn(double angle) { return angle - 360 * std::floor(angle / 360); }

  /// A polynomial by its control points.
  void polynomial(const PathObject &object, int degree) {
    double low = object.parameterRange[0];
    double high = object.parameterRange[1];
    if (low == 0 && high == 0)
      high = 1;
    std::array<Vector3, 6> control{};
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 6> c{};
      for (int k = 0; k <= degree; ++k)
        c[static_cast<size_t>(k)] = coefficient(object, degree, axis, k);
      reparametrise(c, degree, low, high);
      toControl(c, degree);
      for (size_t k = 0; k <= static_cast<size_t>(degree); ++k) {
        double *const parts[] = {&control[k].x, &control[k].y, &control[k].z};
        *parts[axis] = c[k];
      }
    }
    const double height = dot(object.normal, placeOf(object.start));
    begin("SPLINE", "AcDbSpline");
    entities_.pair(70, 8);
    entities_.pair(71, degree);
    entities_.pair(72, 2 * (degree + 1));
    entities_.pair(73, degree + 1);
    entities_.pair(74, 0);
    for (int k = 0; k < 2 * (degree + 1); ++k)
      entities_.pair(40, k <= degree ? 0.0 : 1.0);
    for (size_t k = 0; k <= static_cast<size_t>(degree); ++k)
      entities_.place(10, degree == 5 ? control[k]
                                      : object.planeX * control[k].x +
                                            object.planeY * control[k].y + object.normal * height);
  }

  static double coefficient(const PathObject &object, int degree, int axis, int k) {
    if (degree == 3)
      return axis == 2 ? 0 : object.shape[4 * axis + k];
    const int at = 6 * axis + k;
    return at < 8 ? object.shape[at] : object.moreShape[at - 8];
  }

  /// The same polynomial over 0 to 1.
  static void reparametrise(std::array<double, 6> &c, int degree, double low, double high) {
    for (int i = 0; i < degree; ++i) // around `low`
      for (int k = degree - 1; k >= i; --k)
        c[static_cast<size_t>(k)] += low * c[static_cast<size_t>(k) + 1];
    double power = 1;
    for (double &one : c) {
      one *= power;
      power *= high - low;
    }
  }

  /// From coefficients of powers to control points.
  static void toControl(std::array<double, 6> &c, int degree) {
    double binomial = 1;
    for (int k = 0; k <= degree; ++k) {
      c[static_cast<size_t>(k)] /= binomial;
      binomial = binomial * (degree - k) / (k + 1);
    }
    for (int i = 1; i <= degree; ++i)
      for (int k = degree; k >= i; --k)
        c[static_cast<size_t>(k)] += c[static_cast<size_t>(k) - 1];
  }

  const DxfExport &how_;
  DxfText entities_;
  std::string_view layer_;
};

/// One table: `rows` writes its rows.
template <class Rows>
void table(DxfText &out, std::string_view name, int handle, int count, const Rows &rows) {
  out.pair(0, "TABLE");
  out.pair(2, name);
  out.pair(5, DxfText::handle(handle));
  out.pair(100, "AcDbSymbolTable");
  out.pair(70, count);
  if (name == "DIMSTYLE")
    out.pair(100, "AcDbDimStyleTable");
  rows();
  out.pair(0, "ENDTAB");
}

void row(DxfText &out, std::string_view type, int owner, std::string_view subclass,
         std::string_view name, int handle = 0) {
  if (handle != 0) {
    out.pair(0, type);
    out.pair(5, DxfText::handle(handle));
    out.pair(330, DxfText::handle(owner));
  } else {
    (void)out.begin(type, owner);
  }
  out.pair(100, "AcDbSymbolTableRecord");
  out.pair(100, subclass);
  out.pair(2, name);
}

/// What AutoCAD asks for.
void tables(DxfText &out) {
  out.section("TABLES");
  const auto none = [] {};
  table(out, "VPORT", 1, 0, none);
  table(out, "LTYPE", 2, 3, [&] {
    for (const std::string_view name : {"ByBlock", "ByLayer", "Continuous"}) {
      row(out, "LTYPE", 2, "AcDbLinetypeTableRecord", name);
      out.pair(70, 0);
      out.pair(3, "");
      out.pair(72, 65);
      out.pair(73, 0);
      out.pair(40, 0.0);
    }
  });
  table(out, "LAYER", 3, 3, [&] {
    constexpr int kWhite = 7;
    constexpr int kBlue = 5;
    constexpr int kGreen = 3;
    for (const auto &[name, color] :
         {std::pair{"0", kWhite}, std::pair{"PATH", kBlue}, std::pair{"RAPID", kGreen}}) {
      row(out, "LAYER", 3, "AcDbLayerTableRecord", name);
      out.pair(70, 0);
      out.pair(62, color);
      out.pair(6, "Continuous");
    }
  });
  table(out, "STYLE", 4, 0, none);
  table(out, "VIEW", 5, 0, none);
  table(out, "UCS", 6, 0, none);
  table(out, "APPID", 7, 1, [&] {
    row(out, "APPID", 7, "AcDbRegAppTableRecord", "ACAD");
    out.pair(70, 0);
  });
  table(out, "DIMSTYLE", 8, 0, none);
  table(out, "BLOCK_RECORD", 9, 2, [&] {
    row(out, "BLOCK_RECORD", 9, "AcDbBlockTableRecord", "*Model_Space", kModelSpace);
    row(out, "BLOCK_RECORD", 9, "AcDbBlockTableRecord", "*Paper_Space", kPaperSpace);
  });
  out.endSection();
}

void blocks(DxfText &out) {
  out.section("BLOCKS");
  for (const auto &[name, owner] :
       {std::pair{"*Model_Space", kModelSpace}, std::pair{"*Paper_Space", kPaperSpace}}) {
    (void)out.begin("BLOCK", owner);
    out.pair(100, "AcDbEntity");
    out.pair(8, "0");
    out.pair(100, "AcDbBlockBegin");
    out.pair(2, name);
    out.pair(70, 0);
    out.place(10, {0, 0, 0});
    out.pair(3, name);
    out.pair(1, "");
    (void)out.begin("ENDBLK", owner);
    out.pair(100, "AcDbEntity");
    out.pair(8, "0");
    out.pair(100, "AcDbBlockEnd");
  }
  out.endSection();
}

void objects(DxfText &out) {
  constexpr int kRoot = 0x30;
  constexpr int kGroups = 0x31;
  out.section("OBJECTS");
  out.pair(0, "DICTIONARY");
  out.pair(5, DxfText::handle(kRoot));
  out.pair(330, "0");
  out.pair(100, "AcDbDictionary");
  out.pair(281, 1);
  out.pair(3, "ACAD_GROUP");
  out.pair(350, DxfText::handle(kGroups));
  out.pair(0, "DICTIONARY");
  out.pair(5, DxfText::handle(kGroups));
  out.pair(330, DxfText::handle(kRoot));
  out.pair(100, "AcDbDictionary");
  out.pair(281, 1);
  out.endSection();
}

std::string drawingText(const Drawer &drawer) {
  constexpr int kMillimetres = 4;
  DxfText out;
  out.section("HEADER");
  out.pair(9, "$ACADVER");
  out.pair(1, "AC1015");
  out.pair(9, "$INSUNITS");
  out.pair(70, kMillimetres);
  out.pair(9, "$HANDSEED");
  out.pair(5, "FFFFFFF");
  out.endSection();
  out.section("CLASSES");
  out.endSection();
  tables(out);
  blocks(out);
  out.section("ENTITIES");
  out.text_ += drawer.text();
  out.endSection();
  objects(out);
  out.pair(0, "EOF");
  return std::move(out.text_);
}

} // namespace

std::optional<std::string> exportDxf(const CncProgram &program, const DxfExport &how,
                                     Diagnostics &diagnostics) {
  Drawer drawer(how);
  size_t count = 0;
  const CncDecoded decoded = decodeCnc(program, [&](const PathObject &object) {
    drawer.draw(object);
    return ++count < kMostCncObjects;
  });
  if (decoded.end == CncEnd::Wrong || decoded.end == CncEnd::Refused) {
    const Span where = decoded.word != nullptr ? decoded.word->span : program.span;
    diagnostics
        .report(Code::CncSentence, where,
                decoded.end == CncEnd::Wrong
                    ? "this sentence cannot be carried out"
                    : fmt::format("the path has more than {} objects", kMostCncObjects),
                "here")
        .help("`stride cnc check` says more of the program");
    return std::nullopt;
  }
  return drawingText(drawer);
}

} // namespace stc

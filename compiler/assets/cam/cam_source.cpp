// Reading cam files.

#include "compiler/assets/cam/cam_source.hpp"

#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace stc {

namespace {

using stride::cam::FileTappet;
using stride::cam::LawShape;
using stride::cam::Node;

constexpr int16_t kTimed = 3;  // TAPPETACTION_time
constexpr double kSame = 1e-9; // of a position

bool same(double a, double b) {
  return std::fabs(a - b) <= kSame * std::max({1.0, std::fabs(a), std::fabs(b)});
}

std::string_view nameOfKind(CamElement::Kind kind) {
  switch (kind) {
  case CamElement::Kind::Point:
    return "point";
  case CamElement::Kind::Line:
    return "line";
  case CamElement::Kind::Law:
    break;
  }
  return "law";
}

class CamReader {
public:
  CamReader(const SourceFile &file, Diagnostics &diagnostics)
      : file_(file), diagnostics_(diagnostics), errors_(diagnostics.errorCount()) {}

  std::optional<CamSource> read() {
    const std::unique_ptr<TomlNode> document = parseToml(file_, diagnostics_);
    if (document == nullptr)
      return std::nullopt;
    const CheckedSection top(*document, camSchema(), diagnostics_);
    readName(top);
    cam_.periodic = top.boolean("periodic", false);
    cam_.interval = top.real("interval", 0);
    if (!cam_.periodic && top.get("interval") != nullptr)
      withoutEffect(diagnostics_, top, "interval", "only with `periodic = true`");
    if (!readMaster(top))
      return std::nullopt;
    readSlave(top);
    for (const CheckedSection &point : top.sections("point", diagnostics_))
      readPoint(point);
    for (const CheckedSection &line : top.sections("line", diagnostics_))
      readLine(line);
    for (const CheckedSection &law : top.sections("law", diagnostics_))
      readLaw(law);
    for (const CheckedSection &tappet : top.sections("tappet", diagnostics_))
      readTappet(tappet);
    for (const CheckedSection &compile : top.sections("compile", diagnostics_))
      readCompile(compile);
    if (!failed())
      arrange(top);
    if (!failed() && cam_.periodic)
      closeCircle();
    if (!failed() && !smoothen(cam_))
      diagnostics_.report(Code::CamTable, masterSpan_,
                          "the smooth points of this cam cannot be computed",
                          "the numbers are too large or too close together");
    if (failed())
      return std::nullopt;
    reportJumps();
    return std::move(cam_);
  }

private:
  [[nodiscard]] bool failed() const { return diagnostics_.errorCount() != errors_; }

  [[nodiscard]] Span beginning() const { return {file_.id(), 0, 0}; }

  void readName(const CheckedSection &top) {
    if (const TomlNode *name = top.get("name")) {
      cam_.name = {name->text, name->span};
      return;
    }
    std::string text = std::filesystem::path(file_.name()).filename().string();
    if (text.size() > kCamSuffix.size())
      text.resize(text.size() - kCamSuffix.size());
    cam_.name = {text, beginning()};
    if (!top.has("name") && !isIdentifier(text))
      diagnostics_
          .report(Code::ConfigBadName, beginning(),
                  fmt::format("`{}` cannot be a name in Structured Text", text),
                  "a cam is named after its file")
          .help("rename the file, or give the cam a name: `name = \"Cam1\"`");
  }

  bool readMaster(const CheckedSection &top) {
    if (!top.has("master")) {
      diagnostics_
          .report(Code::ConfigMissingKey, beginning(), "a cam needs [master]",
                  "`master` is missing")
          .help("add the range of the master:\n[master]\nstart = 0\nend = 360");
      return false;
    }
    const std::vector<CheckedSection> sections = top.sections("master", diagnostics_);
    if (sections.empty())
      return false;
    const CheckedSection &master = sections.front();
    const TomlNode *start = master.get("start");
    const TomlNode *end = master.get("end");
    if (start == nullptr || end == nullptr)
      return false;
    cam_.start = start->floating;
    cam_.end = end->floating;
    cam_.masterUnit = master.text("unit");
    masterSpan_ = master.table().span;
    if (cam_.start < cam_.end)
      return true;
    diagnostics_
        .report(Code::CamElements, end->span, "a cam must end after its start",
                fmt::format("not greater than {}", cam_.start))
        .label(start->span, "the start");
    return false;
  }

  void readSlave(const CheckedSection &top) {
    for (const CheckedSection &slave : top.sections("slave", diagnostics_)) {
      cam_.slaveUnit = slave.text("unit");
      cam_.slaveScale = scale(slave, "minimum", "maximum");
    }
  }

  /// Two numbers that come together, the first one less than the second one.
  std::optional<std::pair<double, double>> scale(const CheckedSection &section,
                                                 std::string_view low, std::string_view high) {
    const TomlNode *minimum = section.get(low);
    const TomlNode *maximum = section.get(high);
    if (minimum == nullptr && maximum == nullptr)
      return std::nullopt;
    if (section.has(low) != section.has(high)) {
      const std::string_view absent = section.has(low) ? high : low;
      diagnostics_
          .report(Code::ConfigMissingKey, (minimum != nullptr ? minimum : maximum)->span,
                  fmt::format("a scale needs `{}` and `{}`", low, high),
                  fmt::format("`{}` is missing", absent))
          .help(fmt::format("add `{} = …`", absent));
      return std::nullopt;
    }
    if (minimum == nullptr || maximum == nullptr)
      return std::nullopt;
    if (minimum->floating < maximum->floating)
      return std::pair(minimum->floating, maximum->floating);
    diagnostics_
        .report(Code::ConfigOutOfRange, maximum->span,
                fmt::format("`{}` must be greater than `{}`", high, low), "not greater than …")
        .label(minimum->span, "… this");
    return std::nullopt;
  }

  void readPoint(const CheckedSection &section) {
    CamElement element;
    element.kind = CamElement::Kind::Point;
    element.left = {section.real("x", 0), section.real("y", 0), section.real("v", 0),
                    section.real("a", 0)};
    element.right = element.left;
    element.span = section.table().span;
    element.smooth = section.boolean("smooth", false);
    element.given = section.has("v") ? 1 : 0;
    if (element.smooth && section.has("a")) {
      withoutEffect(diagnostics_, section, element.given == 0 ? "a" : "smooth",
                    element.given == 0 ? "together with `v`, or without `smooth`" : "without `a`");
      element.smooth = element.given == 0;
    }
    if (cam_.periodic && element.left.x == cam_.end)
      for (const std::string_view name : {"v", "a"})
        if (section.get(name) != nullptr)
          endGiven_.emplace_back(name, section.get(name));
    cam_.elements.push_back(element);
  }

  bool ends(const CheckedSection &section, std::string_view what) {
    const TomlNode *start = section.get("x");
    const TomlNode *end = section.get("x_end");
    if (start == nullptr || end == nullptr || start->floating < end->floating)
      return true;
    diagnostics_
        .report(Code::CamElements, end->span, fmt::format("a {} must end after its start", what),
                "`x_end` is not greater than …")
        .label(start->span, "… `x`");
    return false;
  }

  void readLine(const CheckedSection &section) {
    CamElement element;
    element.kind = CamElement::Kind::Line;
    element.span = section.table().span;
    element.left = {section.real("x", 0), section.real("y", 0), 0, 0};
    element.right = {section.real("x_end", 0), section.real("y_end", 0), 0, 0};
    if (!ends(section, "line"))
      return;
    element.left.v = element.right.v =
        (element.right.y - element.left.y) / (element.right.x - element.left.x);
    cam_.elements.push_back(element);
  }

  void readLaw(const CheckedSection &section) {
    CamElement element;
    element.kind = CamElement::Kind::Law;
    element.span = section.table().span;
    element.left = {section.real("x", 0), section.real("y", 0), section.real("v", 0),
                    section.real("a", 0)};
    element.right = {section.real("x_end", 0), section.real("y_end", 0), section.real("v_end", 0),
                     section.real("a_end", 0)};
    using stride::cam::Law;
    element.shape.law = static_cast<Law>(section.choice("law", 0));
    element.shape.parameter = section.real("parameter", element.shape.parameter);
    element.shape.inflexion = section.real("inflexion", element.shape.inflexion);
    if (!ends(section, "law"))
      return;
    if (element.shape.law != Law::ModifiedSine && section.get("parameter") != nullptr)
      withoutEffect(diagnostics_, section, "parameter", "only for the law \"modified_sine\"");
    if (element.shape.law == Law::Polynomial && section.get("inflexion") != nullptr)
      withoutEffect(diagnostics_, section, "inflexion", "only for other laws than \"polynomial\"");
    if (element.shape.law == Law::Harmonic) {
      for (const std::string_view name : {"a", "a_end"})
        if (section.get(name) != nullptr)
          withoutEffect(diagnostics_, section, name,
                        "for other laws than \"harmonic\", which has its own");
      const stride::cam::Segment own =
          stride::cam::makeSegment(element.shape, element.left, element.right);
      element.left.a = stride::cam::evaluateSegment(own, own.start).a;
      element.right.a = stride::cam::evaluateSegment(own, own.end).a;
    }
    cam_.elements.push_back(element);
  }

  void readTappet(const CheckedSection &section) {
    FileTappet tappet{};
    tappet.x = section.real("x", 0);
    tappet.group = static_cast<int16_t>(section.integer("group", 0));
    tappet.pass = static_cast<int16_t>(section.choice("pass", 0));
    tappet.action = static_cast<int16_t>(section.choice("action", 0));
    tappet.delay = static_cast<uint32_t>(section.integer("delay", 0));
    tappet.duration = static_cast<uint32_t>(section.integer("duration", 0));
    if (const TomlNode *x = section.get("x");
        x != nullptr && (tappet.x < cam_.start || tappet.x > cam_.end))
      outside(x->span, "a tappet");
    if (tappet.action == kTimed) {
      if (!section.has("duration"))
        diagnostics_
            .report(Code::ConfigMissingKey, section.get("action")->span,
                    "a tappet with action = \"timed\" needs `duration`", "switches for how long?")
            .help("add `duration = …`: µs for which the tappet bit stays TRUE");
    } else if (!section.has("action") || section.get("action") != nullptr) {
      for (const std::string_view name : {"delay", "duration"})
        if (section.get(name) != nullptr)
          withoutEffect(diagnostics_, section, name, "only with action = \"timed\"");
    }
    cam_.tappets.push_back(tappet);
  }

  void readCompile(const CheckedSection &section) {
    CamCompile &compile = cam_.compile;
    compile.mode = static_cast<CamMode>(section.choice("mode", 0));
    compile.type = static_cast<stride::cam::Element>(section.choice("type", 6));
    compile.places = static_cast<int32_t>(section.integer("places", 0));
    compile.cubic = section.choice("interpolation", 1) == 3;
    compile.masterNumbers = scale(section, "master_minimum", "master_maximum");
    compile.slaveNumbers = scale(section, "slave_minimum", "slave_maximum");
    const TomlNode *mode = section.get("mode");
    if (mode == nullptr)
      return;
    const TomlNode *places = section.get("places");
    compile.span = places != nullptr ? places->span : mode->span;
    const bool table =
        compile.mode == CamMode::Equidistant || compile.mode == CamMode::ElementOptimised;
    if (!table) {
      for (const std::string_view name : {"type", "places", "interpolation", "master_minimum",
                                          "master_maximum", "slave_minimum", "slave_maximum"})
        if (section.get(name) != nullptr)
          withoutEffect(diagnostics_, section, name,
                        "only with mode = \"equidistant\" or \"element_optimised\"");
      return;
    }
    if (!section.has("places"))
      diagnostics_
          .report(Code::ConfigMissingKey, mode->span, "a table needs `places`",
                  "how many places has the table?")
          .help("add `places = …`, 2 to 32767");
    if (compile.mode == CamMode::Equidistant)
      for (const std::string_view name : {"master_minimum", "master_maximum"})
        if (section.get(name) != nullptr)
          withoutEffect(diagnostics_, section, name, "only with mode = \"element_optimised\"");
  }

  void outside(Span where, std::string_view what) {
    diagnostics_
        .report(Code::CamElements, where,
                fmt::format("{} must lie on the cam, from {} to {}", what, cam_.start, cam_.end),
                "outside of the master's range")
        .label(masterSpan_, "the range");
  }

  // Brings the elements into order and looks whether they follow each other.
  void arrange(const CheckedSection &top) {
    std::vector<CamElement> &elements = cam_.elements;
    if (elements.empty() && !cam_.tappets.empty()) { // a digital cam table
      for (const std::string_view name : {"periodic", "interval"})
        if (top.get(name) != nullptr)
          withoutEffect(diagnostics_, top, name, "only with points, lines or laws");
      for (const CheckedSection &compile : top.sections("compile", diagnostics_))
        if (cam_.compile.mode != CamMode::None)
          withoutEffect(diagnostics_, compile, "mode", "only with points, lines or laws");
      cam_.periodic = false;
      cam_.interval = 0;
      return;
    }
    if (elements.empty()) {
      diagnostics_
          .report(Code::CamElements, masterSpan_, "a cam needs elements",
                  "there are no points, lines or laws")
          .help(fmt::format("begin with the two ends:\n[[point]]\nx = {}\ny = 0\n\n[[point]]\nx = "
                            "{}\ny = 0",
                            cam_.start, cam_.end));
      return;
    }
    std::stable_sort(
        elements.begin(), elements.end(), [](const CamElement &a, const CamElement &b) {
          return a.left.x < b.left.x || (a.left.x == b.left.x && a.right.x < b.right.x);
        });
    for (const CamElement &element : elements)
      if (element.left.x < cam_.start || element.right.x > cam_.end)
        outside(element.span, fmt::format("a {}", nameOfKind(element.kind)));
    for (size_t i = 1; i < elements.size(); ++i)
      follow(elements[i - 1], elements[i]);
    if (failed())
      return;
    if (elements.front().left.x != cam_.start)
      missingEnd(elements.front().span, "start", cam_.start);
    if (elements.back().right.x == cam_.end)
      return;
    if (!cam_.periodic || cam_.interval != 0) {
      missingEnd(elements.back().span, "end", cam_.end);
      return;
    }
    CamElement end; // the start again
    end.left = elements.front().left;
    end.left.x = cam_.end;
    end.right = end.left;
    end.span = elements.front().span;
    end.smooth = elements.front().smooth;
    end.given = elements.front().given;
    elements.push_back(end);
  }

  void missingEnd(Span nearest, std::string_view which, double x) {
    diagnostics_
        .report(Code::CamElements, nearest,
                fmt::format("no element is at the {} of the cam, {}", which, x),
                which == "start" ? "the first element" : "the last element")
        .label(masterSpan_, "the range of the cam")
        .help(fmt::format("add a point there:\n[[point]]\nx = {}\ny = …", x));
  }

  void follow(const CamElement &before, const CamElement &behind) {
    const bool twoPoints = before.kind == CamElement::Kind::Point &&
                           behind.kind == CamElement::Kind::Point && before.left.x == behind.left.x;
    if (twoPoints || behind.left.x < before.right.x) {
      diagnostics_
          .report(Code::CamElements, behind.span,
                  twoPoints ? fmt::format("two points lie at master position {}", behind.left.x)
                            : fmt::format("a {} and a {} overlap", nameOfKind(before.kind),
                                          nameOfKind(behind.kind)),
                  twoPoints ? "the second one"
                            : fmt::format("begins at {}, before …", behind.left.x))
          .label(before.span, twoPoints ? std::string("the first one")
                                        : fmt::format("… this one ends, at {}", before.right.x));
      return;
    }
    if (behind.left.x == before.right.x && !same(behind.left.y, before.right.y))
      diagnostics_
          .report(Code::CamElements, behind.span,
                  fmt::format("the slave would jump at master position {}", behind.left.x),
                  fmt::format("begins at {}", behind.left.y))
          .label(before.span, fmt::format("ends at {}", before.right.y));
  }

  // The end of a periodic cam has position, velocity and acceleration of the start.
  void closeCircle() {
    const Node &start = cam_.elements.front().left;
    CamElement &last = cam_.elements.back();
    const double rise = last.right.y - start.y;
    const double periods = cam_.interval == 0 ? 0 : std::round(rise / cam_.interval);
    const double end = start.y + periods * cam_.interval;
    if (!same(last.right.y, end)) {
      Diagnostic &d = diagnostics_.report(
          Code::CamPeriodic, last.span,
          fmt::format("a periodic cam must end where it began: at {}{}", start.y,
                      cam_.interval == 0
                          ? std::string()
                          : fmt::format(", or by a multiple of {} further", cam_.interval)),
          fmt::format("ends at {}", last.right.y));
      d.label(cam_.elements.front().span, fmt::format("begins at {}", start.y));
      if (cam_.interval == 0)
        d.help(fmt::format("a slave that goes on and on needs its period: `interval = {}`",
                           std::fabs(rise)));
      else
        d.help(fmt::format("the nearest place is {}", end));
      return;
    }
    if (last.kind != CamElement::Kind::Point)
      return;
    for (const auto &[name, value] : endGiven_)
      if (!same(value->floating, name == "v" ? start.v : start.a))
        diagnostics_
            .report(Code::ConfigWithoutEffect, value->keySpan,
                    fmt::format("`{}` has no effect here", name),
                    "a periodic cam ends as it begins")
            .label(cam_.elements.front().span, "the start");
    last.left.v = last.right.v = start.v;
    last.left.a = last.right.a = start.a;
    last.smooth = cam_.elements.front().smooth;
    last.given = cam_.elements.front().given;
  }

  void reportJumps() {
    for (const CamJump &jump : jumpsOf(segmentsOf(cam_), cam_.periodic, cam_.interval)) {
      Span where = cam_.elements.back().span;
      for (const CamElement &element : cam_.elements)
        if (element.left.x == jump.x || element.right.x == jump.x)
          where = element.span;
      diagnostics_
          .report(Code::CamJump, where,
                  fmt::format("the {} jumps from {:.6g} to {:.6g} at master position {}", jump.what,
                              jump.before, jump.behind, jump.x),
                  "at this element")
          .note(jump.what == "acceleration" ? "the slave gets a jolt there"
                                            : "no slave can follow that");
    }
  }

  const SourceFile &file_;
  Diagnostics &diagnostics_;
  size_t errors_;
  CamSource cam_;
  Span masterSpan_;
  /// `v` and `a` of the point at the end of a periodic cam.
  std::vector<std::pair<std::string_view, const TomlNode *>> endGiven_;
};

} // namespace

std::optional<CamSource> readCam(const SourceFile &file, Diagnostics &diagnostics) {
  return CamReader(file, diagnostics).read();
}

} // namespace stc

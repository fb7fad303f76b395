// Reading and writing cams in all the forms that `stride cam` knows.

#include "compiler/cli/cam.hpp"
#include "compiler/source/read_source.hpp"
#include "compiler/syntax/st_text.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace {

using namespace stride::cam;

/// The name without folder and what ends it.
std::string stemOf(const std::string &path) {
  std::string name = std::filesystem::path(path).filename().string();
  return name.substr(0, name.find('.'));
}

void keepSegments(LoadedCam &cam, const Curve &curve) {
  for (uint32_t i = 0; i < pieceCount(curve); ++i)
    cam.segments.push_back(pieceOf(curve, i, false));
}

std::string_view reasonOf(CamFileError error) {
  switch (error) {
  case CamFileError::None:
    break;
  case CamFileError::Version:
    return "it is no cam file, or one of another version";
  case CamFileError::Form:
    return "its form or the type of its numbers is unknown";
  case CamFileError::Truncated:
    return "it ends too early";
  case CamFileError::Damaged:
    return "its contents are damaged";
  }
  return "";
}

std::optional<LoadedCam> loadBinary(const std::string &path, const Sources &sources,
                                    Diagnostics &diagnostics) {
  const std::optional<std::string> bytes = sources.read(path);
  if (!bytes) {
    diagnostics.report(Code::UnreadableFile, {},
                       fmt::format("`{}` cannot be read: {}", path, readSourceError()));
    return std::nullopt;
  }
  std::vector<double> aligned((bytes->size() + sizeof(double) - 1) / sizeof(double) + 1);
  std::memcpy(aligned.data(), bytes->data(), bytes->size());
  CamFile file;
  const CamFileError error = openCamFile(reinterpret_cast<const uint8_t *>(aligned.data()),
                                         static_cast<int64_t>(bytes->size()), file);
  if (error != CamFileError::None) {
    diagnostics.report(Code::CamUnreadable, {},
                       fmt::format("`{}` cannot be read: {}", path, reasonOf(error)));
    return std::nullopt;
  }
  LoadedCam cam;
  cam.kind = LoadedCam::Kind::Binary;
  cam.data.header = file.header;
  const auto size = static_cast<size_t>(
      elementBlockSize(file.header.form, file.header.element, file.header.elements));
  cam.data.storage.resize((size + sizeof(double) - 1) / sizeof(double));
  if (size != 0)
    std::memcpy(cam.data.storage.data(), file.elements, size);
  cam.data.tappets.assign(file.tappets, file.tappets + file.header.tappets);
  cam.source.name.text = file.header.name;
  if (!isIdentifier(cam.source.name.text))
    cam.source.name.text.clear();
  cam.source.start = file.header.start;
  cam.source.end = file.header.end;
  cam.source.tappets = cam.data.tappets;
  if (file.header.elements != 0)
    keepSegments(cam, cam.data.curve());
  return cam;
}

/// Cuts a number off the front; false: there is none.
bool takeNumber(std::string_view &text, double &value) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  std::string copy(text.substr(0, text.find_first_of(":; \t\r")));
  for (char &c : copy)
    c = c == ',' ? '.' : c;
  const char *begin = copy.data() + (copy.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, copy.data() + copy.size(), value);
  if (error != std::errc() || end != copy.data() + copy.size() || !std::isfinite(value))
    return false;
  text.remove_prefix(copy.size());
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\r'))
    text.remove_prefix(1);
  return true;
}

/// What both ends of a piece are, as the piece itself has them.
CamElement elementOf(const Segment &segment) {
  const auto node = [&](double x) {
    const Point at = evaluateSegment(segment, x);
    return Node{x, at.y, at.v, at.a};
  };
  CamElement element;
  element.kind = CamElement::Kind::Law;
  element.left = node(segment.start);
  element.right = node(segment.end);
  element.shape = {segment.law, segment.parameter, segment.inflexion};
  bool straight = segment.law == Law::Polynomial;
  for (int i = 2; i < 8; ++i)
    straight = straight && segment.coefficients[i] == 0.0;
  if (straight)
    element.kind = CamElement::Kind::Line;
  return element;
}

bool isSame(const Segment &segment, const CamElement &element) {
  if (element.kind == CamElement::Kind::Line)
    return true;
  const Segment again = makeSegment(element.shape, element.left, element.right);
  double size = 1;
  double most = 0;
  for (int i = 0; i <= 64; ++i) {
    const double x = segment.start + (segment.end - segment.start) * i / 64;
    const double y = evaluateSegment(segment, x).y;
    size = std::max(size, std::fabs(y));
    most = std::max(most, std::fabs(y - evaluateSegment(again, x).y));
  }
  return most <= 1e-9 * size;
}

/// Gives the node velocity and acceleration of the parabola through three places.
void bend(Node &node, const CamPlace &a, const CamPlace &b, const CamPlace &c) {
  const double left = (b.y - a.y) / (b.x - a.x);
  const double right = (c.y - b.y) / (c.x - b.x);
  const double half = (right - left) / (c.x - a.x); // of the second derivative
  node.v = left + half * (2 * node.x - a.x - b.x);
  node.a = 2 * half;
}

} // namespace

Curve LoadedCam::curve() const {
  Curve curve;
  curve.start = source.start;
  curve.end = source.end;
  curve.form = Form::Segments;
  curve.count = static_cast<int32_t>(segments.size());
  curve.data = segments.data();
  return curve;
}

std::optional<std::vector<CamPlace>> readPlaces(const SourceFile &file, Diagnostics &diagnostics) {
  std::vector<CamPlace> places;
  for (uint32_t number = 1; number <= file.lineCount(); ++number) {
    const std::string_view line = file.line(number);
    const uint32_t begin = file.lineStart(number);
    const Span where{file.id(), begin, begin + static_cast<uint32_t>(line.size())};
    std::string_view rest = line;
    if (rest.find_first_not_of(" \t\r") == std::string_view::npos)
      continue;
    CamPlace place;
    const bool good = takeNumber(rest, place.x) && !rest.empty() &&
                      (rest.front() == ';' || rest.front() == ':') &&
                      (rest.remove_prefix(1), takeNumber(rest, place.y)) && rest.empty();
    if (!good) {
      diagnostics
          .report(Code::CamUnreadable, where, fmt::format("`{}` is no table of a cam", file.name()),
                  "not a place")
          .help("each line has a master and a slave position: `120;45.5`");
      return std::nullopt;
    }
    if (!places.empty() && place.x <= places.back().x) {
      diagnostics.report(
          Code::CamUnreadable, where, fmt::format("`{}` is no table of a cam", file.name()),
          fmt::format("the master does not ascend: {} comes after {}", place.x, places.back().x));
      return std::nullopt;
    }
    places.push_back(place);
  }
  if (places.size() >= 2 && places.size() <= kCamFileMaxCount)
    return places;
  diagnostics.report(Code::CamUnreadable, {},
                     fmt::format("`{}` is no table of a cam: it has {} places, and 2 to {} are "
                                 "possible",
                                 file.name(), places.size(), kCamFileMaxCount));
  return std::nullopt;
}

std::string placesText(const std::vector<CamPlace> &places) {
  std::string text;
  for (const CamPlace &place : places)
    text += fmt::format("{};{}\r\n", place.x, place.y == 0 ? 0 : place.y);
  return text;
}

std::optional<LoadedCam> loadCam(const std::string &path, Sources &sources,
                                 Diagnostics &diagnostics) {
  const std::string lower = lowerCase(path);
  if (lower.ends_with(".cam"))
    return loadBinary(path, sources, diagnostics);
  const std::optional<FileId> id = sources.load(path, path);
  if (!id) {
    diagnostics.report(Code::UnreadableFile, {},
                       fmt::format("`{}` cannot be read: {}", path, readSourceError()));
    return std::nullopt;
  }
  LoadedCam cam;
  if (lower.ends_with(kCamSuffix)) {
    std::optional<CamSource> source = readCam(sources.file(*id), diagnostics);
    if (!source)
      return std::nullopt;
    std::optional<CamData> data = compileCam(*source, diagnostics);
    if (!data)
      return std::nullopt;
    cam.segments = segmentsOf(*source);
    cam.source = std::move(*source);
    cam.data = std::move(*data);
    return cam;
  }
  const std::optional<std::vector<CamPlace>> places = readPlaces(sources.file(*id), diagnostics);
  if (!places)
    return std::nullopt;
  cam.kind = LoadedCam::Kind::Table;
  cam.source.name.text = stemOf(path);
  if (!isIdentifier(cam.source.name.text))
    cam.source.name.text.clear();
  pointsThrough(*places, cam.source);
  cam.segments = segmentsOf(cam.source);
  if (checkCurve(cam.curve()) == CurveError::None)
    return cam;
  diagnostics.report(
      Code::CamUnreadable, {},
      fmt::format("`{}` is no table of a cam: its numbers are too large or too close "
                  "together",
                  path));
  return std::nullopt;
}

void pointsThrough(const std::vector<CamPlace> &places, CamSource &cam) {
  const size_t count = places.size();
  for (size_t i = 0; i < count; ++i) {
    CamElement element;
    element.left = {places[i].x, places[i].y, 0, 0};
    if (count == 2) {
      element.left.v = (places[1].y - places[0].y) / (places[1].x - places[0].x);
    } else {
      const size_t middle = std::min(std::max<size_t>(i, 1), count - 2);
      bend(element.left, places[middle - 1], places[middle], places[middle + 1]);
    }
    element.right = element.left;
    cam.elements.push_back(element);
  }
  cam.start = places.front().x;
  cam.end = places.back().x;
}

void joinEnds(CamSource &cam) {
  if (cam.elements.size() < 3)
    return;
  Node &first = cam.elements.front().left;
  Node &last = cam.elements.back().left;
  const Node &second = cam.elements[1].left;
  const Node &previous = cam.elements[cam.elements.size() - 2].left;
  const CamPlace before{previous.x - (last.x - first.x), previous.y - (last.y - first.y)};
  bend(first, before, {first.x, first.y}, {second.x, second.y});
  last.v = first.v;
  last.a = first.a;
  cam.elements.front().right = first;
  cam.elements.back().right = last;
}

bool elementsOf(const LoadedCam &from, CamSource &cam) {
  cam.elements.clear();
  if (from.data.header.form == Form::Nodes && from.kind == LoadedCam::Kind::Binary) {
    for (uint32_t i = 0; i < from.data.header.elements; ++i) {
      CamElement element;
      std::memcpy(&element.left, from.data.storage.data() + size_t{4} * i, sizeof element.left);
      element.right = element.left;
      cam.elements.push_back(element);
    }
    return true;
  }
  bool good = true;
  for (const Segment &segment : from.segments) {
    cam.elements.push_back(elementOf(segment));
    good = good && isSame(segment, cam.elements.back());
  }
  return good;
}

} // namespace stc::cli

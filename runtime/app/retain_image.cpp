#include "runtime/app/retain_image.hpp"

#include "runtime/app/byte_stream.hpp"
#include "runtime/app/checksum.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/app/symbols.hpp"
#include "runtime/common/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <map>
#include <set>

namespace stride::app {

namespace {

constexpr std::string_view kMagic = "STRDRTN\n";
constexpr uint32_t kVersion = 2;
/// Of magic, version, size and checksum, which lie before everything else.
constexpr size_t kFrame = 8 + 4 + 8 + 8;
/// The checksum is about everything but itself.
constexpr size_t kSummed = kFrame - 8;

/// Values at their natural alignment in one piece.
template <class T> void copyUnits(const std::byte *&from, std::byte *&to, uint64_t &left) noexcept {
  for (; left >= sizeof(T); left -= sizeof(T)) {
    const T value = __atomic_load_n(reinterpret_cast<const T *>(from), __ATOMIC_RELAXED);
    std::memcpy(to, &value, sizeof value);
    from += sizeof(T);
    to += sizeof(T);
  }
}

} // namespace

void copyRetained(const std::byte *state, std::span<const RetainRange> ranges,
                  std::byte *to) noexcept {
  for (const RetainRange &range : ranges) {
    const std::byte *from = state + range.offset;
    uint64_t left = range.size;
    // Up to a multiple of 8 in the largest pieces that are aligned.
    while (left > 0 && std::bit_cast<uintptr_t>(from) % 8 != 0) {
      const uintptr_t at = std::bit_cast<uintptr_t>(from);
      uint64_t piece = at % 2 != 0 ? 1 : at % 4 != 0 ? 2 : 4;
      piece = std::min(piece, std::bit_floor(left));
      uint64_t one = piece;
      if (piece == 4)
        copyUnits<uint32_t>(from, to, one);
      else if (piece == 2)
        copyUnits<uint16_t>(from, to, one);
      else
        copyUnits<uint8_t>(from, to, one);
      left -= piece;
    }
    copyUnits<uint64_t>(from, to, left);
    copyUnits<uint32_t>(from, to, left);
    copyUnits<uint16_t>(from, to, left);
    copyUnits<uint8_t>(from, to, left);
  }
}

std::vector<std::byte> encodeImage(const RetainHead &head, std::span<const std::byte> layout,
                                   std::span<const std::byte> values) {
  ByteWriter body;
  body.number(head.sequence);
  body.number(head.buildHash);
  body.text(head.application);
  body.number(static_cast<uint64_t>(layout.size()));
  body.raw(layout);
  body.number(static_cast<uint64_t>(values.size()));
  body.raw(values);
  const std::vector<std::byte> bytes = body.take();
  ByteWriter out;
  out.raw(std::as_bytes(std::span(kMagic)));
  out.number(kVersion);
  out.number(static_cast<uint64_t>(bytes.size()));
  const std::vector<std::byte> front = out.take();
  out.raw(front);
  out.number(crc64(bytes, crc64(front)));
  out.raw(bytes);
  return out.take();
}

bool mayBeImage(std::span<const std::byte> bytes) {
  const std::span<const std::byte> begin = bytes.first(std::min(bytes.size(), kMagic.size()));
  return std::equal(begin.begin(), begin.end(), std::as_bytes(std::span(kMagic)).begin()) ||
         std::all_of(begin.begin(), begin.end(), [](std::byte b) { return b == std::byte{0}; });
}

RetainImage decodeImage(std::span<const std::byte> bytes, bool checked) {
  if (bytes.size() < kFrame)
    throw Error("it ends too early");
  ByteReader frame(bytes.first(kFrame));
  const std::span<const std::byte> magic = frame.raw(kMagic.size());
  if (std::memcmp(magic.data(), kMagic.data(), kMagic.size()) != 0)
    throw Error("it does not begin as retained data do");
  const auto version = frame.number<uint32_t>();
  const auto size = frame.number<uint64_t>();
  const auto sum = frame.number<uint64_t>();
  const std::span<const std::byte> rest = bytes.subspan(kFrame);
  if (size != rest.size())
    throw Error("it has not the length it should have");
  // The first version left the front out: those files are told apart, not taken for damaged ones.
  if (checked && crc64(rest, crc64(bytes.first(kSummed))) != sum &&
      !(version == 1 && crc64(rest) == sum))
    throw Error("its checksum is wrong");
  if (version != kVersion)
    throw RetainVersionError(fmt::format(
        "it has version {} of the format, this Stride knows version {}", version, kVersion));
  ByteReader in(rest);
  RetainHead head;
  head.sequence = in.number<uint64_t>();
  head.buildHash = in.number<uint64_t>();
  head.application = in.text();
  RetainLayout layout = RetainLayout::decode(in.raw(in.number<uint64_t>()));
  const std::span<const std::byte> values = in.raw(in.number<uint64_t>());
  if (values.size() != layout.bytes() || in.left() != 0)
    throw Error("its values do not fit its description");
  return {std::move(head), std::move(layout), {values.begin(), values.end()}};
}

namespace {

/// The values at their places; zero elsewhere.
std::vector<std::byte> spread(const RetainImage &image) {
  // A few bytes more, so that nothing that is read as a whole word lies outside.
  std::vector<std::byte> state(image.layout.description().stateSize + 8);
  const std::byte *from = image.values.data();
  for (const RetainRange &range : image.layout.ranges()) {
    std::memcpy(state.data() + range.offset, from, range.size);
    from += range.size;
  }
  return state;
}

/// Native blocks of the image whose fields the build has changed: their code relies on all of them
/// at once, so that nothing of them is taken over.
std::function<bool(const TypeDesc &)> changedNative(const StrideAppV1 &app) {
  std::map<std::string, uint64_t> native;
  for (uint32_t i = 0; i < app.typeCount; ++i)
    if ((app.types[i].flags & kTypeExternal) != 0)
      native.emplace(common::lowerCase(app.types[i].name), app.types[i].layoutHash);
  return [native = std::move(native)](const TypeDesc &type) {
    if ((type.flags & kTypeExternal) == 0)
      return false;
    const auto found = native.find(common::lowerCase(type.name));
    return found != native.end() && found->second != type.layoutHash;
  };
}

/// Without the name of the structure that holds what lies in the process image.
std::string shown(const std::string &path) {
  return path.starts_with("%.") ? path.substr(2) : path;
}

/// The names of what lies in the process image.
std::set<std::string> located(const StrideAppV1 &layout) {
  std::set<std::string> out;
  for (uint32_t i = 0; i < layout.rootCount; ++i) {
    const TypeDesc &type = layout.types[layout.roots[i].type];
    for (uint32_t m = 0; std::string_view(layout.roots[i].name) == "%" && m < type.memberCount; ++m)
      out.insert(layout.members[type.firstMember + m].name);
  }
  return out;
}

/// `path` is `of` or inside of it.
bool isInside(std::string_view path, std::string_view of) {
  return path.starts_with(of) && (path.size() == of.size() || path[of.size()] == '.' ||
                                  path[of.size()] == '[' || path[of.size()] == ',');
}

/// `a[1..3,0..5].x` -> `a[1,0].x`
std::string firstElement(const std::string &path) {
  std::string out;
  for (size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '.' && i + 1 < path.size() && path[i + 1] == '.')
      while (i < path.size() && path[i] != ']' && path[i] != ',')
        ++i;
    out += path[i];
  }
  return out;
}

/// `A[1..3,0..5].x` -> `a[].x`: the same of all builds, whatever the bounds of their arrays.
std::string withoutIndices(const std::string &path) {
  std::string out;
  bool inside = false;
  for (const char c : common::lowerCase(path)) {
    inside = inside && c != ']';
    if (!inside)
      out += c;
    inside = inside || c == '[';
  }
  return out;
}

bool exists(const SymbolTable &symbols, const std::string &path) {
  try {
    static_cast<void>(symbols.resolve(firstElement(path)));
    return true;
  } catch (const Error &) {
    return false;
  }
}

} // namespace

RetainImage withoutRetains(const RetainImage &image, uint32_t keep) {
  const std::vector<std::byte> state = spread(image);
  RetainLayout layout(image.layout.description(), keep);
  std::vector<std::byte> values(layout.bytes());
  copyRetained(state.data(), layout.ranges(), values.data());
  return {image.head, std::move(layout), std::move(values)};
}

RetainRestore::RetainRestore(const StrideAppV1 &app, const RetainLayout &layout,
                             const RetainImage &image)
    : app_(&app), image_(&image), sameBuild_(image.head.buildHash == app.buildHash),
      keepsRetains_(sameBuild_ && image.layout.sameAs(layout)),
      wanted_(app, sameBuild_ ? kRetained : uint32_t{kSymPersistent}),
      stored_(image.layout.description(), kRetained, changedNative(app)),
      plan_(std::make_unique<CarryOver>(stored_.description(), wanted_.description(),
                                        MatchOptions{0, false, false})) {}

RetainReport RetainRestore::apply(std::byte *state) const {
  const std::vector<std::byte> before = spread(*image_);
  CarryResult result;
  plan_->apply(before.data(), state, result);
  RetainReport report;
  report.kept = plan_->report().keptValues() - result.outOfRange();
  explain(report);
  for (const std::string &line : plan_->describe(result, before.data()))
    report.lost.push_back(shown(line));
  return report;
}

/// Why variables of the file are not restored.
class RetainRestore::Losses {
public:
  Losses(const RetainRestore &restore, RetainReport &report)
      : report_(&report), symbols_(*restore.app_), before_(restore.image_->layout.description()),
        variables_(restore.image_->layout.variables()),
        located_(located(restore.image_->layout.description())),
        retained_(RetainLayout(*restore.app_, kRetained).variables()) {
    for (std::string &path : retained_)
      path = withoutIndices(path);
    for (const Finding &finding : restore.plan_->report().findings())
      if (finding.kind == Finding::Kind::Renamed)
        renamed_.insert(finding.oldPath);
  }

  void explain(const Finding &finding) const {
    const std::string path = shown(finding.path);
    switch (finding.kind) {
    case Finding::Kind::Dropped:
      dropped(finding.path, path);
      break;
    case Finding::Kind::Lost:
      lose(path, fmt::format("it was {} and is {}", finding.oldType, finding.newType));
      break;
    case Finding::Kind::ElementsLost:
      lose(path, fmt::format("only {}", finding.detail));
      break;
    case Finding::Kind::UnionChanged:
      lose(path, "only the bytes of the fields that did not change are");
      break;
    case Finding::Kind::Renamed:
      report_->notes.push_back(fmt::format("{} {}", path, finding.detail));
      break;
    case Finding::Kind::Converted:
      report_->notes.push_back(
          fmt::format("{} was {} and is {}: converted", path, finding.oldType, finding.newType));
      break;
    case Finding::Kind::Added:
      // It was there, but is not compared (see changedNative), unless it has another name now.
      if (!renamed_.contains(finding.path) && exists(before_, finding.path))
        lose(path, fmt::format("{} has a native body and other fields now", finding.newType));
      break;
    default: // texts and enumerators are reported when they were really cut or lost
      break;
    }
  }

private:
  void lose(const std::string &path, const std::string &why) const {
    report_->lost.push_back(fmt::format("{} is not restored: {}", path, why));
  }

  void loseVariable(const std::string &path) const {
    if (!exists(symbols_, path))
      return lose(path, "the program does not have it any more");
    if (std::any_of(retained_.begin(), retained_.end(),
                    [&](const std::string &own) { return isInside(withoutIndices(path), own); }))
      return lose(path, "this is another build of the program, and only PERSISTENT variables "
                        "survive that, not RETAIN");
    lose(path, "it is neither RETAIN nor PERSISTENT any more");
  }

  /// All variables of the file that lie where the finding says; `path` is how it is shown.
  void dropped(const std::string &found, const std::string &path) const {
    bool named = false;
    for (const std::string &variable : variables_) {
      // What lies in the process image is a variable of its own, wherever it is declared.
      const bool inImage = located_.contains(variable);
      if (found == "%" ? !inImage
          : inImage    ? variable != path || found == path
                       : !isInside(variable, path))
        continue;
      loseVariable(variable);
      named = true;
    }
    if (!named)
      loseVariable(path);
  }

  RetainReport *report_;
  SymbolTable symbols_; ///< of the program
  SymbolTable before_;  ///< of the program that has written the file
  std::vector<std::string> variables_;
  std::set<std::string> located_;
  std::vector<std::string> retained_; ///< Of the program, withoutIndices().
  std::set<std::string> renamed_;     ///< Their names in the file.
};

void RetainRestore::explain(RetainReport &report) const {
  const Losses losses(*this, report);
  for (const Finding &finding : plan_->report().findings())
    losses.explain(finding);
}

} // namespace stride::app

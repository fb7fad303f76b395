// Outputs that lie over each other by mistake: written in one task, of which the later one wins.

#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/sharing/graph.hpp"

namespace stc {

namespace {

/// Such a place can be one of many of its size that lie side by side, without a gap.
bool isAligned(const WrittenOutput &place) {
  const uint64_t bytes = place.bytes;
  return bytes > 8 || (bytes & (bytes - 1)) != 0 || place.at.byte % bytes == 0;
}

bool contains(const WrittenOutput &outer, const WrittenOutput &inner) {
  return outer.at.bit < 0 && outer.at.byte <= inner.at.byte &&
         inner.at.byte + inner.bytes <= outer.at.byte + outer.bytes;
}

/// A word and its bytes and bits, as programs name them on purpose.
bool isView(const WrittenOutput &outer, const WrittenOutput &inner) {
  return !outer.isNumber && contains(outer, inner) && isAligned(outer) && isAligned(inner);
}

bool overlaps(const WrittenOutput &a, const WrittenOutput &b) {
  const bool areBits = a.at.bit >= 0 && b.at.bit >= 0;
  const bool areSame = a.at.byte == b.at.byte && a.bytes == b.bytes && a.at.bit == b.at.bit;
  return !areBits && !areSame && a.at.byte < b.at.byte + b.bytes && b.at.byte < a.at.byte + a.bytes;
}

std::string bytesText(const WrittenOutput &place) {
  const std::string first = std::to_string(place.at.byte);
  return place.bytes == 1
             ? "byte " + first
             : "bytes " + first + " to " + std::to_string(place.at.byte + place.bytes - 1);
}

} // namespace

bool WrittenOutput::operator<(const WrittenOutput &other) const {
  return std::tuple(at.byte, at.bit, bytes, isNumber) <
         std::tuple(other.at.byte, other.at.bit, other.bytes, other.isNumber);
}

void SharingGraph::noteOutput(uint32_t task, const Location &at, const ImageAccess &access) {
  if (at.area == Area::Output)
    outputs_[task].try_emplace({at, access.bytes, access.isNumber}, access.span);
}

void SharingGraph::reportOverlaps() const {
  const auto clash = [](const WrittenOutput &a, const WrittenOutput &b) {
    return overlaps(a, b) && !isView(a, b) && !isView(b, a);
  };
  for (const auto &written : outputs_)
    for (auto one = written.begin(); one != written.end(); ++one) {
      const uint64_t end = one->first.at.byte + one->first.bytes;
      auto other = std::next(one);
      while (other != written.end() && other->first.at.byte < end &&
             !clash(one->first, other->first))
        ++other;
      if (other != written.end() && other->first.at.byte < end)
        reportOverlap(*one, *other); // once: a number may have many bits
    }
}

void SharingGraph::reportOverlap(const std::pair<const WrittenOutput, Span> &one,
                                 const std::pair<const WrittenOutput, Span> &other) const {
  const bool inOrder = std::pair(one.second.file, one.second.begin) <
                       std::pair(other.second.file, other.second.begin);
  const auto &[first, firstSpan] = inOrder ? one : other;
  const auto &[second, secondSpan] = inOrder ? other : one;
  const auto text = [&](const WrittenOutput &place) {
    return "`" + addressText(place.at, place.bytes, program_.settings.addressing) + "`";
  };
  program_.diagnostics
      .report(Code::OutputsOverlap, secondSpan,
              "the outputs " + text(second) + " and " + text(first) +
                  " overlap, and both are written",
              "writes " + bytesText(second))
      .label(firstSpan, "writes " + bytesText(first))
      .note(program_.settings.addressing == Addressing::Bytes
                ? "the numbers of addresses count bytes here, also those of words: `%QW2` follows "
                  "`%QW0`; `addressing` of [image] in stride.toml says so"
                : "what is written later wins")
      .help("let them lie one behind the other");
}

} // namespace stc

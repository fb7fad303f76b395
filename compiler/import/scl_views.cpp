#include "compiler/import/scl_views.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/texts.hpp"
#include "compiler/source/identifier.hpp"
#include "compiler/source/st_scan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace stc::import {

namespace scl_views {
namespace {

struct Size {
  std::string_view type; ///< lower case
  unsigned bits;
};

/// Types that a view may be of.
constexpr std::array<Size, 18> kViewed = {{{"byte", 8},
                                           {"sint", 8},
                                           {"usint", 8},
                                           {"char", 8},
                                           {"word", 16},
                                           {"int", 16},
                                           {"uint", 16},
                                           {"date", 16},
                                           {"dword", 32},
                                           {"dint", 32},
                                           {"udint", 32},
                                           {"real", 32},
                                           {"time", 32},
                                           {"lword", 64},
                                           {"lint", 64},
                                           {"ulint", 64},
                                           {"lreal", 64},
                                           {"ltime", 64}}};
/// Types of parts: those of which a bit string has some.
constexpr std::array<Size, 3> kParts = {{{"bool", 1}, {"byte", 8}, {"word", 16}}};

constexpr unsigned kMostBits = 64;

unsigned bitsOf(std::span<const Size> sizes, std::string_view type) {
  const std::string lower = lowerCase(type);
  const auto found = std::ranges::find(sizes, lower, &Size::type);
  return found == sizes.end() ? 0 : found->bits;
}

/// Lays out parts one after the other.
class Layout {
public:
  explicit Layout(unsigned bytes) : bytes_(bytes) {}

  /// False: it does not fit any more.
  bool add(std::string name, unsigned bits) {
    if (bits != 1)
      next_ = (next_ + bits - 1) / bits * bits; // BYTEs at whole bytes, WORDs at even ones
    if (next_ + bits > bytes_ * 8)
      return false;
    const unsigned byte = next_ / 8;
    std::string part = bits == 1   ? fmt::format("{}", (bytes_ - 1 - byte) * 8 + next_ % 8)
                       : bits == 8 ? fmt::format("%B{}", bytes_ - 1 - byte)
                                   : fmt::format("%W{}", (bytes_ - 2 - byte) / 2);
    next_ += bits;
    return parts.emplace(std::move(name), std::move(part)).second;
  }

  std::map<std::string, std::string, std::less<>> parts;

private:
  unsigned bytes_;
  unsigned next_ = 0; ///< bit from the beginning of the variable
};

std::optional<long> numberOf(std::string_view text) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// `Array[0..15] of Bool`
bool addElements(std::string_view as, Layout &layout) {
  const size_t open = as.find('[');
  const size_t dots = as.find("..");
  const size_t close = as.find(']');
  if (open == std::string_view::npos || dots == std::string_view::npos || dots < open ||
      close == std::string_view::npos || close < dots ||
      !equalIgnoringCase(trimmed(as.substr(0, open)), "array"))
    return false;
  const auto low = numberOf(trimmed(as.substr(open + 1, dots - open - 1)));
  const auto high = numberOf(trimmed(as.substr(dots + 2, close - dots - 2)));
  const std::string_view rest = trimmed(as.substr(close + 1));
  const size_t blank = rest.find_first_of(" \t\r\n");
  if (!low || !high || *low < 0 || *high < *low || blank == std::string_view::npos ||
      !equalIgnoringCase(rest.substr(0, blank), "of"))
    return false;
  const unsigned bits = bitsOf(kParts, trimmed(rest.substr(blank)));
  if (bits == 0 || *high - *low >= static_cast<long>(kMostBits))
    return false;
  for (long i = *low; i <= *high; ++i)
    if (!layout.add(std::to_string(i), bits))
      return false;
  return true;
}

/// `TYPE F_b : STRUCT a, b : BOOL; c : BYTE; END_STRUCT END_TYPE`
bool addMembers(std::string_view structure, Layout &layout) {
  const std::vector<StWord> words = wordsOf(structure);
  const auto at = [&](size_t i) {
    return i < words.size() ? structure.substr(words[i].begin, words[i].end - words[i].begin)
                            : std::string_view();
  };
  size_t i = 0;
  while (i < words.size() && !equalIgnoringCase(at(i), "struct"))
    ++i;
  for (++i; i < words.size() && !equalIgnoringCase(at(i), "end_struct");) {
    std::vector<std::string> names = {lowerCase(at(i++))};
    for (; at(i) == ","; i += 2)
      names.push_back(lowerCase(at(i + 1)));
    const unsigned bits = bitsOf(kParts, at(i + 1));
    if (at(i) != ":" || bits == 0 || at(i + 2) != ";")
      return false;
    i += 3;
    for (std::string &name : names)
      if (!layout.add(std::move(name), bits))
        return false;
  }
  return i + 2 == words.size() || i + 3 == words.size(); // END_TYPE, perhaps `;`
}

std::string_view bitString(unsigned bits) {
  return bits == 8 ? "BYTE" : bits == 16 ? "WORD" : bits == 32 ? "DWORD" : "LWORD";
}

} // namespace
} // namespace scl_views

std::optional<SclViewParts> sclViewParts(std::string_view as, std::string_view structure,
                                         std::string_view of) {
  const unsigned bits = scl_views::bitsOf(scl_views::kViewed, trimmed(of));
  if (bits == 0)
    return std::nullopt;
  scl_views::Layout layout(bits / 8);
  const bool good = structure.empty() ? scl_views::addElements(trimmed(as), layout)
                                      : scl_views::addMembers(structure, layout);
  if (!good || layout.parts.empty())
    return std::nullopt;
  return SclViewParts{scl_views::bitString(bits), std::move(layout.parts)};
}

const std::string *sclViewPartAt(const SclViewParts &view, std::span<const SclToken> tokens,
                                 size_t at, size_t &end) {
  std::array<size_t, 3> next{}; // `[`, `5`, `]`
  for (size_t &each : next) {
    do
      ++at;
    while (at < tokens.size() &&
           (tokens[at].kind == SclKind::Blank || tokens[at].kind == SclKind::Comment));
    each = at;
  }
  if (next[1] >= tokens.size())
    return nullptr;
  std::string key;
  if (tokens[next[0]].text == "[" && next[2] < tokens.size() && tokens[next[2]].text == "]") {
    if (const auto number = scl_views::numberOf(tokens[next[1]].text))
      key = std::to_string(*number);
    end = next[2] + 1;
  } else if (tokens[next[0]].text == ".") {
    key = lowerCase(asIdentifier(sclName(tokens[next[1]])));
    end = next[1] + 1;
  }
  const auto found = view.parts.find(key);
  return found == view.parts.end() ? nullptr : &found->second;
}

} // namespace stc::import

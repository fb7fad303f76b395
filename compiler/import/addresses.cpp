#include "compiler/import/addresses.hpp"

#include "compiler/import/st_words.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// `%IW0.4.2`, taken apart.
struct Address {
  char area = 'i';  ///< i, q, m
  char size = 'x';  ///< x, b, w, d, l, r
  std::string path; ///< `0.4.2`
  size_t numbers = 0;
};

/// A place in the image of inputs or outputs.
struct Place {
  size_t bit = 0;  ///< from the image's beginning
  size_t bits = 1; ///< how many it has
};

/// By area and path: `i0.4.2`.
using Places = std::map<std::string, Place>;

std::optional<Address> addressOf(std::string_view text) {
  Address address;
  if (text.size() < 3 || text[0] != '%')
    return std::nullopt;
  address.area = lowerCase(text[1]);
  size_t at = 2;
  if (text[at] < '0' || text[at] > '9')
    address.size = lowerCase(text[at++]);
  address.path = text.substr(at);
  if (std::string_view("iqm").find(address.area) == std::string_view::npos ||
      std::string_view("xbwdlr").find(address.size) == std::string_view::npos ||
      address.path.empty() || address.path.find_first_not_of("0123456789.") != std::string::npos ||
      address.path.size() > 40)
    return std::nullopt;
  address.numbers =
      1 + static_cast<size_t>(std::count(address.path.begin(), address.path.end(), '.'));
  return address;
}

size_t bitsOf(char size) {
  switch (size) {
  case 'b':
    return 8;
  case 'w':
    return 16;
  case 'd':
  case 'r':
    return 32;
  case 'l':
    return 64;
  default:
    return 1;
  }
}

/// Whether it can only name a module: plain addresses have one number, those of bits two.
bool isHierarchical(const Address &address) {
  return address.size == 'r' || address.numbers > (address.size == 'x' ? 2U : 1U);
}

std::string parentOf(const std::string &path) {
  const size_t dot = path.rfind('.');
  return dot == std::string::npos ? std::string() : path.substr(0, dot);
}

std::string plainAddress(char area, char size, size_t bit, const std::string &addressing) {
  const char upper = static_cast<char>(area - 'a' + 'A');
  const size_t byte = bit / 8;
  if (size == 'x')
    return addressing == "words" ? fmt::format("%{}X{}.{}", upper, byte / 2, bit % 16)
                                 : fmt::format("%{}X{}.{}", upper, byte, bit % 8);
  const char letter = size == 'r' ? 'D' : static_cast<char>(size - 'a' + 'A');
  const size_t unit = addressing == "bytes" ? 1 : bitsOf(size) / 8;
  return fmt::format("%{}{}{}", upper, letter, byte / unit);
}

/// Gives channels their places in turn.
class Layout {
public:
  void add(const Address &address) {
    if (address.area == 'm')
      return;
    const std::string key = address.area + address.path;
    size_t &next = next_[address.area == 'q' ? 1 : 0];
    std::string &module = bitModule_[address.area == 'q' ? 1 : 0];
    const size_t bits = bitsOf(address.size);
    const std::string parent = parentOf(address.path);
    // Bits of one module share bytes.
    if (bits > 1 || parent != module)
      next = (next + std::max<size_t>(bits, 8) - 1) / std::max<size_t>(bits, 8) *
             std::max<size_t>(bits, 8);
    module = bits == 1 ? parent : std::string(1, '-');
    if (places_.try_emplace(key, Place{next, bits}).second)
      next += bits;
  }

  [[nodiscard]] const Places &places() const { return places_; }

private:
  Places places_;
  std::array<size_t, 2> next_{};
  std::array<std::string, 2> bitModule_{"-", "-"};
};

/// Where an address of a source lies: that of a channel, or a bit of one.
std::optional<size_t> bitOf(const Address &address, const Places &places) {
  if (const auto place = places.find(address.area + address.path); place != places.end())
    return place->second.bit;
  const size_t dot = address.path.rfind('.');
  if (address.size != 'x' || dot == std::string::npos || address.path.size() - dot > 3)
    return std::nullopt;
  const auto channel = places.find(address.area + address.path.substr(0, dot));
  const std::string digits = address.path.substr(dot + 1);
  if (channel == places.end() || digits.empty())
    return std::nullopt;
  const size_t bit = std::stoul(digits);
  return bit < channel->second.bits ? std::optional(channel->second.bit + bit) : std::nullopt;
}

/// Rewrites one address after the other, and remembers what became of it.
class Mover {
public:
  Mover(Model &model, Places places) : model_(model), places_(std::move(places)) {}

  /// The new address; empty: it stays.
  std::string move(std::string_view text, const Origin &origin) {
    const std::optional<Address> address = addressOf(text);
    if (!address || address->area == 'm')
      return {};
    const std::optional<size_t> bit = bitOf(*address, places_);
    if (!bit) {
      if (missing_.insert(std::string(text)).second)
        model_.leftOut.push_back(
            {origin, std::string(text), "the PLC configuration has no channel at this address"});
      return {};
    }
    std::string result = plainAddress(address->area, address->size, *bit, model_.addressing);
    if (moved_.emplace(std::string(text), result).second)
      model_.addresses.push_back({std::string(text), result});
    return result;
  }

private:
  Model &model_;
  Places places_;
  std::set<std::string> missing_;
  std::map<std::string, std::string> moved_;
};

/// Hierarchical addresses without the hardware that they belong to.
void reportUnknown(Model &model) {
  std::set<std::string> seen;
  for (const Object &object : model.objects) {
    for (const StWord &word : wordsOf(object.text)) {
      const std::string text = object.text.substr(word.begin, word.end - word.begin);
      const std::optional<Address> address =
          word.kind == StWord::Kind::Address ? addressOf(text) : std::nullopt;
      if (address && address->area != 'm' && isHierarchical(*address) && seen.insert(text).second)
        model.leftOut.push_back(
            {object.origin, text,
             "it names a module of the target's hardware; import the export of the PLC "
             "configuration, too"});
    }
  }
}

} // namespace

void settleAddressing(Model &model, const std::string &wanted) {
  bool any = !model.channels.empty();
  bool ambiguous = false;
  for (const Object &object : model.objects)
    for (const StWord &word : wordsOf(object.text))
      if (word.kind == StWord::Kind::Address) {
        any = true;
        const std::optional<Address> address =
            addressOf(std::string_view(object.text).substr(word.begin, word.end - word.begin));
        ambiguous = ambiguous || (address && address->size != 'b' && !isHierarchical(*address));
      }
  if (!wanted.empty())
    model.addressing = wanted;
  else if (any && ambiguous && !model.addressing.empty())
    model.notes.push_back(fmt::format(
        "Numbers in addresses count {} here, as CoDeSys V2.3 does when the target settings do not "
        "say byte addressing. If they do: --addressing bytes.",
        model.addressing));
  if (!any)
    model.addressing.clear();
}

void moveAddresses(Model &model) {
  const bool hierarchical =
      std::any_of(model.hardware.begin(), model.hardware.end(), [](const HardwareChannel &each) {
        const std::optional<Address> address = addressOf(each.address);
        return address && isHierarchical(*address);
      });
  if (!hierarchical)
    return reportUnknown(model);
  Layout layout;
  for (const HardwareChannel &each : model.hardware)
    if (const std::optional<Address> address = addressOf(each.address))
      layout.add(*address);
  Mover mover(model, layout.places());
  for (IoChannel &channel : model.channels)
    if (std::string moved = mover.move(channel.address, channel.origin); !moved.empty())
      channel.address = std::move(moved);
  for (Object &object : model.objects)
    object.text = replaceWords(object.text, [&](const StWord &word, std::string_view text) {
      return word.kind == StWord::Kind::Address ? mover.move(text, object.origin) : std::string();
    });
}

} // namespace stc::import

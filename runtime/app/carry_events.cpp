// What only the values of a carry-over showed.
#include "runtime/app/carry_over.hpp"

#include <fmt/format.h>

#include <bit>

namespace stride::app {

namespace {

uint64_t addressIn(const std::byte *place) { return std::bit_cast<uint64_t>(place); }

} // namespace

void CarryResult::add(const CarryEvent &event) noexcept {
  switch (event.kind) {
  case CarryEvent::Kind::Nulled:
    ++nulled_;
    break;
  case CarryEvent::Kind::TextCut:
    ++textsCut_;
    break;
  case CarryEvent::Kind::EnumeratorGone:
    ++enumeratorsGone_;
    break;
  case CarryEvent::Kind::OutOfRange:
    ++outOfRange_;
    break;
  }
  if (used_ < events_.size())
    events_[used_++] = event;
}

std::vector<std::string> CarryOver::describe(const CarryResult &result,
                                             const std::byte *oldState) const {
  std::vector<std::string> lines;
  for (const CarryEvent &event : result.events()) {
    std::string name = newIndex_.pathOf(event.newOffset, event.newType);
    if (name.empty())
      name = "an object of __NEW";
    switch (event.kind) {
    case CarryEvent::Kind::TextCut:
      lines.push_back(fmt::format("{}: its text was cut to {} characters", name,
                                  match_.newApp().types[event.newType].stringLength));
      continue;
    case CarryEvent::Kind::EnumeratorGone:
      lines.push_back(fmt::format("{}: the new {} does not have its value; it starts anew", name,
                                  match_.newApp().types[event.newType].name));
      continue;
    case CarryEvent::Kind::OutOfRange:
      lines.push_back(fmt::format("{}: {} is out of range for {}; it starts anew", name,
                                  static_cast<int64_t>(event.address),
                                  match_.newApp().types[event.newType].name));
      continue;
    case CarryEvent::Kind::Nulled:
      break;
    }
    const uint64_t offset = event.address - addressIn(oldState);
    std::string target;
    if (pool_.contains(offset))
      target = "an object of __NEW";
    else if (offset <= match_.oldApp().stateSize)
      target = oldIndex_.path(
          oldIndex_.target(offset, addresses_.slot(event.oldType, event.newType).oldPointee));
    if (target.empty()) {
      lines.push_back(fmt::format("{} is now 0: it pointed to {:#x}, where no variable lies", name,
                                  event.address));
      continue;
    }
    const char *why = event.status == AddressMap::Status::OtherType ? "has another type now"
                                                                    : "the new build does not have";
    if (pool_.contains(offset))
      why = "has another type now";
    constexpr std::string_view kTypeId = ".type__"; // what interface variables point to
    if (target.ends_with(kTypeId)) {
      target.resize(target.size() - kTypeId.size());
      why = "has no methods in the new build, or is not in it";
    }
    lines.push_back(fmt::format("{} is now 0: it pointed to {}, which {}", name, target, why));
  }
  if (result.total() > result.events().size())
    lines.push_back(fmt::format("and {} more", result.total() - result.events().size()));
  return lines;
}

} // namespace stride::app

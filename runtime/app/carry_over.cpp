#include "runtime/app/carry_over.hpp"

#include "runtime/app/carry_values.hpp"
#include "runtime/app/image_moves.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace stride::app {

namespace {

/// The number of a BIT in its byte.
unsigned bitOf(uint32_t flags) {
  return (flags & (kSymBit | kSymLocated | kSymSlot)) == kSymBit ? flags >> kSymBitShift & 7U
                                                                 : kNoBit;
}

/// Longer programs are called, shorter ones are written out in place.
constexpr size_t kInlineSteps = 16;

uint64_t addressOf(const std::byte *place) { return std::bit_cast<uint64_t>(place); }

} // namespace

CarryOver::CarryOver(const StrideAppV1 &oldApp, const StrideAppV1 &newApp, MatchOptions options,
                     std::vector<SharedMemory> shared)
    : match_(oldApp, newApp, options), pool_(match_), oldIndex_(oldApp), newIndex_(newApp),
      addresses_(match_, oldIndex_, newIndex_), shared_(std::move(shared)), report_(match_) {
  const size_t pairs = match_.pairs().size();
  numbers_.resize(pairs);
  targets_.resize(pairs);
  for (uint32_t i = 0; i < pairs; ++i) {
    const TypePair &pair = match_.pair(i);
    const TypeDesc &from = oldApp.types[pair.oldType];
    const TypeDesc &to = newApp.types[pair.newType];
    if (pair.carry == Carry::Number)
      numbers_[i] = numberConversion(
          from.kind == Kind::Enum ? oldApp.types[from.element].kind : from.kind, to.kind);
    else if (pair.carry == Carry::Slot)
      targets_[i] = addresses_.slot(pair.oldType, pair.newType);
  }
  copyPrograms_.resize(pairs);
  slotPrograms_.resize(pairs * 2);
  copyKnown_.resize(pairs);
  slotKnown_.resize(pairs * 2);
  Steps copies;
  Steps slots;
  const RootDesc *const poolOfNew = pool_.present() ? poolRoot(newApp) : nullptr;
  auto added = match_.addedRoots().begin();
  for (const FieldPair &root : match_.roots()) {
    for (; added != match_.addedRoots().end() && added->offset < root.newOffset; ++added)
      copies.barrier = true;
    if (root.hold != Hold::No || newApp.roots + root.newMember == poolOfNew) {
      copies.barrier = true;
      continue;
    }
    copySteps(root.pair, {root.oldOffset, root.newOffset}, copies);
    slotSteps(root.pair, {root.oldOffset, root.newOffset}, false, slots);
  }
  for (const ImageMove &move : imageMoves(oldApp, newApp)) // after the image as a whole
    if (move.sameType)
      copies.list.push_back({move.isBit ? Step::Kind::Bit : Step::Kind::Copy, false, kNoIndex,
                             move.oldOffset, move.newOffset, move.count, 0, 0});
  poolSlots_.resize(pairs);
  for (const PoolType &type : match_.poolTypes()) {
    const uint32_t program = store(slotProgram(type.pair, false));
    poolSlots_[type.pair] = programs_[program];
  }
  copies_ = programs_[store(copies)];
  slots_ = programs_[store(slots)];
  copyPrograms_ = {};
  slotPrograms_ = {};
}

uint64_t CarryOver::oldSize(uint32_t pair) const {
  return match_.oldApp().types[match_.pair(pair).oldType].size;
}

uint64_t CarryOver::newSize(uint32_t pair) const {
  return match_.newApp().types[match_.pair(pair).newType].size;
}

CarryOver::Place CarryOver::elementPlace(const TypePair &array, Place at) const {
  return {at.oldOffset + array.oldFirst * oldSize(array.element),
          at.newOffset + array.newFirst * newSize(array.element)};
}

/// Bytes at `at`; one copy with those before when only padding lies between.
void CarryOver::appendCopy(Place at, uint64_t bytes, uint64_t align, Steps &out) const {
  if (!out.list.empty() && out.list.back().kind == Step::Kind::Copy) {
    Step &last = out.list.back();
    const uint64_t oldEnd = last.oldOffset + last.count;
    const uint64_t newEnd = last.newOffset + last.count;
    if (at.oldOffset >= oldEnd && at.newOffset >= newEnd) {
      const uint64_t gap = at.newOffset - newEnd;
      if (at.oldOffset - oldEnd == gap &&
          (gap == 0 || (gap < align && !out.barrier && match_.options().padding))) {
        last.count += gap + bytes;
        out.barrier = false;
        return;
      }
    }
  }
  out.list.push_back({Step::Kind::Copy, false, kNoIndex, at.oldOffset, at.newOffset, bytes, 0, 0});
  out.barrier = false;
}

uint32_t CarryOver::store(const Steps &program) {
  programs_.push_back(
      {static_cast<uint32_t>(steps_.size()), static_cast<uint32_t>(program.list.size())});
  steps_.insert(steps_.end(), program.list.begin(), program.list.end());
  return static_cast<uint32_t>(programs_.size() - 1);
}

void CarryOver::append(const Steps &program, Place at, Steps &out) {
  for (Step step : program.list) {
    step.oldOffset += at.oldOffset;
    step.newOffset += at.newOffset;
    out.list.push_back(step);
  }
  out.barrier = true;
}

void CarryOver::repeat(const Steps &program, Place at, const TypePair &array, Steps &out) {
  if (program.list.size() == 1 && program.list[0].count == 1 &&
      program.list[0].kind != Step::Kind::Copy && program.list[0].kind != Step::Kind::Repeat) {
    Step step = program.list[0]; // one value: the step itself goes over the elements
    const Place first = elementPlace(array, at);
    step.oldOffset += first.oldOffset;
    step.newOffset += first.newOffset;
    step.count = array.count;
    step.oldStride = oldSize(array.element);
    step.newStride = newSize(array.element);
    out.list.push_back(step);
    return;
  }
  out.barrier = true;
  if (program.list.empty())
    return;
  const Place first = elementPlace(array, at);
  if (array.count == 1)
    return append(program, first, out);
  out.list.push_back({Step::Kind::Repeat, false, store(program), first.oldOffset, first.newOffset,
                      array.count, oldSize(array.element), newSize(array.element)});
}

const CarryOver::Steps &CarryOver::copyProgram(uint32_t pair) {
  if (!copyKnown_[pair]) {
    Steps steps;
    copySteps(pair, {0, 0}, steps);
    // Called where it is long: a program of its own, which is one step.
    if (steps.list.size() > kInlineSteps) {
      const uint32_t program = store(steps);
      steps.list = {{Step::Kind::Repeat, false, program, 0, 0, 1, 0, 0}};
    }
    copyPrograms_[pair] = std::move(steps);
    copyKnown_[pair] = true;
  }
  return copyPrograms_[pair];
}

const CarryOver::Steps &CarryOver::slotProgram(uint32_t pair, bool maybe) {
  const size_t key = size_t{pair} * 2 + (maybe ? 1 : 0);
  if (!slotKnown_[key]) {
    Steps steps;
    slotSteps(pair, {0, 0}, maybe, steps);
    if (steps.list.size() > kInlineSteps) {
      const uint32_t program = store(steps);
      steps.list = {{Step::Kind::Repeat, false, program, 0, 0, 1, 0, 0}};
    }
    slotPrograms_[key] = std::move(steps);
    slotKnown_[key] = true;
  }
  return slotPrograms_[key];
}

void CarryOver::copySteps(uint32_t index, Place at, Steps &out) {
  const TypePair &pair = match_.pair(index);
  const TypeDesc &to = match_.newApp().types[pair.newType];
  if (pair.bitwise)
    return appendCopy(at, to.size, to.align, out);
  const auto single = [&](Step::Kind kind) {
    out.list.push_back({kind, false, index, at.oldOffset, at.newOffset, 1, 0, 0});
  };
  switch (pair.carry) {
  case Carry::Bytes:
    if (pair.ranged)
      return single(Step::Kind::Range);
    return appendCopy(at, to.size, to.align, out);
  case Carry::Slot:
    return appendCopy(at, to.size, to.align, out);
  case Carry::Union:
    appendCopy(at, pair.bytes, to.align, out);
    out.barrier = true; // other fields may be longer
    return;
  case Carry::Number:
    return single(pair.ranged ? Step::Kind::Range : Step::Kind::Number);
  case Carry::Text:
    return single(Step::Kind::Text);
  case Carry::Names:
    return single(Step::Kind::Names);
  case Carry::Initial:
    out.barrier = true;
    return;
  case Carry::Elements: {
    const TypePair &element = match_.pair(pair.element);
    if (element.bitwise && oldSize(pair.element) == newSize(pair.element)) {
      out.barrier = true; // elements that are not common lie before and after
      appendCopy(elementPlace(pair, at), pair.count * newSize(pair.element), to.align, out);
      out.barrier = true;
      return;
    }
    return repeat(copyProgram(pair.element), at, pair, out);
  }
  case Carry::Fields:
    return fieldSteps(pair, at, out);
  }
}

void CarryOver::fieldSteps(const TypePair &pair, Place at, Steps &out) {
  std::vector<uint64_t> added;
  for (const LoneField &field : pair.added)
    added.push_back(field.offset);
  std::sort(added.begin(), added.end());
  auto next = added.begin();
  for (const FieldPair &field : pair.fields) {
    for (; next != added.end() && *next < field.newOffset; ++next)
      out.barrier = true;
    if (field.hold != Hold::No) {
      out.barrier = true;
      continue;
    }
    const Place place{at.oldOffset + field.oldOffset, at.newOffset + field.newOffset};
    const TypePair &own = match_.pair(field.pair);
    const unsigned oldBit = bitOf(match_.oldApp().members[field.oldMember].flags);
    const unsigned newBit = bitOf(match_.newApp().members[field.newMember].flags);
    if (oldBit < kNoBit || newBit < kNoBit) {
      if (own.carry == Carry::Bytes)
        out.list.push_back({Step::Kind::Bit, false, kNoIndex, place.oldOffset, place.newOffset,
                            oldBit + 16 * newBit, 0, 0});
      out.barrier = true;
      continue;
    }
    if (!own.bitwise && own.carry == Carry::Fields)
      append(copyProgram(field.pair), place, out);
    else
      copySteps(field.pair, place, out);
  }
  out.barrier = true;
}

/// The address slots below, after their bytes have been copied.
void CarryOver::slotSteps(uint32_t index, Place at, bool maybe, Steps &out) {
  const TypePair &pair = match_.pair(index);
  if (!pair.hasSlots)
    return;
  switch (pair.carry) {
  case Carry::Slot:
    out.list.push_back({Step::Kind::Slot, maybe, index, at.oldOffset, at.newOffset, 1, 0, 0});
    return;
  case Carry::Elements:
    return repeat(slotProgram(pair.element, maybe), at, pair, out);
  case Carry::Fields:
  case Carry::Union:
    for (const FieldPair &field : pair.fields) {
      const bool isUnion = pair.carry == Carry::Union;
      if (field.hold != Hold::No || !match_.pair(field.pair).hasSlots ||
          (isUnion && (!match_.pair(field.pair).bitwise || field.oldOffset != field.newOffset)))
        continue;
      append(slotProgram(field.pair, maybe || isUnion),
             {at.oldOffset + field.oldOffset, at.newOffset + field.newOffset}, out);
    }
    return;
  case Carry::Bytes:
  case Carry::Number:
  case Carry::Text:
  case Carry::Names:
  case Carry::Initial:
    return;
  }
}

/// One application of the plan.
struct CarryOver::Run {
  const CarryOver &plan;
  const std::byte *oldState;
  std::byte *newState;
  CarryResult &result;

  void run(Program program, const std::byte *from, std::byte *to) const noexcept {
    const Step *step = plan.steps_.data() + program.first;
    for (const Step *const end = step + program.count; step != end; ++step)
      one(*step, from + step->oldOffset, to + step->newOffset);
  }

  void one(const Step &step, const std::byte *from, std::byte *to) const noexcept {
    switch (step.kind) {
    case Step::Kind::Copy:
      std::memcpy(to, from, step.count);
      return;
    case Step::Kind::Bit:
      bit(static_cast<unsigned>(step.count), *from, *to);
      return;
    case Step::Kind::Number:
      plan.numbers_[step.pair](from, to, step.count, step.oldStride, step.newStride);
      return;
    case Step::Kind::Repeat:
      for (uint64_t i = 0; i < step.count; ++i)
        run(plan.programs_[step.pair], from + i * step.oldStride, to + i * step.newStride);
      return;
    case Step::Kind::Text:
      for (uint64_t i = 0; i < step.count; ++i)
        text(step, from + i * step.oldStride, to + i * step.newStride);
      return;
    case Step::Kind::Names:
      for (uint64_t i = 0; i < step.count; ++i)
        names(step, from + i * step.oldStride, to + i * step.newStride);
      return;
    case Step::Kind::Range:
      for (uint64_t i = 0; i < step.count; ++i)
        range(step, from + i * step.oldStride, to + i * step.newStride);
      return;
    case Step::Kind::Slot:
      for (uint64_t i = 0; i < step.count; ++i)
        slot(step, from + i * step.oldStride, to + i * step.newStride);
      return;
    }
  }

  static void bit(unsigned numbers, std::byte from, std::byte &to) noexcept {
    const unsigned oldBit = numbers % 16;
    const unsigned newBit = numbers / 16;
    const bool set = (oldBit < kNoBit ? from >> oldBit & std::byte{1} : from) != std::byte{0};
    const std::byte mask = newBit < kNoBit ? std::byte{1} << newBit : std::byte{1};
    to = newBit < kNoBit ? to & ~mask : std::byte{0};
    if (set)
      to |= mask;
  }

  void report(CarryEvent::Kind kind, const Step &step, const std::byte *to,
              AddressMap::Status status, uint64_t address) const noexcept {
    const TypePair &pair = plan.match_.pair(step.pair);
    result.add(
        {kind, status, pair.oldType, pair.newType, static_cast<uint64_t>(to - newState), address});
  }

  void text(const Step &step, const std::byte *from, std::byte *to) const noexcept {
    const TypePair &pair = plan.match_.pair(step.pair);
    const TypeDesc &a = plan.match_.oldApp().types[pair.oldType];
    const TypeDesc &b = plan.match_.newApp().types[pair.newType];
    if (!carryText(from, a.stringLength, to, b.stringLength, a.kind == Kind::WSTRING ? 2 : 1))
      report(CarryEvent::Kind::TextCut, step, to, AddressMap::Status::Kept, 0);
  }

  void names(const Step &step, const std::byte *from, std::byte *to) const noexcept {
    const TypePair &pair = plan.match_.pair(step.pair);
    const StrideAppV1 &oldApp = plan.match_.oldApp();
    const StrideAppV1 &newApp = plan.match_.newApp();
    const Kind a = oldApp.types[oldApp.types[pair.oldType].element].kind;
    const Kind b = newApp.types[newApp.types[pair.newType].element].kind;
    int64_t value = readInteger(a, from);
    const auto move =
        std::lower_bound(pair.moves.begin(), pair.moves.end(), value,
                         [](const EnumeratorMove &m, int64_t wanted) { return m.from < wanted; });
    if (move != pair.moves.end() && move->from == value) {
      if (move->gone)
        return report(CarryEvent::Kind::EnumeratorGone, step, to, AddressMap::Status::Gone, 0);
      value = move->to;
    } else if (!keepsEveryValue(a, b)) {
      return report(CarryEvent::Kind::EnumeratorGone, step, to, AddressMap::Status::OtherType, 0);
    }
    writeInteger(b, value, to);
  }

  void range(const Step &step, const std::byte *from, std::byte *to) const noexcept {
    const TypePair &pair = plan.match_.pair(step.pair);
    const TypeDesc &type = plan.match_.newApp().types[pair.newType];
    std::byte value[sizeof(int64_t)] = {};
    if (pair.carry == Carry::Number)
      plan.numbers_[step.pair](from, value, 1, 0, 0);
    else
      std::memcpy(value, from, type.size);
    const int64_t number = readInteger(type.kind, value);
    if (isInRange(type, number))
      std::memcpy(to, value, type.size);
    else
      report(CarryEvent::Kind::OutOfRange, step, to, AddressMap::Status::OtherType,
             static_cast<uint64_t>(number));
  }

  void slot(const Step &step, const std::byte *from, std::byte *to) const noexcept {
    uint64_t address = 0;
    std::memcpy(&address, from, sizeof address);
    if (address == 0)
      return;
    AddressMap::Status status = AddressMap::Status::Unknown;
    const uint64_t offset = address - addressOf(oldState); // wraps where it lies before
    if (offset <= plan.match_.oldApp().stateSize) {
      uint64_t target = 0;
      if (!plan.pool_.contains(offset))
        status = plan.addresses_.map(offset, plan.targets_[step.pair], target);
      else if (plan.pool_.map(offset, newState, target))
        status = plan.targets_[step.pair].sameName ? AddressMap::Status::Kept
                                                   : AddressMap::Status::OtherType;
      else
        status = AddressMap::Status::Gone;
      if (status == AddressMap::Status::Kept) {
        ++result.addressesKept;
        target += addressOf(newState);
        std::memcpy(to, &target, sizeof target);
        return;
      }
    } else if (std::any_of(plan.shared_.begin(), plan.shared_.end(),
                           [&](const SharedMemory &m) { return address - m.begin < m.size; })) {
      ++result.addressesKept;
      return;
    }
    if (step.maybe)
      return;
    report(CarryEvent::Kind::Nulled, step, to, status, address);
    address = 0;
    std::memcpy(to, &address, sizeof address);
  }
};

void CarryOver::apply(const std::byte *oldState, std::byte *newState,
                      CarryResult &result) const noexcept {
  const Run run{*this, oldState, newState, result};
  run.run(copies_, oldState, newState);
  result.objectsGivenUp += pool_.copy(oldState, newState);
  run.run(slots_, oldState, newState);
  pool_.eachElement(oldState, newState, [&](uint32_t pair, const std::byte *from, std::byte *to) {
    run.run(poolSlots_[pair], from, to);
  });
}

CarryOver::Taken CarryOver::takeOver(const Ctx &now, std::byte *oldState, std::byte *newState,
                                     CarryResult &result, const LifecycleCall &call) const {
  const auto run = [&](void (*hook)(Ctx *), std::byte *state) {
    Ctx ctx = now;
    ctx.state = state;
    ctx.inCopyCode = 1;
    return hook == nullptr || call(hook, ctx);
  };
  if (!run(match_.oldApp().exit, oldState))
    return Taken::ExitFailed;
  apply(oldState, newState, result);
  run(match_.newApp().settle, newState);
  const bool whole = run(match_.newApp().reinit, newState);
  run(match_.newApp().settle, newState); // FB_Reinit may have written
  return whole ? Taken::Whole : Taken::ReinitFailed;
}

} // namespace stride::app
